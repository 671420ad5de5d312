// `compare` as a user meets it: known distances, both kinds of results, limits, files, bad input.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>

#include "app/json/json_value.hpp"
#include "kernel/exchange/mesh_files.hpp"
#include "tests/app/program.hpp"

namespace blendwright::test {
namespace {

using testing::HasSubstr;

/// Places of a sphere on a grid, the same for every radius; outward.
TriMesh ball(double radius) {
  constexpr int rings = 24, turns = 48;
  TriMesh mesh;
  mesh.name = "ball";
  const auto at = [](int i, int j) { return static_cast<std::uint32_t>(1 + (i - 1) * turns + j % turns); };
  mesh.points.emplace_back(0, 0, radius);
  for (int i = 1; i < rings; ++i)
    for (int j = 0; j < turns; ++j) {
      const double a = std::numbers::pi * i / rings, b = 2.0 * std::numbers::pi * j / turns;
      mesh.points.push_back(radius * Vec3(std::sin(a) * std::cos(b), std::sin(a) * std::sin(b), std::cos(a)));
    }
  mesh.points.emplace_back(0, 0, -radius);
  const auto south = static_cast<std::uint32_t>(mesh.points.size() - 1);
  for (int j = 0; j < turns; ++j) {
    mesh.triangles.push_back({0, at(1, j), at(1, j + 1)});
    mesh.triangles.push_back({south, at(rings - 1, j + 1), at(rings - 1, j)});
    for (int i = 1; i + 1 < rings; ++i) {
      mesh.triangles.push_back({at(i, j), at(i + 1, j), at(i + 1, j + 1)});
      mesh.triangles.push_back({at(i, j), at(i + 1, j + 1), at(i, j + 1)});
    }
  }
  return mesh;
}

TriMesh square(double z) {
  return {"square", {{0, 0, z}, {1, 0, z}, {1, 1, z}, {0, 1, z}}, {}, {{0, 1, 2}, {0, 2, 3}}, {}};
}

class CompareVerb : public testing::Test {
 protected:
  [[nodiscard]] std::string at(const std::string& name) const { return quoted_path(folder_ / name); }
  [[nodiscard]] JsonValue report(const std::string& arguments, int code = 0) const {
    const Outcome outcome = run_program("compare " + arguments + " --json");
    EXPECT_EQ(outcome.code, code) << outcome.err;
    return parse_json(outcome.out);
  }
  static double number(const JsonValue& of, const char* key) { return *of.find(key)->number(); }
  Folder folder_;
};

TEST_F(CompareVerb, FindsTheDifferenceOfTwoRadii) {
  write_vtp(folder_ / "one.vtp", ball(1.0));
  write_vtp(folder_ / "larger.vtp", ball(1.01));
  const JsonValue r = report(at("one.vtp") + " " + at("larger.vtp"));
  // A corner of the larger is 0.01 from that of the smaller, and nothing of the smaller is nearer: it is
  // convex, and the corner's own direction points outward.
  EXPECT_NEAR(number(*r.find("second_to_first"), "largest"), 0.01, 1e-12);
  EXPECT_NEAR(number(r, "hausdorff"), 0.01, 1e-12);
  EXPECT_GE(number(r, "proven"), 0.01 - 1e-12);
  EXPECT_LE(number(r, "proven"), 0.01 * (1.0 + 2e-6));
  // From the smaller to the facets of the larger: 0.01 times the cosine of half a facet's turn (7.5 degrees
  // at most) or more.
  const JsonValue& back = *r.find("first_to_second");
  EXPECT_LE(number(back, "largest"), 0.01);
  EXPECT_GE(number(back, "largest"), 0.01 * std::cos(7.5 * std::numbers::pi / 180.0));
  EXPECT_LT(number(back, "most"), 0.0);  // inside
  EXPECT_GT(number(*r.find("second_to_first"), "least"), 0.0);
}

TEST_F(CompareVerb, FindsTheShiftOfAPlaneEverywhere) {
  write_stl(folder_ / "a.stl", std::vector{square(0.0)});
  write_obj(folder_ / "b.obj", std::vector{square(0.25)});
  const JsonValue r = report(at("a.stl") + " " + at("b.obj"));
  for (const char* way : {"first_to_second", "second_to_first"})
    for (const char* key : {"largest", "mean", "rms", "percentile_95"})
      EXPECT_NEAR(number(*r.find(way), key), 0.25, 1e-12) << way << " " << key;
  EXPECT_NEAR(number(*r.find("first_to_second"), "signed_mean"), -0.25, 1e-12);
}

TEST_F(CompareVerb, FindsWhatOnlyTheMiddleOfATriangleShows) {
  // Above the middle of the square a tent: no corner of the square is off, its middle is 0.5 away or less.
  TriMesh tent{"tent",
               {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0.5, 0.5, 1}},
               {},
               {{0, 1, 4}, {1, 2, 4}, {2, 3, 4}, {3, 0, 4}},
               {}};
  write_ply(folder_ / "flat.ply", square(0.0));
  write_ply(folder_ / "tent.ply", tent);
  const JsonValue r = report(at("flat.ply") + " " + at("tent.ply"));
  // The walls rise 1 over 0.5: the middle is 0.5 cos(atan(0.5)) = 1 / sqrt(5) from each.
  EXPECT_NEAR(number(*r.find("first_to_second"), "largest"), 1.0 / std::sqrt(5.0), 1e-5);
  EXPECT_NEAR(number(*r.find("second_to_first"), "largest"), 1.0, 1e-12);
}

TEST_F(CompareVerb, HoldsAJobAgainstItsOwnStepFileAndItsMesh) {
  const std::string job =
      quoted_path(fs::path(BLENDWRIGHT_SOURCE_DIR) / "examples/specs/coaxial-cylinders.json");
  ASSERT_EQ(run_program("blend " + job + " -o " + at("out") + " --format step,vtp --quiet").code, 0);
  const std::string step = quoted_path(folder_ / "out/coaxial-cylinders.step");
  const Outcome own = run_program("compare " + job + " " + step + " --limit 1e-6");
  EXPECT_EQ(own.code, 0) << own.out << own.err;
  EXPECT_THAT(own.out, HasSubstr("within the limit 1e-06 mm"));
  // The corners of the mesh lie on the surface; its triangles do not.
  const JsonValue mesh = report(quoted_path(folder_ / "out/coaxial-cylinders.reducer.vtp") + " " + step);
  EXPECT_GT(number(*mesh.find("first_to_second"), "largest"), 1e-6);
  EXPECT_LT(number(*mesh.find("first_to_second"), "largest"), 0.05);
  EXPECT_EQ(run_program("compare " + step + " " + step + "#nothing").code, 3);
}

TEST_F(CompareVerb, EndsWithTheCodeOfALimitAndWritesTheColumn) {
  write_vtp(folder_ / "a.vtp", square(0.0));
  write_vtp(folder_ / "b.vtp", square(0.01));
  const std::string both = at("a.vtp") + " " + at("b.vtp");
  EXPECT_EQ(run_program("compare " + both + " --limit 0.011").code, 0);
  EXPECT_EQ(run_program("compare " + both + " --limit 0.009").code, 1);
  EXPECT_EQ(run_program("compare " + both + " --limit 0").code, 2);
  EXPECT_EQ(run_program("compare " + both + " --quiet -o " + at("d.vtp")).code, 0);
  const TriMesh written = read_mesh(folder_ / "d.vtp");
  ASSERT_EQ(written.columns.size(), 1u);
  EXPECT_EQ(written.columns[0].name, "deviation");
  EXPECT_EQ(written.columns[0].unit, "mm");
  for (const double d : written.columns[0].values) EXPECT_NEAR(d, -0.01, 1e-15);
  EXPECT_EQ(run_program("compare " + both + " -o " + at("d.vtp")).code, 5);
  EXPECT_EQ(run_program("compare " + both + " -o " + at("d.txt")).code, 3);
}

TEST_F(CompareVerb, RefusesWhatCannotBeCompared) {
  write_vtp(folder_ / "good.vtp", square(0.0));
  const std::vector<PolyLine> lines{{"line", {{0, 0, 0}, {1, 0, 0}}, false, {}}};
  write_vtp(folder_ / "lines.vtp", lines);
  write(folder_ / "empty.stl", "");
  write(folder_ / "noise.ply", std::string("ply\n\0\xff\xfe", 7));
  write(folder_ / "nan.obj", "v 0 0 nan\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
  write(folder_ / "text.txt", "hello");
  write(folder_ / "noise.step", "ISO-10303-21;\n");
  const struct {
    const char* file;
    int code;
  } bad[] = {{"missing.stl", 5}, {"lines.vtp", 3}, {"empty.stl", 5},
             {"noise.ply", 5},   {"text.txt", 3},  {"noise.step", 5}};
  for (const auto& [file, code] : bad) {
    const Outcome outcome = run_program("compare " + at("good.vtp") + " " + at(file));
    EXPECT_EQ(outcome.code, code) << file << ": " << outcome.err;
    EXPECT_THAT(outcome.err, HasSubstr(file));
    EXPECT_EQ(outcome.out, "");
  }
  const int nan = run_program("compare " + at("good.vtp") + " " + at("nan.obj")).code;
  EXPECT_TRUE(nan == 3 || nan == 5) << nan;
}

}  // namespace
}  // namespace blendwright::test
