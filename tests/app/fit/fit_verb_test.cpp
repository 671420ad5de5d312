// `fit` writes a job that reproduces the fitted blend, keeps what the user typed, and says what it did.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <map>

#include "app/json/fit_report.hpp"
#include "app/json/job_reader.hpp"
#include "app/json/json_value.hpp"
#include "app/pipeline/fit_job.hpp"
#include "app/pipeline/write_outputs.hpp"
#include "kernel/geometry/curvature.hpp"
#include "tests/app/mini_schema.hpp"
#include "tests/app/program.hpp"

namespace blendwright::test {
namespace {

using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;

fs::path specs() { return fs::path(BLENDWRIGHT_SOURCE_DIR) / "examples/specs"; }

const char* const examples[] = {"fit-rolling-ball", "fit-fairest", "fit-through-points", "fit-clearance"};

struct Fitted {
  std::string text;
  JobSpec job;
  FitJobResult result;
};

Fitted fitted(const std::string& name, int threads = 1) {
  const fs::path file = specs() / (name + ".json");
  const std::string text = content(file);
  const JobSpec job = read_job(text, file);
  FitJobOptions options;
  options.folder = job.folder;
  options.threads = threads;
  return {text, job, run_fit_job(text, job, options)};
}

/// An example, fitted once for all tests.
const Fitted& fitted_example(const std::string& name) {
  static std::map<std::string, Fitted> known;
  const auto at = known.find(name);
  return at != known.end() ? at->second : known.emplace(name, fitted(name)).first->second;
}

double largest_distance(const OdeBlend& a, const OdeBlend& b) {
  double worst = 0.0;
  for (int i = 0; i <= 10; ++i)
    for (int j = 0; j <= 40; ++j) {
      const UV p{i / 10.0, a.domain().v.at(j / 40.0)};
      worst = std::max(worst, (a.jet(p).S - b.jet(p).S).norm());
    }
  return worst;
}

class FitExamples : public ::testing::TestWithParam<const char*> {};

TEST_P(FitExamples, AreFulfilledAndReproducedByTheJobThatIsWritten) {
  const Fitted& f = fitted_example(GetParam());
  EXPECT_TRUE(f.result.fulfilled());
  EXPECT_TRUE(verified(f.result.verified));
  ASSERT_EQ(f.result.blends.size(), 1u);
  const FittedBlend& blend = f.result.blends[0];
  // The specification that the fit returned, built directly on the job's own trimlines.
  const JobResult start = run_job(f.job);
  JobSpec direct = f.job;
  direct.blends[0] = blend.after;
  const JobResult expected = run_job(direct);
  const OdeBlend& written = f.result.verified.blends[0].blend.surface;
  // Every number is written so that it is read back: the same bits go in, the same surface comes out.
  EXPECT_LE(largest_distance(written, expected.blends[0].blend.surface), 1e-12);
  EXPECT_GT(largest_distance(written, start.blends[0].blend.surface), 1e-3);  // it did change
  EXPECT_LT(
      blend.fit.objectives[0].after * (blend.fit.objectives[0].name == std::string("clearance") ? -1 : 1),
      blend.fit.objectives[0].before);
}

TEST_P(FitExamples, KeepWhatWasTyped) {
  const Fitted& f = fitted_example(GetParam());
  const std::string& text = f.result.text;
  EXPECT_EQ(text.substr(0, text.find("\"blends\"")), f.text.substr(0, f.text.find("\"blends\"")));
  const std::size_t fit = f.text.find("\"fit\": {");
  EXPECT_NE(text.find(f.text.substr(fit, f.text.find("\n      }\n", fit) - fit)), std::string::npos) << text;
  EXPECT_NE(text, f.text);
}

INSTANTIATE_TEST_SUITE_P(All, FitExamples, ::testing::ValuesIn(examples), [](const auto& row) {
  std::string name = row.param;
  for (char& c : name)
    if (c == '-') c = '_';
  return name;
});

/// Whatever was free, the job that is written is the blend that was found.
class FitUnknownsOfAJob : public ::testing::TestWithParam<std::pair<const char*, const char*>> {};

TEST_P(FitUnknownsOfAJob, AreWrittenSoThatTheyAreReadBack) {
  const auto [name, fit] = GetParam();
  const fs::path file = specs() / (std::string(name) + ".json");
  std::string text = content(file);
  const std::size_t from = text.find("\"from\"");
  ASSERT_NE(from, std::string::npos);
  text.insert(from, std::string("\"fit\": ") + fit + ",\n      ");
  const JobSpec job = read_job(text, file);
  FitJobOptions options;
  options.folder = job.folder;
  const FitJobResult result = run_fit_job(text, job, options);
  const FittedBlend& blend = result.blends.at(0);
  EXPECT_LE(blend.fit.costs.back(), blend.fit.costs.front());
  JobSpec direct = job;
  direct.blends[0] = blend.after;
  const JobResult found = run_job(direct), start = run_job(job);
  const OdeBlend& written = result.verified.blends[0].blend.surface;
  EXPECT_LE(largest_distance(written, found.blends[0].blend.surface), 1e-12);
  EXPECT_GT(largest_distance(written, start.blends[0].blend.surface), 1e-6);
}

INSTANTIATE_TEST_SUITE_P(
    Jobs, FitUnknownsOfAJob,
    ::testing::Values(
        std::pair{"coaxial-cylinders",
                  R"({ "objectives": [{ "kind": "thin_plate" }, { "kind": "no_fold" }],
                       "unknowns": { "tangent_angle": true, "correspondence": 3, "magnitudes": [1, 3] } })"},
        std::pair{
            "leaning-cylinder",
            R"({ "objectives": [{ "kind": "thin_plate" }], "unknowns": { "tension_per_component": true } })"},
        std::pair{
            "leaning-cylinder",
            R"({ "objectives": [{ "kind": "thin_plate" }, { "kind": "largest_curvature", "least_radius": 0.2 }],
                       "unknowns": { "coefficients": true, "magnitudes": 0 } })"},
        std::pair{"open-blend", R"({ "objectives": [{ "kind": "curvature_variation" }], "starts": 2 })"},
        std::pair{"step-transition", R"({ "objectives": [{ "kind": "thin_plate" }] })"},
        std::pair{"fig1a-eq8",
                  R"({ "objectives": [{ "kind": "thin_plate" }], "unknowns": { "coefficients": true } })"}));

