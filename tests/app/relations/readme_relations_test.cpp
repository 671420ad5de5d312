// What the README shows of `offset`, `relate` and `collide` is what they print.
#include <gtest/gtest.h>

#include <sstream>

#include "kernel/base/text_file.hpp"
#include "tests/app/program.hpp"

namespace blendwright::test {
namespace {

const fs::path root = BLENDWRIGHT_SOURCE_DIR;

/// What stands below the only command that starts with these words, up to the figures that depend on the
/// machine or on rounding.
void expect_shown(const std::string& verb, std::size_t lines_at_least) {
  const std::string readme = read_text_file(root / "README.md", 10'000'000);
  const std::string start = "build/release/app/cli/blendwright " + verb + " ";
  const std::size_t at = readme.find(start);
  ASSERT_NE(at, std::string::npos);
  EXPECT_EQ(readme.find(start, at + 1), std::string::npos);
  const std::string command = readme.substr(at, readme.find('\n', at) - at);
  const std::string between = "\n```\n\n```text\n";
  ASSERT_EQ(readme.compare(at + command.size(), between.size(), between), 0);
  const std::size_t first = at + command.size() + between.size();
  std::istringstream shown(readme.substr(first, readme.find("```", first) - first));

  const std::string program = "build/release/app/cli/blendwright ";
  const Outcome run = run_program(command.substr(program.size()), "cd " + quoted_path(root) + "; ");
  ASSERT_EQ(run.code, 0) << run.err;
  std::istringstream printed(run.out);
  std::size_t compared = 0;
  for (std::string is, must; std::getline(printed, must); ++compared) {
    ASSERT_TRUE(std::getline(shown, is)) << must;
    if (must.find(" s") == must.size() - 2 || must.find("error") != std::string::npos ||
        must.find("worst at") != std::string::npos)
      continue;
    // Witnesses and box counts may differ in the last digits between instruction sets.
    const std::size_t figures = must.find_first_of("(0123456789", 30);
    EXPECT_EQ(is.substr(0, figures), must.substr(0, figures));
  }
  EXPECT_GE(compared, lines_at_least);
}

TEST(ReadmeRelations, ShowsWhatOffsetPrints) { expect_shown("offset", 12); }
TEST(ReadmeRelations, ShowsWhatRelatePrints) { expect_shown("relate", 7); }
TEST(ReadmeRelations, ShowsWhatCollidePrints) { expect_shown("collide", 5); }

}  // namespace
}  // namespace blendwright::test
