// Impossible and contradictory intents: one clear message with its place, the right exit code, and the best
// result where there is one.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/app/program.hpp"

namespace blendwright::test {
namespace {

using testing::HasSubstr;
using testing::Not;

struct BadIntent {
  const char* name;
  const char* fit;    ///< the object
  const char* where;  ///< JSON pointer below /blends/reducer
  const char* words;
  int code;                ///< 1: built, not fulfilled; 3: bad input; 5: a file
  const char* sides = "";  ///< more keys of both sides
  const char* shape = "";  ///< the object "shape", with its comma
};

void PrintTo(const BadIntent& bad, std::ostream* out) { *out << bad.name; }

constexpr const char* g2 = R"(, "continuity": "G2")";
constexpr const char* fair = R"({ "objectives": [{ "kind": "thin_plate" }] })";

constexpr BadIntent bad_intents[] = {
    {"no-object", R"(3)", "/fit", "is 3, must be an object", 3},
    {"no-objectives", R"({ })", "/fit/objectives", "is missing", 3},
    {"empty-list", R"({ "objectives": [] })", "/fit/objectives", "must be a list with at least one", 3},
    {"unknown-kind", R"({ "objectives": [{ "kind": "rolling_bal", "radius": 1 }] })",
     "/fit/objectives/0/kind", "did you mean \"rolling_ball\"?", 3},
    {"unknown-key", R"({ "objectives": [{ "kind": "rolling_ball", "radius": 1, "weigth": 1 }] })",
     "/fit/objectives/0/weigth", "did you mean \"weight\"?", 3},
    {"unknown-unknown", R"({ "objectives": [{ "kind": "thin_plate" }], "unknowns": { "tensions": true } })",
     "/fit/unknowns/tensions", "did you mean \"tension\"?", 3},
    {"weights-zero", R"({ "objectives": [{ "kind": "thin_plate", "weight": 0 }] })", "/fit/objectives",
     "all have weight 0", 3},
    {"weight-negative", R"({ "objectives": [{ "kind": "thin_plate", "weight": -1 }] })",
     "/fit/objectives/0/weight", "is -1, must be >= 0", 3},
    {"radius-missing", R"({ "objectives": [{ "kind": "rolling_ball" }] })", "/fit/objectives/0/radius",
     "is missing", 3},
    {"radius-negative", R"({ "objectives": [{ "kind": "rolling_ball", "radius": -2 }] })",
     "/fit/objectives/0/radius", "is -2, must be > 0", 3},
    {"radius-law-backwards",
     R"({ "objectives": [{ "kind": "rolling_ball", "radius": [[0.5, 1], [0.2, 1]] }] })",
     "/fit/objectives/0/radius/1/0", "must be > 0.5", 3},
    {"radius-larger-than-fits", R"({ "objectives": [{ "kind": "rolling_ball", "radius": 500 }] })", "",
     "rolling ball is not fulfilled", 1},
    {"across-outside", R"({ "objectives": [{ "kind": "rolling_ball", "radius": 1, "across": [0.5, 2] }] })",
     "/fit/objectives/0/across", "must lie within [0, 1]", 3},
    {"point-metres-off",
     R"({ "objectives": [{ "kind": "pass_through", "points": [[1.5, 0, 1.5], [1500, 0, 1500]] }] })",
     "/fit/objectives/0/points/1", "from the blend", 3},
    {"point-of-two", R"({ "objectives": [{ "kind": "pass_through", "points": [[1.5, 0]] }] })",
     "/fit/objectives/0/points/0", "must be a list of 3 numbers", 3},
    {"no-points", R"({ "objectives": [{ "kind": "pass_through", "points": [] }] })",
     "/fit/objectives/0/points", "must be a list of points", 3},
    {"more-points-than-fit",
     R"({ "objectives": [{ "kind": "pass_through", "points": [[1.5, 0, 1.5], [1.9, 0, 1.5]] }] })", "",
     "pass through is not fulfilled", 1},
    {"least-radius-zero", R"({ "objectives": [{ "kind": "largest_curvature", "least_radius": 0 }] })",
     "/fit/objectives/0/least_radius", "is 0, must be > 0", 3},
    {"least-radius-larger-than-fits",
     R"({ "objectives": [{ "kind": "largest_curvature", "least_radius": 90 }] })", "",
     "largest curvature is not fulfilled", 1},
    {"margin-of-two", R"({ "objectives": [{ "kind": "no_fold", "margin": 2 }] })", "/fit/objectives/0/margin",
     "must be >= 0 and <= 0.99", 3},
    {"clearance-without-file", R"({ "objectives": [{ "kind": "clearance", "distance": 1 }] })",
     "/fit/objectives/0/to", "is missing", 3},
    {"clearance-file-not-there",
     R"({ "objectives": [{ "kind": "clearance", "distance": 1, "to": "nowhere.stl" }] })",
     "/fit/objectives/0/to", "nowhere.stl", 5},
    {"clearance-of-a-picture",
     R"({ "objectives": [{ "kind": "clearance", "distance": 1, "to": "obstacle.png" }] })",
     "/fit/objectives/0/to", "must end in .stl, .vtp, .ply or .obj", 3},
    {"clearance-of-garbage",
     R"({ "objectives": [{ "kind": "clearance", "distance": 1, "to": "garbage.stl" }] })",
     "/fit/objectives/0/to", "garbage.stl", 5},
    {"clearance-of-no-node",
     R"({ "objectives": [{ "kind": "clearance", "distance": 1, "to": "near.json#bal" }] })",
     "/fit/objectives/0/to", "did you mean \"ball\"?", 3},
    {"clearance-in-another-unit",
     R"({ "objectives": [{ "kind": "clearance", "distance": 1, "to": "inches.json" }] })",
     "/fit/objectives/0/to", "is in in, must be in mm", 3},
    {"obstacle-touches-the-trimline",
     R"({ "objectives": [{ "kind": "clearance", "distance": 0.1, "to": "touching.json" }] })",
     "/fit/objectives/0/to", "a blend starts there whatever its shape", 3},
    {"obstacle-near-the-trimline",
     R"({ "objectives": [{ "kind": "clearance", "distance": 0.5, "to": "near.json" }] })",
     "/fit/objectives/0/to", "which no shape of the blend can change", 1},
    {"scan-not-there", R"({ "objectives": [{ "kind": "scanned_points", "file": "nowhere.csv" }] })",
     "/fit/objectives/0/file", "nowhere.csv", 5},
    {"scan-empty", R"({ "objectives": [{ "kind": "scanned_points", "file": "empty.csv" }] })",
     "/fit/objectives/0/file", "has no points", 3},
    {"scan-with-nan", R"({ "objectives": [{ "kind": "scanned_points", "file": "nan.csv" }] })",
     "/fit/objectives/0/file", "line 2", 3},
    {"scan-metres-off", R"({ "objectives": [{ "kind": "scanned_points", "file": "far.csv" }] })",
     "/fit/objectives/0/file", "from the blend", 3},
    {"robust-scale-negative",
     R"({ "objectives": [{ "kind": "scanned_points", "file": "nan.csv", "robust_scale": -1 }] })",
     "/fit/objectives/0/robust_scale", "is -1, must be > 0", 3},
    {"bounds-crossed", R"({ "objectives": [{ "kind": "thin_plate" }], "bounds": { "tension": [5, 1] } })",
     "/fit/bounds/tension", "must be [low, high] with low < high", 3},
    {"bounds-beyond-what-is-exact",
     R"({ "objectives": [{ "kind": "thin_plate" }], "bounds": { "tension": [0, 900] } })",
     "/fit/bounds/tension", "must stay <= 70", 3},
    {"angle-beyond-60",
     R"({ "objectives": [{ "kind": "thin_plate" }], "bounds": { "tangent_angle_deg": 80 } })",
     "/fit/bounds/tangent_angle_deg", "<= 60", 3},
    {"nothing-may-change",
     R"({ "objectives": [{ "kind": "thin_plate" }], "unknowns": { "tension": false, "magnitudes": 0 } })",
     "/fit/unknowns", "free at least one", 3},
    {"tension-and-coefficients",
     R"({ "objectives": [{ "kind": "thin_plate" }], "unknowns": { "tension": true, "coefficients": true } })",
     "/fit/unknowns/tension", "contradicts /blends/reducer/fit/unknowns/coefficients", 3},
    {"per-component-of-sixth-order",
     R"({ "objectives": [{ "kind": "thin_plate" }], "unknowns": { "tension_per_component": true } })",
     "/fit/unknowns/tension_per_component", "which makes it sixth", 3, g2},
    {"coefficients-of-sixth-order",
     R"({ "objectives": [{ "kind": "thin_plate" }], "unknowns": { "coefficients": true } })",
     "/fit/unknowns/coefficients", "which makes it sixth", 3, g2},
    {"q-with-g2", fair, "/shape/q", "contradicts G2", 3, g2, R"("shape": { "q": 2 }, )"},
    {"tangent-angle-of-g0",
     R"({ "objectives": [{ "kind": "thin_plate" }], "unknowns": { "tangent_angle": [true, false] } })",
     "/fit/unknowns/tangent_angle/0", "asks G0 only", 3, R"(, "continuity": "G0")"},
    {"half-a-magnitude", R"({ "objectives": [{ "kind": "thin_plate" }], "unknowns": { "magnitudes": 2.5 } })",
     "/fit/unknowns/magnitudes", "must be whole numbers in [0, 64]", 3},
    {"angle-that-is-a-number",
     R"({ "objectives": [{ "kind": "thin_plate" }], "unknowns": { "tangent_angle": 3 } })",
     "/fit/unknowns/tangent_angle", "must be true, false or two of them", 3},
    {"no-starts", R"({ "objectives": [{ "kind": "thin_plate" }], "starts": 0 })", "/fit/starts",
     "is 0, must be >= 1", 3},
    {"samples-across", R"({ "objectives": [{ "kind": "thin_plate" }], "samples": [5000, 48] })",
     "/fit/samples/0", "is 5000, must lie in [2, 64]", 3},
};

class BadIntents : public ::testing::TestWithParam<BadIntent> {};

void write_files(const Folder& folder) {
  write(folder / "garbage.stl", "solid? no");
  write(folder / "obstacle.png", "x");
  write(folder / "empty.csv", "x, y, z\n");
  write(folder / "nan.csv", "1.5, 0, 1.5\n1.5, nan, 1.5\n");
  write(folder / "far.csv", "1.5, 0, 1.5\n1500, 0, 1500\n");
  const auto ball = [](const char* unit, const char* place) {
    return std::string(R"({ "unit": ")") + unit + R"(", "nodes": {
      "ball": { "kind": "superquadric", "a": 0.5, "b": 0.5, "c": 0.5, "n1": 2, "n2": 2 },
      "placed": { "kind": "place", "of": "ball", "move": )" +
           place + R"( } }, "solid": "placed" })";
  };
  write(folder / "touching.json", ball("mm", "[1, 0, 0]"));
  write(folder / "near.json", ball("mm", "[1.8, 0, 0]"));  // 0.3 from the trimline at (1, 0, 0)
  write(folder / "inches.json", ball("in", "[9, 0, 0]"));
}

TEST_P(BadIntents, EndInOneClearMessage) {
  const BadIntent& bad = GetParam();
  const Folder folder;
  write_files(folder);
  const std::string sides = bad.sides;
  write(folder / "job.json", R"({ "primaries": {
    "thin": { "kind": "cylinder", "radius": 1, "length": [-2, 0] },
    "wide": { "kind": "cylinder", "radius": 2, "length": [3, 5] } },
  "blends": { "reducer": {
    "from": { "primary": "thin", "trimline": { "kind": "isoline", "length": 0 })" +
                                 sides + R"( },
    "to":   { "primary": "wide", "trimline": { "kind": "isoline", "length": 3 })" +
                                 sides + R"( },
    )" + bad.shape +
                                 "\"fit\": " + bad.fit + " } } }");
  const auto before = folder.files();
  const Outcome run =
      run_program("fit " + quoted_path(folder / "job.json") + " -o " + quoted_path(folder / "fitted.json"));
  EXPECT_EQ(run.code, bad.code) << run.err;
  EXPECT_THAT(run.err, HasSubstr(std::string("/blends/reducer") + bad.where + (*bad.where ? ": " : "")));
  EXPECT_THAT(run.err, HasSubstr(bad.words));
  EXPECT_THAT(run.err, Not(HasSubstr("unexpected error")));
  if (bad.code == 1) {
    EXPECT_THAT(run.out, HasSubstr("not all targets met"));
    EXPECT_TRUE(fs::exists(folder / "fitted.json"));  // the best there is
  } else {
    EXPECT_EQ(run.out, "");
    EXPECT_EQ(folder.files(), before);
    EXPECT_THAT(run.err, HasSubstr(bad.code == 3 ? ": 1 problem\n" : "job.json: /blends"));
  }
}

INSTANTIATE_TEST_SUITE_P(Table, BadIntents, ::testing::ValuesIn(bad_intents), [](const auto& row) {
  std::string name = row.param.name;
  for (char& c : name)
    if (c == '-') c = '_';
  return name;
});

TEST(BadIntents, AreAllToldAtOnce) {
  const Folder folder;
  write(folder / "job.json", R"({ "blends": { "x": { "v": [0, 1],
    "from": { "C": [0, "v", 0], "T": [1, 0, 0] }, "to": { "C": [1, "v", 0], "T": [1, 0, 0] },
    "fit": { "objectives": [{ "kind": "thin_plates" }, { "kind": "rolling_ball", "radius": 0 }],
             "bounds": { "prior": -1 }, "starts": 1.5 } } } })");
  const Outcome run = run_program("fit " + quoted_path(folder / "job.json"));
  EXPECT_EQ(run.code, 3);
  EXPECT_THAT(run.err, HasSubstr("4 problems"));
  for (const char* where : {"objectives/0/kind", "objectives/1/radius", "bounds/prior", "starts"})
    EXPECT_THAT(run.err, HasSubstr(std::string("/blends/x/fit/") + where + ": "));
  // blend and verify read it too, though they do not act on it.
  EXPECT_EQ(run_program("verify " + quoted_path(folder / "job.json")).err, run.err);
}

