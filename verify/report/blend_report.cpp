#include "verify/report/blend_report.hpp"

namespace blendwright {}
