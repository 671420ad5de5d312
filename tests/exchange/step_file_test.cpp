// What a user receives: the STEP file, read back.
#include <gtest/gtest.h>
#include <sys/resource.h>

#include <BRep_Builder.hxx>
#include <TopoDS_Shell.hxx>
#include <array>
#include <csignal>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <thread>

#include "kernel/base/error.hpp"
#include "kernel/brep/shape_impl.hpp"
#include "kernel/exchange/step_file.hpp"
#include "tests/exchange/joints.hpp"
#include "tests/exchange/scratch_folder.hpp"
#include "tests/support/for_all.hpp"

namespace blendwright::test {
namespace {

constexpr double tolerance = 1e-6;

std::string bytes_of(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
}

const StepFace& face_named(const StepContent& content, const std::string& name) {
  for (const StepFace& f : content.faces)
    if (f.name == name) return f;
  throw std::runtime_error("no face " + name);
}

class StepFile : public ::testing::Test {
 protected:
  void SetUp() override { setenv("SOURCE_DATE_EPOCH", "1700000000", 1); }
  void TearDown() override { unsetenv("SOURCE_DATE_EPOCH"); }
  ScratchFolder folder_;
};

TEST_F(StepFile, ClosedBlendComesBackSoundInEverySchemaAndUnit) {
  const Assembly assembly = coaxial(0.3);
  const Shape shape = assemble(assembly, tolerance).shape;
  for (const StepSchema schema : {StepSchema::AP214, StepSchema::AP242})
    for (const LengthUnit unit :
         {LengthUnit::millimetre, LengthUnit::centimetre, LengthUnit::metre, LengthUnit::inch}) {
      SCOPED_TRACE(std::string(name(schema)) + " " + name(unit));
      write_step(folder_ / "joint.step", shape, {schema, unit, "joint"});
      const StepContent c = read_step(folder_ / "joint.step", unit);
      EXPECT_TRUE(c.check.valid) << ::testing::PrintToString(c.check.problems);
      EXPECT_LE(c.check.largest_tolerance, tolerance);
      EXPECT_EQ(c.check.faces, 3u);
      EXPECT_EQ(c.check.free_edges, 2u);
      EXPECT_EQ(c.check.unexpected_free_edges, 0u);
      EXPECT_NEAR(c.check.area, coaxial_area, 1e-5 * coaxial_area);
      EXPECT_EQ(c.unit, name(unit));
      EXPECT_NE(c.schema.find(schema == StepSchema::AP214 ? "AUTOMOTIVE_DESIGN" : "AP242"), std::string::npos)
          << c.schema;
    }
}

TEST_F(StepFile, IsConvertedToTheUnitThatIsAskedFor) {
  write_step(folder_ / "joint.step", assemble(coaxial(), tolerance).shape,
             {StepSchema::AP242, LengthUnit::inch, "joint"});
  const StepContent c = read_step(folder_ / "joint.step", LengthUnit::millimetre);
  EXPECT_NEAR(c.check.area, coaxial_area * 25.4 * 25.4, 1e-5 * coaxial_area * 25.4 * 25.4);
}

TEST_F(StepFile, BlendKeepsItsParametersAndPoints) {
  const Assembly assembly = coaxial(0.3);
  write_step(folder_ / "joint.step", assemble(assembly, tolerance).shape, {});
  const StepContent c = read_step(folder_ / "joint.step");
  const Surface& back = face_named(c, "blend").surface;
  ASSERT_TRUE(back.target<BSplineSurface>());
  EXPECT_TRUE(back.domain().v_closed);
  const BSplineSurface& ours = assembly.blends[0].surface;
  for_all([&](Rng& rng) {
    const UV p{uniform(rng, 0.0, 1.0), uniform(rng, 0.0, 2.0 * pi)};
    const SurfaceJet a = ours.jet(p), b = back.jet(p);
    // The file keeps 15 digits of coordinates up to 10; second derivatives divide by spans of about 0.1
    // twice.
    EXPECT_LE((a.S - b.S).norm(), 1e-12);
    EXPECT_LE((a.Svv - b.Svv).norm(), 1e-9);
  });
}

TEST_F(StepFile, NamesAndColoursSurvive) {
  Assembly assembly = coaxial();
  assembly.blends[0].colour = {0.9, 0.1, 0.2};
  write_step(folder_ / "joint.step", assemble(assembly, tolerance).shape, {});
  const StepContent c = read_step(folder_ / "joint.step");
  ASSERT_EQ(c.faces.size(), 3u);
  const StepFace& blend = face_named(c, "blend");
  ASSERT_TRUE(blend.colour);
  // Colours are kept as linear single precision numbers.
  EXPECT_NEAR(blend.colour->r, 0.9, 1e-3);
  EXPECT_NEAR(blend.colour->g, 0.1, 1e-3);
  EXPECT_NEAR(blend.colour->b, 0.2, 1e-3);
  ASSERT_TRUE(face_named(c, "upper").colour);
  EXPECT_NEAR(face_named(c, "upper").colour->g, assembly.primaries[0].colour.g, 1e-3);
  EXPECT_GT(blend.control_points, 0u);
  EXPECT_EQ(face_named(c, "lower").control_points, 0u);
}

TEST_F(StepFile, ElementaryPrimariesStayElementary) {
  write_step(folder_ / "joint.step", assemble(coaxial(), tolerance).shape, {});
  const std::string text = bytes_of(folder_ / "joint.step");
  EXPECT_NE(text.find("CYLINDRICAL_SURFACE"), std::string::npos);
  EXPECT_EQ(text.find("FACETED"), std::string::npos);
}

TEST_F(StepFile, TwoRunsGiveTheSameBytes) {
  const Shape shape = assemble(coaxial(), tolerance).shape;
  std::filesystem::create_directory(folder_ / "a");
  std::filesystem::create_directory(folder_ / "b");
  write_step(folder_ / "a/joint.step", shape, {});
  write_step(folder_ / "b/joint.step", shape, {});
  const std::string a = bytes_of(folder_ / "a/joint.step"), b = bytes_of(folder_ / "b/joint.step");
  EXPECT_EQ(a, b);
  EXPECT_NE(a.find("2023-11-14T22:13:20"), std::string::npos);
  setenv("SOURCE_DATE_EPOCH", "1700000001", 1);
  write_step(folder_ / "b/joint.step", shape, {});
  EXPECT_NE(a, bytes_of(folder_ / "b/joint.step"));
}

TEST_F(StepFile, SeveralThreadsMayWriteAndRead) {
  const Shape shape = assemble(coaxial(), tolerance).shape;
  std::vector<std::thread> threads;
  std::array<StepContent, 4> read;
  for (std::size_t i = 0; i < read.size(); ++i)
    threads.emplace_back([&, i] {
      const auto file = folder_ / (std::to_string(i) + ".step");
      const LengthUnit unit = i % 2 ? LengthUnit::inch : LengthUnit::metre;
      write_step(file, shape, {StepSchema::AP242, unit, "joint"});
      read[i] = read_step(file, unit);
    });
  for (std::thread& t : threads) t.join();
  for (const StepContent& c : read) {
    EXPECT_TRUE(c.check.valid);
    EXPECT_NEAR(c.check.area, coaxial_area, 1e-5 * coaxial_area);
  }
}

TEST_F(StepFile, LeavesNothingWhereItCannotWrite) {
  const Shape shape = assemble(coaxial(), tolerance).shape;
  EXPECT_THROW(write_step(folder_ / "missing/joint.step", shape, {}), IoError);
  std::ofstream(folder_ / "file") << "text";
  EXPECT_THROW(write_step(folder_ / "file/joint.step", shape, {}), IoError);
  EXPECT_EQ(folder_.entries(), std::vector<std::string>{"file"});
}

/// While it lives, no file of this process grows beyond `bytes`: what a full disk looks like to a writer.
class FileSizeLimit {
 public:
  explicit FileSizeLimit(rlim_t bytes) {
    getrlimit(RLIMIT_FSIZE, &previous_);
    handler_ = std::signal(SIGXFSZ, SIG_IGN);
    const rlimit limit{bytes, previous_.rlim_max};
    setrlimit(RLIMIT_FSIZE, &limit);
  }
  ~FileSizeLimit() {
    setrlimit(RLIMIT_FSIZE, &previous_);
    std::signal(SIGXFSZ, handler_);
  }

