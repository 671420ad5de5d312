#include "kernel/exchange/mesh_files.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <unistd.h>

#include <Eigen/Geometry>
#include <cmath>
#include <csignal>
#include <cstring>
#include <fstream>
#include <functional>
#include <limits>
#include <map>
#include <numbers>
#include <sstream>

#include "kernel/base/error.hpp"
#include "tests/exchange/scratch_folder.hpp"
#include "tests/support/for_all.hpp"

namespace blendwright {
namespace {

using test::Rng;
using test::ScratchFolder;
using test::uniform;

/// Torus of radii 2 and 1 with 3-D noise, so that every coordinate uses all its bits. Closed, Euler number 0.
TriMesh noisy_torus(Rng& rng, std::uint32_t nu = 12, std::uint32_t nv = 9) {
  TriMesh mesh;
  mesh.name = "noisy torus";
  Column curvature{"curvature jump", "1/mm", 1, {}}, offset{"offset", "", 3, {}};
  for (std::uint32_t i = 0; i < nu; ++i)
    for (std::uint32_t j = 0; j < nv; ++j) {
      const double u = 2.0 * std::numbers::pi * i / nu, v = 2.0 * std::numbers::pi * j / nv;
      const Vec3 n(std::cos(v) * std::cos(u), std::cos(v) * std::sin(u), std::sin(v));
      const Vec3 noise(uniform(rng, -0.1, 0.1), uniform(rng, -0.1, 0.1), uniform(rng, -0.1, 0.1));
      mesh.points.push_back(2.0 * Vec3(std::cos(u), std::sin(u), 0.0) + n + noise);
      mesh.normals.push_back(n);
      curvature.values.push_back(std::pow(10.0, uniform(rng, -300.0, 300.0)));
      for (int k = 0; k < 3; ++k) offset.values.push_back(noise[k]);
      const std::uint32_t i1 = (i + 1) % nu, j1 = (j + 1) % nv;
      mesh.triangles.push_back({i * nv + j, i1 * nv + j, i1 * nv + j1});
      mesh.triangles.push_back({i * nv + j, i1 * nv + j1, i * nv + j1});
    }
  mesh.columns = {curvature, offset};
  return mesh;
}

double area(const TriMesh& mesh) {
  double sum = 0.0;
  for (const auto& t : mesh.triangles)
    sum += 0.5 * (mesh.points[t[1]] - mesh.points[t[0]]).cross(mesh.points[t[2]] - mesh.points[t[0]]).norm();
  return sum;
}

/// Edges that do not join exactly two triangles of opposite direction.
std::size_t open_edges(const TriMesh& mesh) {
  std::map<std::pair<std::uint32_t, std::uint32_t>, int> uses;
  for (const auto& t : mesh.triangles)
    for (std::size_t k = 0; k < 3; ++k) ++uses[{t[k], t[(k + 1) % 3]}];
  std::size_t open = 0;
  for (const auto& [edge, count] : uses) {
    const auto back = uses.find({edge.second, edge.first});
    if (count != 1 || back == uses.end() || back->second != 1) ++open;
  }
  return open;
}

std::string bytes_of(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  std::ostringstream out;
  out << in.rdbuf();
  return out.str();
}

void expect_same_columns(const std::vector<Column>& a, const std::vector<Column>& b) {
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t c = 0; c < a.size(); ++c) {
    EXPECT_EQ(a[c].name, b[c].name);
    EXPECT_EQ(a[c].unit, b[c].unit);
    EXPECT_EQ(a[c].components, b[c].components);
    EXPECT_EQ(a[c].values, b[c].values);
  }
}

TEST(VtpFile, GivesBackEveryBitOfAMesh) {
  const ScratchFolder folder;
  test::for_all(
      [&](Rng& rng) {
        const TriMesh mesh = noisy_torus(rng);
        write_vtp(folder / "mesh.vtp", mesh);
        const TriMesh back = read_mesh(folder / "mesh.vtp");
        EXPECT_EQ(back.name, mesh.name);
        EXPECT_EQ(back.points, mesh.points);
        EXPECT_EQ(back.normals, mesh.normals);
        EXPECT_EQ(back.triangles, mesh.triangles);
        expect_same_columns(back.columns, mesh.columns);
      },
      20);
}

TEST(VtpFile, NamesArraysWithTheirUnitsAndKeepsFactsAndTheShownColumn) {
  const ScratchFolder folder;
  Rng rng(2);
  TriMesh mesh = noisy_torus(rng);
  const std::size_t n = mesh.points.size();
  mesh.columns = {{"u", "", 1, std::vector<double>(n, 0.5)},
                  {"gap", "mm", 1, std::vector<double>(n, 1e-9)},
                  {"angle_deg", "deg", 1, std::vector<double>(n, 2.0)}};
  mesh.note = "chord mode";
  mesh.facts = {{"fillet: tension", "", 1, {2.5}},
                {"fillet: factor from", "", 2, {0.0, 1.0, 0.5, 1.2}},
                {"fillet: worst gap from", "mm", 1, {3e-8}},
                {"<\"fillet\" & co>: mode", "", 1, {2.0}, {"origin", "anchor", "chord"}}};
  mesh.shown = "gap";
  write_vtp(folder / "a.vtp", mesh);
  const std::string text = bytes_of(folder / "a.vtp");
  for (const char* array : {"Name=\"u\"", "Name=\"gap [mm]\"", "Name=\"angle_deg\"", "Scalars=\"gap [mm]\"",
                            "Name=\"fillet: worst gap from [mm]\""})
    EXPECT_NE(text.find(array), std::string::npos) << array;
  const TriMesh back = read_mesh(folder / "a.vtp");
  expect_same_columns(back.columns, mesh.columns);
  expect_same_columns(back.facts, mesh.facts);
  EXPECT_EQ(back.facts.at(3).labels, mesh.facts[3].labels);
  EXPECT_EQ(back.shown, "gap");
  EXPECT_EQ(back.note, "chord mode");

  mesh.shown.clear();  // negative control: nothing is active unless asked for
  write_vtp(folder / "b.vtp", mesh);
  EXPECT_EQ(read_mesh(folder / "b.vtp").shown, "");

  const std::vector<PolyLine> lines{{"ring",
                                     {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}},
                                     true,
                                     {{"gap", "mm", 1, {1e-9, 2e-9, 3e-9}}},
                                     "note",
                                     mesh.facts,
                                     "gap"}};
  write_vtp(folder / "lines.vtp", lines);
  EXPECT_NE(bytes_of(folder / "lines.vtp").find("Scalars=\"gap [mm]\""), std::string::npos);
  const std::vector<PolyLine> read = read_polylines(folder / "lines.vtp");
  expect_same_columns(read.at(0).facts, mesh.facts);
  EXPECT_EQ(read.at(0).note, "note");

