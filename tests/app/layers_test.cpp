// The direction of dependencies, read from the sources themselves.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <regex>
#include <string>
#include <vector>

namespace {

namespace fs = std::filesystem;

struct Include {
  std::string file;    ///< relative to the project root
  std::string target;  ///< as written between the quotes or brackets
};

std::vector<Include> includes_below(const std::vector<std::string>& folders) {
  static const std::regex pattern(R"(^\s*#\s*include\s*[<"]([^>"]+)[>"])");
  std::vector<Include> found;
  const fs::path root = BLENDWRIGHT_SOURCE_DIR;
  for (const std::string& folder : folders)
    for (const auto& entry : fs::recursive_directory_iterator(root / folder)) {
      if (entry.path().extension() != ".hpp" && entry.path().extension() != ".cpp") continue;
      std::ifstream in(entry.path());
      std::smatch match;
      for (std::string line; std::getline(in, line);)
        if (std::regex_search(line, match, pattern))
          found.push_back({fs::relative(entry.path(), root).generic_string(), match[1]});
    }
  return found;
}

bool starts_with_any(const std::string& text, const std::vector<std::string>& prefixes) {
  for (const std::string& p : prefixes)
    if (text.rfind(p, 0) == 0) return true;
  return false;
}

/// "file includes target" for every include of `folders` that starts with one of `forbidden`.
std::vector<std::string> violations(const std::vector<std::string>& folders,
                                    const std::vector<std::string>& forbidden) {
  std::vector<std::string> bad;
  for (const Include& i : includes_below(folders))
    if (starts_with_any(i.target, forbidden)) bad.push_back(i.file + " includes " + i.target);
  return bad;
}

const std::vector<std::string> occt{"BRep", "Geom", "TopoDS",    "TopExp", "gp_", "STEP",
                                    "XCAF", "TDoc", "Standard_", "Poly_",  "TCol"};

TEST(Layers, SourcesAreFound) {
  ASSERT_GT(includes_below({"kernel", "parametric", "implicit", "verify", "app"}).size(), 100u);
}

TEST(Layers, KernelStandsAlone) {
  EXPECT_EQ(violations({"kernel"}, {"parametric/", "implicit/", "verify/", "app/"}),
            std::vector<std::string>{});
}
TEST(Layers, CoreKernelKnowsNeitherBrepNorFiles) {
  EXPECT_EQ(violations({"kernel/base", "kernel/math", "kernel/geometry", "kernel/primitives", "kernel/mesh",
                        "kernel/field"},
                       {"kernel/brep", "kernel/exchange"}),
            std::vector<std::string>{});
}
TEST(Layers, ModulesDoNotKnowEachOther) {
  EXPECT_EQ(violations({"parametric"}, {"implicit/", "verify/", "app/", "kernel/brep", "kernel/exchange"}),
            std::vector<std::string>{});
  EXPECT_EQ(violations({"verify"}, {"parametric/", "implicit/", "app/", "kernel/brep", "kernel/exchange"}),
            std::vector<std::string>{});
  EXPECT_EQ(violations({"implicit"}, {"parametric/", "verify/", "app/", "kernel/brep", "kernel/exchange"}),
            std::vector<std::string>{});
}
TEST(Layers, HeavyLibrariesStayInTheirFolders) {
  EXPECT_EQ(
      violations({"kernel/base", "kernel/math", "kernel/geometry", "kernel/primitives", "kernel/mesh",
                  "kernel/field", "parametric", "implicit", "verify", "app/json", "app/pipeline", "app/cli"},
                 occt),
      std::vector<std::string>{});
  EXPECT_EQ(
      violations({"kernel", "parametric", "implicit", "verify", "app/pipeline", "app/cli"}, {"nlohmann/"}),
      std::vector<std::string>{});
  EXPECT_EQ(violations({"kernel", "verify", "app"}, {"ceres/"}), std::vector<std::string>{});
  EXPECT_EQ(violations({"implicit"}, {"vtk"}), std::vector<std::string>{});
  EXPECT_EQ(violations({"kernel", "verify", "app"}, {"hwy/"}), std::vector<std::string>{});
}
TEST(Layers, CommandLineLibraryIsInOneFile) {
  for (const Include& i : includes_below({"kernel", "parametric", "implicit", "verify", "app"}))
    if (i.target.rfind("CLI/", 0) == 0) {
      EXPECT_EQ(i.file, "app/cli/options.hpp");
    }
}
TEST(Layers, DecompositionsStayInOneFile) {
  for (const Include& i : includes_below({"kernel", "parametric", "verify", "app"}))
    if (starts_with_any(i.target, {"Eigen/Dense", "Eigen/SVD", "Eigen/QR", "Eigen/LU", "Eigen/Cholesky",
                                   "Eigen/Eigenvalues"})) {
      EXPECT_EQ(i.file, "kernel/math/dense_solve.cpp");
    }
}

}  // namespace