 private:
  rlimit previous_{};
  void (*handler_)(int);
};

TEST_F(StepFile, FullDiskLeavesNothing) {
  const Shape shape = assemble(coaxial(), tolerance).shape;
  {
    const FileSizeLimit full(16384);
    EXPECT_THROW(write_step(folder_ / "joint.step", shape, {}), IoError);
  }
  EXPECT_TRUE(folder_.entries().empty());
  write_step(folder_ / "joint.step", shape, {});
  EXPECT_GT(bytes_of(folder_ / "joint.step").size(), 16384u);
}

TEST_F(StepFile, WhatIsNoStepFileIsRefused) {
  std::ofstream(folder_ / "text.step") << "no STEP at all";
  std::ofstream(folder_ / "empty.step");
  EXPECT_THROW((void)read_step(folder_ / "text.step"), IoError);
  EXPECT_THROW((void)read_step(folder_ / "empty.step"), IoError);
  EXPECT_THROW((void)read_step(folder_ / "none.step"), IoError);
}

TEST_F(StepFile, SolidsPolesHolesAndSplinesComeBackSound) {
  const Surface below = sphere(2.0), above = moved(sphere(1.0), {0.0, 0.0, 5.0});
  struct Case {
    std::string name;
    Assembly assembly;
    std::size_t faces, free_edges, solids;
  };
  const std::vector<Case> cases{
      {"spheres",
       joint({"below", below, line({0.25 * pi, 0.7}, {0.0, 1.0}), true},
             {"above", above, line({-0.25 * pi, 0.7}, {0.0, 1.0}), false}),
       3, 0, 1},
      {"hole",
       joint({"post", cylinder(1.0, {0.5, 4.0}), line({1.0, 0.3}, {0.0, 1.0}), false},
             {"floor", plane({-5.0, 5.0}, {-5.0, 5.0}), circle({0.0, 0.0}, 2.0), false}),
       3, 5, 0},
      {"spline primary",
       joint(
           {"egg", ellipsoid(2.0, 1.5, 1.2), line({0.3, 1.9}, {0.0, 1.0}), true},
           {"ring", moved(cylinder(1.0, {0.0, 3.0}), {0.0, 0.0, 2.0}), line({0.5, 1.9}, {0.0, 1.0}), false}),
       3, 1, 0},
      {"tori",
       joint({"tube", torus(4.0, 1.0), circle({1.0, 0.0}, 0.4), false},
             {"far", moved(torus(4.0, 1.0), {0.0, 0.0, 6.0}), circle({-1.0, 0.0}, 0.4), false}),
       3, 0, 1},
      {"wave",
       joint({"upper", cylinder(1.0, {4.0, 9.0}), wave(5.5, 0.4, 2.0, 0.7), false},
             {"lower", cylinder(2.0, {-2.0, 4.0}), wave(2.5, 0.5, 3.0, 0.7), true}),
       3, 2, 0}};
  for (const Case& k : cases) {
    SCOPED_TRACE(k.name);
    const Shape shape = assemble(k.assembly, tolerance).shape;
    const double area = check_shape(shape).area;
    write_step(folder_ / "joint.step", shape, {});
    const StepContent c = read_step(folder_ / "joint.step");
    EXPECT_TRUE(c.check.valid) << ::testing::PrintToString(c.check.problems);
    EXPECT_LE(c.check.largest_tolerance, tolerance);
    EXPECT_LE(c.check.largest_edge_gap, tolerance);
    EXPECT_EQ(c.check.faces, k.faces);
    EXPECT_EQ(c.check.free_edges, k.free_edges);
    EXPECT_EQ(c.check.unexpected_free_edges, 0u);
    EXPECT_EQ(c.check.solids, k.solids);
    EXPECT_NEAR(c.check.area, area, 1e-5 * area);
  }
}

TEST_F(StepFile, MissingPrimaryIsSeenAfterReading) {
  const Shape good = assemble(coaxial(), tolerance).shape;
  auto lost = std::make_shared<Shape::Impl>();
  TopoDS_Shell shell;
  BRep_Builder().MakeShell(shell);
  for (const ShapeFace& f : good.impl().faces) {
    if (f.name == "upper") continue;
    BRep_Builder().Add(shell, f.face);
    lost->faces.push_back(f);
  }
  lost->shape = shell;
  write_step(folder_ / "joint.step", Shape(lost), {});
  EXPECT_EQ(read_step(folder_ / "joint.step").check.unexpected_free_edges, 1u);
}

}  // namespace
}  // namespace blendwright::test
