// Every example job is proven between the samples: formula, exported B-spline and the STEP file read back.
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdlib>
#include <iomanip>
#include <iostream>
#include <map>
#include <set>

#include "kernel/geometry/curvature.hpp"
#include "tests/app/job_support.hpp"
#include "tests/support/for_all.hpp"

namespace blendwright {
namespace {

namespace fs = std::filesystem;
using test::example_job;

/// Sides whose boundary data are not tangent as printed: the bound says so instead of holding the goal.
const std::set<std::string> not_tangent{"fig3-eq10-printed", "fig4-eq11-printed", "fig6-eq13-printed",
                                        "fig7-eq14-printed"};
/// The trimline of its side "from" stops at v = 0: no normal there, but a limit of the angle.
const std::string stopping = "fig2-eq9-literal";

struct Certified {
  JobResult result;
  double seconds;             ///< for making, proving and not writing
  std::vector<Surface> step;  ///< of every blend, as read back
};

std::vector<Surface> read_back(const JobResult& result, const JobOutputs& outputs) {
  std::vector<Surface> surfaces;
  for (const BlendResult& b : result.blends)
    for (const StepFace& face : outputs.step->faces)
      if (face.name == b.entry.name) surfaces.push_back(face.surface);
  return surfaces;
}

/// Made once for all tests.
const Certified& certified(const std::string& name) {
  static std::map<std::string, Certified> all;
  const auto known = all.find(name);
  if (known != all.end()) return known->second;
  const test::TemporaryFolder folder("certify-" + name);
  JobSpec job = example_job(name);
  job.output.formats = {OutputFormat::step};
  using Clock = std::chrono::steady_clock;
  const auto start = Clock::now();
  JobResult result = run_job(job, {}, {.certify = true});
  const double seconds = std::chrono::duration<double>(Clock::now() - start).count();
  const JobOutputs outputs =
      write_outputs(result, {.folder = folder.path(), .overwrite = true, .times = false});
  std::vector<Surface> step = read_back(result, outputs);
  return all.emplace(name, Certified{std::move(result), seconds, std::move(step)}).first->second;
}

std::vector<std::string> names() {
  std::vector<std::string> all;
  for (const auto& entry : fs::directory_iterator(test::specs_folder()))
    if (entry.path().extension() == ".json") all.push_back(entry.path().stem());
  std::sort(all.begin(), all.end());
  return all;
}

class CertificateGoal : public ::testing::TestWithParam<std::string> {};

void expect_agreed(const ProvenFigure& f, const char* what) {
  EXPECT_TRUE(f.agreed()) << what << ": " << f.unproven;
  EXPECT_LE(f.proven, 1.1 * std::max(f.sampled, f.found) + f.floor) << what;
}

TEST_P(CertificateGoal, IsProvenAndMeetsItsLimits) {
  const std::string name = GetParam();
  const Certified& made = certified(name);
  const JobResult& result = made.result;
  EXPECT_LE(made.seconds, 2.0);
  for (const BlendResult& b : result.blends) {
    ASSERT_EQ(b.stages.size(), 3u);
    for (const BlendReport& stage : b.stages) {
      ASSERT_TRUE(stage.proven.has_value());
      for (std::size_t i = 0; i < 2; ++i) {
        SCOPED_TRACE(stage.stage + " " + stage.seams[i].name);
        const SeamCertificate& c = (*stage.proven)[i];
        std::cout << std::scientific << std::setprecision(2) << name << ' ' << stage.stage << ' ' << i
                  << ": gap " << c.gap.sampled << " <= " << c.gap.proven << ", angle "
                  << Radians(c.angle.sampled).degrees() << " <= " << Radians(c.angle.proven).degrees()
                  << " deg, jump " << c.curvature.sampled << " <= " << c.curvature.proven << ", " << c.pieces
                  << " pieces, job " << std::fixed << made.seconds << " s\n";
        expect_agreed(c.gap, "gap");
        EXPECT_LE(c.gap.proven, 1e-6);
        expect_agreed(c.angle, "angle");
        if (!not_tangent.count(name)) {
          EXPECT_LE(Radians(c.angle.proven).degrees(), 1e-3);
        }
        if (not_tangent.count(name)) continue;  // no G1 joint, no curvature jump
        if (name == stopping && i == 0) {
          EXPECT_NE(c.curvature.unproven.find("the trimline stops there"), std::string::npos);
          continue;
        }
        expect_agreed(c.curvature, "curvature");
        if (b.entry.sides[i].side.continuity < Continuity::G2) continue;
        EXPECT_LE(c.curvature.proven, 1e-4);
      }
    }
  }
}

/// Figures from jets at random places, by another path than the reports': normals from central differences of
/// positions (step h: truncation h^2, rounding eps/h; with h = 1e-5 of the range both stay below 1e-9 of the
/// derivatives here, so 1e-7 rad is demanded).
TEST_P(CertificateGoal, IsNotExceededByRandomSamplesNorByDifferencedNormals) {
  const std::string name = GetParam();
  const Certified& made = certified(name);
  // 24 jobs, 3 stages, 2 sides: 10^7 places in the long run.
  const int count = std::getenv("BLENDWRIGHT_LONG") ? 70000 : 350;
  ASSERT_EQ(made.step.size(), made.result.blends.size());
  for (std::size_t n_blend = 0; n_blend < made.step.size(); ++n_blend)
    for (std::size_t k = 0; k < 3; ++k) {
      const BlendResult& b = made.result.blends[n_blend];
      const Surface surface = k == 0   ? Surface(b.blend.surface)
                              : k == 1 ? Surface(b.fit.surface)
                                       : made.step[n_blend];
      const BlendUnderTest tested = under_test(b, surface);
      for (std::size_t i = 0; i < 2; ++i) {
        const SeamCertificate& c = (*b.stages[k].proven)[i];
        const Seam& seam = tested.seams[i];
        const double u = static_cast<double>(i);
        test::Rng rng(17 + k + 2 * i);
        for (int n = 0; n < count; ++n) {
          const double v = seam.blend.domain().v.at(test::uniform(rng, 0.0, 1.0));
          const Vec2 foot = seam.pcurve->point(v);
          const SurfaceJet S = surface.jet({u, v}), P = seam.primary->jet({foot.x(), foot.y()});
          ASSERT_LE((S.S - P.S).norm(), c.gap.proven + c.gap.floor) << name << " at v = " << v;
          const double angle = plane_angle(unit_normal(S), unit_normal(P)).value;
          ASSERT_LE(angle, c.angle.proven + std::max(c.angle.floor, 1e-13)) << name << " at v = " << v;
          if (n % 50 != 0 || name == stopping) continue;
          const SurfaceDomain d = seam.primary->domain();
          const double hu = 1e-5 * d.u.length(), hv = 1e-5 * d.v.length();
          const auto at = [&](double du, double dv) {
            return seam.primary->point({foot.x() + du, foot.y() + dv});
          };
          const bool inside = d.u.contains(foot.x() + hu) && d.u.contains(foot.x() - hu);
          const Vec3 Pu = inside ? Vec3(at(hu, 0) - at(-hu, 0)) : Vec3(P.Su), Pv = at(0, hv) - at(0, -hv);
          if (d.v_closed || (d.v.contains(foot.y() + hv) && d.v.contains(foot.y() - hv))) {
            EXPECT_LE(plane_angle(Pu.cross(Pv), unit_normal(P)).value, 1e-7) << name << " at v = " << v;
          }
        }
      }
    }
}

/// The same spline, clamped in v, with one more knot at t (Boehm).
BSplineSurface with_knot(const BSplineSurface& s, double t) {
  const BSplineBasis& v = s.basis_v();
  const int p = v.degree(), n = v.count();
  std::vector<double> knots;
  for (std::size_t i = 0; i < v.breaks().size(); ++i)
    knots.insert(knots.end(), static_cast<std::size_t>(v.multiplicities()[i]), v.breaks()[i]);
  const int k = static_cast<int>(std::upper_bound(knots.begin(), knots.end(), t) - knots.begin()) - 1;
  const auto at = [&](int i) { return knots[static_cast<std::size_t>(i)]; };
  std::vector<Vec3> control;
  for (int i = 0; i < s.basis_u().count(); ++i)
    for (int j = 0; j <= n; ++j) {
      const double a = j <= k - p ? 1.0 : j > k ? 0.0 : (t - at(j)) / (at(j + p) - at(j));
      control.push_back(a * s.control(i, std::min(j, n - 1)) + (1.0 - a) * s.control(i, std::max(j - 1, 0)));
    }
  std::vector<double> breaks = v.breaks();
  std::vector<int> multiplicities = v.multiplicities();
  const auto place = std::upper_bound(breaks.begin(), breaks.end(), t) - breaks.begin();
  breaks.insert(breaks.begin() + place, t);
  multiplicities.insert(multiplicities.begin() + place, 1);
  return {s.basis_u(), BSplineBasis(p, breaks, multiplicities, false), control};
}

/// A bump of about `height` on the edge u = 0, on p + 2 new knots within `width` around `at`.
BSplineSurface bumped(const BSplineSurface& s, double at, double width, double height) {
  const int p = s.basis_v().degree();
  BSplineSurface dense = s;
  for (int i = 0; i < p + 2; ++i) dense = with_knot(dense, at + width * (i / (p + 1.0) - 0.5));
  const std::vector<double> greville = dense.basis_v().greville();
  std::size_t middle = 0;
  for (std::size_t j = 0; j < greville.size(); ++j)
    if (std::abs(greville[j] - at) < std::abs(greville[middle] - at)) middle = j;
  std::vector<Vec3> control = dense.control();
  const SurfaceJet jet = s.jet({0.0, at});
  control[middle] += height / 0.55 * unit_normal(jet);  // maximum of the quintic function of even knots: 0.55
  return {dense.basis_u(), dense.basis_v(), control};
}

TEST(Certificate, FindsABumpBetweenTheSamplesOfTheStepFile) {
  // Midway between two of the 2048 samples, a third of their distance wide; the fitted edge is 1e-7 off at
  // most.
  for (const double height : {0.0, 1e-6}) {
    const test::TemporaryFolder folder("certify-bump");
    JobSpec job = example_job("open-blend");
    job.output.formats = {OutputFormat::step};
    JobResult result = run_job(job, {}, {.certify = true});
    result.job.tolerance.position = 1e-5;  // faces are joined in spite of the bump
    BlendResult& blend = result.blends.front();
    const Interval v = blend.fit.surface.domain().v;
    ASSERT_FALSE(blend.fit.surface.basis_v().periodic());
    const double step = v.length() / 2046.0, at = v.at((1000.0 + 0.618 + 0.5) / 2046.0);
    blend.fit.surface = bumped(blend.fit.surface, at, step / 3.0, height);
    const JobOutputs outputs =
        write_outputs(result, {.folder = folder.path(), .overwrite = true, .times = false});
    ASSERT_EQ(blend.stages.size(), 3u) << outputs.not_joined;
    const ProvenFigure& gap = (*blend.stages[2].proven)[0].gap;
    EXPECT_EQ(blend.stages[2].stage, "step");
    EXPECT_LT(gap.sampled, 2e-7);  // the control: sampling misses it
    EXPECT_EQ(gap.agreed(), height == 0.0) << gap.unproven;
    if (height == 0.0) continue;
    EXPECT_GE(gap.found, 0.8e-6);
    EXPECT_GE(gap.proven, 0.9e-6);
    EXPECT_LE(gap.proven, 1.4e-6);
    EXPECT_NEAR(gap.v, at, step);
  }
}

INSTANTIATE_TEST_SUITE_P(Examples, CertificateGoal, ::testing::ValuesIn(names()), [](const auto& p) {
  std::string name = p.param;
  std::replace(name.begin(), name.end(), '-', '_');
  return name;
});

}  // namespace
}  // namespace blendwright
