// What the README shows is what the repository holds.
#include <gtest/gtest.h>

#include <filesystem>
#include <regex>

#include "kernel/base/text_file.hpp"

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
