#include "parametric/shape_fit/shape_fit.hpp"

#include <stdexcept>

namespace blendwright {

const char* name(const FitObjective& objective) {
  constexpr std::array names{"thin plate",        "curvature variation", "rolling ball", "pass through",
                             "largest curvature", "clearance",           "no fold",      "scanned points"};
  return names[objective.index()];
}

ShapeFitResult fit_shape(const Trimline&, const Trimline&, const BlendSpec&, double, const ShapeFitOptions&,
                         const Progress&, const FitStep&) {
  throw std::logic_error("not there yet");
}

ShapeFitResult fit_literal_shape(const EndCondition&, const EndCondition&, const BlendShape&,
                                 const ShapeFitOptions&, const Progress&, const FitStep&) {
  throw std::logic_error("not there yet");
}

}  // namespace blendwright
