// `collide` as a user meets it: answers that are proven, motions, scripts, interruption.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <sstream>

#include "tests/app/relations/relation_scenes.hpp"
#include "tests/app/running.hpp"

namespace blendwright::test {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;

/// Directions of length 1 with few digits.
const Vec3 oblique(2.0 / 3.0, 1.0 / 3.0, 2.0 / 3.0);

class CollideVerb : public testing::Test {
 protected:
  CollideVerb() {
    files_.add("ball.json", ball_scene(1.0));
    // Spheres of radius 1 whose centres are 2 + gap apart.
    for (const auto& [file, gap] :
         {std::pair("apart.json", 1e-3), {"near.json", 1e-6}, {"deep.json", -0.1}}) {
      const Vec3 centre = (2.0 + gap) * oblique;
      files_.add(file, ball_scene(1.0, centre.x(), centre.y(), centre.z()));
    }
    files_.add("far.json", ball_scene(1.0, 10.0));
    // A ball in the hole of a ring, 0.01 from it all around: no plane parts them, so boxes have to.
    files_.add("ring.json", R"({ "solid": { "kind": "torus", "ring": 1, "tube": 0.3 } })");
    files_.add("pea.json", ball_scene(0.69));
    files_.add("wall.json",
               R"({ "solid": { "kind": "quadric", "coefficients": [0,0,0,0,0,0,1,0,0,-0.5] } })");
  }
  [[nodiscard]] JsonValue pair(const std::string& arguments, int code = 0) const {
    const Outcome outcome = files_.run("collide --json " + arguments);
    EXPECT_EQ(outcome.code, code) << outcome.err;
    return (*(*parse_json(outcome.out).find("steps")->items())[0].find("pairs")->items())[0];
  }
  SceneFolder files_;
};

std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream in(text);
  for (std::string line; std::getline(in, line);) lines.push_back(line);
  return lines;
}

std::vector<std::string> fields_of(const std::string& line) {
  std::vector<std::string> fields(1);
  for (const char c : line) {
    if (c == ',')
      fields.emplace_back();
    else
      fields.back() += c;
  }
  return fields;
}

TEST_F(CollideVerb, ProvesThatSpheresAreDisjointAndEstimatesTheGap) {
  const Outcome outcome = files_.run("collide ball.json apart.json");
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_EQ(outcome.err, "");
  EXPECT_THAT(outcome.out, AllOf(HasSubstr("ball and apart: disjoint, proven\n"), HasSubstr(" examined   ")));
  EXPECT_LE(widest(outcome.out), 80u) << outcome.out;
  const JsonValue found = pair("ball.json apart.json");
  EXPECT_EQ(text_at(found, "verdict"), "disjoint");
  // Distances are exact, so the estimate of first order is the gap, up to where the point lies: beside the
  // line of centres by t it grows by t^2 to leading order.
  ASSERT_FALSE(found.find("point")->is_null());
  const Vec3 point = point_at(found, "point"), normal = point_at(found, "normal");
  EXPECT_NEAR(number_at(found, "gap"), 1e-3, 1e-6);
  EXPECT_LE((point - 1.0005 * oblique).norm(), 1e-3);
  EXPECT_GE(normal.dot(oblique), 1.0 - 1e-5);
  EXPECT_LE(number_at(pair("ball.json near.json"), "boxes"), 1000.0);
}

TEST_F(CollideVerb, GivesAWitnessOfContact) {
  const Outcome outcome = files_.run("collide ball.json deep.json");
  EXPECT_EQ(outcome.code, 0);
  EXPECT_THAT(outcome.out, AllOf(HasSubstr("ball and deep: in contact, witness point ("),
                                 HasSubstr("penetration "), HasSubstr("to first order")));
  const JsonValue found = pair("ball.json deep.json");
  EXPECT_EQ(text_at(found, "verdict"), "contact");
  const Vec3 point = point_at(found, "point");
  EXPECT_LE(point.norm(), 1.0);
  EXPECT_LE((point - 1.9 * oblique).norm(), 1.0);
  EXPECT_LT(number_at(found, "gap"), 0.0);
}

