// A scene shaped by hand: sliders, undo, saving, and what is refused.
#include "app/view/session/scene_session.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <fstream>
#include <iterator>

#include "kernel/base/error.hpp"
#include "tests/support/for_all.hpp"

namespace blendwright::test {
namespace {

using testing::HasSubstr;

std::filesystem::path scene_file(const std::string& name) {
  return std::filesystem::path(BLENDWRIGHT_SOURCE_DIR) / "examples/scenes" / (name + ".json");
}
std::string scene_of(const std::string& name) {
  std::ifstream file(scene_file(name));
  return {std::istreambuf_iterator<char>(file), {}};
}
/// Few cells: what is tested does not depend on them.
constexpr SceneCells few{12, 24};
SceneSession opened_scene(const std::string& text, SceneCells cells = few) { return {text, "x.json", cells}; }

std::size_t slider(const SceneSession& session, const std::string& name) {
  const auto all = session.controls();
  for (std::size_t i = 0; i < all.size(); ++i)
    if (all[i].name == name) return i;
  throw std::out_of_range("no slider " + name);
}

bool same_mesh(const TriMesh& a, const TriMesh& b) {
  return a.points == b.points && a.triangles == b.triangles && a.normals == b.normals;
}

/// A ball that wanders through a wall: comments, a formula, and a key that is left out.
const std::string walled = R"(// a ball in a wall
{
  "let": { "r": 3 },
  "nodes": {
    "ball": { "kind": "lp_metric", "a": "2*r", /* half-axis */ "b": 6, "c": 6,   "n": 2 },
    "soft": { "kind": "soft_object", "distance": "ball" }, // as wide as it is
    "placed": { "kind": "place", "of": "soft", "move": [0, "r", 1.50] },
    "other": { "kind": "soft_object", "distance": { "kind": "lp_metric", "a": 1, "b": 1, "c": 1, "n": 2 } }
  },
  "solid": "placed",
  "adjust": { "ball/a": [1, 12], "placed/move/2": [-4, 4], "soft/softness": [0, 1],
              "other/softness": [0, 1] }
}
)";

TEST(SceneSession, HasASliderForEveryAdjustableNumberThatTheSolidUses) {
  const SceneSession session = opened_scene(walled);
  const auto all = session.controls();
  ASSERT_EQ(all.size(), 3u);  // not that of "other"
  EXPECT_EQ(all[0].name, "ball/a");
  EXPECT_EQ(all[0].value, 6.0);
  EXPECT_EQ(all[0].low, 1.0);
  EXPECT_EQ(all[0].high, 12.0);
  EXPECT_EQ(all[1].value, 1.5);
  EXPECT_EQ(all[2].value, 0.0);  // the default of the key that is left out
  EXPECT_FALSE(session.changed());
  EXPECT_FALSE(session.coarse());
  EXPECT_EQ(session.spec(), read_scene(walled));
}

TEST(SceneSession, IsCoarseWhileDraggedAndFineWhenLetGo) {
  SceneSession session = opened_scene(walled);
  const std::size_t fine = session.mesh().triangles.size();
  ASSERT_TRUE(session.set(slider(session, "ball/a"), 5.5).done);
  EXPECT_TRUE(session.coarse());
  EXPECT_TRUE(session.changed());
  // Triangles grow with the square of the cells: a quarter, but for the margin of the box.
  EXPECT_LT(session.mesh().triangles.size(), fine / 2);
  ASSERT_TRUE(session.commit().done);
  EXPECT_FALSE(session.coarse());
  EXPECT_TRUE(same_mesh(
      session.mesh(),
      run_mesh_job(build_scene_text(session.saved_text(), "x.json"), {.cells = few.fine}).made.mesh));
}

TEST(SceneSession, FineIsTheCellOfTheMeshVerb) {
  const SceneSession session(scene_of("s3-bridge"), "s3-bridge.json");
  EXPECT_EQ(SceneCells{}.fine, MeshJob{}.cells);
  EXPECT_TRUE(
      same_mesh(session.mesh(), run_mesh_job(build_scene_file(scene_file("s3-bridge")), {}).made.mesh));
}

TEST(SceneSession, UndoAndRedoGoGestureByGesture) {
  SceneSession session = opened_scene(walled);
  const SceneSpec first = session.spec();
  const TriMesh first_mesh = session.mesh();
  const std::size_t a = slider(session, "ball/a"), z = slider(session, "placed/move/2");
  for (const double x : {5.0, 4.0, 3.0}) ASSERT_TRUE(session.set(a, x).done);  // one gesture
  ASSERT_TRUE(session.commit().done);
  const SceneSpec second = session.spec();
  ASSERT_TRUE(session.set(z, -2.0).done);  // undo ends the gesture
  const SceneSpec third = session.spec();
  EXPECT_TRUE(session.undo());
  EXPECT_EQ(session.spec(), second);
  EXPECT_FALSE(session.coarse());
  EXPECT_TRUE(session.undo());
  EXPECT_EQ(session.spec(), first);
  EXPECT_TRUE(same_mesh(session.mesh(), first_mesh));
  EXPECT_FALSE(session.changed());
  EXPECT_FALSE(session.undo());
  EXPECT_TRUE(session.redo());
  EXPECT_TRUE(session.redo());
  EXPECT_EQ(session.spec(), third);
  EXPECT_FALSE(session.redo());
  EXPECT_TRUE(session.undo());
  ASSERT_TRUE(session.set(a, 8.0).done);  // another way: what was taken back is gone
  ASSERT_TRUE(session.commit().done);
  EXPECT_FALSE(session.redo());
}

TEST(SceneSession, AClickThatChangesNothingIsNoStep) {
  SceneSession session = opened_scene(walled);
  const std::size_t a = slider(session, "ball/a");
  EXPECT_TRUE(session.set(a, 6.0).done);
  EXPECT_TRUE(session.commit().done);
  EXPECT_FALSE(session.undo());
  ASSERT_TRUE(session.set(a, 7.0).done);
  ASSERT_TRUE(session.set(a, 6.0).done);  // and back, without letting go
  EXPECT_TRUE(session.commit().done);
  EXPECT_FALSE(session.coarse());
  EXPECT_FALSE(session.changed());
  EXPECT_FALSE(session.undo());
}

TEST(SceneSession, TheSavedTextDiffersInTheNumbersOnly) {
  SceneSession session = opened_scene(walled);
  EXPECT_EQ(session.saved_text(), walled);
  ASSERT_TRUE(session.set(slider(session, "ball/a"), 5.25).done);
  ASSERT_TRUE(session.set(slider(session, "placed/move/2"), -2.5).done);
  ASSERT_TRUE(session.set(slider(session, "soft/softness"), 0.5).done);
  std::string wanted = walled;
  const auto replace = [&](const std::string& old, const std::string& by) {
    const std::size_t at = wanted.find(old);
    ASSERT_NE(at, std::string::npos) << old;
    wanted.replace(at, old.size(), by);
  };
  replace("\"2*r\"", "5.25");
  replace("1.50", "-2.5");  // its neighbour "r" stays a formula
  replace(R"("distance": "ball" })", R"("distance": "ball", "softness": 0.5 })");
  EXPECT_TRUE(session.changed());
  EXPECT_EQ(session.saved_text(), wanted);
  EXPECT_TRUE(session.changed());
  session.mark_saved();
  EXPECT_FALSE(session.changed());
  const SceneSession again = opened_scene(wanted);
  EXPECT_EQ(again.spec(), session.spec());
  // Taken back, the text is the old one byte by byte.
  EXPECT_TRUE(session.undo());
  EXPECT_TRUE(session.changed());
  EXPECT_EQ(session.saved_text(), walled);
}

TEST(SceneSession, ASavedExampleOpensWithTheSameValuesAndMesh) {
  for (const char* name : {"s0-12ab", "s3-bridge", "s3-tee"}) {
    SCOPED_TRACE(name);
    const std::string text = scene_of(name);
    SceneSession session = opened_scene(text);
    const auto before = session.controls();
    ASSERT_GE(before.size(), 3u);
    for (std::size_t i = 0; i < before.size(); ++i) {
      const double value = 0.4 * before[i].low + 0.6 * before[i].value;
      ASSERT_TRUE(session.set(i, value).done) << before[i].name;
    }
    ASSERT_TRUE(session.commit().done);
    const std::string saved = session.saved_text();
    EXPECT_EQ(saved.substr(0, text.find('{')), text.substr(0, text.find('{')));  // the comments
    const SceneSession again = opened_scene(saved);
    EXPECT_EQ(again.spec(), session.spec());
    EXPECT_TRUE(same_mesh(again.mesh(), session.mesh()));
    for (std::size_t i = 0; i < before.size(); ++i) EXPECT_NE(again.controls()[i].value, before[i].value);
  }
}

TEST(SceneSession, RandomDragsAreSavedAndTakenBack) {
  const std::string text = scene_of("s0-12ab");
  for_all(
      [&](Rng& rng) {
        SceneSession session = opened_scene(text, {8, 8});
        const SceneSpec first = session.spec();
        int steps = 0;
        for (int i = 0; i < 4; ++i) {
          const auto all = session.controls();
          const auto k = static_cast<std::size_t>(integer(rng, 0, static_cast<int>(all.size()) - 1));
          const SceneSpec before = session.spec();
          const bool done = session.set(k, uniform(rng, all[k].low, all[k].high)).done;
          EXPECT_EQ(session.spec() != before, done);
          EXPECT_TRUE(session.commit().done);
          steps += done;
        }
        EXPECT_EQ(read_scene(session.saved_text()), session.spec());
        for (int i = 0; i < steps; ++i) EXPECT_TRUE(session.undo());
        EXPECT_EQ(session.spec(), first);
        EXPECT_EQ(session.saved_text(), text);
        EXPECT_GT(steps, 0);
      },
      6);
}

TEST(SceneSession, WhatCannotBeIsRefusedAndTheLastMeshStays) {
  // The tool of an erosion that cuts through is the scene's refusal, a level beyond all values leaves no
  // solid.
  const std::string text = R"({ "nodes": {
    "sphere": { "kind": "lp_metric", "a": 25, "b": 25, "c": 25, "n": 2 },
    "tool": { "kind": "lp_metric", "a": 4, "b": 4, "c": 16, "n": 2 },
    "soft": { "kind": "soft_object", "distance": { "kind": "erosion", "of": "sphere", "by": "tool", "n": 1 } } },
    "solid": "soft", "adjust": { "tool/c": [4, 60] } })";
  SceneSession session = opened_scene(text);
  ASSERT_TRUE(session.set(0, 12.0).done);
  const TriMesh mesh = session.mesh();
  const SceneSpec spec = session.spec();
  const auto refused = session.set(0, 60.0);
  EXPECT_FALSE(refused.done);
  EXPECT_THAT(refused.message, HasSubstr("tool/c = 60"));
  EXPECT_THAT(refused.message, HasSubstr("ErosionOverreach"));
  EXPECT_TRUE(same_mesh(session.mesh(), mesh));
  EXPECT_EQ(session.spec(), spec);
  EXPECT_TRUE(session.commit().done);
  EXPECT_TRUE(session.set(0, 8.0).done);  // and goes on
}

