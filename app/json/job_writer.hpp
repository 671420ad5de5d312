#pragma once
// A job's text with other values: how fits and editors save what they changed.
#include <filesystem>
#include <string>

#include "app/pipeline/job.hpp"

namespace blendwright {

/// `text` with the sides, trimlines, correspondence and shape of `changed.blends` (same names as in the
/// text), each written in the keys that a person would use; what did not change, comments, order and layout
/// stay as they are (comments inside a list whose length changes go with it). Reading the result gives the
/// same blends to the last bit; what has no effect is not written (the anchor of another mode, coefficients
/// of the fourth order when a side asks for G2). Angles are in degrees, or in radians (keys ending in _rad)
/// where no number of degrees is read as exactly this angle. Throws InputError when `text` is not a readable
/// job or a value cannot stand in one (a factor of 0, a number that is not finite), std::logic_error when the
/// blends are not those of the text.
[[nodiscard]] std::string job_text(const std::string& text, const JobSpec& changed);

/// `text` of a job file in the folder `from` for a file in `to`: the relative paths in it name the same
/// files.
[[nodiscard]] std::string moved_job_text(const std::string& text, const std::filesystem::path& from,
                                         const std::filesystem::path& to);

}  // namespace blendwright
