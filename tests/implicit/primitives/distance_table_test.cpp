// The rows of distance primitives: complete, and what they refuse.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <set>

#include "tests/implicit/primitives/made_primitive.hpp"
#include "tests/implicit/support/scene_parts.hpp"

namespace blendwright {
namespace {

using namespace test;
using ::testing::HasSubstr;
using ::testing::StartsWith;
using List = std::vector<double>;
using Rows = std::vector<std::vector<double>>;

const PrimitiveSample* sample_of(std::string_view kind) {
  for (const PrimitiveSample& s : primitive_samples())
    if (solid_of(s.scene).kind == kind) return &s;
  return nullptr;
}

/// The sample's scene with one value of its solid changed.
SceneSpec with(SceneSpec scene, std::string_view key, NodeValue value) {
  for (NodeSpec& node : scene.nodes)
    if (node.name == scene.solid) node.values[std::string(key)] = std::move(value);
  return scene;
}

MadePrimitive made(const char* kind, Values values) {
  return make_primitive(scene_of({part("case", kind, std::move(values))}));
}

TEST(DistanceRows, AreComplete) {
  std::set<std::string_view> names;
  for (const NodeKind& row : distance_kinds()) {
    SCOPED_TRACE(row.name);
    EXPECT_EQ(row.family, NodeFamily::distance);
    EXPECT_FALSE(row.equation.empty() || row.description.empty() || row.source.empty());
    EXPECT_TRUE(names.insert(row.name).second);
    std::set<std::string_view> keys;
    for (const NodeParam& p : row.params) {
      EXPECT_TRUE(keys.insert(p.info.name).second) << p.info.name;
      EXPECT_FALSE(p.info.description.empty()) << p.info.name;
    }
    for (const auto text : {row.equation, row.description, row.source})
      for (const char c : text) EXPECT_TRUE(c >= ' ' && c <= '~') << text;
  }
  for (const char* kind :
       {"plane", "half_space", "slab", "lp_metric", "superquadric", "asymmetric_superellipsoid",
        "generalized_distance", "segment_skeleton", "capsule_gauge"})
    EXPECT_TRUE(names.contains(kind)) << kind;
}

TEST(DistanceRows, MakeNodesFromTheirSamples) {
  for (const NodeKind& row : distance_kinds()) {
    SCOPED_TRACE(row.name);
    const PrimitiveSample* sample = sample_of(row.name);
    ASSERT_NE(sample, nullptr);
    const MadePrimitive node = make_primitive(sample->scene);
    EXPECT_TRUE(node.tape) << (node.problems.empty() ? "" : node.problems[0].message);
    EXPECT_EQ(node.node.level, Level::one);
    ASSERT_TRUE(node.tape);
    EXPECT_EQ(node.tape->size(), 1u);  // a primitive is one step
  }
}

TEST(DistanceRows, RefuseNumbersOutOfTheirBounds) {
  int seen = 0;
  for (const NodeKind& row : distance_kinds()) {
    const PrimitiveSample* sample = sample_of(row.name);
    ASSERT_NE(sample, nullptr) << row.name;
    for (const NodeParam& p : row.params) {
      if (p.type != NodeParam::Type::number && p.type != NodeParam::Type::integer) continue;
      SCOPED_TRACE(std::string(row.name) + " " + std::string(p.info.name));
      List wrong{std::nan(""), std::numeric_limits<double>::infinity()};
      if (p.info.min > -std::numeric_limits<double>::max())
        wrong.push_back(p.info.min_allowed ? p.info.min - 0.01 * (1.0 + std::abs(p.info.min)) : p.info.min);
      if (p.info.max < std::numeric_limits<double>::max()) wrong.push_back(p.info.max * 1.01);
      for (const double value : wrong) {
        const MadePrimitive node = make_primitive(with(sample->scene, p.info.name, value));
        ASSERT_EQ(node.problems.size(), 1u) << value;
        EXPECT_EQ(node.problems[0].where, p.info.name);
        EXPECT_THAT(node.problems[0].message, StartsWith("InvalidParameter: is "));
        EXPECT_THAT(node.problems[0].message, HasSubstr("must be"));
        ++seen;
      }
    }
  }
  EXPECT_GT(seen, 30);
}

TEST(DistanceRows, RefuseLengthsWhoseInverseIsNoUse) {
  const MadePrimitive tiny = made("slab", {{"normal", List{0, 0, 1}}, {"a", 1e-200}});
  ASSERT_EQ(tiny.problems.size(), 1u);
  EXPECT_EQ(tiny.problems[0].where, "a");
  EXPECT_EQ(tiny.problems[0].message, "InvalidParameter: is 1e-200, must be >= 1e-30");
  EXPECT_TRUE(made("slab", {{"normal", List{0, 0, 1}}, {"a", 1e-30}}).problems.empty());
}

TEST(DistanceRows, RefuseHalfAxesThatAreNotPositive) {
  const MadePrimitive node = made("asymmetric_superellipsoid",
                                  {{"x", List{1, 2}}, {"y", List{1, -2}}, {"z", List{0, 2}}, {"n", 2.0}});
  ASSERT_EQ(node.problems.size(), 2u);
  EXPECT_EQ(node.problems[0].where, "y/1");
  EXPECT_EQ(node.problems[0].message, "InvalidParameter: is -2, must be > 0");
  EXPECT_EQ(node.problems[1].where, "z/0");
}

TEST(DistanceRows, RefusePointsBeyondAllNumbers) {
  const MadePrimitive node =
      made("segment_skeleton", {{"p0", List{0, 1e200, 0}}, {"p1", List{1, 0, 0}}, {"radius", 1.0}});
  ASSERT_EQ(node.problems.size(), 1u);
  EXPECT_EQ(node.problems[0].where, "p0/1");
}

TEST(Normals, ThatAreZeroAreRefused) {
  for (const char* kind : {"plane", "half_space", "slab"}) {
    const MadePrimitive node = made(kind, {{"normal", List{0, 0, 0}}, {"a", 1.0}});
    ASSERT_EQ(node.problems.size(), 1u) << kind;
    EXPECT_EQ(node.problems[0].message, "InvalidParameter: is the zero vector, must have a direction");
  }
  const MadePrimitive node =
      made("generalized_distance", {{"normals", Rows{{1, 0, 0}, {0, 0, 0}, {0, 0, 1}}}, {"n", 2.0}});
  ASSERT_EQ(node.problems.size(), 1u);
  EXPECT_EQ(node.problems[0].where, "normals/1");
}

TEST(Normals, OfAnotherLengthAreNormalisedWithAWarning) {
  const MadePrimitive tilted = made("plane", {{"normal", List{3, 0, 4}}, {"a", 2.5}});
  ASSERT_EQ(tilted.warnings.size(), 1u);
  EXPECT_EQ(tilted.warnings[0].where, "normal");
  EXPECT_EQ(tilted.warnings[0].message, "has length 5 and was normalised to 1");
  EXPECT_NEAR(value_at(*tilted.tape, {0.6, 0, 0.8}), 0.4, 1e-15);
  EXPECT_TRUE(made("plane", {{"normal", List{0.6, 0, 0.8 + 1e-10}}, {"a", 2.5}}).warnings.empty());
  EXPECT_EQ(made("plane", {{"normal", List{0.6, 0, 0.8 + 1e-8}}, {"a", 2.5}}).warnings.size(), 1u);
  EXPECT_NEAR(value_at(*made("slab", {{"normal", List{0, 1e-320, 0}}, {"a", 2.0}}).tape, {0, 3, 0}), 1.5,
              1e-15);

  const MadePrimitive ten =
      made("generalized_distance", {{"normals", Rows{{1, 0, 0}, {0, 2, 0}, {0, 0, 1}}}, {"n", 2.0}});
  ASSERT_EQ(ten.warnings.size(), 1u);
  EXPECT_EQ(ten.warnings[0].message, "are not all of length 1 (number 1 has length 2); 1 of 3 normalised");
  EXPECT_NEAR(value_at(*ten.tape, {0, 3, 4}), 5.0, 1e-14);
}

TEST(GeneralizedDistance, IsBoundedIfItsNormalsSpanSpace) {
  const auto positive = [](const Rows& normals) {
    return made("generalized_distance", {{"normals", normals}, {"n", 4.0}}).node.positive;
  };
  EXPECT_TRUE(positive({{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}));
  EXPECT_TRUE(positive({{1, 0, 0}, {0, 1, 0}, {1, 1, 2e-6}}));
  EXPECT_FALSE(positive({{1, 0, 0}, {0, 1, 0}, {1, 1, 5e-7}}));
  EXPECT_FALSE(positive({{1, 0, 0}, {0, 1, 0}, {1, -1, 0}, {2, 1, 0}}));
  EXPECT_FALSE(positive({{1, 0, 0}, {-1, 0, 0}, {1, 1e-8, 1e-8}}));
}

}  // namespace
}  // namespace blendwright
