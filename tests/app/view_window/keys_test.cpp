// Keys: one table for what they do, the help, and README.
#include "app/view/window/keys.hpp"

#include <gtest/gtest.h>

#include <set>

#include "tests/app/program.hpp"

namespace blendwright {
namespace {

TEST(ViewKeys, NoTwoActionsShareAKeyAndEveryActionHasOne) {
  std::set<std::string> keys;
  std::set<ViewAction> actions;
  for (const ViewKey& k : view_keys()) {
    EXPECT_TRUE(keys.insert(std::string(k.key)).second) << k.key;
    if (!k.also.empty()) {
      EXPECT_TRUE(keys.insert(std::string(k.also)).second) << k.also;
    }
    EXPECT_TRUE(actions.insert(k.action).second) << k.key;
  }
  EXPECT_EQ(actions.size(), static_cast<std::size_t>(ViewAction::quit) + 1);
}

TEST(ViewKeys, AreFoundByTheNamesOfX) {
  EXPECT_EQ(action_of("z", true), ViewAction::undo);
  EXPECT_EQ(action_of("z", false), ViewAction::along_z);
  EXPECT_EQ(action_of("Z", false), ViewAction::along_z);
  EXPECT_EQ(action_of("question", false), ViewAction::help);
  EXPECT_EQ(action_of("Escape", false), ViewAction::escape);
  EXPECT_EQ(action_of("Next", false), ViewAction::next_page);
  EXPECT_EQ(action_of("z1", false), std::nullopt);
  EXPECT_EQ(action_of("", false), std::nullopt);
  EXPECT_EQ(action_of("f", true), std::nullopt);
}

TEST(ViewKeys, AreInReadme) {
  const std::string readme = test::content(std::string(BLENDWRIGHT_SOURCE_DIR) + "/README.md");
  for (const ViewKey& k : view_keys()) {
    std::string row = "| `";
    row.append(k.key).append("`");
    EXPECT_NE(readme.find(row), std::string::npos) << k.key;
    EXPECT_NE(readme.find(std::string(k.does)), std::string::npos) << k.does;
  }
}

}  // namespace
}  // namespace blendwright