  mesh.facts[1].values.pop_back();
  EXPECT_THROW(write_vtp(folder / "c.vtp", mesh), InputError);
  EXPECT_FALSE(std::filesystem::exists(folder / "c.vtp"));
}

TEST(VtpFile, IsTheSameBytesTwice) {
  const ScratchFolder folder;
  Rng rng(1);
  const TriMesh mesh = noisy_torus(rng);
  write_vtp(folder / "a.vtp", mesh);
  write_vtp(folder / "b.vtp", mesh);
  EXPECT_GT(bytes_of(folder / "a.vtp").size(), 1000u);
  EXPECT_EQ(bytes_of(folder / "a.vtp"), bytes_of(folder / "b.vtp"));

  TriMesh other = mesh;  // negative control: the last bit of one coordinate shows
  other.points[3].x() = std::nextafter(other.points[3].x(), 10.0);
  write_vtp(folder / "b.vtp", other);
  EXPECT_NE(bytes_of(folder / "a.vtp"), bytes_of(folder / "b.vtp"));
}

TEST(VtpFile, KeepsLinesClosedOrOpenWithTheirColumns) {
  const ScratchFolder folder;
  const std::vector<PolyLine> lines{
      {"ring", {{0, 0, 0}, {1, 0, 0}, {1, 1, 1e-17}}, true, {{"gap", "mm", 1, {1e-9, 2e-9, 1.0 / 3.0}}}},
      {"strut",
       {{5, 0, 0}, {6, 0, 0}},
       false,
       {{"gap", "mm", 1, {0.0, 7.0}}, {"angle", "deg", 1, {1.0, 2.0}}}}};
  write_vtp(folder / "lines.vtp", lines);
  const std::vector<PolyLine> back = read_polylines(folder / "lines.vtp");
  ASSERT_EQ(back.size(), lines.size());
  for (std::size_t i = 0; i < lines.size(); ++i) {
    EXPECT_EQ(back[i].name, lines[i].name);
    EXPECT_EQ(back[i].points, lines[i].points);
    EXPECT_EQ(back[i].closed, lines[i].closed);
    EXPECT_EQ(back[i].columns.at(0).values, lines[i].columns.at(0).values);
    EXPECT_EQ(back[i].columns.at(0).unit, "mm");
  }
  EXPECT_EQ(back[1].columns.at(1).values, lines[1].columns.at(1).values);
  for (const double missing : back[0].columns.at(1).values) EXPECT_TRUE(std::isnan(missing));
}

