// Files of which bytes, lines or references were lost: read, or refused with a message, and never a crash.
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cmath>
#include <cstdlib>
#include <fstream>
#include <iterator>

#include "kernel/base/error.hpp"
#include "kernel/brep/step_part.hpp"
#include "kernel/exchange/box_cells.hpp"
#include "kernel/exchange/mesh_files.hpp"
#include "kernel/exchange/step_file.hpp"
#include "tests/exchange/joints.hpp"
#include "tests/exchange/scratch_folder.hpp"
#include "tests/support/for_all.hpp"

namespace blendwright::test {
namespace {

enum Ending { read_well = 0, refused = 1, other_exception = 2 };

/// In a child of its own: a crash must be seen, not met. 128 + signal when there was one.
template <class Read>
int ending(Read read) {
  const pid_t child = ::fork();
  if (child == 0) {
    ::alarm(30);
    try {
      read();
      ::_exit(read_well);
    } catch (const Error&) {
      ::_exit(refused);
    } catch (...) {
      ::_exit(other_exception);
    }
  }
  int status = 0;
  ::waitpid(child, &status, 0);
  return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
}

std::size_t place(Rng& rng, std::size_t from, std::size_t to) { return from + rng.next() % (to - from); }

/// "#123" at a random place from `from` on: where, and how long.
std::pair<std::size_t, std::size_t> reference(const std::string& text, std::size_t from, Rng& rng) {
  std::size_t at = text.find('#', place(rng, from, text.size()));
  if (at == std::string::npos) at = text.find('#', from);
  std::size_t end = at + 1;
  while (end < text.size() && std::isdigit(static_cast<unsigned char>(text[end])) != 0) ++end;
  return {at, end - at};
}

/// Damages what comes after byte `from`.
std::string damaged(std::string text, std::size_t from, bool references, Rng& rng) {
  switch (integer(rng, 0, references ? 5 : 2)) {
    case 0:
      for (int k = 0; k < 3; ++k)
        text[place(rng, from, text.size())] = static_cast<char>(integer(rng, 0, 255));
      return text;
    case 1: {
      const std::size_t at = place(rng, from, text.size()), end = text.find('\n', at);
      return text.erase(at, end == std::string::npos ? end : end - at);
    }
    case 2:
      text.resize(place(rng, from, text.size()));
      return text;
    case 3: {
      const auto [at, length] = reference(text, from, rng);
      return text.replace(at, length, "#999999");
    }
    case 4: {
      const auto [at, length] = reference(text, from, rng);
      return text.replace(at, length, "#99999999999");
    }
    default: {
      const auto [at, length] = reference(text, from, rng);
      const auto [other, other_length] = reference(text, from, rng);
      const std::string wrong = text.substr(other, other_length);
      return text.replace(at, length, wrong);
    }
  }
}

std::string content(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

void write(const std::filesystem::path& file, const std::string& text) {
  std::ofstream(file, std::ios::binary) << text;
}

TEST(DamagedFile, OfStepIsReadOrRefusedAndNeverACrash) {
  const ScratchFolder folder;
  const auto sound = folder / "sound.step", file = folder / "damaged.step";
  write_step(sound, assemble(coaxial(0.3), 1e-6).shape, {StepSchema::AP242, LengthUnit::millimetre, "joint"});
  const std::string text = content(sound);
  const std::size_t data = text.find("DATA;");
  ASSERT_NE(data, std::string::npos);
  int refusals = 0, all = 0;
  for_all(
      [&](Rng& rng) {
        write(file, damaged(text, data, true, rng));
        for (const bool part : {false, true}) {
          const int end = ending([&] {
            if (part)
              (void)StepPart::read(file, LengthUnit::millimetre);
            else
              (void)read_step(file, LengthUnit::millimetre);
          });
          EXPECT_LE(end, refused) << (part ? "as a part" : "as a result");
          refusals += end == refused;
          ++all;
        }
      },
      60);
  EXPECT_GT(refusals, all / 4);  // they are damaged
  EXPECT_EQ(ending([&] { (void)read_step(sound, LengthUnit::millimetre); }), read_well);
  EXPECT_EQ(ending([&] { (void)StepPart::read(sound, LengthUnit::millimetre); }), read_well);
}

TEST(DamagedFile, OfStepIsNamedWithItsFirstBrokenEntity) {
  const ScratchFolder folder;
  const auto file = folder / "joint.step";
  write_step(file, assemble(coaxial(0.3), 1e-6).shape, {StepSchema::AP242, LengthUnit::millimetre, "joint"});
  std::string text = content(file);
  const std::size_t vertex = text.find("VERTEX_POINT('',#");
  ASSERT_NE(vertex, std::string::npos);
  text.replace(vertex + 16, text.find(')', vertex) - vertex - 16, "#999999");
  write(file, text);
  try {
    (void)read_step(file, LengthUnit::millimetre);
    FAIL();
  } catch (const IoError& e) {
    EXPECT_NE(std::string(e.what()).find("is damaged: 1 entity cannot be read, #"), std::string::npos)
        << e.what();
  }
}

/// Every format that meshes and cells are written in.
TEST(DamagedFile, OfAMeshIsReadOrRefusedAndNeverACrash) {
  const ScratchFolder folder;
  TriMesh mesh;
  for (int i = 0; i < 12; ++i) {
    const double t = 0.5 * i;
    mesh.points.emplace_back(std::cos(t), std::sin(t), 0.1 * i);
    mesh.normals.push_back(Vec3(std::sin(t), 0.3, std::cos(t)).normalized());
    if (i > 1)
      mesh.triangles.push_back({static_cast<std::uint32_t>(i - 2), static_cast<std::uint32_t>(i - 1),
                                static_cast<std::uint32_t>(i)});
  }
  mesh.name = "strip";
  write_vtp(folder / "m.vtp", mesh);
  write_stl(folder / "m.stl", std::span(&mesh, 1));
  write_obj(folder / "m.obj", std::span(&mesh, 1));
  write_ply(folder / "m.ply", mesh);
  write_vtu(folder / "m.vtu",
            BoxCells{.name = "cells", .boxes = {{Vec3(0, 0, 0), Vec3(1, 1, 1)}}, .columns = {}});
  int refusals = 0;
  for (const std::string end : {".vtp", ".stl", ".obj", ".ply", ".vtu"}) {
    const std::string text = content(folder / ("m" + end));
    const auto file = folder / ("damaged" + end);
    for_all(
        [&](Rng& rng) {
          write(file, damaged(text, 0, false, rng));
          const int how = ending([&] {
            if (end == ".vtu")
              (void)read_vtu(file);
            else
              (void)read_mesh(file);
          });
          EXPECT_LE(how, refused) << end;
          refusals += how == refused;
        },
        40);
  }
  EXPECT_GT(refusals, 40);
}

}  // namespace
}  // namespace blendwright::test