TEST(BadIntents, FilesThatAreNoJobsAreNamedForWhatTheyAre) {
  const Folder folder;
  write(folder / "half.json", R"({ "blends": { )");
  write(folder / "none.json", " ");
  for (const auto& [file, words] : std::vector<std::pair<std::string, std::string>>{
           {"half.json", "line 1, "}, {"none.json", "is empty"}}) {
    const Outcome run =
        run_program("fit " + quoted_path(folder / file) + " -o " + quoted_path(folder / "out.json"));
    EXPECT_EQ(run.code, 3) << file;
    EXPECT_THAT(run.err, HasSubstr(words));
  }
  EXPECT_EQ(run_program("fit " + quoted_path(folder / "nowhere.json")).code, 5);
  EXPECT_FALSE(fs::exists(folder / "out.json"));
}

TEST(BadIntents, JobsWithoutIntentAreToldHowToGiveOne) {
  const std::string job =
      quoted_path(fs::path(BLENDWRIGHT_SOURCE_DIR) / "examples/specs/coaxial-cylinders.json");
  const Outcome run = run_program("fit " + job);
  EXPECT_EQ(run.code, 3);
  EXPECT_THAT(run.err, HasSubstr("--objective thin_plate"));
  for (const auto& [flag, words] : std::vector<std::pair<std::string, std::string>>{
           {"--objective thin_plat", "did you mean \"thin_plate\"?"},
           {"--objective rolling_ball", "radius is missing"},
           {"--objective rolling_ball=-2", "radius is -2, must be > 0"},
           {"--objective pass_through=1,2", "must be a list of 3 numbers"},
           {"--objective thin_plate=0", "so that nothing is wanted"},
           {"--plot plot.gif", "must end in .png or .svg"},
           {"-o fitted.step", "must end in .json"},
           {"-o - --json", "both take standard output"}}) {
    const Outcome bad = run_program("fit " + job + " " + flag);
    EXPECT_EQ(bad.code, 3) << flag;
    EXPECT_THAT(bad.err, HasSubstr(words)) << flag;
  }
}

}  // namespace
}  // namespace blendwright::test