TEST(StlFile, HoldsEveryTriangleAndTheArea) {
  const ScratchFolder folder;
  test::for_all(
      [&](Rng& rng) {
        std::vector<TriMesh> meshes{noisy_torus(rng), noisy_torus(rng, 20, 5)};
        for (Vec3& p : meshes[1].points) p.x() += 10.0;
        write_stl(folder / "a.stl", meshes);
        const std::size_t triangles = meshes[0].triangles.size() + meshes[1].triangles.size();
        EXPECT_EQ(std::filesystem::file_size(folder / "a.stl"), 84 + 50 * triangles);
        const TriMesh back = read_mesh(folder / "a.stl");
        EXPECT_EQ(back.triangles.size(), triangles);
        EXPECT_EQ(back.points.size(), meshes[0].points.size() + meshes[1].points.size());
        EXPECT_EQ(open_edges(back), 0u);
        // Each coordinate (|x| < 14) moves by at most half a float step, 14 * 2^-24; a point by sqrt(3) of
        // that, d. A triangle's area changes by at most d * (its perimeter), and perimeters here are below 6.
        const double d = std::sqrt(3.0) * 14.0 * 0x1p-24;
        EXPECT_NEAR(area(back), area(meshes[0]) + area(meshes[1]), 6.0 * d * static_cast<double>(triangles));
      },
      20);
}

TEST(StlFile, ShowsAMissingTriangleAsOpenEdges) {
  const ScratchFolder folder;
  Rng rng(7);
  TriMesh mesh = noisy_torus(rng);
  mesh.triangles.pop_back();
  write_stl(folder / "hole.stl", std::vector{mesh});
  EXPECT_EQ(open_edges(read_mesh(folder / "hole.stl")), 3u);
}

TEST(StlFile, StoresUnitNormalsByTheRightHandRule) {
  const ScratchFolder folder;
  TriMesh mesh;
  mesh.points = {{0, 0, 0}, {2, 0, 0}, {0, 3, 0}, {4, 0, 0}};
  mesh.triangles = {{0, 1, 2}, {0, 2, 1}, {0, 1, 3}};  // up, down, without area
  write_stl(folder / "a.stl", std::vector{mesh});
  const std::string bytes = bytes_of(folder / "a.stl");
  const auto normal = [&](std::size_t t) {
    std::array<float, 3> n{};
    std::memcpy(n.data(), bytes.data() + 84 + 50 * t, sizeof n);
    return n;
  };
  EXPECT_EQ(normal(0), (std::array<float, 3>{0, 0, 1}));
  EXPECT_EQ(normal(1), (std::array<float, 3>{0, 0, -1}));
  EXPECT_EQ(normal(2), (std::array<float, 3>{0, 0, 0}));
}

