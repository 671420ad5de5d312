// The STEP file says what the result says, in every schema and unit.
#include <gtest/gtest.h>

#include <algorithm>

#include "app/pipeline/result_meshes.hpp"
#include "kernel/math/quadrature.hpp"
#include "tests/app/job_support.hpp"

namespace blendwright {
namespace {

using std::numbers::pi;

struct Variant {
  StepSchema schema;
  LengthUnit unit;
};

/// Two coaxial pipes that reach beyond their trimlines, so that the file's areas depend on the cuts. What
/// stays: radius 1 from -2 to 0, radius 2 from 3 to 5.
JobSpec pipes(const Variant& variant) {
  JobSpec job = test::example_job("coaxial-cylinders");
  for (PrimaryEntry& primary : job.primaries) {
    auto& spec = std::get<PrimarySpec>(primary.spec);
    spec.u = primary.name == "thin" ? Interval{-2.0, 1.0} : Interval{2.5, 5.0};
  }
  job.unit = variant.unit;
  job.output = {{OutputFormat::step}, variant.schema};
  return job;
}
constexpr double pipe_area = 2.0 * pi * 1.0 * 2.0 + 2.0 * pi * 2.0 * 2.0;  // 2 pi r L each

/// Over the whole domain, by Gauss's rule on 4 x 4 panels: errors far below 1e-9 for these shapes.
template <class Integrand>
double integral(const Surface& surface, Integrand f) {
  constexpr int panels = 4;
  const QuadratureRule& rule = gauss_legendre(12);
  const SurfaceDomain domain = surface.domain();
  double sum = 0.0;
  for (int i = 0; i < panels; ++i)
    for (int j = 0; j < panels; ++j)
      for (std::size_t a = 0; a < rule.x.size(); ++a)
        for (std::size_t b = 0; b < rule.x.size(); ++b) {
          const UV p{domain.u.at((i + rule.x[a]) / panels), domain.v.at((j + rule.x[b]) / panels)};
          sum += rule.w[a] * rule.w[b] * f(surface.jet(p));
        }
  return sum * domain.u.length() * domain.v.length() / (panels * panels);
}
double area(const Surface& surface) {
  return integral(surface, [](const SurfaceJet& j) { return j.Su.cross(j.Sv).norm(); });
}
/// Between the blend and the discs at z = 0 and z = 3, of radius 2: a third of the flux of S outwards.
double volume(const Surface& surface) {
  const double disc = 3.0 * 4.0 * pi;
  return (disc - integral(surface, [](const SurfaceJet& j) { return j.S.dot(j.Su.cross(j.Sv)); })) / 3.0;
}
/// The same of a solid of revolution about z: int pi r^2 dz along one meridian.
double volume_of_revolution(const Surface& surface) {
  return integral(surface, [&](const SurfaceJet& j) { return pi * j.S.head<2>().squaredNorm() * j.Su.z(); }) /
         surface.domain().v.length();
}

const StepFace& face_named(const StepContent& content, const std::string& name) {
  const auto face = std::find_if(content.faces.begin(), content.faces.end(),
                                 [&](const StepFace& f) { return f.name == name; });
  if (face == content.faces.end()) throw std::runtime_error("no face " + name);
  return *face;
}

void expect_colour(const StepFace& face, const Colour& expected) {
  ASSERT_TRUE(face.colour) << face.name;
  // Colours are kept as linear single precision numbers.
  EXPECT_NEAR(face.colour->r, expected.r, 1e-3) << face.name;
  EXPECT_NEAR(face.colour->g, expected.g, 1e-3) << face.name;
  EXPECT_NEAR(face.colour->b, expected.b, 1e-3) << face.name;
}

class RoundTrip : public ::testing::TestWithParam<Variant> {
 protected:
  RoundTrip() : result_(run_job(pipes(GetParam()))), folder_("round-trip") {
    outputs_ = write_outputs(result_, {.folder = folder_.path()});
  }
  [[nodiscard]] const StepContent& step() const { return outputs_.step.value(); }
  [[nodiscard]] const BlendResult& blend() const { return result_.blends[0]; }