TEST_F(CollideVerb, SaysWhatItCannotDecide) {
  EXPECT_THAT(files_.run("collide ring.json pea.json").out, HasSubstr("ring and pea: disjoint, proven"));
  const Outcome outcome = files_.run("collide ring.json pea.json --tolerance 0.5");
  EXPECT_EQ(outcome.code, 1);
  EXPECT_THAT(outcome.out, HasSubstr("ring and pea: undecided below 0.5 mm"));
  const Outcome limited = files_.run("collide ring.json pea.json --max-boxes 3");
  EXPECT_EQ(limited.code, 1);
  EXPECT_THAT(limited.out, HasSubstr("undecided after 3 boxes, the work limit"));
  const JsonValue found = pair("ring.json pea.json --tolerance 0.5", 1);
  EXPECT_EQ(text_at(found, "verdict"), "undecided");
  EXPECT_FALSE(found.find("undecided")->is_null());
}

TEST_F(CollideVerb, ExitsAsScriptsExpect) {
  EXPECT_EQ(files_.run("collide ball.json apart.json --expect disjoint --quiet").code, 0);
  EXPECT_EQ(files_.run("collide ball.json apart.json --expect contact").code, 1);
  EXPECT_EQ(files_.run("collide ball.json deep.json --expect contact").code, 0);
  EXPECT_EQ(files_.run("collide ball.json deep.json --expect disjoint").code, 1);
  EXPECT_EQ(files_.run("collide ring.json pea.json --tolerance 0.5 --expect disjoint").code, 1);
  EXPECT_EQ(files_.run("collide ball.json apart.json --quiet").out, "");
}

TEST_F(CollideVerb, TellsEveryPairOfSeveralBodies) {
  const Outcome outcome = files_.run("collide ball.json deep.json far.json");
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_THAT(outcome.out, AllOf(HasSubstr("3 bodies: 1 contact\n"), HasSubstr("ball and deep: in contact"),
                                 HasSubstr("ball and far: disjoint, proven"),
                                 HasSubstr("deep and far: disjoint, proven")));
}

TEST_F(CollideVerb, LooksWhereItIsToldTo) {
  // A half space has no bounds; the ball has.
  EXPECT_THAT(files_.run("collide wall.json ball.json").out, HasSubstr("in contact"));
  EXPECT_THAT(files_.run("collide wall.json ball.json --domain=-2,-2,-2,0,2,2").out,
              HasSubstr("disjoint, proven"));
  const Outcome endless = files_.run("collide wall.json wall.json");
  EXPECT_EQ(endless.code, 3);
  EXPECT_THAT(endless.err, HasSubstr("--domain: "));
}

TEST_F(CollideVerb, DecidesLessByBars) {
  // Along the ring's axis its hole is open; across it, bars through the ball meet the ring before and behind.
  EXPECT_EQ(files_.run("collide ring.json pea.json --projected z").code, 0);
  const Outcome across = files_.run("collide ring.json pea.json --projected x --tolerance 0.05");
  EXPECT_EQ(across.code, 1);
  EXPECT_THAT(across.out, HasSubstr("undecided below 0.05 mm"));
}

const std::string path =
    "step,body,x,y,z\n"
    "0,2,3,0,0\n"
    "1,2,1.9,0,0\n"
    "2,2,0,2.5,0\n"
    "3,1,0,1,0\n";

TEST_F(CollideVerb, FollowsAMotion) {
  files_.add("path.csv", path);
  const Outcome outcome = files_.run("collide ball.json ball.json --motion path.csv -o new/contacts.csv");
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_THAT(outcome.out,
              AllOf(HasSubstr("2 bodies, 4 steps: 2 contacts\n"), HasSubstr("step 1"), HasSubstr("step 3"),
                    Not(HasSubstr("step 2")), HasSubstr("wrote new/contacts.csv")));
  const auto lines = lines_of(content(files_ / "new/contacts.csv"));
  ASSERT_EQ(lines.size(), 5u);
  EXPECT_EQ(lines[0], "step,first,second,verdict,x,y,z,nx,ny,nz,gap,boxes");
  std::vector<std::string> verdicts;
  for (std::size_t i = 1; i < lines.size(); ++i) {
    const auto fields = fields_of(lines[i]);
    ASSERT_EQ(fields.size(), 12u);
    EXPECT_EQ(fields[0], std::to_string(i - 1));
    EXPECT_EQ(fields[1], "ball");
    EXPECT_EQ(fields[2], "ball (2)");
    verdicts.push_back(fields[3]);
  }
  // The second body stays at (0, 2.5, 0) in the last step, where the first comes to (0, 1, 0).
  EXPECT_THAT(verdicts, ElementsAre("disjoint", "contact", "disjoint", "contact"));
  const JsonValue report =
      parse_json(files_.run("collide ball.json ball.json --json --motion - < path.csv").out);
  EXPECT_EQ(text_at(report, "answer"), "contact");
  EXPECT_EQ(report.find("steps")->items()->size(), 4u);
  EXPECT_EQ(number_at((*report.find("steps")->items())[3], "step"), 3.0);
}