TEST(ObjFile, GivesBackPointsAndNormalsOfAllGroups) {
  const ScratchFolder folder;
  Rng rng(3);
  const std::vector<TriMesh> meshes{noisy_torus(rng), noisy_torus(rng, 7, 5)};
  write_obj(folder / "a.obj", meshes);
  const TriMesh back = read_mesh(folder / "a.obj");
  const std::size_t first = meshes[0].points.size();
  ASSERT_EQ(back.points.size(), first + meshes[1].points.size());
  ASSERT_EQ(back.normals.size(), back.points.size());
  for (std::size_t i = 0; i < meshes[1].points.size(); ++i) {
    EXPECT_EQ(back.points[first + i], meshes[1].points[i]);
    EXPECT_EQ(back.normals[first + i], meshes[1].normals[i]);
  }
  EXPECT_EQ(open_edges(back), 0u);
  EXPECT_THAT(bytes_of(folder / "a.obj"), testing::HasSubstr("\ng noisy_torus\n"));
}

TEST(ObjFile, MayMixMeshesWithAndWithoutNormals) {
  const ScratchFolder folder;
  Rng rng(4);
  std::vector<TriMesh> meshes{noisy_torus(rng), noisy_torus(rng), noisy_torus(rng)};
  meshes[1].normals.clear();
  write_obj(folder / "a.obj", meshes);
  const TriMesh back = read_mesh(folder / "a.obj");
  EXPECT_EQ(back.triangles.size(), 3 * meshes[0].triangles.size());
  EXPECT_TRUE(back.normals.empty());
  const std::size_t third = 2 * meshes[0].points.size(), normals = meshes[0].points.size();
  const std::string first_corner =
      "f " + std::to_string(third + 1) + "//" + std::to_string(normals + 1) + " ";
  EXPECT_THAT(bytes_of(folder / "a.obj"), testing::HasSubstr(first_corner));
}

using Writer = void (*)(const std::filesystem::path&, const TriMesh&);
struct NamedWriter {
  const char* extension;
  Writer write;
  std::string (*damage)(const std::string& bytes);
};
void PrintTo(const NamedWriter& row, std::ostream* out) { *out << row.extension; }
std::string first_half(const std::string& bytes) { return bytes.substr(0, bytes.size() / 2); }
const NamedWriter writers[] = {
    {".vtp", [](const auto& file, const TriMesh& mesh) { write_vtp(file, mesh); }, first_half},
    {".stl", [](const auto& file, const TriMesh& mesh) { write_stl(file, std::vector{mesh}); }, first_half},
    {".obj", [](const auto& file, const TriMesh& mesh) { write_obj(file, std::vector{mesh}); },
     [](const std::string& bytes) { return bytes + "f 1 2 999999\n"; }},
    {".ply", [](const auto& file, const TriMesh& mesh) { write_ply(file, mesh); }, first_half},
};

class MeshWriter : public testing::TestWithParam<NamedWriter> {};
INSTANTIATE_TEST_SUITE_P(Formats, MeshWriter, testing::ValuesIn(writers),
                         [](const auto& row) { return std::string(row.param.extension + 1); });

TEST_P(MeshWriter, NamesAFolderThatIsMissingAndAParentThatIsAFile) {
  const ScratchFolder folder;
  Rng rng(5);
  const TriMesh mesh = noisy_torus(rng);
  const std::string name = std::string("a") + GetParam().extension;
  std::ofstream(folder / "file") << "not a folder";
  for (const char* parent : {"missing", "file"}) {
    const std::filesystem::path target = folder / parent / name;
    try {
      GetParam().write(target, mesh);
      ADD_FAILURE() << "wrote " << target;
    } catch (const IoError& e) {
      EXPECT_THAT(e.what(), testing::StartsWith(target.string() + ": "));
    }
  }
  EXPECT_EQ(folder.entries(), std::vector<std::string>{"file"});
  GetParam().write(folder / name,
                   mesh);  // negative control: the same call succeeds in a folder that is there
  EXPECT_EQ(folder.entries(), (std::vector<std::string>{name, "file"}));
}

