// Every golden case of a solid, on the scalar, the vector and the derivative kernels.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>

#include "implicit/scene/scene.hpp"
#include "tests/support/golden_folder.hpp"
#include "tests/support/relation_golden.hpp"

namespace blendwright::test {
namespace {

/// The tolerances that the data come with: 1e-12 of a value, 1e-10 of a derivative, relative to max(1,
/// |value|).
bool agrees(double value, double golden, double relative, double size) {
  return std::abs(value - golden) <= relative * std::max(1.0, std::abs(size));
}

/// Results of all three orders, by the vector kernels and by the scalar ones, against one sample. Gradients
/// of distances at points with several feet are not in the data.
void expect_sample(const Tape& tape, const RelationSample& s) {
  const double x[] = {s.x().at(0)}, y[] = {s.x().at(1)}, z[] = {s.x().at(2)};
  for (const Order order : {Order::value, Order::gradient, Order::hessian})
    for (const bool scalar : {false, true}) {
      SCOPED_TRACE("order " + std::to_string(static_cast<int>(order)) + (scalar ? ", scalar" : ", vector"));
      std::vector<double> out(components(order));
      scalar ? tape.evaluate_scalar(order, {x, y, z}, out) : tape.evaluate(order, {x, y, z}, out);
      EXPECT_TRUE(agrees(out[0], s.value(), 1e-12, s.value())) << out[0] << " for " << s.value();
      if (order == Order::value) continue;
      ASSERT_NE(s.gradient(), nullptr);
      for (std::size_t i = 0; i < 3; ++i)
        EXPECT_TRUE(agrees(out[1 + i], s.gradient()->at(i), 1e-10, s.value()))
            << i << ": " << out[1 + i] << " for " << s.gradient()->at(i);
      const auto hessian = s.lists.find("hessian");
      if (order == Order::gradient || hessian == s.lists.end()) continue;
      const std::size_t place[] = {0, 4, 8, 1, 2, 5};  // of xx, yy, zz, xy, xz, yz in a row-major matrix
      for (std::size_t k = 0; k < 6; ++k)
        EXPECT_TRUE(agrees(out[4 + k], hessian->second.at(place[k]), 1e-10, s.value()))
            << k << ": " << out[4 + k] << " for " << hessian->second.at(place[k]);
    }
}

const std::vector<RelationCase>& golden() {
  static const std::vector<RelationCase> all = read_relation_golden(golden_folder());
  return all;
}

class GoldenSolids : public ::testing::TestWithParam<const char*> {};

TEST_P(GoldenSolids, AreReached) {
  std::size_t seen = 0;
  for (const RelationCase& c : golden()) {
    if (c.function != GetParam()) continue;
    SCOPED_TRACE(c.id);
    const Scene scene = build_scene(c.scene);
    EXPECT_EQ(scene.field.level(), Level::function);
    const auto tape = build_tape(c.scene);
    for (const RelationSample& s : c.samples) {
      SCOPED_TRACE(::testing::PrintToString(s.x()));
      expect_sample(*tape, s);
      ++seen;
    }
  }
  EXPECT_GE(seen, 8u);
}

INSTANTIATE_TEST_SUITE_P(Functions, GoldenSolids,
                         ::testing::Values("quadric", "perturbation", "freeform", "signed_distance_sphere",
                                           "signed_distance_ellipsoid", "signed_distance_torus",
                                           "signed_distance_box"));

/// The nearest point is X - f grad f, the gradient being a unit vector.
TEST(GoldenDistances, HaveTheirFeet) {
  std::size_t seen = 0;
  for (const RelationCase& c : golden()) {
    if (!c.function.starts_with("signed_distance_")) continue;
    SCOPED_TRACE(c.id);
    const Scene scene = build_scene(c.scene);
    for (const RelationSample& s : c.samples) {
      const Vec3 p(s.x()[0], s.x()[1], s.x()[2]);
      const FieldValues f = scene.field.evaluate(Order::gradient, std::span<const Vec3>(&p, 1));
      const Vec3 foot = p - f.value(0) * f.gradient(0);
      for (int i = 0; i < 3; ++i)
        EXPECT_NEAR(foot[i], s.lists.at("foot").at(static_cast<std::size_t>(i)), 1e-10);
      ++seen;
    }
  }
  EXPECT_GE(seen, 32u);
}

TEST(RelationGolden, ComparisonsRefuseWhatIsOff) {
  EXPECT_TRUE(agrees(2.0, 2.0 + 1.9e-12, 1e-12, 2.0));
  EXPECT_FALSE(agrees(2.0, 2.0 + 2.1e-12, 1e-12, 2.0));
  EXPECT_FALSE(agrees(1e-3, 1e-3 + 1.1e-12, 1e-12, 1e-3));
}

TEST(RelationGolden, HasEveryFunctionOfItsSchema) {
  std::set<std::string> seen;
  for (const RelationCase& c : golden()) seen.insert(c.function);
  EXPECT_EQ(seen, relation_functions());
  EXPECT_EQ(seen.size(), 33u);
}

/// A folder with one golden file of this text.
class Folder {
 public:
  explicit Folder(const std::string& text)
      : path_(std::filesystem::path(::testing::TempDir()) /
              ("relation_golden_" +
               std::string(::testing::UnitTest::GetInstance()->current_test_info()->name()))) {
    std::filesystem::create_directories(path_);
    std::ofstream(path_ / "a.json") << text;
  }
  ~Folder() { std::filesystem::remove_all(path_); }
  [[nodiscard]] const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

std::string fault_of(const std::string& cases) {
  const Folder folder(R"({"schema": "perturbation_offset/1", "cases": [)" + cases + "]}");
  try {
    static_cast<void>(read_relation_golden(folder.path()));
  } catch (const std::runtime_error& e) {
    return e.what();
  }
  return "";
}

TEST(RelationGolden, RefusesWhatItDoesNotKnow) {
  using ::testing::HasSubstr;
  const std::string sample = R"("samples": [{"x": [1], "value": 0, "gradient": [1]}]})";
  EXPECT_EQ(fault_of(R"({"function": "liming", "parameters": {"u": 0.5}, )" + sample), "");
  EXPECT_THAT(fault_of(R"({"function": "teapot", "parameters": {}, )" + sample), HasSubstr("teapot"));
  EXPECT_THAT(fault_of(R"({"function": "liming", "parameters": {"u": 0.5, "v": 1}, )" + sample),
              HasSubstr("unknown key v"));
  EXPECT_THAT(fault_of(R"({"function": "liming", "parameters": {}, )" + sample), HasSubstr("no u"));
  EXPECT_THAT(fault_of(R"({"function": "liming", "parameters": {"u": 0.5}, "samples": []})"),
              HasSubstr("no samples"));
  EXPECT_THAT(fault_of(R"({"function": "liming", "parameters": {"u": 0.5},
                         "samples": [{"x": [1, 2], "value": 0, "gradient": [1]}]})"),
              HasSubstr("wrong length"));
}

}  // namespace
}  // namespace blendwright::test
