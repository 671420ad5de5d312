// Jobs on STEP parts: the one that comes with the examples, and parts of commercial systems, which are not
// part of the project. The environment variable BLENDWRIGHT_STEP_DIR names the folder of the latter.
#include <gtest/gtest.h>

#include <cstdlib>

#include "app/json/job_reader.hpp"
#include "tests/app/job_support.hpp"

namespace blendwright {
namespace {

/// Runs the job with STEP output only, and judges what is read back as a user would.
void expect_reached(JobSpec job, const std::string& name) {
  job.output.formats = {OutputFormat::step};
  JobResult result = run_job(job);
  const test::TemporaryFolder folder("real-" + name);
  const JobOutputs outputs = write_outputs(result, {.folder = folder.path()});
  const BlendResult& blend = result.blends.at(0);
  ASSERT_EQ(blend.stages.back().stage, "step");
  for (std::size_t side = 0; side < 2; ++side) {
    const SeamReport& seam = blend.stages.back().seams.at(side);
    SCOPED_TRACE(seam.name);
    EXPECT_GT(seam.samples, 2000u);
    EXPECT_LE(seam.gap.worst, 1e-6);
    EXPECT_LE(seam.surface_gap.worst, 1e-6);
    EXPECT_LE(Radians(seam.angle.worst).degrees(), 1e-3);
    if (blend.entry.sides[side].side.continuity == Continuity::G2) {
      EXPECT_LE(seam.curvature.worst, 1e-4);
    }
  }
  for (const std::string& w : result.warnings)
    EXPECT_EQ(w.find("not carried over"), std::string::npos) << w;  // faces keep their own edges
  ASSERT_TRUE(outputs.step.has_value());
  EXPECT_TRUE(outputs.step->check.valid);
  EXPECT_EQ(outputs.step->check.unexpected_free_edges, 0u);
  EXPECT_EQ(outputs.step->check.shells, 1u);
  EXPECT_LE(outputs.step->check.largest_tolerance, 1e-6);
}

TEST(RealPart, StepExampleReachesItsContinuityInTheWrittenFile) {
  expect_reached(test::example_job("step-transition"), "example");
}

struct PartCase {
  const char *name, *file;
  /// Selector, trimline and placement of each side, as in a job file.
  const char *from_face, *from_line, *to_face, *to_line;
};

class RealPartBlend : public ::testing::TestWithParam<std::tuple<PartCase, const char*>> {};

TEST_P(RealPartBlend, ReachesItsContinuityInTheWrittenFile) {
  const char* folder = std::getenv("BLENDWRIGHT_STEP_DIR");
  if (!folder) GTEST_SKIP() << "BLENDWRIGHT_STEP_DIR names no folder with real parts";
  const auto& [c, continuity] = GetParam();
  const std::string file = (std::filesystem::path(folder) / c.file).string();
  const auto primary = [&](const char* face) {
    return R"({"kind": "step_face", "file": ")" + file + R"(", )" + face + "}";
  };
  const auto side = [&](const char* name, const char* line) {
    return std::string(R"({"primary": ")") + name + R"(", "trimline": {)" + line + R"(}, "continuity": ")" +
           continuity + R"("})";
  };
  const std::string text = R"({"primaries": {"a": )" + primary(c.from_face) + R"(, "b": )" +
                           primary(c.to_face) + R"(}, "blends": {"blend": {"from": )" +
                           side("a", c.from_line) + R"(, "to": )" + side("b", c.to_line) + "}}}";
  expect_reached(read_job(text, "real.json"), std::string(c.name) + continuity);
}