TEST_F(CollideVerb, AnswersTheSameOnOneThreadAndAgain) {
  std::string motion = "time,body,x,y,z,axis_x,axis_y,axis_z,angle_deg\n";
  for (int i = 0; i < 20; ++i)
    for (int body = 1; body <= 4; ++body)
      motion += number_text(0.1 * i) + "," + std::to_string(body) + "," +
                number_text(2.0 * body - 0.03 * i * body) + ",0,0.2,1,1,0," + std::to_string(10 * i) + "\n";
  files_.add("egg.json", R"({ "solid": { "kind": "ellipsoid", "a": 1.2, "b": 0.8, "c": 0.6 } })");
  files_.add("motion.csv", motion);
  const std::string scenes = "collide egg.json egg.json ball.json egg.json --motion motion.csv ";
  const Outcome one = files_.run(scenes + "--json --threads 1"), two = files_.run(scenes + "--json");
  EXPECT_EQ(one.code, two.code);
  EXPECT_THAT(one.out, HasSubstr("\"contact\""));
  EXPECT_TRUE(one.out == two.out);
}

TEST_F(CollideVerb, KeepsFilesThatExistAndLeavesNothingWhenTheDiskIsFull) {
  files_.add("contacts.csv", "mine");
  const Outcome refused = files_.run("collide ball.json deep.json -o contacts.csv");
  EXPECT_EQ(refused.code, 5);
  EXPECT_EQ(content(files_ / "contacts.csv"), "mine");
  EXPECT_EQ(files_.run("collide ball.json deep.json -o contacts.csv --force --quiet").code, 0);
  EXPECT_THAT(content(files_ / "contacts.csv"), HasSubstr("ball,deep,contact,"));
  std::string motion = "step,body,x,y,z\n";
  for (int i = 0; i < 200; ++i) motion += std::to_string(i) + ",1,0.1,0.2,0.3\n";
  files_.add("long.csv", motion);
  const std::size_t before = files_.files().size();
  const Outcome full = files_.run("collide ball.json deep.json --motion long.csv -o new/full.csv",
                                  "trap '' XFSZ; ulimit -f 8; exec");
  EXPECT_EQ(full.code, 5) << full.err;
  EXPECT_THAT(full.err, AllOf(HasSubstr("new/full.csv"), Not(HasSubstr("unfinished"))));
  EXPECT_EQ(files_.files().size(), before);
}

TEST_F(CollideVerb, StopsAtCtrlCAndLeavesNothing) {
  // The motion comes through a pipe that stays open, so the program waits until the signal is there.
  const std::string ball = (files_ / "ball.json").string();
  Running running({"collide", ball, ball, "--motion", "-", "-o", (files_ / "out.csv").string()}, path,
                  files_ / "err");
  ASSERT_TRUE(running.handles(SIGINT));
  running.send(SIGINT);
  EXPECT_EQ(running.finish(), 4);
  EXPECT_THAT(content(files_ / "err"), HasSubstr("stopped while "));
  EXPECT_THAT(files_.files(), Not(testing::Contains("out.csv")));
}

TEST_F(CollideVerb, RunsToTheEndWhenNobodyStopsIt) {  // the negative control of the test above
  const std::string ball = (files_ / "ball.json").string();
  Running running({"collide", ball, ball, "--motion", "-", "-o", (files_ / "out.csv").string()}, path,
                  files_ / "err");
  ASSERT_TRUE(running.handles(SIGINT));
  EXPECT_EQ(running.finish(), 0) << content(files_ / "err");
  EXPECT_THAT(files_.files(), testing::Contains("out.csv"));
}

}  // namespace
}  // namespace blendwright::test
