// `mesh` as a user meets it: figures, files in every format, what happens at the box, interruption.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "app/json/json_value.hpp"
#include "implicit/polygonize/polygonize.hpp"
#include "kernel/exchange/mesh_files.hpp"
#include "tests/app/program.hpp"
#include "tests/app/running.hpp"

namespace blendwright::test {
namespace {

using testing::AllOf;
using testing::Contains;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;

constexpr double pi = std::numbers::pi, radius = 4.0;

/// A ball of radius 4 and one twice as wide along x, far from each other.
const std::string scene = R"({
  "unit": "cm",
  "nodes": {
    "ball": { "kind": "soft_object", "distance": { "kind": "lp_metric", "a": 8, "b": 8, "c": 8, "n": 2 } },
    "egg": { "kind": "soft_object", "distance": { "kind": "place", "move": [40, 0, 0],
             "of": { "kind": "lp_metric", "a": 16, "b": 8, "c": 8, "n": 2 } } },
    "both": { "kind": "soft_blend", "of": ["ball", "egg"] },
    "wall": { "kind": "slab", "normal": [0, 0, 1], "a": 1 }
  },
  "solid": "ball"
})";

class MeshVerb : public testing::Test {
 protected:
  MeshVerb() { write(folder_ / "scene.json", scene); }
  [[nodiscard]] Outcome run(const std::string& arguments, const std::string& before = "") const {
    return run_program("mesh " + quoted_path(folder_ / "scene.json") + " " + arguments,
                       "cd " + quoted_path(folder_.path()) + "; " + before);
  }
  [[nodiscard]] JsonValue figures(const std::string& arguments) const {
    const Outcome outcome = run("--json " + arguments);
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    return parse_json(outcome.out);
  }
  Folder folder_;
};

double number(const JsonValue& report, const char* key) { return *report.find(key)->number(); }

/// Vertices lie on the sphere and edges are no longer than a cell's diagonal, so the flat triangles stay
/// outside of the sphere of radius sqrt(R^2 - 3 h^2).
double inner_radius(double cell) { return std::sqrt(radius * radius - 3.0 * cell * cell); }

TEST_F(MeshVerb, MeasuresABall) {
  const JsonValue report = figures("--cell 0.25");
  const double inner = inner_radius(0.25);
  EXPECT_LE(number(report, "area"), 4.0 * pi * radius * radius);
  EXPECT_GE(number(report, "area"), 4.0 * pi * inner * inner);
  EXPECT_LE(number(report, "volume"), 4.0 / 3.0 * pi * std::pow(radius, 3));
  EXPECT_GE(number(report, "volume"), 4.0 / 3.0 * pi * std::pow(inner, 3));
  EXPECT_EQ(number(report, "euler_characteristic"), 2.0);
  EXPECT_EQ(number(report, "components"), 1.0);
  EXPECT_LE(number(report, "largest_distance"), 1e-6 * 0.25);
  EXPECT_FALSE(*report.find("cut_by_box")->boolean());
  EXPECT_EQ(*report.find("unit")->text(), "cm");
  EXPECT_EQ(*report.find("solid")->text(), "ball");
  EXPECT_EQ(number(report, "cell"), 0.25);
  EXPECT_EQ(report.find("times"), nullptr);
  EXPECT_NE(figures("--times --cells 8").find("times"), nullptr);
}

TEST_F(MeshVerb, CountsCellsAlongTheLongestSide) {
  // The egg is 16 long and 8 wide.
  // Bounds are found by a search that stops at 1e-12 of them.
  EXPECT_NEAR(number(figures("--solid egg --cells 32"), "cell"), 0.5, 1e-11);
  EXPECT_EQ(number(figures("--solid both --cells 10 --box 0,0,0,10,20,5"), "cell"), 2.0);
  const JsonValue both = figures("--solid both --cell 1");
  EXPECT_EQ(number(both, "components"), 2.0);
  EXPECT_EQ(number(both, "euler_characteristic"), 4.0);
}

TEST_F(MeshVerb, PrintsATableThatFitsATerminal) {
  const Outcome outcome = run("--cells 32 -o ball.vtp");
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_EQ(outcome.err, "");
  for (const char* words :
       {"scene.json: the solid \"ball\", 7 nodes\n", "live blocks ", "points evaluated ", "vertices ",
        "triangles ", "area ", " cm^2\n", "volume ", " cm^3\n", "Euler characteristic  2\n",
        "components            1\n", "distance error ", "wrote ball.vtp ("})
    EXPECT_THAT(outcome.out, HasSubstr(words));
  for (std::size_t at = 0, end = 0; end != std::string::npos; at = end + 1) {
    end = outcome.out.find('\n', at);
    EXPECT_LE(std::min(end, outcome.out.size()) - at, 80u) << outcome.out;
  }
}

