// A scene shaped in the window: its sliders are dragged, without a display and in the real window.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "app/json/scene_reader.hpp"
#include "app/view/window/controller.hpp"
#include "app/view/window/scene_document.hpp"
#include "tests/app/view_window/viewing.hpp"

namespace blendwright::test {
namespace {

using testing::HasSubstr;

fs::path scene_file(const std::string& name) {
  return fs::path(BLENDWRIGHT_SOURCE_DIR) / "examples/scenes" / (name + ".json");
}

double control(const JsonValue& state, const std::string& name) {
  const JsonValue* found = state.find("controls")->find(name);
  return found && found->number() ? *found->number() : std::nan("");
}

std::unique_ptr<Controller> opened(const fs::path& file, Controller::Files files = {}) {
  std::vector<std::unique_ptr<Document>> all;
  all.push_back(std::make_unique<SceneDocument>(file, content(file), Progress{}, SceneCells{12, 32}));
  return std::make_unique<Controller>(std::move(all), std::move(files), 1280, 960);
}
std::size_t triangles(const Controller& c) { return c.document().surfaces().at(0).triangles.size(); }
Vec2 middle(const PixelBox& b) { return {0.5 * (b.left + b.right), 0.5 * (b.bottom + b.top)}; }

TEST(ViewScene, TheMeshIsCoarseWhileASliderIsHeldAndFineAfterwards) {
  const Folder folder;
  const auto c = opened(scene_file("s0-12ab"), {.save = folder / "saved.json"});
  const std::size_t fine = triangles(*c);
  const PixelBox track = c->reveal("bar/a");
  const double before = c->controls()[0].value;
  c->press(Controller::Button::left, {Controller::pixel_of(c->controls()[0], track), middle(track).y()});
  for (const double x : {0.3, 0.4, 0.45}) {
    c->move({track.left + x * track.width(), middle(track).y()});
    // Triangles grow with the square of the cells: 1/7 of the fine ones, but for the margins.
    EXPECT_LT(triangles(*c), fine / 3);
    EXPECT_THAT(c->document().figures(), HasSubstr("coarse"));
  }
  c->release({track.left + 0.45 * track.width(), middle(track).y()});
  EXPECT_GT(triangles(*c), fine / 2);
  EXPECT_THAT(c->document().figures(), testing::Not(HasSubstr("coarse")));
  const double dragged = c->controls()[0].value;
  EXPECT_NE(dragged, before);

  EXPECT_THAT(c->window_title(), HasSubstr("*"));
  c->key("z", true);
  EXPECT_EQ(c->controls()[0].value, before);
  EXPECT_EQ(triangles(*c), fine);
  c->key("y", true);
  EXPECT_EQ(c->controls()[0].value, dragged);
  c->key("s", true);
  EXPECT_FALSE(c->document().changed());
  const SceneFile saved = build_scene_file(folder / "saved.json");
  EXPECT_EQ(adjusted_number(saved.spec, saved.adjust[0]), dragged);
}

TEST(ViewScene, WhatTheSceneRefusesIsSaidAndTheLastMeshStays) {
  const Folder folder;
  write(folder / "lens.json", R"({ "nodes": {
    "right": { "kind": "place", "of": { "kind": "sphere", "radius": 5 }, "move": [4, 0, 0] },
    "lens": { "kind": "min", "of": [{ "kind": "sphere", "radius": 5 }, "right"] } },
    "solid": "lens", "adjust": { "right/move/0": [0, 30] } })");
  const auto c = opened(folder / "lens.json");
  const PixelBox track = c->reveal("right/move/0");
  c->press(Controller::Button::left, {Controller::pixel_of(c->controls()[0], track), middle(track).y()});
  c->move({track.left + 0.2 * track.width(), middle(track).y()});
  const double good = c->controls()[0].value;
  EXPECT_FALSE(c->state().warning);
  c->move({track.left + 0.9 * track.width(), middle(track).y()});
  EXPECT_TRUE(c->state().warning);
  EXPECT_THAT(c->state().message, HasSubstr("right/move/0"));
  EXPECT_EQ(c->controls()[0].value, good);
  c->release({track.left + 0.9 * track.width(), middle(track).y()});
  EXPECT_GT(triangles(*c), 0u);
  EXPECT_EQ(c->controls()[0].value, good);
}

