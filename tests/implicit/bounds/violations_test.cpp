// Bounds are never violated: 10^7 random pairs of a box and a point per family of nodes when
// BLENDWRIGHT_LONG is set, a share of them else; and a checker that would see it.
#include <gtest/gtest.h>

#include <chrono>
#include <cstdlib>
#include <iostream>

#include "implicit/scene/scene.hpp"
#include "tests/implicit/bounds/narrow_ops.hpp"
#include "tests/implicit/bounds/random_boxes.hpp"
#include "tests/implicit/support/random_scene.hpp"

namespace blendwright::test {
namespace {

std::vector<const NodeKind*> kinds_of(NodeFamily family) {
  std::vector<const NodeKind*> list;
  for (const NodeKind* kind : node_kinds())
    if (kind->family == family) list.push_back(kind);
  return list;
}

/// The scene's solid somewhere else, turned and in another size. Boxes follow it.
struct Placed {
  double scale = 1.0;
  Vec3 move = Vec3::Zero();
  Placed() = default;
  Placed(Rng& rng, SceneSpec& scene) {
    scale = log_uniform(rng, 1e-4, 1e4);
    const double far = scale * log_uniform(rng, 1e-3, 1e5);
    for (int i = 0; i < 3; ++i) move[i] = uniform(rng, -far, far);
    Vec3 axis(uniform(rng, -1.0, 1.0), uniform(rng, -1.0, 1.0), uniform(rng, -1.0, 1.0));
    axis += Vec3::Unit(0) * 1e-3;
    axis.normalize();
    scene.nodes.push_back(part("placed", "place",
                               {{"of", ref(scene.solid)},
                                {"move", std::vector<double>{move.x(), move.y(), move.z()}},
                                {"axis", std::vector<double>{axis.x(), axis.y(), axis.z()}},
                                {"turn_deg", uniform(rng, -180.0, 180.0)},
                                {"scale", scale}}));
    scene.solid = "placed";
  }
  [[nodiscard]] Box of(const Box& box) const { return {move + scale * box.lo, move + scale * box.hi}; }
};

/// An offset of a random solid. Those by balls are mostly of solids with a closed form: of others each value
/// is a search.
SceneSpec offset_scene(Rng& rng, const NodeKind& kind, bool searched) {
  const bool any = kind.name == "iso_offset" || kind.name == "normal_offset" || searched;
  const bool twice = kind.name == "opening" || kind.name == "closing";  // of exact distances only
  constexpr std::string_view closed[] = {"sphere", "torus", "box", "quadric", "ellipsoid_quadric"};
  const std::vector<const NodeKind*> solids = kinds_of(NodeFamily::solid);
  const NodeKind* of =
      any ? solids[static_cast<std::size_t>(integer(rng, 0, static_cast<int>(solids.size()) - 1))]
          : find_node_kind(closed[integer(rng, 0, twice ? 2 : 4)]);
  SceneSpec scene = random_scene_of(rng, *of);
  Values values{{"of", ref(scene.solid)}};
  for (const NodeParam& p : kind.params) {
    const std::string key(p.info.name);
    if (key == "value" || key == "distance") values[key] = uniform(rng, -0.4, 0.4);
    if (key == "inner" || key == "outer" || key == "radius") values[key] = uniform(rng, 0.05, 0.3);
    if (key == "tolerance") values[key] = log_uniform(rng, 1e-3, 1e-2);
  }
  scene.nodes.push_back(part("offset", std::string(kind.name), std::move(values)));
  scene.solid = "offset";
  return scene;
}

/// One random scene of a kind, a few boxes, their points.
void check_scene(const NodeKind& kind, std::uint64_t seed, BoundCount& count) {
  Rng rng(seed);
  const bool offset = kind.family == NodeFamily::offset, searched = offset && seed % 2000 == 0;
  SceneSpec scene = offset ? offset_scene(rng, kind, searched) : random_scene_of(rng, kind);
  const Placed placed = uniform(rng, 0.0, 1.0) < 0.3 ? Placed(rng, scene) : Placed();
  const std::shared_ptr<const Tape> tape = build_tape(scene);
  const Box where{Vec3::Constant(-2.0), Vec3::Constant(2.0)};
  const std::string what = std::string(kind.name) + ", seed " + std::to_string(seed);
  for (int i = searched ? 7 : 0; i < 8; ++i) {
    const Box box = placed.of(random_box(rng, where));
    check_bounds(*tape, box, points_in(rng, box, searched ? 1 : 15), what, count);
  }
}

BoundCount check_family(NodeFamily family, std::size_t pairs) {
  const std::vector<const NodeKind*> kinds = kinds_of(family);
  BoundCount count;
  for (std::uint64_t seed = 1; count.pairs < pairs; ++seed)
    check_scene(*kinds[seed % kinds.size()], seed, count);
  return count;
}

class Family : public ::testing::TestWithParam<NodeFamily> {};

TEST_P(Family, BoundsHoldEveryValue) {
  const bool whole = std::getenv("BLENDWRIGHT_LONG") != nullptr;
  const auto start = std::chrono::steady_clock::now();
  const BoundCount count = check_family(GetParam(), whole ? 10'000'000 : 300'000);
  const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  std::cout << name(GetParam()) << ": " << count.pairs << " pairs in " << count.boxes << " boxes, "
            << count.violations() << " violations (range " << count.range << ", linear " << count.linear
            << " + " << count.linear_range << " + " << count.wider << ", within " << count.within
            << "); first order in " << 100 * count.first_order / count.boxes << " % of the boxes; " << seconds
            << " s\n";
  for (const std::string& example : count.examples) ADD_FAILURE() << example;
  EXPECT_EQ(count.violations(), 0u);
}

std::string title(const ::testing::TestParamInfo<NodeFamily>& info) {
  std::string text(name(info.param));
  std::replace(text.begin(), text.end(), ' ', '_');
  return text;
}

INSTANTIATE_TEST_SUITE_P(Bounds, Family,
                         ::testing::Values(NodeFamily::distance, NodeFamily::distance_operation,
                                           NodeFamily::field, NodeFamily::solid, NodeFamily::offset,
                                           NodeFamily::operation, NodeFamily::conversion,
                                           NodeFamily::placement),
                         title);

/// Few pairs are enough for what is wrong at a corner.
BoundCount count_of(Narrow which) {
  const std::shared_ptr<const Tape> tape = narrow_tape(which);
  BoundCount count;
  Rng rng(7);
  for (int i = 0; i < 2000; ++i) {
    const Box box = random_box(rng, {Vec3::Constant(-2.0), Vec3::Constant(2.0)});
    check_bounds(*tape, box, points_in(rng, box, 15), "planted", count);
  }
  return count;
}

TEST(Violation, IsNotSeenInTrueBounds) { EXPECT_EQ(count_of(Narrow::none).violations(), 0u); }
TEST(Violation, IsSeenInARangeThatIsShortByOneBillionth) { EXPECT_GT(count_of(Narrow::range).range, 100u); }
TEST(Violation, IsSeenInALinearRestThatIsShortByOneBillionth) {
  const BoundCount count = count_of(Narrow::rest);
  EXPECT_GT(count.linear, 100u);
  EXPECT_EQ(count.range, 0u);
}
TEST(Violation, IsSeenInALinearBoundThatIsTiltedByOneBillionth) {
  EXPECT_GT(count_of(Narrow::slope).linear, 100u);
}
TEST(Violation, IsSeenInAShortcutThatIsTakenTooEarly) { EXPECT_GT(count_of(Narrow::shortcut).within, 10u); }

}  // namespace
}  // namespace blendwright::test
