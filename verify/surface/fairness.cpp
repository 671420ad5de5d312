#include "verify/surface/fairness.hpp"

#include <Eigen/Geometry>
#include <cmath>
#include <limits>

#include "kernel/base/error.hpp"
#include "kernel/base/number_text.hpp"
#include "kernel/base/parallel_for.hpp"
#include "kernel/geometry/curvature.hpp"
#include "kernel/math/quadrature.hpp"
#include "verify/surface/compass_search.hpp"

namespace blendwright {
namespace {

constexpr int points_per_cell = 4;
constexpr double infinity = std::numeric_limits<double>::infinity();

/// The extremes that the samples of one column hold, before refinement.
struct Extremes {
  detail::PeakUV largest{{}, -infinity}, smallest{{}, -infinity}, sharpest{{}, -infinity};
  detail::PeakUV draft_low{{}, -infinity}, draft_high{{}, -infinity};
  void take(const Extremes& other) {
    const auto better = [](detail::PeakUV& mine, const detail::PeakUV& theirs) {
      if (theirs.value > mine.value) mine = theirs;
    };
    better(largest, other.largest);
    better(smallest, other.smallest);
    better(sharpest, other.sharpest);
    better(draft_low, other.draft_low);
    better(draft_high, other.draft_high);
  }
};

/// What one line v = constant adds.
struct Column {
  double area = 0.0, bending = 0.0, thin_plate = 0.0, variation = 0.0;
  std::vector<double> curvature;  ///< of the line, at its Gauss points; empty when one is not known
  Extremes extremes;
  std::size_t unmeasured = 0;
};

/// n.pull, the sine of the draft angle.
double draft_sine(const SurfaceJet& jet, const Vec3& pull) { return unit_normal(jet).dot(pull); }

bool measurable(const SurfaceJet& jet) {
  return (jet.S + jet.Su + jet.Sv + jet.Suu + jet.Suv + jet.Svv).allFinite() && !unit_normal(jet).isZero(0.0);
}

/// Curvature and arc length of the line v = constant, and their derivative by a difference within the cell:
/// the normal curvature of the line is analytic, so the step is a thousandth of the cell.
double curvature_slope(const Surface& surface, UV at, double step) {
  const SurfaceJet a = surface.jet({at.u - step, at.v}), b = surface.jet({at.u + step, at.v});
  if (!measurable(a) || !measurable(b)) return 0.0;
  const double ka = normal_curvature(a, a.Su, unit_normal(a)), kb = normal_curvature(b, b.Su, unit_normal(b));
  return (kb - ka) / (step * (a.Su.norm() + b.Su.norm()));
}

class Measurement {
 public:
  Measurement(const Surface& surface, const FairnessOptions& options)
      : surface_(surface),
        options_(options),
        domain_(surface.domain()),
        rule_(gauss_legendre(points_per_cell)) {}

  FairnessReport run(const Progress& progress) {
    columns_.resize(static_cast<std::size_t>(options_.nv * points_per_cell));
    parallel_for(columns_.size(), 4, [&](std::size_t begin, std::size_t end) {
      for (std::size_t j = begin; j < end; ++j) columns_[j] = column(j);
    });
    progress.at(0.8, "fairness");
    FairnessReport report;
    Extremes found;
    for (const Column& c : columns_) {
      report.area += c.area;
      report.bending += c.bending;
      report.thin_plate += c.thin_plate;
      report.variation += c.variation;
      report.unmeasured += c.unmeasured;
      found.take(c.extremes);
    }
    report.turns = turns(std::abs(found.sharpest.value));
    refine(found, report);
    return report;
  }

 private:
  /// Gauss point k of a direction that is cut into `cells`.
  [[nodiscard]] double at(Interval range, int cells, std::size_t k) const {
    const std::size_t cell = k / points_per_cell, point = k % points_per_cell;
    return range.at((static_cast<double>(cell) + rule_.x[point]) / cells);
  }