TEST(Fit, GivesTheRadiusOfTheBallAlongTheWholeTrimline) {
  const Fitted& f = fitted_example("fit-rolling-ball");
  const OdeBlend& blend = f.result.verified.blends[0].blend.surface;
  for (int j = 0; j < 500; ++j) {  // other places than the fit's
    const SurfaceJet s = blend.jet({0.5, blend.domain().v.at((j + 0.31) / 500.0)});
    EXPECT_NEAR(1.0 / std::abs(normal_curvature(s, s.Su, unit_normal(s))), 1.0, 0.01);
  }
}

TEST(Fit, IsTheSameForAnyNumberOfThreads) {
  EXPECT_EQ(fitted_example("fit-clearance").result.text, fitted("fit-clearance", 2).result.text);
}

TEST(Fit, IsIgnoredByVerify) {
  const Folder folder;
  const std::string text = content(specs() / "fit-fairest.json");
  const std::size_t at = text.find(",\n      \"fit\"");
  ASSERT_NE(at, std::string::npos);
  write(folder / "job.json", text.substr(0, at) + "\n    }\n  }\n}\n");
  const auto figures = [](const fs::path& file) {
    std::string out = run_program("verify --json " + quoted_path(file)).out;
    return out.substr(out.find("\"unit\""));  // behind name and hash
  };
  EXPECT_EQ(figures(folder / "job.json"), figures(specs() / "fit-fairest.json"));
}

TEST(FitVerb, WritesJobPlotAndReport) {
  const Folder folder;
  const Outcome run = run_program(
      "fit " + quoted_path(specs() / "fit-clearance.json") + " -o " + quoted_path(folder / "fitted.json") +
      " --plot " + quoted_path(folder / "plot.svg") + " --report " + quoted_path(folder / "fit.html"));
  EXPECT_EQ(run.code, 0) << run.err;
  EXPECT_THAT(run.out, HasSubstr("fit-clearance.json: 1 blend fitted, all targets met, joints verified\n"));
  EXPECT_THAT(run.out, HasSubstr("from/magnitude at 0.25"));
  EXPECT_THAT(run.out, HasSubstr("fit.html"));
  EXPECT_THAT(content(folder / "plot.svg"), HasSubstr("<svg"));
  const std::string page = content(folder / "fit.html");
  for (const char* part : {"Every target is met", "convergence-0", "least distance (mm)", "blendwright fit",
                           "data:image/png;base64,", "how far they are from where the fit started"})
    EXPECT_THAT(page, HasSubstr(part));
  // From its new folder the job still finds the obstacle, and there is nothing left to gain.
  const Outcome again = run_program("fit --json " + quoted_path(folder / "fitted.json"));
  EXPECT_EQ(again.code, 0) << again.err;
  EXPECT_EQ(run_program("verify --quiet " + quoted_path(folder / "fitted.json")).code, 0);
}

