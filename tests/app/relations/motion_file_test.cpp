// Motions of bodies from lines of numbers: what is read, and what is said of broken lines.
#include "app/pipeline/motion_file.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <sstream>

#include "kernel/base/error.hpp"
#include "tests/support/for_all.hpp"

namespace blendwright::test {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

const std::vector<std::string> bodies{"arm", "part", "tool"};

Motion read(const std::string& text) {
  std::istringstream in(text);
  return read_motion(in, bodies);
}

/// "where: message" of every problem.
std::vector<std::string> problems_of(const std::string& text) {
  try {
    static_cast<void>(read(text));
  } catch (const InputError& e) {
    std::vector<std::string> all;
    for (const Problem& p : e.problems()) all.push_back(p.where + ": " + p.message);
    return all;
  }
  return {};
}

TEST(MotionFile, ReadsStepsBodiesAndQuaternions) {
  const Motion motion = read(
      "# a comment\n"
      "step, body, x, y, z, qw, qx, qy, qz\n"
      "0, 1, 1, 2, 3, 1, 0, 0, 0\n"
      "\n"
      "0, part, -1, 0, 0, 0, 0, 0, 1\n"
      "2.5, \"arm\", 0, 0, 0, 0.6, 0, 0.8, 0\r\n");
  EXPECT_EQ(motion.at_name, "step");
  ASSERT_EQ(motion.steps.size(), 2u);
  EXPECT_EQ(motion.steps[0].at, 0.0);
  ASSERT_EQ(motion.steps[0].placed.size(), 2u);
  EXPECT_EQ(motion.steps[0].placed[0].first, 0u);
  EXPECT_TRUE(motion.steps[0].placed[0].second.R.isIdentity(0.0));
  EXPECT_EQ(motion.steps[0].placed[0].second.t, Vec3(1, 2, 3));
  EXPECT_EQ(motion.steps[0].placed[1].first, 1u);
  // Half a turn about z.
  EXPECT_LE((motion.steps[0].placed[1].second(Vec3(1, 2, 3)) - Vec3(-2, -2, 3)).norm(), 1e-15);
  EXPECT_EQ(motion.steps[1].at, 2.5);
  EXPECT_EQ(motion.steps[1].placed[0].first, 0u);
  // About y by 2 acos(0.6): cosine 2 0.36 - 1, sine 2 0.6 0.8.
  EXPECT_LE((motion.steps[1].placed[0].second(Vec3(0, 0, 1)) - Vec3(0.96, 0, -0.28)).norm(), 1e-15);
}

TEST(MotionFile, ReadsAxesAndAnglesInAnyOrderOfColumns) {
  const Motion motion =
      read("angle_deg;axis_x;axis_y;axis_z;Z;Y;X;Body;Time\n90;0;0;5;3;2;1;tool;0.5\n0;0;0;0;0;0;7;2;0.5\n");
  EXPECT_EQ(motion.at_name, "time");
  ASSERT_EQ(motion.steps.size(), 1u);
  EXPECT_EQ(motion.steps[0].placed[0].first, 2u);
  EXPECT_LE((motion.steps[0].placed[0].second(Vec3(1, 0, 0)) - Vec3(1, 3, 3)).norm(), 1e-15);
  // Without an angle the axis does not matter.
  EXPECT_EQ(motion.steps[0].placed[1].second(Vec3(0, 0, 0)), Vec3(7, 0, 0));
  EXPECT_EQ(read("step body x y z\n1 1 1 1 1\n").steps[0].placed[0].second(Vec3(1, 1, 1)), Vec3(2, 2, 2));
}

TEST(MotionFile, MakesRotationsOfQuaternionsThatAreNearlyUnit) {
  // Text with six digits is off by up to 1e-6 in length; the matrix is a rotation to rounding.
  const Motion motion = read("step,body,x,y,z,qw,qx,qy,qz\n0,1,0,0,0,0.182574,0.365148,0.547723,0.730297\n");
  const Eigen::Matrix3d& turn = motion.steps[0].placed[0].second.R;
  EXPECT_LE((turn * turn.transpose() - Eigen::Matrix3d::Identity()).cwiseAbs().maxCoeff(), 1e-15);
  EXPECT_NEAR(turn.determinant(), 1.0, 1e-15);
}

TEST(MotionFile, NamesEveryBrokenLineAtOnce) {
  const auto problems = problems_of(
      "step,body,x,y,z,qw,qx,qy,qz\n"
      "0,1,0,0,0,1,0,0,0\n"
      "0,1,0,0,0,1,0,0,0\n"
      "1,4,0,0,0,1,0,0,0\n"
      "1,prat,0,0,0,1,0,0,0\n"
      "1,2,0,0,0,1,0,0\n"
      "1,2,0,nan,0,1,0,0,0\n"
      "1,2,0,0,far,1,0,0,0\n"
      "1,2,0,0,1e999,1,0,0,0\n"
      "1,2,0,0,0,1,0.1,0,0\n"
      "1,2,0,0,0,0,0,0,0\n"
      "0,2,0,0,0,1,0,0,0\n"
      "0.5,1.5,0,0,0,1,0,0,0\n");
  // The last step that could be read before line 12 is 0, so that line ascends.
  EXPECT_THAT(
      problems,
      ElementsAre("line 3: places the body \"arm\" a second time at step 0",
                  "line 4: body is \"4\", must be a number from 1 to 3 or a name",
                  "line 5: body is \"prat\", must be \"arm\", \"part\" or \"tool\" or a number; did you "
                  "mean \"part\"?",
                  "line 6: has 8 values, must have 9", "line 7: y is \"nan\", must be a finite number",
                  "line 8: z is \"far\", must be a number", "line 9: z is \"1e999\", must be a finite number",
                  "line 10: the quaternion has the length 1.00498756, must be 1 within 1e-06",
                  "line 11: the quaternion has the length 0, must be 1 within 1e-06",
                  "line 13: body is \"1.5\", must be a number from 1 to 3 or a name"));
}

TEST(MotionFile, RefusesColumnsThatItDoesNotKnowOrThatAreMissing) {
  const struct {
    const char *text, *problem;
  } wrong[] = {
      {"", "is empty"},
      {"# only a comment\n", "is empty"},
      {"0,1,0,0,0\n", "line 1: has numbers, must name the columns"},
      {"step,body,x,y,z\n", "has no line besides the names of its columns"},
      {"step,body,x,y\n0,1,0,0\n", "line 1: names no column \"z\""},
      {"body,x,y,z\n1,0,0,0\n", "line 1: names no column \"step\" or \"time\""},
      {"step,time,body,x,y,z\n", "names both \"step\" and \"time\""},
      {"step,body,x,y,z,qw,qx,qy\n", "names no column \"qz\""},
      {"step,body,x,y,z,axis_x,axis_y,axis_z\n", "names no column \"angle_deg\""},
      {"step,body,x,y,z,qw,qx,qy,qz,axis_x,axis_y,axis_z,angle_deg\n", "must name one turn"},
      {"step,body,x,y,z,angle\n", "names the column \"angle\", which is not known"},
      {"step,body,x,y,z,axis_w\n", "did you mean \"axis_"},
      {"step,body,x,y,z,x\n", "names the column \"x\" twice"},
      {"step,body,x,y,z,axis_x,axis_y,axis_z,angle_deg\n0,1,0,0,0,0,0,0,30\n", "line 2: the axis is 0"},
      {"step,body,x,y,z\n1,1,0,0,0\n0,1,0,0,0\n", "line 3: step is 0 after 1, must ascend"},
  };
  for (const auto& [text, problem] : wrong) {
    SCOPED_TRACE(text);
    const auto problems = problems_of(text);
    ASSERT_FALSE(problems.empty());
    EXPECT_THAT(problems.front(), HasSubstr(problem));
  }
  EXPECT_THAT(problems_of("step,body,x,y,z\n0,1,0,0,0\n"), testing::IsEmpty());  // the control
}

TEST(MotionFile, CountsBrokenLinesBeyondTwenty) {
  std::string text = "step,body,x,y,z\n";
  for (int i = 0; i < 100; ++i) text += "bad\n";
  const auto problems = problems_of(text);
  ASSERT_EQ(problems.size(), 21u);
  EXPECT_EQ(problems.back(), ": 80 more broken lines");
  EXPECT_THAT(problems_of("step,body,x,y,z\n" + std::string(2'000'000, '1')).back(),
              HasSubstr("line 2: is longer than 1 MB"));
}

/// A file with a few bytes changed is read or refused with problems, never anything else.
TEST(MotionFile, SurvivesMutations) {
  const std::string sound =
      "step,body,x,y,z,qw,qx,qy,qz\n0,arm,1,2,3,1,0,0,0\n0,part,-1e-3,0,0,0,0,0,1\n1,3,0,0,0,0.6,0,0.8,0\n"
      "2,arm,1,2,3,1,0,0,0\n";
  constexpr std::string_view bytes = ",;\"\n\r\t #.-+eE019naifxyzqw\x80\xFF\xEF\xBB\xBF";
  std::size_t good = 0, refused = 0;
  for_all(
      [&](Rng& rng) {
        const auto below = [&](std::size_t n) {
          return static_cast<std::size_t>(integer(rng, 0, static_cast<int>(n) - 1));
        };
        std::string text = sound;
        for (std::size_t change = 1 + below(4); change-- > 0;) {
          const std::size_t at = below(text.size());
          const char byte = below(8) == 0 ? '\0' : bytes[below(bytes.size())];
          const std::size_t how = below(3);
          if (how == 0)
            text[at] = byte;
          else if (how == 1)
            text.insert(at, 1, byte);
          else
            text.erase(at, 1 + below(3));
        }
        try {
          for (const MotionStep& step : read(text).steps)
            for (const auto& [body, motion] : step.placed) {
              ASSERT_LT(body, bodies.size());
              ASSERT_TRUE(motion.R.allFinite() && motion.t.allFinite());
            }
          ++good;
        } catch (const InputError& e) {
          ASSERT_FALSE(e.problems().empty());
          ++refused;
        }
      },
      20'000);
  // Most bytes of digits may change, but hardly one of a header or quaternion.
  EXPECT_GT(good, (good + refused) / 100);
  EXPECT_GT(refused, (good + refused) / 4);
}

}  // namespace
}  // namespace blendwright::test