/// A write beyond the limit fails as it does on a full disk.
class FileSizeLimit {
 public:
  explicit FileSizeLimit(rlim_t bytes) : handler_(std::signal(SIGXFSZ, SIG_IGN)) {
    getrlimit(RLIMIT_FSIZE, &before_);
    const rlimit limited{bytes, before_.rlim_max};
    setrlimit(RLIMIT_FSIZE, &limited);
  }
  ~FileSizeLimit() {
    setrlimit(RLIMIT_FSIZE, &before_);
    std::signal(SIGXFSZ, handler_);
  }
  FileSizeLimit(const FileSizeLimit&) = delete;
  FileSizeLimit& operator=(const FileSizeLimit&) = delete;

 private:
  rlimit before_{};
  void (*handler_)(int);
};

TEST_P(MeshWriter, KeepsTheOldFileWhenTheDiskIsFull) {
  const ScratchFolder folder;
  Rng rng(6);
  const TriMesh mesh = noisy_torus(rng);
  const std::string name = std::string("a") + GetParam().extension;
  GetParam().write(folder / name, mesh);
  const std::string before = bytes_of(folder / name);
  const TriMesh larger = noisy_torus(rng, 40, 40);
  {
    const FileSizeLimit limit(512);
    EXPECT_THROW(GetParam().write(folder / name, larger), IoError);
  }
  EXPECT_EQ(folder.entries(), std::vector<std::string>{name});
  EXPECT_EQ(bytes_of(folder / name), before);
  GetParam().write(folder / name, larger);  // negative control
  EXPECT_NE(bytes_of(folder / name), before);
}

TEST_P(MeshWriter, RefusesMeshesThatContradictThemselves) {
  const ScratchFolder folder;
  const std::string name = std::string("a") + GetParam().extension;
  const std::function<void(TriMesh&)> faults[] = {
      [](TriMesh& m) { m.triangles[2][1] = static_cast<std::uint32_t>(m.points.size()); },
      [](TriMesh& m) { m.normals.pop_back(); },
      [](TriMesh& m) { m.points[4].y() = std::numeric_limits<double>::quiet_NaN(); },
      [](TriMesh& m) { m.columns[1].values.pop_back(); },
      [](TriMesh& m) { m.columns[0].components = 0; },
      [](TriMesh& m) { m.columns[0].name.clear(); },
  };
  for (const auto& fault : faults) {
    Rng rng(8);
    TriMesh mesh = noisy_torus(rng);
    fault(mesh);
    EXPECT_THROW(GetParam().write(folder / name, mesh), InputError);
  }
  EXPECT_TRUE(folder.entries().empty());
}

TEST_P(MeshWriter, WritesAnEmptyMesh) {
  const ScratchFolder folder;
  const std::filesystem::path file = folder / (std::string("a") + GetParam().extension);
  GetParam().write(file, TriMesh{});
  EXPECT_TRUE(read_mesh(file).triangles.empty());
}

TEST_P(MeshWriter, ItsReaderSaysWhatIsWrongWithADamagedFile) {
  const ScratchFolder folder;
  Rng rng(9);
  const std::filesystem::path file = folder / (std::string("a") + GetParam().extension);
  EXPECT_THROW((void)read_mesh(file), IoError);  // not there yet
  GetParam().write(file, noisy_torus(rng));
  EXPECT_NO_THROW((void)read_mesh(file));
  const std::string bytes = bytes_of(file);
  std::ofstream(file, std::ios::binary | std::ios::trunc) << GetParam().damage(bytes);
  testing::internal::CaptureStderr();
  EXPECT_THROW((void)read_mesh(file), IoError);
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
}

TEST(PolyLineFile, RefusesALineOfOnePoint) {
  const ScratchFolder folder;
  const std::vector<PolyLine> lines{{"dot", {{0, 0, 0}}, false, {}}};
  EXPECT_THROW(write_vtp(folder / "a.vtp", lines), InputError);
  EXPECT_TRUE(folder.entries().empty());
}

TEST(ReadMesh, RefusesAnUnknownExtension) { EXPECT_THROW((void)read_mesh("part.gltf"), IoError); }

}  // namespace
}  // namespace blendwright
