// A job shaped in the real window: sliders and handles are dragged by events, under a display of its own.
#include <gtest/gtest.h>

#include <cmath>

#include "tests/app/view_window/viewing.hpp"
#include "tests/support/for_all.hpp"

namespace blendwright::test {
namespace {

const std::string job = BLENDWRIGHT_SOURCE_DIR "/examples/specs/branch-to-main.json --width 640 --height 480";

double control(const JsonValue& state, const std::string& name) {
  const JsonValue* found = state.find("controls")->find(name);
  return found && found->number() ? *found->number() : std::nan("");
}

/// Every numeric slider's name, as the first state tells.
std::vector<std::string> sliders() {
  const Viewed v = viewed(job, "state\n");
  std::vector<std::string> names;
  if (v.states.empty()) return names;
  for (const JsonMember& m : *v.states[0].find("controls")->members())
    if (m.value.number()) names.push_back(m.key);
  return names;
}

TEST(ViewJob, EachSliderReshapesAndUndoGivesTheJobBack) {
  const std::vector<std::string> names = sliders();
  ASSERT_GE(names.size(), 3u);
  std::string events = "state\n";
  for (const std::string& name : names) {
    events.append("drag \"").append(name).append("\" 1.5\n");
    events += "key Ctrl+Z\n";
  }
  const Viewed v = viewed(job, events);
  ASSERT_EQ(v.states.size(), 1 + 2 * names.size()) << v.err;
  for (std::size_t i = 0; i < names.size(); ++i) {
    const double before = control(v.states[0], names[i]), after = control(v.states[2 * i + 1], names[i]);
    EXPECT_NE(after, before) << names[i];
    // A slider has at least 170 pixels; the widest range is four decades.
    EXPECT_NEAR(std::log(after / 1.5), 0.0, std::log(1e4) / 170.0) << names[i];
    EXPECT_EQ(control(v.states[2 * i + 2], names[i]), before) << names[i];
    EXPECT_TRUE(*v.states[2 * i + 1].find("changed")->boolean());
  }
}

TEST(ViewJob, ASavedJobShowsTheSameAgain) {
  const Folder folder;
  const std::vector<std::string> names = sliders();
  ASSERT_FALSE(names.empty());
  const std::string first = names.front();
  const Viewed v = viewed(job, "drag \"" + first + "\" 3\nsave " + (folder / "saved.json").string() +
                                   "\nscreenshot " + (folder / "a.png").string() + "\n");
  ASSERT_EQ(v.states.size(), 3u) << v.err;
  EXPECT_FALSE(*v.states[1].find("changed")->boolean());
  const Viewed again = viewed(quoted_path(folder / "saved.json") + " --width 640 --height 480",
                              "screenshot " + (folder / "b.png").string() + "\n");
  ASSERT_EQ(again.states.size(), 1u) << again.err;
  EXPECT_EQ(control(again.states[0], first), control(v.states[0], first));
  const Pixels a = read_png(folder / "a.png"), b = read_png(folder / "b.png");
  ASSERT_EQ(a.rgb.size(), b.rgb.size());
  std::size_t different = 0;
  for (int y = 50; y < a.height; ++y)  // above the status, which tells of the saving
    for (int x = 200; x < a.width; ++x)
      for (int c = 0; c < 3; ++c)
        if (std::abs(a.at(x, y)[c] - b.at(x, y)[c]) > 8) ++different;
  EXPECT_LT(different, a.rgb.size() / 1000);
}

TEST(ViewJob, AHandleMovesAndErrorsStayAtRounding) {
  const Viewed v = viewed(job, "state\ndrag-handle 8 10 12\nkey Ctrl+Z\nkey Ctrl+Y\n");
  ASSERT_EQ(v.states.size(), 4u) << v.err;
  EXPECT_GE(v.states[0].find("handles")->items()->size(), 8u);
  EXPECT_TRUE(*v.states[1].find("changed")->boolean());
  for (const JsonValue& s : v.states) EXPECT_LE(*s.find("worst_gap")->number(), 1e-12);
  EXPECT_EQ(json_text(*v.states[2].find("handles")), json_text(*v.states[0].find("handles")));
  EXPECT_EQ(json_text(*v.states[3].find("handles")), json_text(*v.states[1].find("handles")));
}

TEST(ViewJob, WithShiftATrimlineMovesAtItsHandleOnly) {
  const Viewed v = viewed(job, "state\nbend-handle 2 0 25\nkey Ctrl+Z\ndrag-handle 2 0 25\n");
  ASSERT_EQ(v.states.size(), 4u) << v.err;
  const auto moved = [&](std::size_t state, std::size_t handle) {
    const auto place = [&](std::size_t s) {
      return json_text((*v.states[s].find("handles")->items())[handle]);
    };
    return place(state) != place(0);
  };
  EXPECT_TRUE(moved(1, 2));
  EXPECT_FALSE(moved(1, 6));  // opposite on a closed line
  EXPECT_FALSE(moved(2, 2));
  EXPECT_TRUE(moved(3, 2));
  EXPECT_TRUE(moved(3, 6));
  for (const JsonValue& s : v.states) EXPECT_LE(*s.find("worst_gap")->number(), 1e-12);
}

TEST(ViewJob, ChoicesAreClickedAndUndone) {
  const Viewed first = viewed(job, "state\n");
  ASSERT_EQ(first.states.size(), 1u) << first.err;
  std::vector<std::string> choices;
  for (const JsonMember& m : *first.states[0].find("controls")->members())
    if (m.value.text()) choices.push_back(m.key);
  ASSERT_GE(choices.size(), 3u);  // mode, continuity from and to
  std::string events = "state\ndrawing off\n";
  for (const std::string& name : choices) events.append("drag \"").append(name).append("\" 1\nkey Ctrl+Z\n");
  const Viewed v = viewed(job, events);
  ASSERT_EQ(v.states.size(), 2 + 2 * choices.size()) << v.err;
  const auto word = [&](std::size_t state, const std::string& name) {
    return *v.states[state].find("controls")->find(name)->text();
  };
  for (std::size_t i = 0; i < choices.size(); ++i) {
    EXPECT_NE(word(2 + 2 * i, choices[i]), word(0, choices[i])) << choices[i];
    EXPECT_EQ(word(3 + 2 * i, choices[i]), word(0, choices[i])) << choices[i];
  }
}

TEST(ViewJob, RandomDragsKeepTheJointsExact) {
  constexpr int drags = 200;
  const std::vector<std::string> names = sliders();
  ASSERT_FALSE(names.empty());
  Rng rng(1);
  std::string events = "state\ndrawing off\n";
  for (int i = 0; i < drags; ++i)
    if (i % 2 == 0) {
      const std::string& name =
          names[static_cast<std::size_t>(integer(rng, 0, static_cast<int>(names.size()) - 1))];
      events.append("drag \"").append(name).append("\" ").append(
          std::to_string(log_uniform(rng, 0.5, 3.0))) += "\n";
    } else {
      events.append(integer(rng, 0, 1) == 0 ? "drag-handle " : "bend-handle ")
          .append(std::to_string(integer(rng, 0, 31)));
      for (int k = 0; k < 2; ++k) events.append(" ").append(std::to_string(integer(rng, -9, 9)));
      events += "\n";
    }
  const Viewed v = viewed(job, events + "drawing on\n");
  ASSERT_EQ(v.states.size(), static_cast<std::size_t>(drags) + 3) << v.err;
  int moved = 0;
  for (std::size_t i = 0; i < v.states.size(); ++i) {
    EXPECT_LE(*v.states[i].find("worst_gap")->number(), 1e-12) << i;
    if (i > 0)
      moved += json_text(*v.states[i].find("handles")) != json_text(*v.states[i - 1].find("handles")) ||
               json_text(*v.states[i].find("controls")) != json_text(*v.states[i - 1].find("controls"));
  }
  EXPECT_GT(moved, drags / 2);  // they are drags of something
}

}  // namespace
}  // namespace blendwright::test
