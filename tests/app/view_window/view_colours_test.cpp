// Deviations in the window, while a job is shaped and between two files; the field of a scene.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/app/view_window/viewing.hpp"

namespace blendwright::test {
namespace {

using ::testing::HasSubstr;

const std::string specs = BLENDWRIGHT_SOURCE_DIR "/examples/specs/";

std::string message(const Viewed& v, std::size_t state) {
  return *v.states.at(state).find("message")->text();
}

double largest(const std::string& message) {
  const std::size_t at = message.find("largest ");
  if (at == std::string::npos) throw std::runtime_error("no deviation is told: " + message);
  return std::stod(message.substr(at + 8));
}

TEST(ViewDeviation, IsNoneAtFirstFollowsTheHandAndGoesWithUndo) {
  const Viewed v = viewed(specs + "branch-to-main.json --width 480 --height 360",
                          "key 9\ndrag tension 20\ndrag tension 2\nkey Ctrl+Z\nkey Ctrl+Z\n");
  ASSERT_EQ(v.states.size(), 5u) << v.err;
  EXPECT_THAT(message(v, 0), HasSubstr("deviation from what was opened"));
  EXPECT_LE(largest(message(v, 0)), 1e-6);  // the grid's points are floats
  EXPECT_GT(largest(message(v, 1)), 0.01);
  EXPECT_LT(largest(message(v, 2)), 0.5 * largest(message(v, 1)));
  EXPECT_EQ(message(v, 3), message(v, 1));
  EXPECT_EQ(message(v, 4), message(v, 0));
}

TEST(ViewDeviation, OfAJobFromItsStepFileIsRounding) {
  const Folder folder;
  const Outcome made = run_program("blend " + specs + "coaxial-cylinders.json --quiet --format step -o " +
                                   quoted_path(folder.path()));
  ASSERT_EQ(made.code, 0) << made.err;
  const Viewed v = viewed(specs + "coaxial-cylinders.json " + quoted_path(folder / "coaxial-cylinders.step") +
                              " --width 640 --height 360",
                          "key 9\n");
  ASSERT_EQ(v.states.size(), 1u) << v.err;
  EXPECT_THAT(message(v, 0), HasSubstr("deviation from coaxial-cylinders.step"));
  EXPECT_LE(largest(message(v, 0)), 1e-6);  // floats; the file itself is as good as the tolerance of the job
  // The other way round: the file's pipes are not in the job's shape, hence not measured against its blend.
  const Viewed back = viewed(quoted_path(folder / "coaxial-cylinders.step") + " " + specs +
                                 "coaxial-cylinders.json --width 640 --height 360",
                             "key 9\n");
  ASSERT_EQ(back.states.size(), 1u) << back.err;
  EXPECT_LE(largest(message(back, 0)), 1e-6);
}

TEST(ViewDeviation, SaysWhyThereIsNone) {
  const Folder folder;
  const Outcome made = run_program("blend " + specs + "coaxial-cylinders.json --quiet --format stl -o " +
                                   quoted_path(folder.path()));
  ASSERT_EQ(made.code, 0) << made.err;
  const std::string stl = quoted_path(folder / folder.files().front());
  const Viewed alone = viewed(stl + " --width 480 --height 360", "key 9\n");
  ASSERT_EQ(alone.states.size(), 1u) << alone.err;
  EXPECT_THAT(message(alone, 0), HasSubstr("needs two files"));
  std::string text = content(specs + "coaxial-cylinders.json");
  text.insert(text.find('{') + 1, "\"unit\": \"in\",");
  write(folder / "inch.json", text);
  const Viewed mixed = viewed(
      specs + "coaxial-cylinders.json " + quoted_path(folder / "inch.json") + " --width 480 --height 360",
      "key 9\n");
  ASSERT_EQ(mixed.states.size(), 1u) << mixed.err;
  EXPECT_THAT(message(mixed, 0), HasSubstr(", must be in mm as "));
}

TEST(ViewField, IsShownOnAPlaneThroughTheSolidAndFollowsTheSlider) {
  const std::string scene = BLENDWRIGHT_SOURCE_DIR "/examples/scenes/s3-bridge.json";
  const Folder folder;
  const Viewed v =
      viewed(scene + " --width 640 --height 480", "key 0\nscreenshot " + (folder / "a.png").string() +
                                                      "\ndrag left/move/0 -6\nscreenshot " +
                                                      (folder / "b.png").string() + "\nkey 1\n");
  ASSERT_EQ(v.states.size(), 5u) << v.err;
  EXPECT_EQ(message(v, 0), "colours: field");
  const Pixels a = read_png(folder / "a.png"), b = read_png(folder / "b.png");
  const auto red = [](const Pixels& p) {  // warm: inside of the solid
    std::size_t count = 0;
    for (int y = 60; y < p.height; ++y)
      for (int x = 0; x < p.width; ++x) count += p.at(x, y)[0] > p.at(x, y)[2] + 20;
    return count;
  };
  EXPECT_GT(red(a), 1000u);
  EXPECT_NE(red(a), red(b));
  const Viewed job = viewed(specs + "coaxial-cylinders.json --width 480 --height 360", "key 0\n");
  EXPECT_THAT(message(job, 0), HasSubstr("nothing here has the figure \"field\""));
}

}  // namespace
}  // namespace blendwright::test
