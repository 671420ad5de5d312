// What the README shows is what the repository holds.
#include <gtest/gtest.h>

#include <filesystem>
#include <regex>

#include "kernel/base/text_file.hpp"
#include "tests/app/program.hpp"

namespace blendwright {
namespace {

const std::filesystem::path root = BLENDWRIGHT_SOURCE_DIR;
std::string text_of(const char* file) { return read_text_file(root / file, 10'000'000); }

TEST(Readme, QuotesTheQuickstartAndTheFirstJobVerbatim) {
  const std::string readme = text_of("README.md");
  EXPECT_NE(readme.find("```cpp\n" + text_of("examples/01_quickstart.cpp") + "```"), std::string::npos);
  EXPECT_NE(readme.find("```jsonc\n" + text_of("examples/specs/coaxial-cylinders.json") + "```"),
            std::string::npos);
}

/// Each run shown must print what stands below its command, up to figures that depend on the machine.
TEST(Readme, ShowsAMeshRunVerbatim) {
  const std::string readme = text_of("README.md");
  const std::string scene = "examples/scenes/s0-12ab.json";
  EXPECT_NE(readme.find("```jsonc\n" + text_of(scene.c_str()) + "```"), std::string::npos);
  const std::string command =
      "blendwright mesh " + scene + " --cells 256 -o body.vtp -o body.stl\n```\n\n```text\n";
  const std::size_t start = readme.find(command);
  ASSERT_NE(start, std::string::npos);
  const std::string shown =
      readme.substr(start + command.size(), readme.find("```", start + command.size()) - start);
  const test::Outcome run = test::run_program("mesh " + test::quoted_path(root / scene) + " --cells 256");
  ASSERT_EQ(run.code, 0) << run.err;
  std::size_t compared = 0;
  for (std::size_t at = 0; at < run.out.size(); ++compared) {
    const std::size_t end = run.out.find('\n', at) + 1;
    const std::string line = run.out.substr(at, end - at);
    at = end;
    // Rounding, and the time that it took.
    if (line.find("distance error") != std::string::npos || line.find("nothing written") != std::string::npos)
      continue;
    EXPECT_NE(shown.find(line), std::string::npos) << line;
  }
  EXPECT_EQ(compared, 12u);
}

TEST(Readme, LinksLeadSomewhere) {
  const std::string readme = text_of("README.md");
  const std::regex link(R"(\]\(([^)#]+)\))");
  std::size_t count = 0;
  for (std::sregex_iterator it(readme.begin(), readme.end(), link), end; it != end; ++it, ++count)
    EXPECT_TRUE(std::filesystem::exists(root / (*it)[1].str())) << (*it)[1];
  EXPECT_GT(count, 30u);
}

}  // namespace
}  // namespace blendwright