TEST(ViewScene, ASavedSceneShowsTheSameAgain) {
  const Folder folder;
  const std::string size = " --width 640 --height 480";
  const Viewed v =
      viewed(quoted_path(scene_file("s3-bridge")) + size,
             "state\ndrag super-elliptic/r/0 14\ndrag super-elliptic/w 4\nsave " +
                 (folder / "saved.json").string() + "\nscreenshot " + (folder / "a.png").string() + "\n");
  ASSERT_EQ(v.states.size(), 5u) << v.err;
  EXPECT_FALSE(*v.states[0].find("changed")->boolean());
  EXPECT_EQ(control(v.states[0], "super-elliptic/r/0"), 8.0);
  // A pixel of 170 of the slider's range.
  EXPECT_NEAR(control(v.states[2], "super-elliptic/r/0"), 14.0, 14.0 / 170.0);
  EXPECT_NEAR(control(v.states[2], "super-elliptic/w"), 4.0, 5.0 / 170.0);
  EXPECT_TRUE(std::isnan(control(v.states[0], "material/a/0")));  // the solid does not use it
  EXPECT_TRUE(*v.states[2].find("changed")->boolean());
  EXPECT_FALSE(*v.states[3].find("changed")->boolean());
  const Viewed again =
      viewed(quoted_path(folder / "saved.json") + size, "screenshot " + (folder / "b.png").string() +
                                                            "\ndrag super-elliptic/w 1\nscreenshot " +
                                                            (folder / "c.png").string() + "\n");
  ASSERT_EQ(again.states.size(), 3u) << again.err;
  EXPECT_EQ(json_text(*again.states[0].find("controls")), json_text(*v.states[3].find("controls")));
  // A reopened window fits its camera to the saved solid, the first one to the solid as it was opened.
  const Pixels a = read_png(folder / "a.png"), b = read_png(folder / "b.png"), c = read_png(folder / "c.png");
  const auto different = [](const Pixels& p, const Pixels& q) {
    std::size_t count = 0;
    for (int y = 50; y < p.height; ++y)
      for (int x = 200; x < p.width; ++x)
        for (int k = 0; k < 3; ++k) count += std::abs(p.at(x, y)[k] - q.at(x, y)[k]) > 8;
    return count;
  };
  ASSERT_EQ(a.rgb.size(), b.rgb.size());
  EXPECT_LT(different(a, b), a.rgb.size() / 100);
  EXPECT_GT(different(b, c), 2 * different(a, b));
}

TEST(ViewScene, WithoutAdjustItIsLookedAt) {
  const Folder folder;
  const Viewed v = viewed(quoted_path(scene_file("s3-ring")) + " --width 640 --height 480",
                          "state\nsave " + (folder / "no.json").string() + "\n");
  ASSERT_EQ(v.states.size(), 2u) << v.err;
  EXPECT_TRUE(v.states[0].find("controls")->members()->empty());
  EXPECT_TRUE(*v.states[1].find("warning")->boolean());
  EXPECT_TRUE(folder.files().empty());
}

TEST(ViewScene, ABrokenAdjustIsToldWithItsPlace) {
  const Folder folder;
  write(folder / "bad.json",
        R"({ "solid": { "kind": "sphere", "radius": 5 }, "adjust": { "/solid/radios": [1, 9] } })");
  write(folder / "ok.txt", "state\n");
  const Outcome o =
      run_program("view " + quoted_path(folder / "bad.json") + " --script " + quoted_path(folder / "ok.txt"));
  EXPECT_EQ(o.code, 3);
  EXPECT_THAT(o.err, HasSubstr("/adjust/~1solid~1radios"));
  EXPECT_THAT(o.err, HasSubstr("did you mean \"radius\""));
}

}  // namespace
}  // namespace blendwright::test