TEST(SceneSession, ASolidThatVanishesIsSaidAndTheLastMeshStays) {
  const auto balls = [](const std::string& kind) {
    return R"({ "nodes": {
      "left": { "kind": "sphere", "radius": 5 },
      "right": { "kind": "place", "of": { "kind": "sphere", "radius": 5 }, "move": [4, 0, 0] },
      "both": { "kind": ")" +
           kind + R"(", "of": ["left", "right"] } },
      "solid": "both", "adjust": { "right/move/0": [0, 30] } })";
  };
  SceneSession lens = opened_scene(balls("min"));
  ASSERT_TRUE(lens.set(0, 6.0).done);
  const TriMesh mesh = lens.mesh();
  const auto refused = lens.set(0, 20.0);
  EXPECT_FALSE(refused.done);
  EXPECT_THAT(refused.message, HasSubstr("right/move/0 = 20"));
  EXPECT_TRUE(same_mesh(lens.mesh(), mesh));
  EXPECT_EQ(lens.controls()[0].value, 6.0);
  // The union of the same balls never vanishes.
  SceneSession both = opened_scene(balls("max"));
  EXPECT_TRUE(both.set(0, 20.0).done);
}

TEST(SceneSession, ValuesAreClampedAndMustBeNumbers) {
  SceneSession session = opened_scene(walled);
  const std::size_t a = slider(session, "ball/a");
  ASSERT_TRUE(session.set(a, 1e9).done);
  EXPECT_EQ(session.controls()[a].value, 12.0);
  EXPECT_FALSE(session.set(a, std::nan("")).done);
  EXPECT_EQ(session.controls()[a].value, 12.0);
}