const std::vector<PartCase> cases{
    // Turned part; every cylinder and cone is two faces of half a turn.
    {"CylinderToCylinder", "sg1-c5-214.stp",
     R"("select": {"surface": "cylinder", "near": [-35.1, -19.2, -60]})",
     R"("kind": "edge_chain", "curve": "circle", "near": [-35.1, -19.2, -50])",
     R"("select": {"surface": "cylinder", "near": [-17.55, -9.59, 37.7]})",
     R"("kind": "edge_chain", "curve": "circle", "near": [-17.55, -9.59, 20])"},
    {"ConeToCylinder", "sg1-c5-214.stp", R"("select": {"surface": "cone", "near": [-26.33, -14.38, -15]})",
     R"("kind": "edge_chain", "curve": "circle", "near": [-17.55, -9.59, 20])",
     R"("select": {"surface": "cylinder", "near": [-17.55, -9.59, 77]})",
     R"("kind": "edge_chain", "curve": "circle", "near": [-17.55, -9.59, 70])"},
    {"HalfConeToHalfCylinder", "sg1-c5-214.stp",
     R"("select": {"surface": "cone", "near": [-26.33, -14.38, -15]})",
     R"("kind": "edge", "curve": "circle", "near": [-17.55, -9.59, 20])",
     R"("select": {"surface": "cylinder", "near": [-17.55, -9.59, 77]})",
     R"("kind": "edge", "curve": "circle", "near": [-17.55, -9.59, 70])"},
    // Screw; whole turns with a seam edge, tori cut open.
    {"CylinderToPlane", "screw.step", R"("select": {"surface": "cylinder", "near": [-22.9, -0.83, -16.6]})",
     R"("kind": "edge", "curve": "circle", "near": [-22.9, -0.83, -33.64])",
     R"("select": {"surface": "plane", "near": [-17.9, -0.83, -34.56]})",
     R"("kind": "edge", "curve": "circle", "near": [-21.98, -0.83, -34.56])"},
    {"ConeToCone", "screw.step", R"("select": {"surface": "cone", "near": [-17.9, -8.33, 2.94]})",
     R"("kind": "edge", "curve": "circle", "near": [-22.9, -0.83, 0.436])",
     R"("select": {"surface": "cone", "near": [-22.44, -0.83, -34.1]})",
     R"("kind": "edge", "curve": "circle", "near": [-22.9, -0.83, -33.64])"},
    {"TorusToCylinder", "screw.step", R"("select": {"surface": "torus", "near": [-17.9, 4.83, 6.77]})",
     R"("kind": "edge", "curve": "circle", "near": [-17.9, 9.17, 5.436])",
     R"("select": {"surface": "cylinder", "near": [-22.9, -0.83, -16.6]}, "placement": {"origin": [0, 0, -4], "direction": [0, 0, 1]})",
     R"("kind": "isoline", "v": -1, "range": [3.5, 5.9])"},
    // Edges up to 0.08 from their faces, meeting at small angles: the neck is turned round and moved away.
    {"SphereToImpreciseNeck", "HEAD_BACK.stp",
     R"("select": {"surface": "sphere", "near": [208.281, 41.7193, 0]})",
     R"("kind": "edge_chain", "curve": "bspline", "near": [250, 59, 0])",
     R"("select": {"surface": "cylinder", "near": [186.395, 18, 0]}, "placement": {"origin": [520, 0, 0], "direction": [0, 0, 1], "x_direction": [-1, 0, 0]})",
     R"("kind": "edge_chain", "curve": "bspline", "near": [192.75, 17.95, 0])"},
    // Open edges of free-form patches.
    {"SplineToPlane", "MAINBODY_BACK.stp",
     R"("select": {"surface": "bspline", "near": [-135.355, -54.4415, 21.0005]})",
     R"("kind": "edge", "curve": "bspline", "near": [-150, -21.4575, 8.27709])",
     R"("select": {"surface": "plane", "near": [-160, 19.74, 0]})",
     R"("kind": "edge", "curve": "circle", "near": [-160, -21, 0])"},
    {"SplineToCylinder", "MAINBODY_BACK.stp",
     R"("select": {"surface": "bspline", "near": [-135.355, -54.4415, 21.0005]})",
     R"("kind": "edge", "curve": "bspline", "near": [-150, -21.4575, 8.27709])",
     R"("select": {"surface": "cylinder", "near": [-155, -21, 0]}, "placement": {"origin": [-15, 0, 0], "direction": [0, 0, 1]})",
     R"("kind": "edge", "curve": "bspline", "near": [-150, -21, 0])"},
    // Planes and cylinders, written as rational B-splines.
    {"HoleToBolt", "dm1-id-214.stp", R"("select": {"surface": "bspline", "near": [25, 0, 50]})",
     R"("kind": "edge", "curve": "bspline", "near": [15.0551, 0, 65])",
     R"("select": {"surface": "bspline", "near": [5.05511, -8.5, 65]}, "placement": {"origin": [0, -14, 0], "direction": [0, 0, 1]})",
     R"("kind": "edge", "curve": "bspline", "near": [5.05511, 10, 65])"},
    {"FlatToFlat", "dm1-id-214.stp", R"("select": {"surface": "bspline", "near": [40, 52.7083, 50]})",
     R"("kind": "edge", "curve": "bspline", "near": [40, 10, 50])",
     R"("select": {"surface": "bspline", "near": [0, 5, 50]})",
     R"("kind": "edge", "curve": "bspline", "near": [0, 10, 50])"}};

INSTANTIATE_TEST_SUITE_P(Parts, RealPartBlend,
                         ::testing::Combine(::testing::ValuesIn(cases), ::testing::Values("G1", "G2")),
                         [](const auto& p) {
                           return std::string(std::get<0>(p.param).name) + std::get<1>(p.param);
                         });

}  // namespace
}  // namespace blendwright
