// From mouse and keys to calls of a document, without a window.
#include "app/view/window/controller.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "kernel/base/text_file.hpp"
#include "tests/app/program.hpp"

namespace blendwright {
namespace {

/// A square with a slider per kind, and a record of what it was asked.
class SquareDocument : public Document {
 public:
  struct Log {
    std::vector<std::pair<std::size_t, double>> sets;
    std::vector<Vec3> drags;
    int commits = 0, undos = 0, saves = 0;
  };
  explicit SquareDocument(Log& log) : log_(log) {}
  [[nodiscard]] std::filesystem::path file() const override { return file_; }
  [[nodiscard]] LengthUnit unit() const override { return LengthUnit::millimetre; }
  [[nodiscard]] std::vector<DrawnSurface> surfaces() const override {
    return {{DrawnSurface::Role::blend, "square", Vec3::Zero(), points_, {}, triangles_}};
  }
  [[nodiscard]] std::vector<PolyLine> lines() const override { return {}; }
  [[nodiscard]] std::vector<CombLine> comb() const override { return {}; }
  [[nodiscard]] std::vector<float> values(std::size_t, Show show, const ShowOptions&) const override {
    return show == Show::gap ? std::vector<float>{1, 2, 3, 4} : std::vector<float>{};
  }
  [[nodiscard]] PickedPoint picked(const SurfaceHit& hit) const override {
    PickedPoint p;
    p.object = "square";
    p.point = hit.point;
    return p;
  }
  [[nodiscard]] std::string figures() const override { return ""; }
  [[nodiscard]] std::vector<SessionControl> controls() const override { return controls_; }
  [[nodiscard]] std::vector<SessionHandle> handles() const override { return {handle_}; }
  Outcome set(std::size_t control, double value) override {
    if (refuse_) return {false, "cannot be built"};
    log_.sets.emplace_back(control, value);
    controls_[control].value = value;
    changed_ = true;
    return {};
  }
  Outcome drag(const SessionHandle&, const Vec3& target) override {
    log_.drags.push_back(target);
    handle_.position = target;
    return {};
  }
  Outcome commit() override {
    ++log_.commits;
    return {};
  }
  bool undo() override { return ++log_.undos == 1; }
  [[nodiscard]] bool changed() const override { return changed_; }
  [[nodiscard]] std::string saved_text() const override {
    ++log_.saves;
    return "saved";
  }
  void mark_saved() override { changed_ = false; }

  std::filesystem::path file_ = "square.json";
  bool refuse_ = false, changed_ = false;
  SessionHandle handle_{SessionHandle::Kind::magnitude, 0, 0, 0, 0.0, {0.9, 0.9, 0.0}};

