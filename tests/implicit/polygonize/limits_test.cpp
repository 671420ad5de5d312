// What is refused, and what does not change the result.
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <stop_token>

#include "implicit/polygonize/polygonize.hpp"
#include "kernel/base/error.hpp"
#include "kernel/base/parallel_for.hpp"
#include "tests/implicit/polygonize/fields.hpp"

namespace blendwright {
namespace {

using test::ball;
using test::box_of;

MeshOptions cells_of(double cell) {
  MeshOptions options;
  options.cell = cell;
  return options;
}

template <class Action>
std::string refused_where(Action action) {
  try {
    action();
  } catch (const InputError& e) {
    return e.problems().front().where;
  }
  return "";
}

bool same_bits(const std::vector<double>& a, const std::vector<double>& b) {
  return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(double)) == 0;
}

TEST(Threads, DoNotChangeAByte) {
  const ScalarField field = test::random_balls(7, 10);
  MeshOptions options = cells_of(0.07);
  options.box = Box{Vec3(-1.5, -1.2, -3.0), Vec3(3.0, 1.0, 1.4)};
  std::vector<FieldMesh> made;
  for (const int threads : {1, 2, 3}) {
    const ThreadLimit limit(threads);
    made.push_back(polygonize(field, options));
  }
  for (std::size_t n = 1; n < made.size(); ++n) {
    EXPECT_EQ(made[n].mesh.points, made[0].mesh.points);
    EXPECT_EQ(made[n].mesh.normals, made[0].mesh.normals);
    EXPECT_EQ(made[n].mesh.triangles, made[0].mesh.triangles);
    EXPECT_EQ(made[n].facts.area, made[0].facts.area);
    EXPECT_EQ(made[n].facts.volume, made[0].facts.volume);
    EXPECT_EQ(made[n].facts.mean_distance, made[0].facts.mean_distance);
    EXPECT_EQ(made[n].facts.evaluated_points, made[0].facts.evaluated_points);
    ASSERT_EQ(made[n].mesh.columns.size(), 5u);
    for (std::size_t c = 0; c < 5; ++c)
      EXPECT_TRUE(same_bits(made[n].mesh.columns[c].values, made[0].mesh.columns[c].values));
  }
}

TEST(Columns, CanBeLeftOut) {
  MeshOptions options = cells_of(0.1);
  const FieldMesh with = polygonize(ball(Vec3::Zero(), 1.0), options);
  options.columns = false;
  const FieldMesh without = polygonize(ball(Vec3::Zero(), 1.0), options);
  EXPECT_TRUE(without.mesh.columns.empty());
  EXPECT_EQ(with.mesh.points, without.mesh.points);
  EXPECT_EQ(with.facts.largest_distance, without.facts.largest_distance);
}

TEST(NewtonSteps, CanBeLeftOut) {
  MeshOptions options = cells_of(0.2);
  options.newton_steps = 0;
  const FieldMesh made = polygonize(ball(Vec3::Zero(), 1.0), options);
  EXPECT_TRUE(find_defects(made.mesh, 0.2).none());
  // Chords of edges of length h are off by at most h^2 / 8 / R.
  EXPECT_LE(made.facts.largest_distance, 0.2 * 0.2 / 8.0);
  EXPECT_GT(made.facts.largest_distance, 1e-4);  // so that the bound of projected meshes means something
}

TEST(BadOptions, AreRefusedByName) {
  const ScalarField field = ball(Vec3::Zero(), 1.0);
  for (const double cell : {0.0, -1.0, static_cast<double>(NAN), static_cast<double>(INFINITY)})
    EXPECT_EQ(refused_where([&] { (void)polygonize(field, cells_of(cell)); }), "cell");
  EXPECT_EQ(refused_where([&] { (void)polygonize(field, cells_of(1e-30)); }), "cell");
  EXPECT_EQ(refused_where([&] { (void)polygonize(field, cells_of(1e-7)); }), "cell");
  for (const Box& box : {Box{Vec3(0, 0, 0), Vec3(1, 0, 1)}, Box{Vec3(0, 0, 0), Vec3(1, -1, 1)},
                         Box{Vec3(0, 0, 0), Vec3(1, INFINITY, 1)}, Box{Vec3(0, 0, NAN), Vec3(1, 1, 1)}}) {
    MeshOptions options = cells_of(0.1);
    options.box = box;
    EXPECT_EQ(refused_where([&] { (void)polygonize(field, options); }), "box");
  }
  EXPECT_EQ(refused_where([&] { (void)polygonize(test::half_space(Vec3(0, 0, 1), 0.0), cells_of(0.1)); }),
            "box");
  MeshOptions options = cells_of(0.1);
  options.newton_steps = -1;
  EXPECT_EQ(refused_where([&] { (void)polygonize(field, options); }), "newton_steps");
}

TEST(CellsFarFromTheOrigin, AreRefusedWhenGridPointsCoincide) {
  EXPECT_EQ(refused_where([&] {
              MeshOptions options = cells_of(1e-3);
              options.box = Box{Vec3(1e15, 0, 0), Vec3(1e15 + 1.0, 1, 1)};
              (void)polygonize(ball(Vec3(1e15, 0, 0), 1.0), options);
            }),
            "cell");
}

TEST(Memory, IsRefusedBeforeItIsTakenWithACellThatFits) {
  const ScalarField field = ball(Vec3::Zero(), 1.0);
  MeshOptions options = cells_of(0.01);
  options.max_memory = std::size_t{1} << 20;
  std::string message;
  try {
    (void)polygonize(field, options);
  } catch (const InputError& e) {
    EXPECT_EQ(e.problems().front().where, "max_memory");
    message = e.problems().front().message;
  }
  const std::string before = "a cell of about ";
  const std::size_t at = message.find(before);
  ASSERT_NE(at, std::string::npos) << message;
  options.cell = std::stod(message.substr(at + before.size()));
  EXPECT_NO_THROW((void)polygonize(field, options));
  options.cell *= 0.5;
  EXPECT_THROW((void)polygonize(field, options), InputError);
}

// 10^6 cells along each axis: 10^12 blocks on the surface. The refusal comes from a sample of the tree, not
// from the tree.
TEST(Memory, IsRefusedAtOnceForHopelesslySmallCells) {
  std::atomic<std::size_t> asked{0};
  const auto model = std::make_shared<test::SlopeField>(
      [&asked](const Vec3& p) {
        ++asked;
        const double r = p.norm();
        return test::ValueAndGradient{1.0 - r, r > 0.0 ? Vec3(-p / r) : Vec3(Vec3::Zero())};
      },
      1.0);
  EXPECT_EQ(refused_where([&] {
              (void)polygonize(ScalarField(model, Level::function, box_of(1.0)), cells_of(2.1e-6));
            }),
            "max_memory");
  EXPECT_LT(asked.load(), 1000000u);
}

TEST(Cancelling, StopsAtEveryStage) {
  const ScalarField field = ball(Vec3::Zero(), 1.0);
  std::vector<double> fractions;
  std::vector<std::string> stages;
  Progress progress;
  progress.report = [&](double fraction, std::string_view stage) {
    fractions.push_back(fraction);
    if (stages.empty() || stages.back() != stage) stages.emplace_back(stage);
  };
  (void)polygonize(field, cells_of(0.02), progress);
  EXPECT_TRUE(std::is_sorted(fractions.begin(), fractions.end()));
  EXPECT_EQ(fractions.back(), 1.0);
  EXPECT_GE(stages.size(), 5u);
  for (const std::string& stage : stages) {
    std::stop_source source;
    Progress stopping;
    stopping.stop = source.get_token();
    stopping.report = [&](double, std::string_view now) {
      if (now == stage) source.request_stop();
    };
    if (stage != stages.back()) {
      EXPECT_THROW((void)polygonize(field, cells_of(0.02), stopping), Cancelled) << stage;
    }
  }
}

TEST(ABoxWithoutSurface, HasNoMesh) {
  MeshOptions options = cells_of(0.1);
  options.box = Box{Vec3(2, 2, 2), Vec3(3, 3, 3)};
  EXPECT_THROW((void)polygonize(ball(Vec3::Zero(), 1.0), options), GeometryError);
  options.box = box_of(0.4);  // inside everywhere
  for (const auto at_box : {MeshOptions::AtBox::cap, MeshOptions::AtBox::open}) {
    options.at_box = at_box;
    EXPECT_THROW((void)polygonize(ball(Vec3::Zero(), 1.0), options), GeometryError);
  }
}

TEST(LiveBlocks, GrowLikeTheSurface) {
  const ScalarField field = test::torus(Vec3::Zero(), 1.0, 0.4);
  const auto coarse = polygonize(field, cells_of(0.02)).facts, fine = polygonize(field, cells_of(0.01)).facts;
  const double points =
      static_cast<double>(fine.evaluated_points) / static_cast<double>(coarse.evaluated_points);
  EXPECT_LT(points,
            4.4);  // 8 for all blocks; ranges of blocks leave a layer of about one block: 4 (1 + O(cell))
  // A ball of slope 1 leaves the blocks whose centres are within their half diagonal 4 sqrt(3) cells of the
  // surface: a layer of area * 8 sqrt(3) cells, in blocks of 512 cells.
  const double layer = fine.area * 8.0 * std::sqrt(3.0) * 0.01 / (512.0 * 1e-6);
  EXPECT_NEAR(static_cast<double>(fine.live_blocks), layer, 0.1 * layer);
}

}  // namespace
}  // namespace blendwright
