// Every broken job ends in one clear message with its JSON pointer and the right exit code, and leaves
// nothing behind.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <set>

#include "tests/app/program.hpp"

namespace blendwright::test {
namespace {

using testing::HasSubstr;

struct BadJob {
  const char* file;
  const char* where;  ///< JSON pointer, or "" for the job as a whole
  const char* words;  ///< of the message
  int code;
};

void PrintTo(const BadJob& bad, std::ostream* out) { *out << bad.file; }

// 1: built, but not verified; 3: bad input; 4: no result; 5: input or output.
constexpr BadJob bad_jobs[] = {
    {"anchor-without-mode", "/blends/reducer/shape/anchor", "is only used by mode \"anchor\"", 3},
    {"axis-and-placement", "/primaries/thin/placement", "contradicts /primaries/thin/axis", 3},
    {"axis-parallel", "/primaries/thin/axis/x_direction", "is parallel to direction", 3},
    {"axis-zero", "/primaries/thin/axis/direction", "is zero, must be a direction", 3},
    {"b-zero", "/blends/reducer/shape/b", "is 0, must not be 0", 3},
    {"blanks", "", "is empty; the shortest job has", 3},
    {"constant-named-sin", "/let/sin", "which formulas use already", 3},
    {"constant-of-variable", "/let/r", "\"v\" is not known", 3},
    {"constant-rule-without-factor", "/blends/reducer/from/magnitude/factor", "is missing", 3},
    {"deep-nesting", "", "nested deeper than 64 levels", 3},
    {"duplicate-key", "/primaries/thin/radius", "appears twice", 3},
    {"edge-of-a-cylinder", "/blends/reducer/from/trimline/kind", "\"thin\" is a cylinder", 3},
    {"empty", "", "is empty; the shortest job has", 3},
    {"factor-law-dips", "/blends/reducer/from/magnitude/factor", "between its points", 3},
    {"factor-law-not-closing", "/blends/reducer/from/magnitude/factor", "leave one out", 3},
    {"factor-negative", "/blends/reducer/from/magnitude/factor", "is -1, must be > 0", 3},
    {"family-without-g2", "/blends/reducer/shape/family", "no side asks for G2", 3},
    {"formula-not-finite", "/primaries/thin/radius", "infinite", 3},
    {"formula-syntax", "/blends/reducer/to/trimline/curve/0", "must be an operator or the \")\"", 3},
    {"formula-unknown-name", "/primaries/thin/radius", "did you mean \"width\"", 3},
    {"frame-not-perpendicular", "/blends/reducer/shape/frame/fixed", "three perpendicular unit vectors", 3},
    {"g2-with-bcd", "/blends/reducer/shape/b", "contradicts G2 at /blends/reducer/from/continuity", 3},
    {"isoline-foreign-parameter", "/blends/reducer/from/trimline/x", "must be \"length\" or \"angle_deg\"",
     3},
    {"isoline-no-parameter", "/blends/reducer/from/trimline/length", "is missing", 3},
    {"isoline-off-surface", "/blends/reducer/from/trimline", "leaves its primary", 4},
    {"isoline-two-parameters", "/blends/reducer/from/trimline/angle_deg",
     "contradicts /blends/reducer/from/trimline/length", 3},
    {"law-outside", "/blends/reducer/from/magnitude/factor/1/0", "is 1.5, must be in [0, 1]", 3},
    {"literal-g2-without-d", "/blends/reducer/from/continuity", "give /blends/reducer/from/D", 3},
    {"literal-with-correspondence", "/blends/reducer/correspondence", "contradicts /blends/reducer/from/C",
     3},
    {"literal-with-keep", "/blends/reducer/from/keep", "contradicts /blends/reducer/from/C", 3},
    {"literal-with-magnitude", "/blends/reducer/from/magnitude", "contradicts /blends/reducer/from/C", 3},
    {"literal-without-t", "/blends/reducer/from/T", "is missing", 3},
    {"literal-without-v", "/blends/reducer/v", "need the range of v", 3},
    {"many-problems", "/tolerance/angle_deg", "many-problems.json: 4 problems", 3},
    {"missing-kind", "/primaries/thin/kind", "is missing; must be \"plane\"", 3},
    {"missing-radius", "/primaries/thin/radius", "is missing", 3},
    {"missing-to", "/blends/reducer/to", "is missing", 3},
    {"missing-trimline", "/blends/reducer/from/trimline", "is missing", 3},
    {"mode-anchor-without-anchor", "/blends/reducer/shape/anchor", "needs a point", 3},
    {"name-not-ascii", "/primaries/d\xC3\xBCnn", "is named \"d\xC3\xBCnn\"; a name must be", 3},
    {"name-with-slash", "/blends/..~1reducer", "a name must be", 3},
    {"nan-literal", "", "line 3, column 45: invalid literal", 3},
    {"negative-radius", "/primaries/thin/radius", "is -2, must be > 0", 3},
    {"negative-tension", "/blends/reducer/shape/tension", "is -1, must be >= 0", 3},
    {"no-blends", "/blends", "must have at least one blend", 3},
    {"not-an-object", "", "is a list of 3 values, must be an object", 3},
    {"number-too-large", "", "1e999", 3},
    {"one-side-literal", "/blends/reducer/to", "both sides must be of one sort", 3},
    {"only-comments", "", "line 4, column 1: unexpected end of input", 3},
    {"open-with-closed", "/blends/reducer", "the trimline of \"from\" is closed and that of \"to\" is open",
     4},
    {"projection-misses", "/blends/reducer/to/trimline", "has no projection", 4},
    {"projection-through-pole", "/blends/reducer/from/trimline", "passes through a pole of its primary", 4},
    {"q-and-c", "/blends/reducer/shape/c", "contradicts /blends/reducer/shape/q", 3},
    {"quintic-with-tension", "/blends/reducer/shape/tension", "contradicts /blends/reducer/shape/family", 3},
    {"range-backwards", "/primaries/thin/length", "is [0, -2], must be [low, high]", 3},
    {"resonance", "/blends/reducer", "in resonance", 4},
    {"same-name", "/blends/thin", "has the name of a primary", 3},
    {"shift-no-list", "/blends/reducer/from/trimline/shift", "must be a list of [t, du, dv]", 3},
    {"shift-two-numbers", "/blends/reducer/from/trimline/shift/0", "must be", 3},
    {"shift-not-increasing", "/blends/reducer/from/trimline/shift/1", "must come after 0.5", 3},
    {"shift-outside", "/blends/reducer/from/trimline/shift/0", "must lie in [0, 1]", 3},
    {"shift-not-closed", "/blends/reducer/from/trimline/shift/2", "same point of a closed trimline", 3},
    {"shift-off-surface", "/blends/reducer/from/trimline", "leaves its primary", 4},
    {"step-ambiguous-edge", "/blends/reducer/to/trimline/near", "matches 2 circle edges, must match one", 3},
    {"step-ambiguous-face", "/primaries/wide/select", "matches 9 plane faces, must match one", 3},
    {"step-missing", "/primaries/wide/file", "no-such-part.step", 5},
    {"step-no-edge", "/blends/reducer/to/trimline/near", "matches no ellipse edge", 3},
    {"step-no-face", "/primaries/wide/select", "matches no torus face", 3},
    {"step-no-step", "/primaries/wide/file", "is not a STEP file", 5},
    {"syntax-error", "", "line 3, column 54", 3},
    {"tangent-angle-too-large", "/blends/reducer/from/tangent_angle_deg", "is 75, must be >= -60 and <= 60",
     3},
    {"tension-and-b", "/blends/reducer/shape/b", "contradicts /blends/reducer/shape/tension", 3},
    {"theta-too-large", "/blends/reducer", "circle_like magnitudes need less than 170 deg", 4},
    {"through-pole", "/blends/reducer", "passes a pole of its primary", 4},
    {"tolerance-zero", "/tolerance/position", "is 0, must be > 0", 3},
    {"torus-cuts-itself", "/primaries/thin/minor_radius", "must be less than the major_radius 1", 3},
    {"literal-not-closing", "/blends/transition", "boundary data must close with their derivatives", 4},
    {"too-few-points", "/blends/reducer/to/trimline/points", "/trimline/points: has 3, degree 3 needs", 3},
    {"crossing-trimlines", "/blends/two/to/trimline", "crosses the trimline /blends/one/to on primary", 4},
    {"self-crossing-trimline", "/blends/foot", "crosses or overlaps itself", 4},
    {"touching-trimlines", "/blends/reducer", "the trimlines touch at v = 0", 4},
    {"trailing-comma", "", "line 4, column 64: a comma before '}' or ']' is one too many", 3},
    {"trailing-text", "", "expected end of input", 3},
    {"trimline-off-surface", "/blends/reducer/from/trimline", "leaves its primary", 4},
    {"truncated-utf8", "", "ill-formed UTF-8", 3},
    {"twisted-correspondence", "", "twisted-correspondence.json: 1 blend", 1},
    {"unclosed", "", "unexpected end of input", 3},
    {"unknown-continuity", "/blends/reducer/from/continuity", "is \"G3\", must be \"G0\", \"G1\" or \"G2\"",
     3},
    {"unknown-format", "/output/formats/1", "is \"iges\", must be \"step\"", 3},
    {"unknown-key", "/blends/reducer/from/contnuity", "did you mean \"continuity\"", 3},
    {"unknown-kind", "/primaries/thin/kind", "did you mean \"cylinder\"", 3},
    {"unknown-primary", "/blends/reducer/from/primary", "did you mean \"thin\"", 3},
    {"unknown-trimline-kind", "/blends/reducer/from/trimline/kind", "did you mean \"isoline\"", 3},
    {"unknown-unit", "/unit", "is \"inch\", must be \"mm\", \"cm\", \"m\" or \"in\"", 3},
    {"utf16", "", "is in UTF-16, must be in UTF-8", 3},
    {"v-without-literal", "/blends/reducer/v", "is for literal boundary data", 3},
    {"wrong-type-closed", "/blends/reducer/to/trimline/closed", "is \"yes\", must be true or false", 3},
    {"wrong-type-primaries", "/primaries", "is a list of 2 values, must be an object", 3},
    {"wrong-type-radius", "/primaries/thin/radius", "is true, must be a number", 3},
    {"wrong-type-range", "/primaries/thin/length", "must be a list of 2 numbers", 3},
    {"zero-tangent", "/blends/reducer", "|C'| = 0", 4},
};

fs::path bad_folder() { return fs::path(BLENDWRIGHT_SOURCE_DIR) / "tests/data/specs/bad"; }

class BadJobs : public testing::TestWithParam<BadJob> {};

TEST_P(BadJobs, EndInOneClearMessageAndLeaveNothing) {
  const BadJob& bad = GetParam();
  const Folder folder;
  const fs::path job = bad_folder() / (std::string(bad.file) + ".json");
  ASSERT_TRUE(fs::exists(job)) << job;
  std::string verb = "verify ";
  if (bad.code != 1) verb = std::string("blend --format step -o ") + quoted_path(folder / "out") + " ";
  const Outcome outcome = run_program(verb + quoted_path(job));
  EXPECT_EQ(outcome.code, bad.code) << outcome.err;
  EXPECT_THAT(folder.files(), testing::IsEmpty());
  if (bad.code == 1) {
    EXPECT_THAT(outcome.out, HasSubstr(bad.words));
    return;
  }
  EXPECT_EQ(outcome.out, "");
  // The message names the file once, at its start, and the place on a line of its own or in the first line.
  EXPECT_EQ(outcome.err.rfind(std::string(bad.file) + ".json: ", 0), 0u) << outcome.err;
  EXPECT_THAT(outcome.err, HasSubstr(bad.words));
  std::string where = bad.where;
  if (!where.empty()) where += ": ";
  EXPECT_THAT(outcome.err, HasSubstr(where));
}

INSTANTIATE_TEST_SUITE_P(Table, BadJobs, testing::ValuesIn(bad_jobs), [](const auto& row) {
  std::string name = row.param.file;
  for (char& c : name)
    if (c == '-') c = '_';
  return name;
});

TEST(BadJobFolder, HasARowForEveryFileAndAtLeast45) {
  std::set<std::string> rows, files;
  for (const BadJob& bad : bad_jobs) rows.insert(bad.file);
  for (const auto& entry : fs::directory_iterator(bad_folder()))
    if (entry.path().extension() == ".json") files.insert(entry.path().stem().string());
  EXPECT_EQ(rows, files);
  EXPECT_GE(rows.size(), 45u);
}

}  // namespace
}  // namespace blendwright::test
