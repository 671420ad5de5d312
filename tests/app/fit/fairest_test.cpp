// Asked to be fair, every example gets fairer: measured by a quadrature of its own on the blends that are
// written.
#include <gtest/gtest.h>

#include <cstdio>

#include "app/json/job_reader.hpp"
#include "app/pipeline/fit_job.hpp"
#include "tests/app/program.hpp"

namespace blendwright::test {
namespace {

fs::path specs() { return fs::path(BLENDWRIGHT_SOURCE_DIR) / "examples/specs"; }

/// Mean |Su| and |Sv|, v over the unit range: the lengths that parameters are measured in.
Vec2 mean_lengths(const OdeBlend& blend) {
  constexpr int n = 40;
  const Interval v = blend.domain().v;
  Vec2 sum = Vec2::Zero();
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j) {
      const SurfaceJet at = blend.jet({(i + 0.5) / n, v.at((j + 0.5) / n)});
      sum += Vec2(at.Su.norm(), at.Sv.norm() * v.length()) / (n * n);
    }
  return sum;
}

/// int |Sss|^2 + 2 |Sst|^2 + |Stt|^2 ds dt with s = u Lu, t = v Lv, by the midpoint rule.
double thin_plate_energy(const OdeBlend& blend, const Vec2& L) {
  constexpr int nu = 60, nv = 240;
  const Interval v = blend.domain().v;
  const double a = 1.0 / (L[0] * L[0]), b = v.length() / (L[0] * L[1]),
               c = v.length() * v.length() / (L[1] * L[1]);
  double sum = 0.0;
  for (int i = 0; i < nu; ++i)
    for (int j = 0; j < nv; ++j) {
      const SurfaceJet at = blend.jet({(i + 0.5) / nu, v.at((j + 0.5) / nv)});
      sum += (a * at.Suu).squaredNorm() + 2.0 * (b * at.Suv).squaredNorm() + (c * at.Svv).squaredNorm();
    }
  return sum * L[0] * L[1] / (nu * nv);
}

TEST(Fairest, FitsLowerTheThinPlateEnergyOfEveryExample) {
  std::size_t fitted = 0;
  for (const auto& entry : fs::directory_iterator(specs())) {
    if (entry.path().extension() != ".json") continue;
    SCOPED_TRACE(entry.path().stem().string());
    const std::string text = content(entry.path());
    JobSpec job = read_job(text, entry.path());
    if (job.blends.at(0).fit) continue;  // these are about something else
    FitJobOptions options;
    options.folder = job.folder;
    options.threads = 2;
    options.objectives = {ThinPlate{}};
    options.files = {""};
    const JobResult before = run_job(job);
    const FitJobResult after = run_fit_job(text, job, options);
    double was = 0.0, is = 0.0;
    for (std::size_t k = 0; k < before.blends.size(); ++k) {
      const OdeBlend& start = before.blends[k].blend.surface;
      const Vec2 lengths = mean_lengths(start);
      was += thin_plate_energy(start, lengths);
      is += thin_plate_energy(after.verified.blends[k].blend.surface, lengths);
    }
    std::printf("%-18s thin-plate energy %9.4g -> %9.4g\n", entry.path().stem().string().c_str(), was, is);
    EXPECT_LT(is, was);
    ++fitted;
  }
  EXPECT_GE(fitted, 20u);
}

}  // namespace
}  // namespace blendwright::test
