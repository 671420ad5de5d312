#pragma once
#include <string>

#include "app/pipeline/compare_job.hpp"

namespace blendwright {

/// Both ways, with their places, as JSON.
[[nodiscard]] std::string compare_report_json(const CompareResult& result);

}  // namespace blendwright
