// Every example job is proven between the samples: formula, exported B-spline and the STEP file read back.
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdlib>
#include <iomanip>
#include <iostream>
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

JobResult certified(const std::string& name, double& seconds) {
  const test::TemporaryFolder folder("certify-" + name);
  JobSpec job = example_job(name);
  job.output.formats = {OutputFormat::step};
  using Clock = std::chrono::steady_clock;
  const auto start = Clock::now();
  JobResult result = run_job(job, {}, {.certify = true});
  seconds = std::chrono::duration<double>(Clock::now() - start).count();
  static_cast<void>(write_outputs(result, {.folder = folder.path(), .overwrite = true, .times = false}));
  return result;
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
  double seconds = 0.0;
  const JobResult result = certified(name, seconds);
  EXPECT_LE(seconds, 2.0);
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
                  << " pieces\n";
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
  const JobResult result = run_job(example_job(name), {}, {.certify = true});
  // 20 jobs, 2 stages, 2 sides: 10^7 places in the long run.
  const int count = std::getenv("BLENDWRIGHT_LONG") ? 125000 : 500;
  for (const BlendResult& b : result.blends)
    for (std::size_t k = 0; k < 2; ++k) {
      const Surface surface = k == 0 ? Surface(b.blend.surface) : Surface(b.fit.surface);
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

INSTANTIATE_TEST_SUITE_P(Examples, CertificateGoal, ::testing::ValuesIn(names()), [](const auto& p) {
  std::string name = p.param;
  std::replace(name.begin(), name.end(), '-', '_');
  return name;
});

}  // namespace
}  // namespace blendwright