TEST_F(MeshVerb, WritesEveryFormatAndWhereItCameFrom) {
  const Outcome outcome = run("--cells 16 -o a.vtp -o new/a.stl -o a.obj -o a.ply");
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_THAT(outcome.out, AllOf(HasSubstr("wrote a.vtp ("), HasSubstr("new/a.stl ("), HasSubstr("a.ply (")));
  const TriMesh mesh = read_mesh(folder_ / "a.vtp");
  EXPECT_EQ(mesh.name, "ball");
  const double cell = 8.0 / 16;
  EXPECT_TRUE(find_defects(mesh, cell).none());
  for (const char* file : {"new/a.stl", "a.obj", "a.ply"}) {
    const TriMesh other = read_mesh(folder_ / file);
    EXPECT_EQ(other.triangles.size(), mesh.triangles.size()) << file;
    EXPECT_EQ(other.points.size(), mesh.points.size()) << file;
  }
  EXPECT_EQ(read_mesh(folder_ / "a.ply").points, mesh.points);
  EXPECT_EQ(read_mesh(folder_ / "a.obj").normals, mesh.normals);
  EXPECT_THAT(content(folder_ / "a.obj"), HasSubstr("# scene scene ("));
  std::vector<std::string> columns, units;
  for (const Column& c : mesh.columns) {
    columns.push_back(c.name);
    units.push_back(c.unit);
  }
  EXPECT_THAT(columns, testing::ElementsAre("value", "distance_error", "mean_curvature", "gaussian_curvature",
                                            "member"));
  EXPECT_THAT(units, testing::ElementsAre("", "cm", "1/cm", "1/cm^2", ""));
  EXPECT_THAT(mesh.columns[4].labels, testing::ElementsAre("ball"));
  // Curvatures of a ball of radius 4, from second derivatives good to 1e-10 or better.
  for (const double k : mesh.columns[2].values) EXPECT_NEAR(k, 0.25, 1e-9);
  for (const double k : mesh.columns[3].values) EXPECT_NEAR(k, 0.0625, 1e-9);
}

TEST_F(MeshVerb, SaysThatTheBoxCutsTheSolid) {
  // Half of the ball, x < 0.
  const std::string box = "--cell 0.25 --box=-5,-5,-5,0,5,5 ";
  const Outcome closed = run(box + "-o closed.vtp"), open = run(box + "-o open.vtp --at-box open");
  EXPECT_EQ(closed.code + open.code, 0);
  EXPECT_THAT(closed.err, HasSubstr("warning: the box cuts the solid; it is closed there by flat faces\n"));
  EXPECT_THAT(open.err, HasSubstr("warning: the box cuts the solid; it is left open there\n"));
  EXPECT_THAT(closed.out, AllOf(HasSubstr("Euler characteristic  2\n"), HasSubstr(" cm^3\n")));
  EXPECT_THAT(open.out, AllOf(HasSubstr("Euler characteristic  1\n"), HasSubstr("the mesh is open")));
  EXPECT_TRUE(find_defects(read_mesh(folder_ / "closed.vtp"), 0.25).none());
  EXPECT_GT(find_defects(read_mesh(folder_ / "open.vtp"), 0.25).open_edges, 0u);
  EXPECT_THAT(run("--cells 16").err, IsEmpty());
}

TEST_F(MeshVerb, MeshesAnUnboundedSolidInABox) {
  const JsonValue report = figures("--solid wall --cell 0.5 --box=-2,-2,-2,2,2,2 --quiet");
  EXPECT_TRUE(*report.find("cut_by_box")->boolean());
  // |z| <= 1 in a box of 4 x 4: flat faces, met exactly.
  EXPECT_NEAR(number(report, "volume"), 32.0, 1e-9);
  EXPECT_NEAR(number(report, "area"), 2 * 16.0 + 4 * 8.0, 1e-9);
}