TEST(FitVerb, NamesFilesFromWhereTheFittedJobLies) {
  const Folder folder;
  const std::string fitted_file = quoted_path(folder / "deep/fitted.json");
  const Outcome run = run_program("fit " + quoted_path(specs() / "step-transition.json") +
                                  " --objective thin_plate --quiet -o " + fitted_file);
  EXPECT_EQ(run.code, 0) << run.err;
  EXPECT_THAT(content(folder / "deep/fitted.json"), Not(HasSubstr("\"parts/two-bodies.step\"")));
  EXPECT_EQ(run_program("verify --quiet " + fitted_file).code, 0);
}

TEST(FitVerb, PrintsAReportThatItsSchemaAccepts) {
  const MiniSchema schema(fit_report_schema());
  for (const char* name : examples) {
    const Outcome run =
        run_program("fit --json --times " + quoted_path(specs() / (std::string(name) + ".json")));
    EXPECT_EQ(run.code, 0) << run.err;
    EXPECT_THAT(schema.violations(parse_json(run.out)), IsEmpty()) << run.out;
  }
  EXPECT_THAT(schema.violations(parse_json("{}")), Not(IsEmpty()));
  EXPECT_EQ(run_program("schema fit-report").out, fit_report_schema());
}

TEST(FitVerb, TakesObjectivesFromTheCommandLine) {
  const std::string job = quoted_path(specs() / "coaxial-cylinders.json");
  const Outcome fairest = run_program("fit " + job + " --objective thin_plate");
  EXPECT_EQ(fairest.code, 0) << fairest.err;
  EXPECT_THAT(fairest.out, HasSubstr("thin plate"));
  const Outcome both =
      run_program("fit " + job + " --objective pass_through=1.45,0,1.5 --objective thin_plate=0.01 -o -");
  EXPECT_THAT(both.out, HasSubstr("// Two coaxial pipes of different radius."));
  EXPECT_EQ(run_program("verify --quiet -",
                        "printf '%s' \""
                        "$(cat " +
                            job + ")\" |")
                .code,
            0);
}

TEST(FitVerb, ReplacesNothingUnasked) {
  const Folder folder;
  const std::string text = content(specs() / "fit-through-points.json");
  write(folder / "job.json", text);
  const std::string job = quoted_path(folder / "job.json");
  const Outcome onto_itself = run_program("fit " + job + " -o " + job);
  EXPECT_EQ(onto_itself.code, 5);
  EXPECT_THAT(onto_itself.err, HasSubstr("is the job itself; --force replaces it"));
  EXPECT_EQ(content(folder / "job.json"), text);
  write(folder / "other.json", "keep me");
  EXPECT_EQ(run_program("fit " + job + " -o " + quoted_path(folder / "other.json")).code, 5);
  EXPECT_EQ(content(folder / "other.json"), "keep me");
  EXPECT_EQ(run_program("fit --force " + job + " -o " + job).code, 0);
  EXPECT_NE(content(folder / "job.json"), text);
  EXPECT_EQ(folder.files().size(), 2u);
}

TEST(FitVerb, PrintsWhatTheReadmeShows) {
  const fs::path root = BLENDWRIGHT_SOURCE_DIR;
  const std::string readme = content(root / "README.md"), job = "examples/specs/fit-through-points.json";
  EXPECT_THAT(readme, HasSubstr("```jsonc\n" + content(root / job) + "```"));
  const std::string command = "blendwright fit " + job + " -o fitted.json\n```\n\n```text\n";
  const std::size_t at = readme.find(command);
  ASSERT_NE(at, std::string::npos);
  const std::string shown =
      readme.substr(at + command.size(), readme.find("wrote ", at) - at - command.size());
  const Outcome run = run_program("fit " + quoted_path(root / job));
  EXPECT_EQ(run.out.substr(0, run.out.find("nothing written")), shown);  // what follows has the time
}

}  // namespace
}  // namespace blendwright::test
