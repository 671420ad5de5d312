// `picture` as a user runs it.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "app/json/json_value.hpp"
#include "tests/app/program.hpp"
#include "tests/exchange/read_png.hpp"

namespace blendwright {
namespace {

using test::run_program;
using testing::HasSubstr;

std::string example(const std::string& file) {
  return test::quoted_path(std::filesystem::path(BLENDWRIGHT_SOURCE_DIR) / "examples" / file);
}
const std::string job = example("specs/coaxial-cylinders.json"), scene = example("scenes/s0-1a.json");

bool can_draw(const test::Outcome& run) { return run.err.find("cannot be drawn") == std::string::npos; }

TEST(PictureVerb, DrawsAndTellsTheTitle) {
  const test::Folder folder;
  const std::string file = test::quoted_path(folder / "a.png");
  const test::Outcome run = run_program("picture " + job + " --show zebra --size 320x240 -o " + file);
  if (!can_draw(run)) GTEST_SKIP() << run.err;
  ASSERT_EQ(run.code, 0) << run.err;
  EXPECT_THAT(run.out, HasSubstr("coaxial-cylinders: zebra stripes, largest gap"));
  EXPECT_THAT(run.out, HasSubstr("wrote "));
  const test::Pixels image = test::read_png(folder / "a.png");
  EXPECT_EQ(image.width, 320);
  EXPECT_EQ(image.height, 240);
  // It does not replace a file unless told so.
  const std::string before = test::content(folder / "a.png");
  const test::Outcome again = run_program("picture " + job + " -o " + file);
  EXPECT_EQ(again.code, 5);
  EXPECT_THAT(again.err, HasSubstr("a.png"));
  EXPECT_EQ(test::content(folder / "a.png"), before);
  EXPECT_EQ(run_program("picture " + job + " --quiet --force --size 320x240 -o " + file).out, "");
  EXPECT_NE(test::content(folder / "a.png"), before);
  EXPECT_EQ(folder.files(), std::vector<std::string>{"a.png"});
}

TEST(PictureVerb, EveryKindOfInputIsDrawn) {
  const test::Folder folder;
  const auto made = [&](const std::string& arguments) { return run_program(arguments).code; };
  ASSERT_EQ(made("blend " + job + " --quiet --format step,vtp -o " + test::quoted_path(folder / "out")), 0);
  ASSERT_EQ(made("mesh " + scene + " --quiet --cells 32 -o " + test::quoted_path(folder / "m.ply") + " -o " +
                 test::quoted_path(folder / "m.stl")),
            0);
  const std::vector<std::pair<std::string, std::string>> inputs{
      {test::quoted_path(folder / "out"), "gap"},
      {test::quoted_path(folder / "out" / "coaxial-cylinders.step"), "curvature"},
      {test::quoted_path(folder / "out" / "coaxial-cylinders.reducer.vtp"), "angle"},
      {test::quoted_path(folder / "out" / "coaxial-cylinders.reducer.trimlines.vtp"), "trimlines"},
      {test::quoted_path(folder / "m.ply"), "isophotes"},
      {test::quoted_path(folder / "m.stl"), "plain"},
      {scene + " --cells 32", "draft"},
      {scene, "field"}};
  int number = 0;
  for (const auto& [input, show] : inputs) {
    const auto file = folder / (std::to_string(number++) + ".png");
    const test::Outcome run =
        run_program("picture " + input + " --show " + show + " --size 320x240 -o " + test::quoted_path(file));
    if (!can_draw(run)) GTEST_SKIP() << run.err;
    EXPECT_EQ(run.code, 0) << input << ": " << run.err;
    EXPECT_TRUE(std::filesystem::exists(file)) << input;
  }
}

TEST(PictureVerb, JsonTellsTitleFigureAndFiles) {
  const test::Folder folder;
  const test::Outcome run = run_program("picture " + scene + " --show radius --cells 32 --json --times -o " +
                                        test::quoted_path(folder / "a.png"));
  if (!can_draw(run)) GTEST_SKIP() << run.err;
  ASSERT_EQ(run.code, 0) << run.err;
  const JsonValue report = parse_json(run.out);
  ASSERT_NE(report.find("figure"), nullptr);
  EXPECT_EQ(*report.find("figure")->find("name")->text(), "least radius");
  EXPECT_GT(*report.find("figure")->find("least")->number(), 0.0);
  EXPECT_EQ(report.find("files")->items()->size(), 1u);
  EXPECT_NE(report.find("seconds")->find("drawing"), nullptr);
}

/// What is wrong, where, and what it must be; the documented code; and no file.
TEST(PictureVerb, RefusesWhatItCannotDraw) {
  struct Case {
    std::string arguments, message;
    int code;
  };
  const test::Folder folder;
  const std::string out = " -o " + test::quoted_path(folder / "a.png");
  test::write(folder / "broken.json", "{\"primaries\": 3");
  test::write(folder / "empty.vtp", "");
  test::write(folder / "noise.step", std::string("\x01\x02\xff ISO", 7));
  const auto file = [&](const char* name) { return test::quoted_path(folder / name); };
  const Case cases[] = {
      {job + " --show zbra" + out, "did you mean \"zebra\"", 3},
      {job + " --show field" + out, "only scenes have", 3},
      {scene + " --cells 16 --show gap" + out, "it can show", 3},
      {job + " --views frnt" + out, "did you mean \"front\"", 3},
      {job + " --show deviation" + out, "--to: is missing", 3},
      {job + " -o " + file("a.jpg"), "must end in .png", 3},
      {job + " --size 12x9" + out, "must be width and height in pixels", 2},
      {job + " --size 640" + out, "must be width and height in pixels", 2},
      {job + " --range 3,1" + out, "must have the lower number first", 2},
      {job + " --plane w=1" + out, "must be an axis and a place", 2},
      {job + " --pull 0,0,0" + out, "must have a direction", 2},
      {job + " --background blue" + out, "blue", 2},
      {file("missing.json") + out, "missing.json", 5},
      {file("missing.step") + out, "missing.step", 5},
      {file("broken.json") + out, "line 1", 3},
      {file("empty.vtp") + out, "empty.vtp", 5},
      {file("noise.step") + out, "noise.step", 5},
      {file("thing.doc") + out, "must be a job or a scene", 3},
      {test::quoted_path(folder.path()) + " --show gap" + out, "", 5},  // its .vtp is broken
  };
  for (const Case& c : cases) {
    const test::Outcome run = run_program("picture " + c.arguments);
    EXPECT_EQ(run.code, c.code) << c.arguments << "\n" << run.err << run.out;
    EXPECT_THAT(run.err, HasSubstr(c.message)) << c.arguments;
    EXPECT_FALSE(std::filesystem::exists(folder / "a.png")) << c.arguments;
  }
}

TEST(PictureVerb, SaysWhatIsMissingWithoutADisplay) {
  const test::Folder folder;
  const test::Outcome run = run_program("picture " + job + " -o " + test::quoted_path(folder / "a.png"),
                                        "unset DISPLAY; PATH=" + test::quoted_path(folder.path()));
  EXPECT_EQ(run.code, 5);
  EXPECT_THAT(run.err, HasSubstr("a.png: cannot be drawn (DISPLAY is not set and Xvfb is not installed"));
  EXPECT_TRUE(folder.files().empty());
}

}  // namespace
}  // namespace blendwright
