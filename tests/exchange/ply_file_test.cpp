// PLY files: everything comes back to the last bit, and files of other programs are read or refused by name.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdint>
#include <cstring>
#include <fstream>
#include <limits>

#include "kernel/base/error.hpp"
#include "kernel/exchange/mesh_files.hpp"
#include "tests/exchange/scratch_folder.hpp"
#include "tests/support/for_all.hpp"

namespace blendwright {
namespace {

using test::Rng;
using test::ScratchFolder;
using test::uniform;

TriMesh random_mesh(Rng& rng) {
  TriMesh mesh;
  mesh.name = "random";
  mesh.note = "made from\nrandom numbers";
  Column bend{"mean curvature", "1/mm", 1, {}}, offset{"offset", "mm", 3, {}}, name{"x", "", 1, {}};
  for (std::uint32_t i = 0; i < 30; ++i) {
    mesh.points.push_back({uniform(rng, -1, 1), uniform(rng, -1, 1), uniform(rng, -1e300, 1e300)});
    mesh.normals.push_back(Vec3(uniform(rng, -1, 1), uniform(rng, -1, 1), 1.0).normalized());
    bend.values.push_back(uniform(rng, -1, 1));
    name.values.push_back(uniform(rng, -1, 1));
    for (int k = 0; k < 3; ++k) offset.values.push_back(uniform(rng, -1, 1));
    if (i >= 2) mesh.triangles.push_back({i - 2, i - 1, i});
  }
  mesh.columns = {bend, offset, name};
  return mesh;
}

TEST(PlyFile, GivesBackEveryBitOfAMesh) {
  const ScratchFolder folder;
  test::for_all(
      [&](Rng& rng) {
        const TriMesh mesh = random_mesh(rng);
        write_ply(folder / "random.ply", mesh);
        const TriMesh back = read_mesh(folder / "random.ply");
        EXPECT_EQ(back.points, mesh.points);
        EXPECT_EQ(back.normals, mesh.normals);
        EXPECT_EQ(back.triangles, mesh.triangles);
        ASSERT_EQ(back.columns.size(), 5u);  // a vector becomes three numbers
        EXPECT_EQ(back.columns[0].name, "mean_curvature");
        EXPECT_EQ(back.columns[0].values, mesh.columns[0].values);
        EXPECT_EQ(back.columns[1].name, "offset_0");
        EXPECT_EQ(back.columns[2].values[7], mesh.columns[1].values[3 * 7 + 1]);
        EXPECT_EQ(back.columns[4].name, "x_");  // x is a coordinate
        EXPECT_EQ(back.columns[4].values, mesh.columns[2].values);
      },
      20);
}

void write_bytes(const std::filesystem::path& file, const std::string& bytes) {
  std::ofstream(file, std::ios::binary) << bytes;
}
template <class T>
std::string bytes_of(T value) {
  std::string bytes(sizeof value, '\0');
  std::memcpy(bytes.data(), &value, sizeof value);
  return bytes;
}

/// One triangle as other programs write it: floats, colours, int indices; `change` breaks it.
std::string foreign(const std::string& from = "", const std::string& to = "") {
  std::string text =
      "ply\nformat binary_little_endian 1.0\nobj_info by hand\nelement vertex 3\nproperty float x\n"
      "property float y\nproperty float z\nproperty uchar red\nelement face 1\n"
      "property list uchar int vertex_index\nproperty short group\nend_header\n";
  const float points[3][3] = {{0.f, 0.f, 0.f}, {1.f, 0.f, 0.f}, {0.f, 1.f, 0.5f}};
  for (std::uint8_t i = 0; i < 3; ++i) {
    for (const float x : points[i]) text += bytes_of(x);
    text += bytes_of(static_cast<std::uint8_t>(10 + i));
  }
  text += bytes_of(std::uint8_t{3}) + bytes_of(std::int32_t{0}) + bytes_of(std::int32_t{1}) +
          bytes_of(std::int32_t{2}) + bytes_of(std::int16_t{7});
  if (!from.empty()) text.replace(text.find(from), from.size(), to);
  return text;
}

TEST(PlyFile, ReadsFloatsColoursAndForeignProperties) {
  const ScratchFolder folder;
  write_bytes(folder / "a.ply", foreign());
  const TriMesh mesh = read_mesh(folder / "a.ply");
  EXPECT_EQ(mesh.points, (std::vector<Vec3>{{0, 0, 0}, {1, 0, 0}, {0, 1, 0.5}}));
  EXPECT_EQ(mesh.triangles, (std::vector<std::array<std::uint32_t, 3>>{{0, 1, 2}}));
  EXPECT_EQ(mesh.columns.at(0).values, (std::vector<double>{10, 11, 12}));
  EXPECT_TRUE(mesh.normals.empty());
}

TEST(PlyFile, SaysWhatItCannotRead) {
  const ScratchFolder folder;
  const struct {
    std::string bytes, words;
  } broken[] = {
      {"ply\nformat ascii 1.0\n", "not a binary little-endian PLY"},
      {"solid", "not a binary little-endian PLY"},
      {foreign("end_header", "end_haeder"), "is not understood"},
      {foreign("float z", "float w"), "have no x, y, z"},
      {foreign("float x", "quad x"), "type \"quad\""},
      {foreign("element face", "element edge"), "element \"edge\""},
      {foreign("vertex 3", "vertex 9"), "ends too early"},
      {foreign("vertex 3", "vertex 99999999999"), "cannot hold"},
      {foreign("vertex 3", "vertex -1"), "cannot hold"},
      {foreign() + "x", "1 bytes follow"},
      {foreign(bytes_of(std::int32_t{2}) + bytes_of(std::int16_t{7}),
               bytes_of(std::int32_t{3}) + bytes_of(std::int16_t{7})),
       "names no vertex"},
      {foreign(bytes_of(std::uint8_t{3}) + bytes_of(std::int32_t{0}),
               bytes_of(std::uint8_t{4}) + bytes_of(std::int32_t{0})),
       "has 4 corners"},
      {foreign(bytes_of(0.5f), bytes_of(std::numeric_limits<float>::quiet_NaN())), "vertex 2 is not finite"}};
  for (const auto& [bytes, words] : broken) {
    SCOPED_TRACE(words);
    write_bytes(folder / "a.ply", bytes);
    try {
      static_cast<void>(read_mesh(folder / "a.ply"));
      ADD_FAILURE() << "was read";
    } catch (const IoError& e) {
      EXPECT_THAT(e.what(), testing::HasSubstr(words));
    }
  }
}

}  // namespace
}  // namespace blendwright