TEST(SceneSession, AThinSolidIsMeshedFinelyWhereTheCoarseGridMissesIt) {
  // 4 cells of 10 mm have no corner in a wire of 0.4 mm that lies beside the axis, cells of 0.1 mm do.
  const std::string text = R"({ "nodes": {
    "wire": { "kind": "box", "half": [20, 0.3, 0.3] },
    "placed": { "kind": "place", "of": "wire", "move": [0, 0.4, 0.4] } },
    "solid": "placed", "adjust": { "wire/half/1": [0.05, 1] } })";
  SceneSession session = opened_scene(text, {4, 400});
  ASSERT_TRUE(session.set(0, 0.2).done);
  EXPECT_FALSE(session.coarse());
  const SceneFile thin = build_scene_text(session.saved_text(), "x.json");
  EXPECT_THROW((void)run_mesh_job(thin, {.cells = 4}), GeometryError);
  EXPECT_TRUE(same_mesh(session.mesh(), run_mesh_job(thin, {.cells = 400}).made.mesh));
}

TEST(SceneSession, WithoutAdjustThereIsNothingToMove) {
  SceneSession session = opened_scene(scene_of("s3-ring"));
  EXPECT_TRUE(session.controls().empty());
  EXPECT_FALSE(session.mesh().triangles.empty());
  EXPECT_FALSE(session.undo());
  EXPECT_EQ(session.saved_text(), scene_of("s3-ring"));
}

