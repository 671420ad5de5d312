#include "app/pipeline/run_job.hpp"

namespace blendwright {}
