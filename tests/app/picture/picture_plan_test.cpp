// What a picture shows is decided before anything is drawn: titles, scales, captions, refusals. No display.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "app/pipeline/picture_comb.hpp"
#include "app/pipeline/picture_deviation.hpp"
#include "app/pipeline/picture_views.hpp"
#include "kernel/base/error.hpp"
#include "tests/app/picture/picture_models.hpp"

namespace blendwright {
namespace {

using test::ball;
using test::input_of;
using test::showing;
using testing::HasSubstr;
using testing::Not;

std::string example(const std::string& file) {
  return std::string(BLENDWRIGHT_SOURCE_DIR "/examples/") + file;
}

PictureJob of_file(const std::string& file, Show show) {
  PictureJob job = showing(show);
  job.input = example(file);
  job.reading.cells = 40;
  return job;
}

std::string message_of(const PictureJob& job) {
  try {
    static_cast<void>(plan_picture(job));
  } catch (const InputError& e) {
    return e.problems().front().where + ": " + e.problems().front().message;
  }
  return "";
}

TEST(PicturePlan, JobsTellTheirWorstFiguresInTheTitle) {
  const PicturePlan plan = plan_picture(of_file("specs/coaxial-cylinders.json", Show::gap));
  EXPECT_THAT(plan.title(),
              testing::MatchesRegex(
                  "coaxial-cylinders: largest gap [0-9.e-]+ mm, angle [0-9.e-]+ deg, curvature jump "
                  "[0-9.e-]+ 1/mm"));
  ASSERT_TRUE(plan.picture && plan.figure);
  EXPECT_EQ(plan.picture->bar_title, "gap (mm)");
  EXPECT_GT(plan.figure->most, 0.0);
  EXPECT_LT(plan.figure->most, 1e-6);  // the job's tolerance
  EXPECT_EQ(plan.picture->width, 1280);
  EXPECT_EQ(plan.picture->lines.size(), 2u);
  // Blends are coloured by their joints, primaries are not.
  for (const PictureMesh& m : plan.picture->meshes) EXPECT_EQ(m.coloured, m.mesh.name == "reducer");
}

TEST(PicturePlan, ConvexSidesHavePositiveCurvatureWhereverTheyComeFrom) {
  // The two pipes of the reducer have mean curvature 1/(2 r): 0.5 and 0.25 1/mm.
  const PicturePlan job = plan_picture(of_file("specs/coaxial-cylinders.json", Show::curvature));
  std::size_t found = 0;
  for (const PictureMesh& m : job.picture->meshes) {
    if (m.mesh.name == "reducer") continue;
    const Column* c = find_column(m.mesh, "mean_curvature");
    ASSERT_NE(c, nullptr);
    for (const double k : c->values) EXPECT_NEAR(k, m.mesh.name == "thin" ? 0.5 : 0.25, 1e-9);
    ++found;
  }
  EXPECT_EQ(found, 2u);
  EXPECT_EQ(job.picture->scale->map(), ColourMap::diverging);
  // A large plate through the post decides nothing.
  const PictureInput post = read_picture_input(example("specs/leaning-cylinder.json"), {});
  for (const PicturePart& part : post.parts) {
    if (part.role != PicturePart::Role::primary) continue;
    const std::vector<double>& mean = find_column(part.mesh, "mean_curvature")->values;
    EXPECT_GE(*std::min_element(mean.begin(), mean.end()), -1e-9) << part.mesh.name;
  }
  // A rounded solid is convex almost everywhere.
  const PicturePlan scene = plan_picture(of_file("scenes/s0-1a.json", Show::curvature));
  EXPECT_GT(scene.figure->most, std::abs(scene.figure->least));
}

TEST(PicturePlan, ZebraIsLeftToTheNormalsAndHasNoBar) {
  const PicturePlan plan = plan_picture(of_file("specs/coaxial-cylinders.json", Show::zebra));
  EXPECT_EQ(plan.picture->pattern, SurfacePattern::zebra);
  EXPECT_FALSE(plan.picture->scale);
  EXPECT_TRUE(plan.picture->lines.empty());  // a line along the joint would hide its kink
  for (const PictureMesh& m : plan.picture->meshes) EXPECT_TRUE(m.coloured) << m.mesh.name;
}

TEST(PicturePlan, ZebraOfFacetsIsRefused) {
  PictureInput facets = input_of(ball(1.0), "facets");
  facets.parts[0].mesh.normals.clear();
  facets.parts[0].mesh.columns.clear();
  for (const Show show : {Show::zebra, Show::isophotes, Show::draft, Show::comb}) {
    try {
      static_cast<void>(plan_picture(facets, showing(show)));
      ADD_FAILURE() << row_of(show).name;
    } catch (const InputError& e) {
      EXPECT_EQ(e.problems().front().where, "--show");
      EXPECT_THAT(e.problems().front().message, HasSubstr("exact normals"));
      EXPECT_THAT(e.problems().front().message, HasSubstr("it can show \"plain\""));
    }
  }
  EXPECT_NO_THROW(static_cast<void>(plan_picture(facets, showing(Show::plain))));
}

TEST(PicturePlan, RadiusTellsTheLeast) {
  const PicturePlan plan = plan_picture(input_of(ball(2.5)), showing(Show::radius));
  EXPECT_EQ(plan.title(), "ball: least radius 2.5 mm");
  EXPECT_EQ(plan.picture->bar_title, "least radius (mm)");
}

TEST(PicturePlan, DraftTellsItsRangeAndItsPull) {
  PictureJob job = showing(Show::draft);
  job.options.pull = Vec3::UnitX();
  const PicturePlan plan = plan_picture(input_of(ball(1.0)), job);
  EXPECT_EQ(plan.title(), "ball: draft angle -90 to 90 deg");
  EXPECT_THAT(plan.picture->caption, HasSubstr("pull (1, 0, 0)"));
  EXPECT_EQ(plan.picture->scale->map(), ColourMap::diverging);
}

TEST(PicturePlan, OutliersDoNotStretchTheBarAndTheTitleStillTellsThem) {
  TriMesh mesh = ball(1.0);
  for (std::size_t i = 0; i < 5; ++i) mesh.columns[0].values[100 + i] = 1e4;  // 5 of some 1,200 points
  const PicturePlan plan = plan_picture(input_of(mesh), showing(Show::curvature));
  EXPECT_LT(plan.picture->scale->axis().hi, 3.0);
  EXPECT_THAT(plan.picture->scale->axis().ticks.back().label, testing::StartsWith("> "));
  EXPECT_THAT(plan.title(), HasSubstr("to 1e+04 1/mm"));
  const PicturePlan without = plan_picture(input_of(ball(1.0)), showing(Show::curvature));
  EXPECT_THAT(without.picture->scale->axis().ticks.back().label, Not(testing::StartsWith("> ")));
}

TEST(PicturePlan, LogarithmicColoursAreOfTheMagnitude) {
  TriMesh mesh = ball(1.0);
  for (std::size_t i = 0; i < mesh.points.size(); ++i)
    mesh.columns[0].values[i] = (i % 2 == 0 ? -1.0 : 1.0) * std::pow(10.0, static_cast<double>(i % 4));
  PictureJob job = showing(Show::curvature);
  job.options.logarithmic = true;
  const PicturePlan plan = plan_picture(input_of(mesh), job);
  EXPECT_TRUE(plan.picture->scale->axis().logarithmic);
  EXPECT_EQ(plan.picture->bar_title, "magnitude of mean curvature (1/mm)");
  for (const double x : plan.picture->meshes[0].mesh.columns[0].values) EXPECT_GT(x, 0.0);
}

TEST(PicturePlan, ARangeThatIsAskedForIsTheBars) {
  PictureJob job = showing(Show::draft);
  job.range = Interval{-30.0, 30.0};
  const PicturePlan plan = plan_picture(input_of(ball(1.0)), job);
  EXPECT_DOUBLE_EQ(plan.picture->scale->axis().lo, -30.0);
  EXPECT_DOUBLE_EQ(plan.picture->scale->axis().hi, 30.0);
  EXPECT_EQ(plan.picture->scale->map(), ColourMap::diverging);
}

TEST(PicturePlan, DeviationIsSignedAndToldWithItsPlace) {
  // A ball of radius 1.1 around one of radius 1: 0.1 outside everywhere, up to the facets' sagitta
  // r (1 - cos(half step)) = 1 - cos(3.75 deg) = 0.0022.
  PictureInput large = input_of(ball(1.1), "large");
  const PictureInput small = input_of(ball(1.0), "small");
  const DeviationFacts facts = add_deviation(large, small);
  EXPECT_NEAR(facts.worst, 0.1, 0.0045);
  EXPECT_NEAR(facts.rms, 0.1, 0.0045);
  EXPECT_GT(facts.facets, 0.0);
  for (const double d : find_column(large.parts[0].mesh, "deviation")->values) EXPECT_GT(d, 0.09);
  PictureInput inside = input_of(ball(0.9), "inside");
  static_cast<void>(add_deviation(inside, small));
  for (const double d : find_column(inside.parts[0].mesh, "deviation")->values) EXPECT_LT(d, -0.09);
}

TEST(PicturePlan, DeviationFromASurfaceIsExact) {
  // Against the exact blend of the job itself, its own mesh is where it is.
  PictureJob job = of_file("specs/coaxial-cylinders.json", Show::deviation);
  const PictureInput other = read_picture_input(job.input, {.surfaces = false});
  PictureInput moved = other;
  for (Vec3& p : moved.parts[0].mesh.points) p += Vec3(0.0, 0.0, 1e-5);
  const DeviationFacts same = [&] {
    PictureInput input = other;
    return add_deviation(input, other);
  }();
  // Newton's foot point is right to its stopping tolerance, 1e-12 of the size of 5 mm at least.
  EXPECT_LT(same.worst, 1e-9);
  EXPECT_EQ(same.facets, 0.0);
  const DeviationFacts shifted = add_deviation(moved, other);
  EXPECT_GT(shifted.worst, 5e-6);
  EXPECT_LE(shifted.worst, 1.001e-5);
}

TEST(PicturePlan, CombsHaveTheCurvatureOfTheSurfaceAsTheirLength) {
  const TriMesh mesh = ball(2.0, 60, 120);
  const std::vector<CombLine> lines = comb_of_sections({&mesh}, 5, 200, nullptr);
  ASSERT_FALSE(lines.empty());
  for (const CombLine& line : lines) {
    EXPECT_TRUE(line.closed);
    // Normals of a sphere turn by ds/r: linear interpolation over 3 degrees leaves 3e-4 of them.
    for (const double k : line.curvature) EXPECT_NEAR(k, 0.5, 0.5 * 0.02);
  }
  const Comb comb = comb_of(lines, 4.0);
  EXPECT_DOUBLE_EQ(comb.shown, 0.5);
  ASSERT_EQ(comb.hairs.edges.size(), comb.envelope.edges.size());
  for (const auto& [root, tip] : comb.hairs.edges) {
    const Vec3 hair = comb.hairs.mesh.points[tip] - comb.hairs.mesh.points[root];
    EXPECT_NEAR(hair.norm(), comb.scale * 0.5, 0.03 * comb.scale);
    EXPECT_GT(hair.dot(comb.hairs.mesh.points[root]), 0.0);  // convex: outward
  }
}

TEST(PicturePlan, CombsOfBlendsAreExact) {
  const PictureInput input = read_picture_input(example("specs/coaxial-cylinders.json"), {.surfaces = false});
  const auto lines = comb_across(*input.parts[0].surface, 8, 20, 1.0);
  ASSERT_EQ(lines.size(), 8u);
  // Asked for G2: the blend starts as straight as the pipes are along their axis. The fit has a tenth of the
  // tolerance 1e-4 1/mm of it.
  for (const CombLine& line : lines)
    for (const double k : {line.curvature.front(), line.curvature.back()}) EXPECT_NEAR(k, 0.0, 1e-5);
  const PicturePlan plan = plan_picture(of_file("specs/coaxial-cylinders.json", Show::comb));
  ASSERT_TRUE(plan.picture->length_bar);
  EXPECT_THAT(plan.picture->length_bar->label, HasSubstr("mm^-1"));
  EXPECT_EQ(plan.picture->keys.size(), 2u);
}

TEST(PicturePlan, FieldsAreShownOnAPlaneThroughTheSolid) {
  PictureJob job = of_file("scenes/s0-12ab.json", Show::field);
  job.plane = SectionPlane{2, 0.0};
  const PicturePlan plan = plan_picture(job);
  EXPECT_THAT(plan.title(), HasSubstr("field on z = 0 mm"));
  EXPECT_EQ(plan.picture->scale->map(), ColourMap::diverging);
  EXPECT_LT(plan.figure->least, 0.0);
  EXPECT_GT(plan.figure->most, 0.0);
  for (const Vec3& p : plan.picture->meshes[0].mesh.points) EXPECT_EQ(p.z(), 0.0);
  ASSERT_EQ(plan.picture->lines.size(), 1u);  // the outline of the solid
  EXPECT_TRUE(plan.picture->lines[0].closed);
  job.plane = SectionPlane{2, 1000.0};
  EXPECT_THAT(message_of(job), HasSubstr("--plane: is z=1000, must be from"));
}

TEST(PicturePlan, TrimlinesArePlotsOfEverythingAlongThem) {
  PictureJob job = of_file("specs/coaxial-cylinders.json", Show::plain);
  job.trimlines = true;
  const PicturePlan plan = plan_picture(job);
  ASSERT_TRUE(plan.plots);
  ASSERT_EQ(plan.plots->plots.size(), 6u);
  EXPECT_EQ(plan.plots->plots[3].y_label, "|T| (mm)");
  EXPECT_EQ(plan.plots->plots[5].title, "correspondence");
  for (const Plot& plot : plan.plots->plots) EXPECT_FALSE(plot.curves.empty()) << plot.title;
  // Round about concentric circles of radius 1 and 2, 3 mm apart: the connecting lines are sqrt(10) long.
  for (const double x : plan.plots->plots[4].curves[0].y) EXPECT_NEAR(x, std::sqrt(10.0), 1e-9);
  // As far along one line as along the other.
  const auto &from = plan.plots->plots[5].curves[0], &to = plan.plots->plots[5].curves[1];
  for (std::size_t i = 0; i < from.y.size(); ++i) EXPECT_NEAR(from.y[i], to.y[i], 1e-9);
}

TEST(PicturePlan, SaysWhatAnInputCannotShow) {
  EXPECT_THAT(message_of(of_file("scenes/s0-1a.json", Show::gap)),
              HasSubstr("--show: is \"gap\", which s0-1a"));
  EXPECT_THAT(message_of(of_file("specs/coaxial-cylinders.json", Show::field)),
              HasSubstr("--show: is \"field\", which only scenes have"));
  EXPECT_THAT(message_of(of_file("specs/coaxial-cylinders.json", Show::deviation)),
              HasSubstr("--to: is missing"));
  PictureJob to = of_file("specs/coaxial-cylinders.json", Show::gap);
  to.to = "x.step";
  EXPECT_THAT(message_of(to), HasSubstr("only --show deviation"));
  PictureJob scene = of_file("scenes/s0-1a.json", Show::plain);
  scene.trimlines = true;
  EXPECT_THAT(message_of(scene), HasSubstr("--show: is \"trimlines\""));
  PictureJob unknown = showing(Show::plain);
  unknown.input = "thing.doc";
  EXPECT_THAT(message_of(unknown), HasSubstr("must be a job or a scene"));
}

TEST(PictureViews, AreKnownByNameAndSuggested) {
  const auto views = views_named({"iso", "front", "top"});
  ASSERT_EQ(views.size(), 3u);
  EXPECT_EQ(views[1].direction, -Vec3::UnitY());
  try {
    static_cast<void>(views_named({"frnt", "iso", "downwards"}));
    ADD_FAILURE();
  } catch (const InputError& e) {
    ASSERT_EQ(e.problems().size(), 2u);  // all of them
    EXPECT_THAT(e.problems()[0].message, HasSubstr("did you mean \"front\""));
  }
}

}  // namespace
}  // namespace blendwright
