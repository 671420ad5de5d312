#pragma once
// What a fit is about: which unknowns there are, where they start, what they are called, and the spec for any
// values of them. Private to this module.
#include <memory>
#include <string>
#include <variant>
#include <vector>

#include "parametric/shape_fit/blend_model.hpp"
#include "parametric/shape_fit/shape_fit.hpp"

namespace blendwright::detail {

/// Either two trimlines with a spec, or two literal ends with a shape.
struct FitInput {
  std::optional<std::array<Trimline, 2>> lines{};
  std::optional<std::array<EndCondition, 2>> ends{};
  BlendSpec spec{};
  double tolerance = 1e-6;
  [[nodiscard]] Blend made(const BlendSpec& s) const;
};

/// One entry of x, between the solver's number and the user's: value = offset + scale x, or the root
/// of a shape unknown.
struct Unknown {
  std::string name{};
  enum class Kind { root, minus_c, d, scaled } kind = Kind::scaled;
  double scale = 1.0;
  Interval bounds{};  ///< of x
  double offset = 0.0;
  [[nodiscard]] double value(double x) const;
  [[nodiscard]] double slope(double x) const;  ///< d value / dx
  [[nodiscard]] Interval value_bounds() const;
};

struct FitProblem {
  FitInput input;
  BlendSpec start;  ///< as the unknowns can express it: laws at the unknowns' places, ...
  std::unique_ptr<BlendModel> model;
  std::vector<Unknown> unknowns;
  std::vector<double> x0;
  std::vector<double> scale;  ///< x of the model = scale * x of the solver
  std::vector<std::string> warnings;

  [[nodiscard]] BlendSpec spec(const double* x) const;  ///< x of the model
};

/// All problems at once, before anything is built. `order`: 4 or 6.
[[nodiscard]] std::vector<Problem> check_fit(const FitInput& input, const ShapeFitOptions& options);
/// Problems that need the start blend: points and obstacles too far off.
[[nodiscard]] std::vector<Problem> check_against(const Blend& start, const ShapeFitOptions& options);

[[nodiscard]] FitProblem fit_problem(FitInput input, const Blend& start, const ShapeFitOptions& options);

[[nodiscard]] int order_of(const FitInput& input);
[[nodiscard]] ShapeUnknown shape_unknown(const FitInput& input, const FitUnknowns& unknowns);

}  // namespace blendwright::detail
