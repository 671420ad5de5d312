// The program's window on files that the program writes, under a display of its own.
#include <gtest/gtest.h>

#include <set>

#include "app/json/json_value.hpp"
#include "tests/app/view_window/viewing.hpp"

namespace blendwright::test {
namespace {

const std::string job = BLENDWRIGHT_SOURCE_DIR "/examples/specs/branch-to-main.json";

/// What `blend` writes of one job, once for all tests.
const Folder& results() {
  static const Folder folder;
  static const Outcome made =
      run_program("blend " + job + " --quiet --format step,vtp,stl,obj -o " + quoted_path(folder.path()));
  if (made.code != 0) throw std::runtime_error(made.err);
  return folder;
}

TEST(ViewFiles, OpensEveryFileThatBlendWrites) {
  std::set<std::string> seen;
  for (const std::string& name : results().files()) {
    const std::string end = fs::path(name).extension();
    if (end == ".json" || end == ".png" || !seen.insert(end).second) continue;
    const Viewed v = viewed(quoted_path(results() / name), "state\n");
    EXPECT_EQ(v.code, 0) << name << v.err;
    ASSERT_EQ(v.states.size(), 1u) << name;
    EXPECT_FALSE(*v.states[0].find("changed")->boolean());
    EXPECT_EQ(*v.states[0].find("file")->text(), name);
  }
  EXPECT_EQ(seen, (std::set<std::string>{".obj", ".step", ".stl", ".vtp"}));
}

TEST(ViewFiles, TheObjectFillsHalfOfTheFrameAtBothSizes) {
  const Folder folder;
  const Viewed v = viewed(quoted_path(results() / "branch-to-main.step"),
                          "screenshot " + (folder / "large.png").string() + "\nresize 640 480\nscreenshot " +
                              (folder / "small.png").string() + "\n");
  ASSERT_EQ(v.code, 0) << v.err;
  for (const auto& [name, width, height] :
       {std::tuple{"large.png", 1280, 960}, std::tuple{"small.png", 640, 480}}) {
    const Pixels p = read_png(folder / name);
    ASSERT_EQ(p.width, width);
    ASSERT_EQ(p.height, height);
    const auto [lo, hi] = p.extent_of_object(0, 60);
    EXPECT_GE(std::max((hi.x() - lo.x()) / width, (hi.y() - lo.y()) / (height - 44.0)), 0.8) << name;
    EXPECT_GE((hi.x() - lo.x()) * (hi.y() - lo.y()), 0.3 * width * height) << name;
  }
}

TEST(ViewFiles, PickingTellsAPlaceOfTheSurface) {
  const Viewed v = viewed(quoted_path(results() / "branch-to-main.step"), "click 640 600\nkey Escape\n");
  ASSERT_EQ(v.states.size(), 2u) << v.err;
  const JsonValue* picked = v.states[0].find("picked");
  ASSERT_TRUE(picked);
  EXPECT_EQ(picked->find("point")->items()->size(), 3u);
  EXPECT_FALSE(v.states[1].find("picked"));
}

TEST(ViewFiles, TwoFilesAreSeenSideBySideByOneCamera) {
  const Folder folder;
  const std::string file = quoted_path(results() / "branch-to-main.step");
  const Viewed v =
      viewed(file + " " + file, "orbit 60 20\nwheel 2\nscreenshot " + (folder / "both.png").string() + "\n");
  ASSERT_EQ(v.code, 0) << v.err;
  const Pixels p = read_png(folder / "both.png");
  // The same file twice: the halves are the same but for rounding of the edges' colours.
  std::size_t different = 0, drawn = 0;
  for (int y = 60; y < p.height - 40; ++y)
    for (int x = 4; x < p.width / 2 - 4; ++x) {
      if (p.is_background(x, y)) continue;
      ++drawn;
      if (p.difference(x, y, x + p.width / 2, y) > 24) ++different;
    }
  EXPECT_GT(drawn, 50'000u);
  EXPECT_LT(different, drawn / 200);
}

TEST(ViewFiles, AFileThatCanOnlyBeSeenIsNotSaved) {
  const Folder folder;
  const Viewed v =
      viewed(quoted_path(results() / "branch-to-main.step"), "save " + (folder / "no.json").string() + "\n");
  ASSERT_EQ(v.states.size(), 1u) << v.err;
  EXPECT_TRUE(*v.states[0].find("warning")->boolean());
  EXPECT_TRUE(folder.files().empty());
}

TEST(ViewFiles, BadInputIsOneMessageAndAnExitCode) {
  const Folder folder;
  write(folder / "bad.txt", "clck 1 2\n");
  const Outcome script = run_program("view " + job + " --script " + quoted_path(folder / "bad.txt"));
  EXPECT_EQ(script.code, 3) << script.err;
  EXPECT_NE(script.err.find("line 1"), std::string::npos) << script.err;
  write(folder / "report.json", "{\"verified\": true}");
  write(folder / "ok.txt", "state\n");
  const std::string replay = " --script " + quoted_path(folder / "ok.txt");
  EXPECT_EQ(run_program("view " + quoted_path(folder / "report.json") + replay).code, 3);
  EXPECT_EQ(run_program("view " + quoted_path(folder / "none.step") + replay).code, 5);
  EXPECT_EQ(run_program("view " + quoted_path(folder / "bad.txt") + replay).code, 3);
  EXPECT_EQ(run_program("view a b c" + replay).code, 2);
}

TEST(ViewFiles, WithoutADisplayAPersonIsToldWhatElseThereIs) {
  const Outcome o = run_program("view " + job, "unset DISPLAY;");
  EXPECT_EQ(o.code, 5);
  EXPECT_NE(o.err.find("DISPLAY is not set"), std::string::npos) << o.err;
  EXPECT_NE(o.err.find("blendwright picture"), std::string::npos) << o.err;
  EXPECT_TRUE(o.out.empty());
}

}  // namespace
}  // namespace blendwright::test
