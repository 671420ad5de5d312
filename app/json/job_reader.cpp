#include "app/json/job_reader.hpp"

namespace blendwright {}