TEST_F(MeshVerb, WritesTheSameBytesAgainAndOnOneThread) {
  for (const char* name : {"a", "b", "c"})
    ASSERT_EQ(run(std::string("--solid both --cells 64 --quiet -o ") + name + ".vtp -o " + name + ".stl -o " +
                  name + ".obj -o " + name + ".ply " + (*name == 'c' ? "--threads 1" : ""))
                  .code,
              0);
  for (const char* extension : {".vtp", ".stl", ".obj", ".ply"})
    for (const char* name : {"b", "c"})
      EXPECT_TRUE(content(folder_ / (std::string("a") + extension)) ==
                  content(folder_ / (name + std::string(extension))))
          << name << extension;
  EXPECT_GT(content(folder_ / "a.vtp").size(), 10'000u);
}

TEST_F(MeshVerb, KeepsFilesThatExistUnlessForced) {
  write(folder_ / "a.stl", "mine");
  const Outcome refused = run("--cells 8 -o a.vtp -o a.stl");
  EXPECT_EQ(refused.code, 5);
  EXPECT_THAT(refused.err, AllOf(HasSubstr("a.stl: already exists"), HasSubstr("--force")));
  EXPECT_EQ(content(folder_ / "a.stl"), "mine");
  EXPECT_EQ(folder_.files().size(), 2u);
  EXPECT_EQ(run("--cells 8 -o a.vtp -o a.stl --force").code, 0);
  EXPECT_NE(content(folder_ / "a.stl"), "mine");
}

TEST_F(MeshVerb, LeavesNothingWhenTheDiskIsFull) {
  // A limit on the size of files acts like a full disk. Blocks of 512 bytes.
  const Outcome outcome = run("--cells 32 -o new/a.ply -o a.stl", "trap '' XFSZ; ulimit -f 16; exec");
  EXPECT_EQ(outcome.code, 5);
  EXPECT_THAT(outcome.err, AllOf(HasSubstr("new/a.ply: "), Not(HasSubstr("unfinished"))));
  EXPECT_THAT(folder_.files(), testing::ElementsAre("scene.json"));
  EXPECT_FALSE(fs::exists(folder_ / "new"));
}

TEST_F(MeshVerb, SaysWhyAPlaceCannotBeWritten) {
  write(folder_ / "file", "mine");
  fs::create_directory(folder_ / "folder.vtp");
  for (const char* place : {"file/a.vtp", "folder.vtp"}) {
    const Outcome outcome = run(std::string("--cells 8 --force -o ") + place);
    EXPECT_EQ(outcome.code, 5) << outcome.err;
    EXPECT_THAT(outcome.err, HasSubstr(std::string(place).substr(0, 4)));
  }
  EXPECT_THAT(folder_.files(), testing::UnorderedElementsAre("scene.json", "file"));
}

TEST_F(MeshVerb, ReadsASceneFromStandardInput) {
  const Outcome outcome = run_program("mesh - --cells 8 < " + quoted_path(folder_ / "scene.json"), "exec");
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_THAT(outcome.out, AllOf(HasSubstr("<stdin>: the solid \"ball\""), HasSubstr("nothing written")));
}

TEST_F(MeshVerb, IsQuietWhenAsked) {
  const Outcome outcome = run("--quiet --cells 8 --box=-5,-5,-5,0,5,5 -o a.stl");
  EXPECT_EQ(outcome.code, 0);
  EXPECT_EQ(outcome.out + outcome.err, "");
}

TEST_F(MeshVerb, DrawsAPictureWhereThereIsADisplay) {
  const Outcome outcome = run("--cells 24 -o ball.png -o ball.stl --colour mean_curvature");
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_THAT(folder_.files(), Contains("ball.stl"));
  if (outcome.err.find("pictures skipped") != std::string::npos) GTEST_SKIP() << outcome.err;
  EXPECT_EQ(content(folder_ / "ball.png").substr(1, 3), "PNG");
}

TEST_F(MeshVerb, MeshesASceneOfAHundredThousandNodes) {
  // A grid of balls of radius 1 that do not touch, each of three nodes.
  std::string nodes, names;
  constexpr int side = 33, count = side * side * side;
  for (int i = 0; i < count; ++i) {
    const std::string name = "\"" + std::to_string(i) + "\"";
    nodes +=
        name + R"(: { "kind": "place", "move": [)" + std::to_string(5 * (i % side)) + "," +
        std::to_string(5 * (i / side % side)) + "," + std::to_string(5 * (i / side / side)) +
        R"(], "of": { "kind": "soft_object", "distance": { "kind": "lp_metric", "a": 2, "b": 2, "c": 2, "n": 2 } } },
)";
    names += (i == 0 ? "" : ", ") + name;
  }
  write(folder_ / "scene.json", "{ \"nodes\": { " + nodes + R"("all": { "kind": "soft_blend", "of": [)" +
                                    names + "] } }, \"solid\": \"all\" }");
  const JsonValue report = figures("--cell 0.5 --box=-2,-2,-2,18,18,18");
  EXPECT_EQ(number(report, "nodes"), 3.0 * count + 1.0);
  EXPECT_EQ(number(report, "components"), 64.0);
  EXPECT_EQ(number(report, "euler_characteristic"), 128.0);
}

TEST_F(MeshVerb, StopsAtCtrlCAndLeavesNothing) {
  // The scene comes through a pipe that stays open, so the program waits until the signal is there.
  Running running({"mesh", "-", "--cells", "64", "-o", (folder_ / "out.vtp").string()}, scene,
                  folder_ / "err");
  ASSERT_TRUE(running.handles(SIGINT));
  running.send(SIGINT);
  EXPECT_EQ(running.finish(), 4);
  EXPECT_THAT(content(folder_ / "err"), HasSubstr("<stdin>: stopped while "));
  EXPECT_THAT(folder_.files(), testing::UnorderedElementsAre("scene.json", "err"));
}

TEST_F(MeshVerb, RunsToTheEndWhenNobodyStopsIt) {  // the negative control of the test above
  Running running({"mesh", "-", "--cells", "64", "-o", (folder_ / "out.vtp").string()}, scene,
                  folder_ / "err");
  ASSERT_TRUE(running.handles(SIGINT));
  EXPECT_EQ(running.finish(), 0) << content(folder_ / "err");
  EXPECT_THAT(folder_.files(), Contains("out.vtp"));
}

}  // namespace
}  // namespace blendwright::test
