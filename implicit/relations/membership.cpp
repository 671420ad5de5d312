#include "implicit/relations/membership.hpp"

#include <array>
#include <cmath>

#include "implicit/relations/box_search.hpp"
#include "kernel/base/number_text.hpp"

namespace blendwright {
namespace {

using detail::Half;
using Mode = MembershipOptions::Mode;

/// Enough to find or exclude an outside next to a surface that is smooth at the scale of the tolerance.
constexpr std::size_t boxes_to_confirm = 400;

Place by_sign(double lo, double hi) {
  return lo > 0.0 ? Place::inside : hi < 0.0 ? Place::outside : Place::boundary;
}

/// The point with what is known of the field there.
struct At {
  Vec3 point;
  double phi;
  double slope;  ///< |grad phi|
  Vec3 inward;   ///< grad phi
};

/// The point's box of half size `length`.
Box around(const Vec3& p, double length) { return {p - Vec3::Constant(length), p + Vec3::Constant(length)}; }

Place place_of(const Half& solid, const At& at, const MembershipOptions& options) {
  switch (options.mode) {
    case Mode::value:
      return by_sign(at.phi - options.tolerance, at.phi + options.tolerance);
    case Mode::length: {
      const Range exact = solid.psi(solid.field->range({at.point, at.point}));
      const double reach = options.tolerance * at.slope;
      return by_sign(std::min(exact.lo, at.phi) - reach, std::max(exact.hi, at.phi) + reach);
    }
    case Mode::guaranteed:
      break;
  }
  const Box box = around(at.point, options.tolerance);
  const Range zero = solid.psi(solid.field->range(box)), first = solid.psi(solid.field->linear(box).range());
  return by_sign(std::max(zero.lo, first.lo), std::min(zero.hi, first.hi));
}

/// What is within `length` of the point: an outside is looked for where the field falls fastest, then by
/// search. With `strictly` only a proof excludes it.
bool meets_outside(const Half& solid, const At& at, double length, bool strictly) {
  if (at.phi < 0.0) return true;
  if (at.slope > 0.0 && solid.psi(solid.field->value(at.point - length / at.slope * at.inward)) < 0.0)
    return true;
  const std::array outside{Half{solid.field, true}};
  const Answer none =
      detail::find_common_point(
          outside, around(at.point, length),
          {.tolerance = std::max(1e-3 * length, 1e-300), .max_boxes = boxes_to_confirm, .domain = {}}, {})
          .proof.answer;
  return none == Answer::refuted || (strictly && none == Answer::undecided);
}

/// The tolerance as a length.
double length_of(const At& at, const MembershipOptions& options) {
  return options.mode == Mode::value && at.slope > 0.0 ? options.tolerance / at.slope : options.tolerance;
}

void check(std::span<const Vec3> points, const MembershipOptions& options) {
  if (!(options.tolerance >= 0.0) || !std::isfinite(options.tolerance))
    throw InputError("tolerance", "is " + number_text(options.tolerance) + ", must be >= 0");
  for (std::size_t i = 0; i < points.size(); ++i)
    if (!points[i].allFinite())
      throw InputError("points", "has a number that is not finite in point " + std::to_string(i));
}

}  // namespace

std::string_view name(Place place) {
  constexpr std::array<std::string_view, 3> names{"outside", "boundary", "inside"};
  return names[static_cast<std::size_t>(place)];
}

std::vector<Membership> membership(const ScalarField& solid, std::span<const Vec3> points,
                                   const MembershipOptions& options) {
  check(points, options);
  const Half half{&solid};
  const FieldValues f = solid.evaluate(Order::gradient, points);
  std::vector<Membership> found(points.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Vec3 inward = half.sign() * f.gradient(i);
    const At at{points[i], half.psi(f.value(i)), inward.norm(), inward};
    Membership& m = found[i];
    m.phi = at.phi;
    m.belongs = at.phi >= 0.0;
    m.distance = at.slope > 0.0 ? std::abs(at.phi) / at.slope : std::numeric_limits<double>::infinity();
    m.place = place_of(half, at, options);
    if (options.confirm && m.place == Place::boundary && options.tolerance > 0.0 &&
        !meets_outside(half, at, length_of(at, options), options.mode == Mode::guaranteed))
      m.place = Place::inside;
  }
  return found;
}

}  // namespace blendwright
