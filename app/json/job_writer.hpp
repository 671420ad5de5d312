#pragma once
// A job's text with other values: how fits and editors save what they changed.
#include <string>

#include "app/pipeline/job.hpp"

namespace blendwright {

/// `text` with the sides, trimlines, correspondence and shape of `changed.blends` (same names as in the
/// text), each written in the keys that a person would use; what did not change, comments, order and layout
/// stay as they are. Reading the result gives the same blends to the last bit. Throws InputError when `text`
/// is not a readable job, std::logic_error when the blends are not those of the text.
[[nodiscard]] std::string job_text(const std::string& text, const JobSpec& changed);

}  // namespace blendwright
