// What is written, what is left when something goes wrong, and what is said then.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "kernel/base/text_file.hpp"
#include "kernel/exchange/mesh_files.hpp"
#include "tests/app/job_support.hpp"

namespace blendwright {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;

constexpr const char* typed_data = R"json({
  "blends": { "strip": { "v": [0, "2*pi"], "closed": true,
    "from": { "C": ["-cos(v)", "sin(v)", "0"], "T": ["0", "0", "-2"] },
    "to":   { "C": ["-2*cos(v)", "2*sin(v)", "-2"], "T": ["0", "0", "-2"] } } } })json";

std::size_t entries(const fs::path& folder) {
  return static_cast<std::size_t>(std::distance(fs::directory_iterator(folder), fs::directory_iterator()));
}

/// A surface moved by a constant vector.
struct Shifted {
  Surface shape;
  Vec3 by;
  [[nodiscard]] SurfaceJet jet(UV p) const {
    SurfaceJet j = shape.jet(p);
    j.S += by;
    return j;
  }
  [[nodiscard]] SurfacePartials partials(UV p) const { return shape.partials(p); }
  [[nodiscard]] SurfaceDomain domain() const { return shape.domain(); }
};

TEST(TypedData, IsMeasuredAgainstItselfWhereThereIsNoPrimary) {
  const JobResult result = run_job(read_job(typed_data, "typed.json"));
  EXPECT_TRUE(verified(result));
  const BlendResult& blend = result.blends.at(0);
  for (const SeamReport& seam : blend.stages.back().seams) {
    EXPECT_TRUE(seam.measured);
    EXPECT_GT(seam.samples, 2000u);
    EXPECT_LE(seam.gap.worst, 1e-6);
    EXPECT_EQ(seam.folded, 0u);
  }
  const BlendReport moved =
      verify_blend(under_test(blend, Shifted{blend.fit.surface, Vec3(0.0, 0.0, 1e-4)}), "fitted");
  for (const SeamReport& seam : moved.seams) EXPECT_NEAR(seam.gap.worst, 1e-4, 1e-6);
}

TEST(Outputs, MeshFilesCarryUnitsParametersAndTheColumnToShow) {
  JobSpec job = test::example_job("branch-to-main");
  job.output.formats = {OutputFormat::vtp};
  JobResult result = run_job(job);
  const test::TemporaryFolder folder("mesh-facts");
  static_cast<void>(write_outputs(result, {.folder = folder.path()}));
  const auto fact = [](const std::vector<Column>& facts, const std::string& wanted) {
    const auto found =
        std::find_if(facts.begin(), facts.end(), [&](const Column& c) { return c.name == wanted; });
    return found == facts.end() ? Column{} : *found;
  };
  const std::vector<PolyLine> lines = read_polylines(folder.path() / "branch-to-main.fillet.trimlines.vtp");
  for (const char* stem : {"fillet", "main", "branch"}) {
    SCOPED_TRACE(stem);
    const TriMesh mesh = read_mesh(folder.path() / ("branch-to-main." + std::string(stem) + ".vtp"));
    EXPECT_EQ(mesh.shown, "gap");
    for (const Column& c : mesh.columns)
      EXPECT_TRUE(!c.unit.empty() || c.name == "u" || c.name == "v") << c.name;
    for (const std::vector<Column>& facts : {mesh.facts, lines.at(0).facts}) {
      EXPECT_EQ(fact(facts, "fillet: tension").values, std::vector{2.0});
      EXPECT_EQ(fact(facts, "fillet: tolerance of gap").unit, "mm");
      const Column mode = fact(facts, "fillet: mode");
      EXPECT_EQ(mode.labels.at(static_cast<std::size_t>(mode.values.at(0))), "chord");
      EXPECT_EQ(fact(facts, "fillet: worst angle to").values,
                std::vector{Radians(result.blends[0].stages.back().seams[1].angle.worst).degrees()});
    }
  }
}

TEST(TypedData, OffItsPrimaryIsReportedAndNotJoined) {
  JobSpec job = test::example_job("fig7-eq14");
  job.blends[0].sides[0].literal->C[2] = "h0 + 1e-4";
  JobResult result = run_job(job);
  const test::TemporaryFolder folder("off-primary");
  const JobOutputs outputs = write_outputs(result, {.folder = folder.path()});
  EXPECT_FALSE(verified(result, &outputs));
  EXPECT_THAT(shape_problems(result, outputs).at(0), HasSubstr("no joined shape"));
  EXPECT_NEAR(result.blends[0].stages.back().seams[0].gap.worst, 1e-4, 1e-8);
  EXPECT_FALSE(fs::exists(folder.path() / "fig7-eq14.step"));
  EXPECT_TRUE(fs::exists(folder.path() / "fig7-eq14.report.json"));
}

TEST(Outputs, SayHowTheBlendWasMade) {
  JobSpec job = test::example_job("fig7-eq14");
  job.output.formats = {OutputFormat::step, OutputFormat::vtp, OutputFormat::obj};
  JobResult result = run_job(job);
  const test::TemporaryFolder folder("note");
  const JobOutputs outputs = write_outputs(result, {.folder = folder.path()});
  const auto says = [&](const char* ending, const char* words) {
    return read_text_file(folder.path() / (std::string("fig7-eq14") + ending), 100'000'000).find(words) !=
           std::string::npos;
  };
  for (const char* ending : {".step", ".obj", ".report.json"}) EXPECT_TRUE(says(ending, "origin")) << ending;
  for (const char* ending : {".transition.vtp", ".transition.trimlines.vtp"})  // field data, compressed
    EXPECT_TRUE(says(ending, "Name=\"note\"")) << ending;
}

TEST(Outputs, AppearTogetherOrNotAtAll) {
  JobResult result = run_job(test::example_job("coaxial-cylinders"));
  const test::TemporaryFolder folder("together");
  for (const double limit : {0.55, 0.65, 0.75}) {  // stopped while joining, writing, verifying
    std::stop_source source;
    Progress progress;
    progress.report = [&](double fraction, std::string_view) {
      if (fraction < limit) source.request_stop();
    };
    progress.stop = source.get_token();
    EXPECT_THROW((void)write_outputs(result, {.folder = folder.path() / "new"}, progress), Cancelled);
    EXPECT_EQ(entries(folder.path()), 0u);
  }
  const JobOutputs outputs = write_outputs(result, {.folder = folder.path()});
  EXPECT_EQ(entries(folder.path()), outputs.files.size());
}

TEST(Outputs, LargestToleranceIsPartOfTheVerdict) {
  JobResult result = run_job(test::example_job("coaxial-cylinders"));
  const test::TemporaryFolder folder("tolerance");
  JobOutputs outputs = write_outputs(result, {.folder = folder.path()});
  EXPECT_TRUE(verified(result, &outputs));
  outputs.step->check.largest_tolerance = 1e-5;
  EXPECT_FALSE(verified(result, &outputs));
  EXPECT_THAT(shape_problems(result, outputs).at(0), HasSubstr("largest tolerance"));
}

}  // namespace
}  // namespace blendwright
