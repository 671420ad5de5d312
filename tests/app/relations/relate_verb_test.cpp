// `relate` as a user meets it: every relation with its proofs, places of points, exit codes.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <sstream>

#include "tests/app/relations/relation_scenes.hpp"
#include "tests/app/running.hpp"

namespace blendwright::test {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

class RelateVerb : public testing::Test {
 protected:
  RelateVerb() {
    files_.add("ball.json", ball_scene(1.0));
    files_.add("small.json", ball_scene(0.25, 0.5));
    files_.add("beside.json", ball_scene(1.0, 1.5, 0.2, 0.1));
    files_.add("far.json", ball_scene(1.0, 2.0, 2.0, 0.5));
    files_.add("both.json", R"({ "nodes": { "big": )" + ball_node(2.0) + R"(, "tiny": )" + ball_node(0.1) +
                                R"( }, "solid": "big" })");
    files_.add("cm.json", ball_scene(0.025, 0.05, 0.0, 0.0, "cm"));
  }
  SceneFolder files_;
};

TEST_F(RelateVerb, TellsEveryRelationWithItsExitCode) {
  const struct {
    const char *scenes, *words;
  } relations[] = {{"ball.json far.json", "ball and far are disjoint, proven\n"},
                   {"small.json ball.json", "small is inside ball, proven\n"},
                   {"ball.json small.json", "small is inside ball, proven\n"},
                   {"ball.json beside.json", "ball and beside overlap, proven\n"},
                   {"both.json#tiny both.json#big", "both#tiny is inside both#big, proven\n"}};
  for (const auto& [scenes, words] : relations) {
    SCOPED_TRACE(scenes);
    const Outcome outcome = files_.run(std::string("relate ") + scenes);
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    EXPECT_THAT(outcome.out, HasSubstr(words));
    EXPECT_EQ(outcome.err, "");
    EXPECT_LE(widest(outcome.out), 100u) << outcome.out;
  }
}

TEST_F(RelateVerb, SaysThatEqualSolidsStayUndecided) {
  const Outcome outcome = files_.run("relate ball.json ball.json --tolerance 0.2");
  EXPECT_EQ(outcome.code, 1) << outcome.err;
  EXPECT_THAT(outcome.out, AllOf(HasSubstr("undecided\n"), HasSubstr("undecided below 0.2 mm"),
                                 HasSubstr("ball is inside ball (2)"), Not(HasSubstr("proven\n"))));
  const Outcome limited = files_.run("relate ball.json ball.json --max-boxes 100");
  EXPECT_EQ(limited.code, 1);
  EXPECT_THAT(limited.out, HasSubstr("100 boxes, the work limit"));
}

TEST_F(RelateVerb, GivesEachStatementItsProofInTheReport) {
  const Outcome outcome = files_.run("relate small.json ball.json --json --tolerance 1e-6");
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  const JsonValue report = parse_json(outcome.out);
  EXPECT_EQ(number_at(report, "tolerance"), 1e-6);
  EXPECT_EQ(text_at(report, "unit"), "mm");
  const auto& statements = *report.find("statements")->items();
  ASSERT_EQ(statements.size(), 5u);
  EXPECT_EQ(text_at(statements[3], "statement"), "small is inside ball");
  EXPECT_EQ(text_at(statements[3], "answer"), "proven");
  EXPECT_TRUE(statements[3].find("witness")->is_null());
  EXPECT_EQ(text_at(statements[4], "answer"), "refuted");
  // The witness of "ball is not inside small" is in the one and outside of the other.
  const Vec3 witness = point_at(statements[4], "witness");
  EXPECT_LE(witness.norm(), 1.0);
  EXPECT_GT((witness - Vec3(0.5, 0, 0)).norm(), 0.25);
  EXPECT_EQ(report.find("bodies")->items()->size(), 2u);
  EXPECT_EQ(files_.run("relate small.json ball.json --json --tolerance 1e-6 --threads 1").out, outcome.out);
}

TEST_F(RelateVerb, PlacesPointsInOneSolid) {
  files_.add("points.csv", "x,y,z\n0,0,0\n1,0,0\n0,1.5,0\n");
  const Outcome outcome = files_.run("relate ball.json --points points.csv");
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  std::istringstream lines(outcome.out);
  std::string line;
  std::getline(lines, line);
  EXPECT_EQ(line, "x,y,z,s2,s3,phi,distance");
  std::getline(lines, line);
  EXPECT_EQ(line.rfind("0,0,0,1,2,1,", 0), 0u) << line;
  std::getline(lines, line);
  EXPECT_EQ(line, "1,0,0,1,1,0,0");
  std::getline(lines, line);
  EXPECT_EQ(line, "0,1.5,0,0,0,-0.5,0.5");
  // A tolerance of 0.6 reaches the third point too.
  EXPECT_THAT(files_.run("relate ball.json --points points.csv --tolerance 0.6").out,
              HasSubstr("0,1.5,0,0,1,-0.5,0.5"));
  EXPECT_THAT(files_.run("relate ball.json --points points.csv --mode guaranteed --tolerance 0.1").out,
              HasSubstr("0,1.5,0,0,0,-0.5,0.5"));
}

TEST_F(RelateVerb, PlacesPointsInTwoSolidsAndWritesThem) {
  files_.add("points.csv", "0.5,0,0\n");
  const Outcome outcome = files_.run("relate ball.json small.json --points - -o new/p.csv < points.csv");
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_THAT(outcome.out, HasSubstr("wrote new/p.csv, 1 point"));
  const std::string text = content(files_ / "new/p.csv");
  EXPECT_EQ(text.substr(0, text.find('\n')), "x,y,z,s2_a,s3_a,phi_a,distance_a,s2_b,s3_b,phi_b,distance_b");
  EXPECT_THAT(text, HasSubstr("0.5,0,0,1,2,0.5,0.5,1,2,0.25,"));
  EXPECT_EQ(files_.run("relate ball.json --points points.csv -o new/p.csv").code, 5);
  EXPECT_EQ(files_.run("relate ball.json --points points.csv -o new/p.csv --force --quiet").out, "");
}

TEST_F(RelateVerb, RefusesOrConvertsUnits) {
  const Outcome refused = files_.run("relate ball.json cm.json");
  EXPECT_EQ(refused.code, 3);
  EXPECT_THAT(refused.err, AllOf(HasSubstr("\"cm\": is in cm, must be in mm as \"ball\" is"),
                                 HasSubstr("--convert-units")));
  // 0.025 cm about (0.05, 0, 0) cm is 0.25 mm about (0.5, 0, 0) mm.
  const Outcome converted = files_.run("relate cm.json ball.json --convert-units");
  EXPECT_EQ(converted.code, 0) << converted.err;
  EXPECT_THAT(converted.out, HasSubstr("cm is inside ball, proven"));
  EXPECT_THAT(converted.err, HasSubstr("ball is in mm: its lengths are multiplied by 0.1"));
}

TEST_F(RelateVerb, ReadsOneSceneFromStandardInput) {
  const Outcome outcome = files_.run("relate - ball.json < small.json");
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_THAT(outcome.out, HasSubstr("scene is inside ball, proven"));
  EXPECT_EQ(files_.run("relate - - < small.json").code, 3);
}

TEST_F(RelateVerb, StopsAtCtrlC) {
  Running running({"relate", "-", (files_ / "ball.json").string(), "--max-boxes", "1000000000"},
                  ball_scene(1.0), files_ / "err");
  ASSERT_TRUE(running.handles(SIGINT));
  running.send(SIGINT);
  EXPECT_EQ(running.finish(), 4);
  EXPECT_THAT(content(files_ / "err"), HasSubstr("stopped while "));
}

}  // namespace
}  // namespace blendwright::test
