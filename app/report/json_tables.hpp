#pragma once
// Private: tables of a page from the objects of a JSON report, so that both tell the same figures.
#include "app/json/json_value.hpp"
#include "app/report/page.hpp"

namespace blendwright::detail {

/// "12", "3.14159" (six digits), "yes", "none", "text", "1, 2, 3", "(x, y, z)" for a list under "point".
[[nodiscard]] std::string cell_text(const JsonValue& value);

/// A member of an object that is known to have it; null otherwise.
[[nodiscard]] const JsonValue& member(const JsonValue& object, std::string_view key);

/// One row per member that is no object and no list of objects: what it is called, its value and, where
/// `object_name` is an object of the job's report, what it means.
[[nodiscard]] PageTable member_table(std::string caption, const JsonValue& object,
                                     std::string_view object_name = "");

}  // namespace blendwright::detail
