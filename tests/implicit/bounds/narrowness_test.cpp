// Linear bounds are narrow: what they leave shrinks with the square of the box where a field is smooth.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <iostream>

#include "implicit/scene/scene.hpp"
#include "tests/implicit/bounds/random_boxes.hpp"
#include "tests/implicit/support/random_scene.hpp"

namespace blendwright::test {
namespace {

double width(Range r) { return r.hi - r.lo; }

double median(std::vector<double> list) {
  if (list.empty()) return 0.0;
  const auto middle = list.begin() + static_cast<std::ptrdiff_t>(list.size() / 2);
  std::nth_element(list.begin(), middle, list.end());
  return *middle;
}

/// A point of the surface, if one lies between two random points near the scene.
std::optional<Vec3> surface_point(const Tape& tape, Level level, Rng& rng) {
  const auto phi = [&](const Vec3& p) {
    const double x[] = {p.x()}, y[] = {p.y()}, z[] = {p.z()};
    double f = 0.0;
    tape.evaluate(Order::value, {x, y, z}, {&f, 1});
    return inside(level, f);
  };
  const auto draw = [&] {
    return Vec3(uniform(rng, -2.0, 2.0), uniform(rng, -2.0, 2.0), uniform(rng, -2.0, 2.0));
  };
  Vec3 in = draw(), out = draw();
  for (int i = 0; i < 30 && !(phi(in) > 0.0); ++i) in = draw();
  for (int i = 0; i < 30 && !(phi(out) < 0.0); ++i) out = draw();
  if (!(phi(in) > 0.0) || !(phi(out) < 0.0)) return std::nullopt;
  for (int i = 0; i < 50; ++i) (phi(0.5 * (in + out)) > 0.0 ? in : out) = 0.5 * (in + out);
  return in;
}

/// What has ranges only: sweeps, offsets that search.
bool has_ranges_only(const NodeKind& kind) {
  return kind.family == NodeFamily::profile || kind.family == NodeFamily::offset ||
         kind.name.starts_with("sweep");
}
bool has_ranges_only(const SceneSpec& scene) {
  return std::any_of(scene.nodes.begin(), scene.nodes.end(), [](const NodeSpec& node) {
    const NodeKind& kind = *find_node_kind(node.kind);
    return kind.family != NodeFamily::profile && has_ranges_only(kind);
  });
}

/// Medians over random scenes of a kind and places on their surfaces: what is left in a box of size h, as a
/// share of the range, and how much less that is in one of half the size.
struct Narrowness {
  double share, halving;
  int places = 0;
};
Narrowness narrowness(const NodeKind& kind, double h) {
  std::vector<double> shares, halvings;
  for (std::uint64_t seed = 1; seed <= 400 && shares.size() < 40; ++seed) {
    Rng rng(seed);
    const SceneSpec scene = random_scene_of(rng, kind);
    if (has_ranges_only(scene)) continue;
    const std::shared_ptr<const Tape> tape = build_tape(scene);
    const std::optional<Vec3> at = surface_point(*tape, build_scene(scene).field.level(), rng);
    if (!at) continue;
    const auto box = [&](double size) {
      return Box{*at - Vec3::Constant(0.5 * size), *at + Vec3::Constant(0.5 * size)};
    };
    const double whole = width(tape->linear(box(h)).rest), half = width(tape->linear(box(0.5 * h)).rest);
    const double range = width(tape->range(box(h)));
    if (!std::isfinite(range) || range <= 0.0) continue;
    shares.push_back(whole / range);
    halvings.push_back(half > 0.0 ? whole / half : 4.0);
  }
  return {median(shares), median(halvings), static_cast<int>(shares.size())};
}

TEST(LinearBound, LeavesAQuarterInABoxOfHalfTheSize) {
  std::cout
      << "kind: share of the range that is left in boxes of size 2^-5, at a half of that size (places)\n";
  for (const NodeKind* kind : node_kinds()) {
    if (has_ranges_only(*kind)) continue;
    const Narrowness n = narrowness(*kind, 0x1p-5);
    std::printf("  %-30s %7.4f  1/%.2f  (%d)\n", std::string(kind->name).c_str(), n.share, n.halving,
                n.places);
    if (n.places < 10) continue;  // a scene of the kind has no surface near by
    // Exact are those that leave rounding only. Random scenes are not smooth everywhere: of second order is
    // the median, 4 but for terms of third order.
    EXPECT_TRUE(n.share < 1e-9 || n.halving > 3.0) << kind->name;
    EXPECT_LT(n.share, 0.6) << kind->name;
  }
}

}  // namespace
}  // namespace blendwright::test
