// Scripts of events: what is wrong is told before anything happens, all of it at once.
#include "app/view/window/script.hpp"

#include <gtest/gtest.h>

#include "kernel/base/error.hpp"

namespace blendwright {
namespace {

std::vector<Problem> problems_of(const std::string& text) {
  try {
    static_cast<void>(read_script(text));
  } catch (const InputError& e) {
    return e.problems();
  }
  return {};
}

TEST(ViewScript, WordsMayBeQuotedAndCommentsAreSkipped) {
  const auto steps = read_script("# first\n\n  drag \"pipe: tension\" 3.5  # to there\nkey Ctrl+Z\n");
  ASSERT_EQ(steps.size(), 2u);
  EXPECT_EQ(steps[0].line, 3u);
  EXPECT_EQ(steps[0].words, (std::vector<std::string>{"pipe: tension", "3.5"}));
  EXPECT_EQ(steps[1].words, (std::vector<std::string>{"Ctrl+Z"}));
}

TEST(ViewScript, EveryBadLineIsTold) {
  const auto problems =
      problems_of("key F\nclck 1 2\nclick 1\nclick 1 two\nkey Ctrl+9\nresize 5 5\nclick nan 3\n");
  ASSERT_EQ(problems.size(), 6u);
  EXPECT_EQ(problems[0].where, "line 2");
  EXPECT_NE(problems[0].message.find("click"), std::string::npos) << problems[0].message;
  EXPECT_EQ(problems[1].where, "line 3");
  EXPECT_NE(problems[2].message.find("\"two\""), std::string::npos);
  EXPECT_EQ(problems[3].where, "line 5");
  EXPECT_EQ(problems[4].where, "line 6");
  EXPECT_EQ(problems[5].where, "line 7");
}

TEST(ViewScript, AnythingElseIsNoCrash) {
  for (const char* text : {"", "\n\n", "\"", "drag \"a", "key \"\"", "\xff\xfe 1 2", "wheel 1e999"}) {
    SCOPED_TRACE(text);
    static_cast<void>(problems_of(text));
  }
}

}  // namespace
}  // namespace blendwright
