#pragma once
// Rows of the family tables (primaries, magnitude rules, exporters, checks, verbs). The job reader, `list`,
// --help, the schema, the documentation and the parametrised tests all read these rows, in their order.
#include <limits>
#include <string_view>

namespace blendwright {

/// One numeric parameter of a row. Its value must satisfy min < value <= max (min itself is allowed when
/// `min_allowed`). A NaN fallback means that the parameter is required.
struct ParamInfo {
  std::string_view name;         ///< job key; ends in _deg for degrees
  std::string_view description;  ///< one phrase, with the symbol used in the row's equation
  double min = 0.0;
  double max = std::numeric_limits<double>::max();
  bool min_allowed = false;
  double fallback = std::numeric_limits<double>::quiet_NaN();
};

}  // namespace blendwright
