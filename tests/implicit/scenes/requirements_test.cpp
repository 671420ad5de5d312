// The page on requirements: every row names nodes that there are, and tests and pictures that there are.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <regex>
#include <sstream>

#include "implicit/scene/node.hpp"
#include "kernel/base/text_file.hpp"

namespace blendwright::test {
namespace {

namespace fs = std::filesystem;
const fs::path root = BLENDWRIGHT_SOURCE_DIR;

/// All matches of the expression's first group.
std::vector<std::string> matches(const std::string& text, const char* expression) {
  const std::regex pattern(expression);
  std::vector<std::string> found;
  for (std::sregex_iterator it(text.begin(), text.end(), pattern), end; it != end; ++it)
    found.push_back((*it)[1].str());
  return found;
}

/// The cells of each row below the header.
std::vector<std::vector<std::string>> rows_of(const std::string& page) {
  std::vector<std::vector<std::string>> rows;
  std::istringstream lines(page);
  for (std::string line; std::getline(lines, line);) {
    if (line.rfind("| ", 0) != 0) continue;
    rows.emplace_back();
    std::istringstream cells(line.substr(1));
    for (std::string cell; std::getline(cells, cell, '|');) rows.back().push_back(cell);
  }
  if (!rows.empty()) rows.erase(rows.begin());
  return rows;
}

std::string all_tests() {
  std::string text;
  for (const auto& file : fs::recursive_directory_iterator(root / "tests"))
    if (file.path().extension() == ".cpp") text += read_text_file(file.path(), 10'000'000);
  return text;
}

TEST(BlendRequirements, NameNodesTestsAndPicturesThatThereAre) {
  const fs::path folder = root / "examples/scenes";
  const auto rows = rows_of(read_text_file(folder / "blends.md", 1'000'000));
  ASSERT_EQ(rows.size(), 16u);  // the requirements of the source
  const std::string tests = all_tests();
  for (const std::vector<std::string>& row : rows) {
    SCOPED_TRACE(row.at(0));
    ASSERT_GE(row.size(), 4u);
    std::size_t nodes = 0;
    for (const std::string& name : matches(row[1] + row[3], "`([a-z][a-z0-9_]+)`")) {
      EXPECT_NE(find_node_kind(name), nullptr) << name;
      ++nodes;
    }
    const auto shown = matches(row[2] + row[3], "([A-Z][A-Za-z]+\\.[A-Z][A-Za-z0-9]+)"),
               links = matches(row[2], "\\]\\(([^)]+)\\)");
    EXPECT_GT(shown.size() + links.size(), 0u);
    EXPECT_TRUE(nodes > 0 || row[1].find("every") != std::string::npos);
    for (const std::string& test : shown) {
      const std::size_t dot = test.find('.');
      const std::regex defined("TEST(_F|_P)?\\(" + test.substr(0, dot) + ",\\s*" + test.substr(dot + 1) +
                               "\\)");
      EXPECT_TRUE(std::regex_search(tests, defined)) << test;
    }
    for (const std::string& link : links) EXPECT_TRUE(fs::exists(folder / link)) << link;
  }
}

}  // namespace
}  // namespace blendwright::test