  [[nodiscard]] Column column(std::size_t j) const {
    Column c;
    const double v = at(domain_.v, options_.nv, j);
    const double wv = rule_.w[j % points_per_cell] / options_.nv;
    const double lu = domain_.u.length(), lv = domain_.v.length();
    const double step = 1e-3 * lu / options_.nu;
    bool whole = true;
    for (std::size_t i = 0; i < static_cast<std::size_t>(options_.nu * points_per_cell); ++i) {
      const UV place{at(domain_.u, options_.nu, i), v};
      const SurfaceJet jet = surface_.jet(place);
      if (!measurable(jet)) {
        ++c.unmeasured;
        whole = false;
        continue;
      }
      const double weight = wv * rule_.w[i % points_per_cell] / options_.nu;
      const double area = jet.Su.cross(jet.Sv).norm() * lu * lv * weight;
      const SurfaceCurvature k = curvature(jet);
      c.area += area;
      c.bending += (k.k_min * k.k_min + k.k_max * k.k_max) * area;
      c.thin_plate += weight * (lu * lu * lu * lu * jet.Suu.squaredNorm() +
                                2.0 * lu * lu * lv * lv * jet.Suv.squaredNorm() +
                                lv * lv * lv * lv * jet.Svv.squaredNorm());
      const double slope = curvature_slope(surface_, place, step);
      c.variation += slope * slope * area;
      c.curvature.push_back(normal_curvature(jet, jet.Su, unit_normal(jet)));
      Extremes here{{place, k.k_max}, {place, -k.k_min}, {place, std::max(k.k_max, -k.k_min)}, {}, {}};
      if (options_.pull) {
        const double sine = draft_sine(jet, *options_.pull);
        here.draft_low = {place, -sine};
        here.draft_high = {place, sine};
      } else {
        here.draft_low = here.draft_high = {place, -infinity};
      }
      c.extremes.take(here);
    }
    if (!whole) c.curvature.clear();
    return c;
  }

  /// Changes of direction that are larger than the threshold: a turn counts when curvature has come back by
  /// it.
  static int turns_of(const std::vector<double>& k, double threshold) {
    int count = 0, direction = 0;
    double extreme = k.front(), low = k.front(), high = k.front();
    for (const double value : k) {
      if (direction == 0) {
        low = std::min(low, value);
        high = std::max(high, value);
        if (high - low <= threshold) continue;
        direction = value == high ? 1 : -1;
        extreme = value;
      } else if (direction * (value - extreme) >= 0.0) {
        extreme = value;
      } else if (std::abs(value - extreme) > threshold) {
        ++count;
        direction = -direction;
        extreme = value;
      }
    }
    return count;
  }

  [[nodiscard]] CurvatureTurns turns(double largest) const {
    CurvatureTurns result;
    std::size_t lines = 0, total = 0;
    for (std::size_t j = 0; j < columns_.size(); ++j) {
      if (columns_[j].curvature.empty()) continue;
      const int count = turns_of(columns_[j].curvature, 1e-6 * largest);
      ++lines;
      total += static_cast<std::size_t>(count);
      if (count > result.most || lines == 1) {
        result.most = count;
        result.v = at(domain_.v, options_.nv, j);
      }
    }
    if (lines > 0) result.average = static_cast<double>(total) / static_cast<double>(lines);
    return result;
  }

  template <class F>
  [[nodiscard]] Extreme refined(const detail::PeakUV& start, F f) const {
    if (start.value == -infinity) {
      const double nan = std::numeric_limits<double>::quiet_NaN();
      return {nan, {domain_.u.lo, domain_.v.lo}, Vec3::Constant(nan)};
    }
    const auto value = [&](UV at) {
      const SurfaceJet jet = surface_.jet(at);
      return measurable(jet) ? f(jet) : -infinity;
    };
    const detail::PeakUV peak =
        detail::compass_maximum(value, domain_, start, 0.5 * domain_.u.length() / options_.nu,
                                0.5 * domain_.v.length() / options_.nv, 20);
    return {peak.value, peak.at, surface_.point(peak.at)};
  }

  void refine(const Extremes& found, FairnessReport& report) const {
    report.largest = refined(found.largest, [](const SurfaceJet& j) { return curvature(j).k_max; });
    report.smallest = refined(found.smallest, [](const SurfaceJet& j) { return -curvature(j).k_min; });
    report.smallest.value = -report.smallest.value;
    report.minimum_radius = refined(found.sharpest, [](const SurfaceJet& j) {
      const SurfaceCurvature k = curvature(j);
      return std::max(k.k_max, -k.k_min);
    });
    report.minimum_radius.value = 1.0 / report.minimum_radius.value;
    if (!options_.pull) return;
    const Vec3 pull = *options_.pull;
    Extreme low = refined(found.draft_low, [&](const SurfaceJet& j) { return -draft_sine(j, pull); });
    Extreme high = refined(found.draft_high, [&](const SurfaceJet& j) { return draft_sine(j, pull); });
    low.value = -std::asin(std::clamp(low.value, -1.0, 1.0));
    high.value = std::asin(std::clamp(high.value, -1.0, 1.0));
    report.draft = {low, high};
  }

  const Surface& surface_;
  const FairnessOptions& options_;
  SurfaceDomain domain_;
  const QuadratureRule& rule_;
  std::vector<Column> columns_;
};

}  // namespace

FairnessReport fairness(const Surface& surface, const FairnessOptions& options, const Progress& progress) {
  if (options.pull && !(std::abs(options.pull->norm() - 1.0) <= 1e-9))
    throw InputError("pull",
                     "has the length " + number_text(options.pull->norm()) + ", must be a unit vector");
  if (options.nu < 1 || options.nv < 1) throw InputError("nu, nv", "must be at least 1");
  return Measurement(surface, options).run(progress);
}

}  // namespace blendwright
