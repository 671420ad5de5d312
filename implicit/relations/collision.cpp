#include "implicit/relations/collision.hpp"

#include <array>
#include <cmath>

#include "implicit/relations/box_search.hpp"

namespace blendwright {
namespace {

using detail::ContactPoint;
using detail::Half;

/// From the first solid to the second: gradients point inward.
std::optional<Vec3> normal_of(const ContactPoint& at) {
  const double l1 = at.g1.norm(), l2 = at.g2.norm();
  if (!(l1 > 0.0) || !(l2 > 0.0) || !std::isfinite(l1) || !std::isfinite(l2)) return std::nullopt;
  const Vec3 mean = at.g2 / l2 - at.g1 / l1;
  const double length = mean.norm();
  return length > 1e-3 ? mean / length : Vec3(-at.g1 / l1);
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
  if (!at) return c;
  c.point = at->point;
  c.normal = normal_of(*at);
  if (c.normal && std::isfinite(at->gap())) c.gap = at->gap();
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

}  // namespace

std::string_view name(Contact contact) {
  constexpr std::array<std::string_view, 3> names{"disjoint", "contact", "undecided"};
  return names[static_cast<std::size_t>(contact)];
}

Collision collide(const ScalarField& first, const ScalarField& second, const SearchOptions& options,
                  const std::optional<Vec3>& start, const Progress& progress) {
  return decide(first, second, options, progress, start, std::nullopt);
}

Collision collide_projected(const ScalarField& first, const ScalarField& second, int axis,
                            const SearchOptions& options, const Progress& progress) {
  if (axis < 0 || axis > 2)
    throw InputError("axis", "is " + std::to_string(axis) + ", must be 0, 1 or 2 (along x, y or z)");
  return decide(first, second, options, progress, std::nullopt, axis);
}

}  // namespace blendwright
