#include "kernel/field/level.hpp"

namespace blendwright {

std::string_view name(Level level) {
  switch (level) {
    case Level::zero:
      return "zero level";
    case Level::one:
      return "one level";
    case Level::half:
      return "half level";
    case Level::function:
      return "function representation";
  }
  return "?";
}

}  // namespace blendwright