  JobResult result_;
  test::TemporaryFolder folder_;
  JobOutputs outputs_;
};

TEST_P(RoundTrip, KeepsEveryFigure) {
  EXPECT_TRUE(verified(result_, &outputs_));
  ASSERT_EQ(blend().stages.size(), 3u);
  const BlendReport &fitted = blend().stages[1], &read = blend().stages[2];
  // The file has 15 digits of coordinates up to 5; derivatives divide by spans of 0.05 or more, once or
  // twice.
  for (std::size_t side = 0; side < 2; ++side) {
    EXPECT_EQ(read.seams[side].samples, fitted.seams[side].samples);
    EXPECT_NEAR(read.seams[side].gap.worst, fitted.seams[side].gap.worst, 1e-13);
    EXPECT_NEAR(read.seams[side].angle.worst, fitted.seams[side].angle.worst, 1e-11);
    EXPECT_NEAR(read.seams[side].curvature.worst, fitted.seams[side].curvature.worst, 1e-9);
  }
  EXPECT_NEAR(read.closing->gap, fitted.closing->gap, 1e-13);
  EXPECT_NEAR(read.minimum_radius.value, fitted.minimum_radius.value, 1e-9);
  EXPECT_EQ(face_named(step(), "reducer").control_points,
            static_cast<std::size_t>(blend().fit.report.control_points));
}

TEST_P(RoundTrip, KeepsNamesColoursSchemaAndUnit) {
  ASSERT_EQ(step().faces.size(), 3u);
  const Assembly assembly = assembly_of(result_);
  for (const BlendPatch& patch : assembly.blends) expect_colour(face_named(step(), patch.name), patch.colour);
  ASSERT_EQ(assembly.primaries.size(), 2u);
  for (const PrimaryPatch& patch : assembly.primaries)
    expect_colour(face_named(step(), patch.name), patch.colour);
  EXPECT_EQ(step().unit, GetParam().unit == LengthUnit::inch ? "in" : "mm");
  const char* schema = GetParam().schema == StepSchema::AP214 ? "AUTOMOTIVE_DESIGN" : "AP242_MANAGED";
  EXPECT_EQ(step().schema.rfind(schema, 0), 0u) << step().schema;
}

TEST_P(RoundTrip, HasTheAreaAndVolumeOfTheExactShapes) {
  const Surface exact = blend().blend.surface, read = face_named(step(), "reducer").surface;
  const double expected = pipe_area + area(exact);
  EXPECT_NEAR(step().check.area, expected, 1e-6 * expected);
  // The fit is within 1e-6 everywhere, against radii of 1 and more.
  EXPECT_NEAR(area(read), area(exact), 1e-6 * area(exact));
  EXPECT_NEAR(volume(read), volume_of_revolution(exact), 1e-6 * volume_of_revolution(exact));
}

/// Negative control: read as millimetres, a file in inches is 25.4 times as large, and only such a file.
TEST_P(RoundTrip, IsReadInTheUnitOfTheFile) {
  const StepContent in_mm = read_step(outputs_.files.front().path, LengthUnit::millimetre);
  const double factor = GetParam().unit == LengthUnit::inch ? 25.4 : 1.0;
  const double expected = factor * factor * (pipe_area + area(blend().blend.surface));
  EXPECT_NEAR(in_mm.check.area, expected, 1e-6 * expected);
  const Vec3 corner = factor * blend().fit.surface.jet({0.0, 0.0}).S;
  EXPECT_LE((face_named(in_mm, "reducer").surface.point({0.0, 0.0}) - corner).norm(), 1e-12 * corner.norm());
}

INSTANTIATE_TEST_SUITE_P(EverySchemaAndUnit, RoundTrip,
                         ::testing::Values(Variant{StepSchema::AP214, LengthUnit::millimetre},
                                           Variant{StepSchema::AP214, LengthUnit::inch},
                                           Variant{StepSchema::AP242, LengthUnit::millimetre},
                                           Variant{StepSchema::AP242, LengthUnit::inch}),
                         [](const auto& p) {
                           return std::string(name(p.param.schema)) + "_" + name(p.param.unit);
                         });

}  // namespace
}  // namespace blendwright
