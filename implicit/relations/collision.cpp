#include "implicit/relations/collision.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "implicit/relations/box_search.hpp"
#include "implicit/relations/contact_point.hpp"

namespace blendwright {
namespace {

using detail::ContactPoint;
using detail::Half;

void set_place(Collision& c, const ContactPoint& at) {
  c.point = at.point;
  c.normal = at.normal();
  if (c.normal && std::isfinite(at.gap())) c.gap = at.gap();
}

Collision collision_of(std::span<const Half, 2> halves, detail::Found found, double reach) {
  Collision c;
  Proof& proof = found.proof;
  c.contact = proof.answer == Answer::proven    ? Contact::disjoint
              : proof.answer == Answer::refuted ? Contact::contact
                                                : Contact::undecided;
  c.boxes = proof.boxes;
  c.undecided = proof.undecided;
  c.cells = std::move(proof.cells);

  std::optional<ContactPoint> at = found.nearest;
  if (c.contact == Contact::contact) {
    // The deepest place near the witness, when that is proven common too.
    const auto deepest = detail::contact_point(halves[0], halves[1], *proof.witness, reach);
    at = deepest && deepest->settled && detail::common(halves, deepest->point)
             ? deepest
             : detail::values_at(halves[0], halves[1], *proof.witness);
  } else if (c.contact == Contact::undecided && !at) {
    const auto near = detail::contact_point(halves[0], halves[1], proof.undecided->centre(), reach);
    if (near && near->settled) at = near;
  }
  if (at) set_place(c, *at);
  return c;
}

Collision decide(const ScalarField& first, const ScalarField& second, const SearchOptions& options,
                 const Progress& progress, const std::optional<Vec3>& start, std::optional<int> depth_axis) {
  const std::array<Half, 2> halves{Half{&first}, Half{&second}};
  const std::optional<Box> domain = detail::search_domain(halves, options);
  if (!domain) {
    Collision apart;
    apart.contact = Contact::disjoint;
    return apart;
  }
  return collision_of(halves,
                      detail::find_common_point(halves, *domain, options, progress, start, depth_axis),
                      domain->size().maxCoeff());
}

/// The middle of what both bounds have in common, or of the gap between them; of the finite ends.
Vec3 between(const std::optional<Box>& first, const std::optional<Box>& second) {
  const Box everything{Vec3::Constant(-std::numeric_limits<double>::infinity()),
                       Vec3::Constant(std::numeric_limits<double>::infinity())};
  const Box a = first.value_or(everything), b = second.value_or(everything);
  Vec3 middle = Vec3::Zero();
  for (int k = 0; k < 3; ++k) {
    const double lo = std::max(a.lo[k], b.lo[k]), hi = std::min(a.hi[k], b.hi[k]);
    if (std::isfinite(lo) && std::isfinite(hi))
      middle[k] = 0.5 * (lo + hi);
    else if (std::isfinite(lo) || std::isfinite(hi))
      middle[k] = std::isfinite(lo) ? lo : hi;
  }
  return middle;
}

}  // namespace

std::string_view name(Contact contact) {
  constexpr std::array<std::string_view, 3> names{"disjoint", "contact", "undecided"};
  return names[static_cast<std::size_t>(contact)];
}

Collision collide(const ScalarField& first, const ScalarField& second, const SearchOptions& options,
                  const std::optional<Vec3>& start, const Progress& progress) {
  return decide(first, second, options, progress, start, std::nullopt);
}

Collision with_nearest_place(Collision collision, const ScalarField& first, const ScalarField& second) {
  if (collision.contact != Contact::disjoint || collision.point) return collision;
  const Half a{&first}, b{&second};
  const Vec3 start = between(first.bounds(), second.bounds());
  double reach = 0.0;
  for (const auto& bounds : {first.bounds(), second.bounds()})
    if (bounds && bounds->finite())
      reach = std::max({reach, bounds->size().maxCoeff(), (bounds->centre() - start).norm()});
  const auto at = reach > 0.0 ? detail::contact_point(a, b, start, reach) : std::nullopt;
  if (at && at->settled && at->v1 < 0.0 && at->v2 < 0.0) set_place(collision, *at);
  return collision;
}

Collision collide_projected(const ScalarField& first, const ScalarField& second, int axis,
                            const SearchOptions& options, const Progress& progress) {
  if (axis < 0 || axis > 2)
    throw InputError("axis", "is " + std::to_string(axis) + ", must be 0, 1 or 2 (along x, y or z)");
  return decide(first, second, options, progress, std::nullopt, axis);
}

}  // namespace blendwright
