#include "kernel/base/units.hpp"

namespace blendwright {

const char* name(Continuity c) {
  switch (c) {
    case Continuity::none:
      return "none";
    case Continuity::G0:
      return "G0";
    case Continuity::G1:
      return "G1";
    case Continuity::G2:
      return "G2";
  }
  return "none";
}

const char* name(LengthUnit u) {
  switch (u) {
    case LengthUnit::millimetre:
      return "mm";
    case LengthUnit::centimetre:
      return "cm";
    case LengthUnit::metre:
      return "m";
    case LengthUnit::inch:
      return "in";
  }
  return "mm";
}

}  // namespace blendwright