/// Printed for people; the bound is that of a hand that still feels followed, five times over for a machine
/// that others use too.
TEST(SceneSession, ExamplesAreMeshedWhileTheyAreDragged) {
  for (const char* name : {"s0-12ab", "s3-bridge", "s3-tee"}) {
    SceneSession session(scene_of(name), scene_file(name));
    const auto all = session.controls();
    constexpr int times = 12;
    double spent = 0.0, worst = 0.0;
    for (int i = 0; i < times; ++i) {
      const SessionControl& c = all[static_cast<std::size_t>(i) % all.size()];
      const double value = c.value + (c.high - c.value) * (0.1 + 0.05 * i);
      const auto start = std::chrono::steady_clock::now();
      ASSERT_TRUE(session.set(static_cast<std::size_t>(i) % all.size(), value).done) << c.name;
      const double s = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
      EXPECT_TRUE(session.coarse());
      spent += s;
      worst = std::max(worst, s);
    }
    const std::size_t coarse = session.mesh().triangles.size();
    const auto start = std::chrono::steady_clock::now();
    ASSERT_TRUE(session.commit().done);
    const double fine = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    std::printf("%s: %.1f ms per coarse mesh (worst %.1f, %zu triangles), %.0f ms fine (%zu)\n", name,
                1e3 * spent / times, 1e3 * worst, coarse, 1e3 * fine, session.mesh().triangles.size());
    EXPECT_LT(spent / times, 0.5);
  }
}

}  // namespace
}  // namespace blendwright::test