 private:
  Log& log_;
  std::vector<float> points_{0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0};
  std::vector<std::array<std::uint32_t, 3>> triangles_{{0, 1, 2}, {0, 2, 3}};
  std::vector<SessionControl> controls_{
      {"b: tension", "tension", 0, SessionControl::Kind::number, 1.0, 0.01, 100.0, true, {}},
      {"b: height", "height", 0, SessionControl::Kind::number, 2.0, -1.0, 5.0, false, {}},
      {"b: mode", "mode", 0, SessionControl::Kind::choice, 0.0, 0.0, 2.0, false, {"x", "y", "z"}}};
};

struct Bench {
  SquareDocument::Log log;
  SquareDocument* document = nullptr;
  std::unique_ptr<Controller> controller;
  explicit Bench(Controller::Files files = {}) {
    auto made = std::make_unique<SquareDocument>(log);
    document = made.get();
    std::vector<std::unique_ptr<Document>> all;
    all.push_back(std::move(made));
    controller = std::make_unique<Controller>(std::move(all), files, 1280, 960);
  }
  void drag(const Vec2& from, const Vec2& to, int steps = 4) {
    controller->press(Controller::Button::left, from);
    for (int i = 1; i <= steps; ++i) controller->move(from + (to - from) * i / steps);
    controller->release(to);
  }
};

TEST(ViewController, PixelsAndValuesOfASliderAreInverse) {
  const Bench bench;
  const PixelBox track{8.0, 700.0, 278.0, 720.0};
  for (SessionControl c : bench.controller->controls()) {
    if (c.kind == SessionControl::Kind::choice) continue;
    for (const double t : {0.0, 0.1, 0.5, 0.99, 1.0}) {
      c.value = c.logarithmic ? c.low * std::pow(c.high / c.low, t) : c.low + t * (c.high - c.low);
      const double back = Controller::value_at(c, track, Controller::pixel_of(c, track));
      EXPECT_NEAR(back, c.value, 1e-12 * std::abs(c.high));
    }
    EXPECT_EQ(Controller::value_at(c, track, -100.0), c.low);
    EXPECT_EQ(Controller::value_at(c, track, 5000.0), c.high);
  }
}

TEST(ViewController, DraggingASliderSetsWhileDraggingAndCommitsOnce) {
  Bench bench;
  const PixelBox track = bench.controller->reveal("height");
  const double y = 0.5 * (track.bottom + track.top);
  SessionControl wanted = bench.controller->controls()[1];
  const Vec2 from(Controller::pixel_of(wanted, track), y);
  wanted.value = 4.0;
  bench.drag(from, {Controller::pixel_of(wanted, track), y});
  ASSERT_GE(bench.log.sets.size(), 3u);
  EXPECT_EQ(bench.log.sets.back().first, 1u);
  // A pixel stands for 6 / 258 of the value.
  EXPECT_NEAR(bench.log.sets.back().second, 4.0, 6.0 / 258.0);
  EXPECT_EQ(bench.log.commits, 1);
  EXPECT_NE(bench.controller->window_title().find("square.json*"), std::string::npos);
}

TEST(ViewController, ChangesStayUnsavedWhenTheirFileCannotBeWritten) {
  Bench bench({.save = "/dev/null/no folder/saved.json"});
  bench.document->changed_ = true;
  bench.controller->act(ViewAction::save);
  EXPECT_EQ(bench.log.saves, 1);
  EXPECT_TRUE(bench.document->changed());
  EXPECT_TRUE(bench.controller->state().warning);
  EXPECT_NE(bench.controller->state().message.find("no file"), std::string::npos);
  bench.controller->act(ViewAction::quit);
  EXPECT_FALSE(bench.controller->ended());
}

TEST(ViewController, ARefusedValueIsToldAndNotTaken) {
  Bench bench;
  bench.document->refuse_ = true;
  const PixelBox track = bench.controller->reveal("b: mode");
  bench.drag({track.right - 3.0, track.bottom + 5.0}, {track.right - 3.0, track.bottom + 5.0}, 1);
  EXPECT_EQ(bench.controller->state().message, "cannot be built");
  EXPECT_TRUE(bench.controller->state().warning);
  EXPECT_EQ(bench.controller->controls()[2].value, 0.0);
  bench.document->refuse_ = false;
  bench.drag({track.right - 3.0, track.bottom + 5.0}, {track.right - 3.0, track.bottom + 5.0}, 1);
  EXPECT_EQ(bench.controller->controls()[2].value, 2.0);
}

TEST(ViewController, AHandleFollowsTheMouseAndTheBackgroundTurns) {
  Bench bench;
  const PixelBox pane = bench.controller->layout().panes[0];
  const ViewCamera before = bench.controller->state().camera;
  const Vec2 at = before.pixel(bench.document->handle_.position, pane);
  bench.drag(at, at + Vec2(40.0, 25.0));
  ASSERT_FALSE(bench.log.drags.empty());
  EXPECT_LE((before.pixel(bench.log.drags.back(), pane) - at - Vec2(40.0, 25.0)).norm(), 1e-9);
  EXPECT_EQ(bench.log.commits, 1);
  EXPECT_EQ((bench.controller->state().camera.back - before.back).norm(), 0.0);
  const std::size_t drags = bench.log.drags.size();
  bench.drag({pane.right - 20.0, pane.bottom + 20.0}, {pane.right - 120.0, pane.bottom + 50.0});
  EXPECT_EQ(bench.log.drags.size(), drags);
  EXPECT_GT((bench.controller->state().camera.back - before.back).norm(), 0.1);
}

TEST(ViewController, AClickPicksAndEscapeForgets) {
  Bench bench;
  const PixelBox pane = bench.controller->layout().panes[0];
  const Vec2 at = bench.controller->state().camera.pixel({0.25, 0.5, 0.0}, pane);
  bench.drag(at, at, 1);
  ASSERT_TRUE(bench.controller->state().picked);
  EXPECT_LE((bench.controller->state().picked->point - Vec3(0.25, 0.5, 0.0)).norm(), 1e-9);
  bench.controller->act(ViewAction::escape);
  EXPECT_FALSE(bench.controller->state().picked);
  bench.drag({pane.left + 3.0, pane.bottom + 3.0}, {pane.left + 3.0, pane.bottom + 3.0}, 1);
  EXPECT_FALSE(bench.controller->state().picked);
}

TEST(ViewController, NothingIsReplacedWithoutBeingAskedTwice) {
  const test::Folder folder;
  Bench bench({folder / "kept.json", false});
  test::write(folder / "kept.json", "old");
  bench.controller->key("s", true);
  EXPECT_EQ(test::content(folder / "kept.json"), "old");
  EXPECT_TRUE(bench.controller->state().warning);
  bench.controller->key("f", false);  // another key: the question is forgotten
  bench.controller->key("s", true);
  EXPECT_EQ(test::content(folder / "kept.json"), "old");
  bench.controller->key("s", true);
  EXPECT_EQ(test::content(folder / "kept.json"), "saved");
  bench.controller->key("s", true);  // its own file
  EXPECT_FALSE(bench.controller->state().warning);
}

TEST(ViewController, LeavingWithUnsavedChangesIsAskedTwice) {
  Bench bench;
  bench.document->changed_ = true;
  bench.controller->key("q", false);
  EXPECT_FALSE(bench.controller->ended());
  bench.controller->key("q", false);
  EXPECT_TRUE(bench.controller->ended());
  Bench unchanged;
  unchanged.controller->key("q", false);
  EXPECT_TRUE(unchanged.controller->ended());
}

TEST(ViewController, UndoSaysWhenThereIsNothing) {
  Bench bench;
  bench.controller->key("z", true);
  EXPECT_EQ(bench.controller->state().message, "taken back");
  bench.controller->key("z", true);
  EXPECT_TRUE(bench.controller->state().warning);
}

TEST(ViewController, AFigureThatNothingHasIsSaid) {
  Bench bench;
  bench.controller->key("2", false);
  EXPECT_FALSE(bench.controller->state().warning);
  bench.controller->key("3", false);
  EXPECT_TRUE(bench.controller->state().warning);
}

}  // namespace
}  // namespace blendwright
