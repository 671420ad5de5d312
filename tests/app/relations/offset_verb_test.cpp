// `offset` as a user meets it: every kind with its measured error, files, and what vanishes.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "implicit/polygonize/polygonize.hpp"
#include "kernel/exchange/mesh_files.hpp"
#include "tests/app/relations/relation_scenes.hpp"
#include "tests/app/running.hpp"

namespace blendwright::test {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;

constexpr double pi = std::numbers::pi;

class OffsetVerb : public testing::Test {
 protected:
  OffsetVerb() {
    files_.add("ball.json", R"({ "unit": "cm", "nodes": { "ball": { "kind": "sphere", "radius": 2 },
      "egg": { "kind": "ellipsoid_quadric", "a": 3, "b": 2, "c": 1 },
      "die": { "kind": "box", "half": [1, 0.8, 0.6] } }, "solid": "ball" })");
  }
  [[nodiscard]] JsonValue report(const std::string& arguments) const {
    const Outcome outcome = files_.run("offset ball.json --json --cells 48 " + arguments);
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    return parse_json(outcome.out);
  }
  /// The only error of the report.
  [[nodiscard]] JsonValue error(const std::string& arguments) const {
    const JsonValue all = *report(arguments).find("offset")->find("errors");
    EXPECT_EQ(all.items()->size(), 1u);
    return all.items()->at(0);
  }
  SceneFolder files_;
};

TEST_F(OffsetVerb, MeshesTheOffsetAndMeasuresIt) {
  const Outcome outcome = files_.run("offset ball.json --distance 0.5 --cells 64 -o grown.vtp");
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_EQ(outcome.err, "");
  EXPECT_THAT(outcome.out,
              AllOf(HasSubstr("ball.json: the offset by 0.5 cm of ball, 4 nodes\n"),
                    HasSubstr("offset error "), HasSubstr(" rms, over "), HasSubstr("wrote grown.vtp")));
  EXPECT_LE(widest(outcome.out), 80u) << outcome.out;
  const TriMesh mesh = read_mesh(files_ / "grown.vtp");
  for (const Vec3& p : mesh.points) EXPECT_NEAR(p.norm(), 2.5, 1e-6);
  EXPECT_EQ(mesh.name, "the offset by 0.5 cm of ball");
  const JsonValue made = report("--distance -0.5");
  EXPECT_EQ(text_at(*made.find("offset"), "kind"), "ball");
  EXPECT_EQ(number_at(*made.find("offset"), "distance"), -0.5);
  EXPECT_NEAR(number_at(made, "volume"), 4.0 / 3.0 * pi * std::pow(1.5, 3), 0.2);
}

TEST_F(OffsetVerb, ShowsHowExactEachKindIs) {
  // The errors of sheets of closed form: constant radius is exact, along the normal off by up to 1.3e-2 at
  // distance 0.3 on this ellipsoid; the field value is no length at all.
  const JsonValue ball = error("--solid egg --distance 0.3"),
                  normal = error("--solid egg --distance 0.3 --kind normal"),
                  iso = error("--solid egg --distance 0.3 --kind iso");
  EXPECT_LE(std::abs(number_at(ball, "worst")), 1e-9);
  EXPECT_GT(std::abs(number_at(normal, "worst")), 5e-3);
  EXPECT_LT(std::abs(number_at(normal, "worst")), 2e-2);
  EXPECT_GT(std::abs(number_at(iso, "worst")), 5e-2);
  EXPECT_GE(number_at(ball, "samples"), 1000.0);
  EXPECT_GE(std::abs(number_at(normal, "worst")), number_at(normal, "rms"));
  const Vec3 where = point_at(normal, "where");
  // Near the offset surface, which lies between two ellipsoids.
  EXPECT_LE((where.cwiseQuotient(Vec3(3.4, 2.4, 1.4))).norm(), 1.0);
  EXPECT_GE((where.cwiseQuotient(Vec3(3.0, 2.0, 1.0))).norm(), 1.0);
}

TEST_F(OffsetVerb, MakesShellsRoundsAndFillets) {
  const JsonValue shell = report("--shell 0.5,0.25");
  EXPECT_NEAR(number_at(shell, "volume"), 4.0 / 3.0 * pi * (std::pow(2.25, 3) - std::pow(1.5, 3)), 0.8);
  EXPECT_EQ(number_at(shell, "components"), 2.0);
  EXPECT_EQ(shell.find("offset")->find("errors")->items()->size(), 2u);
  const JsonValue round = report("--solid die --round 0.2");
  EXPECT_NEAR(number_at(round, "volume"), 3.68589966375522, 0.02);
  EXPECT_EQ(round.find("offset")->find("errors")->items()->size(), 0u);
  const JsonValue fillet = report("--solid die --fillet 0.2");
  EXPECT_NEAR(number_at(fillet, "volume"), 8 * 0.48, 0.02);  // a convex solid has no concave edge
}

TEST_F(OffsetVerb, SaysThatNothingIsLeftAndProvesIt) {
  for (const char* arguments :
       {"--distance -2.5", "--round 2.5", "--solid egg --distance=-1.5", "--distance=-3 --kind iso"}) {
    SCOPED_TRACE(arguments);
    const Outcome outcome = files_.run(std::string("offset ball.json -o left.vtp ") + arguments);
    EXPECT_EQ(outcome.code, 4) << outcome.out;
    EXPECT_THAT(outcome.err, AllOf(HasSubstr("leaves nothing of"), HasSubstr("proven")));
    EXPECT_EQ(outcome.out, "");
    EXPECT_THAT(files_.files(), testing::ElementsAre("ball.json"));
  }
  EXPECT_EQ(files_.run("offset ball.json --distance -1.9").code, 0);  // the control
}

TEST_F(OffsetVerb, TakesTheFlagsOfMesh) {
  const Outcome outcome = files_.run(
      "offset ball.json --distance 0.5 --cell 0.25 --box=-3,-3,-3,0,3,3 --at-box open -o a.stl -o a.ply "
      "--threads 1");
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_THAT(outcome.err, HasSubstr("the box cuts the solid; it is left open there"));
  EXPECT_THAT(outcome.out, AllOf(HasSubstr("each 0.25 cm"), HasSubstr("wrote a.stl"), HasSubstr("a.ply")));
  EXPECT_EQ(files_.run("offset ball.json --distance 0.5 -o a.stl").code, 5);
  EXPECT_EQ(files_.run("offset ball.json --distance 0.5 -o a.stl --force --quiet").out, "");
}

TEST_F(OffsetVerb, WritesTheSameBytesAgain) {
  for (const char* name : {"a", "b"})
    ASSERT_EQ(files_
                  .run(std::string("offset ball.json --solid egg --distance -0.2 --cells 32 --quiet -o ") +
                       name + ".vtp" + (*name == 'b' ? " --threads 1" : ""))
                  .code,
              0);
  EXPECT_TRUE(content(files_ / "a.vtp") == content(files_ / "b.vtp"));
}

TEST_F(OffsetVerb, StopsAtCtrlCAndLeavesNothing) {
  Running running({"offset", "-", "--distance", "0.1", "-o", (files_ / "out.vtp").string()}, ball_scene(1.0),
                  files_ / "err");
  ASSERT_TRUE(running.handles(SIGINT));
  running.send(SIGINT);
  EXPECT_EQ(running.finish(), 4);
  EXPECT_THAT(content(files_ / "err"), HasSubstr("<stdin>: stopped while "));
  EXPECT_THAT(files_.files(), Not(testing::Contains("out.vtp")));
}

}  // namespace
}  // namespace blendwright::test
