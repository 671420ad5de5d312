#include "parametric/shape_fit/fit_measure.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "kernel/base/number_text.hpp"
#include "kernel/base/parallel_for.hpp"
#include "kernel/geometry/curvature.hpp"
#include "kernel/geometry/project.hpp"
#include "kernel/math/quadrature.hpp"
#include "parametric/trimline/law_spline.hpp"

namespace blendwright::detail {
namespace {

constexpr int rows = 24, columns = 129;

struct Sample {
  double u, t;
  SurfaceJet jet;  ///< derivatives by v of the blend
};

/// f(sample) at rows x columns points, ends included.
template <class F>
void over_grid(const Blend& blend, const F& f) {
  const Interval v = blend.surface.domain().v;
  for (int j = 0; j < columns; ++j)
    for (int i = 0; i <= rows; ++i) {
      const double u = static_cast<double>(i) / rows, t = static_cast<double>(j) / (columns - 1);
      f(Sample{u, t, blend.surface.jet({u, v.at(t)})});
    }
}

double thin_plate(const Blend& blend, const Vec2& lengths) {
  const QuadratureRule& rule = gauss_legendre(32);
  const Interval v = blend.surface.domain().v;
  const double a = lengths[0] * lengths[0], b = lengths[0] * lengths[1] / v.length(),
               c = lengths[1] * lengths[1] / (v.length() * v.length());
  constexpr int cells = 64;
  double sum = 0.0;
  for (int k = 0; k < cells; ++k)
    for (const double part : {0.5 - std::sqrt(1.0 / 12.0), 0.5 + std::sqrt(1.0 / 12.0)})
      for (std::size_t i = 0; i < rule.x.size(); ++i) {
        const SurfaceJet j = blend.surface.jet({rule.x[i], v.at((k + part) / cells)});
        sum += rule.w[i] * 0.5 / cells *
               (j.Suu.squaredNorm() / (a * a) + 2.0 * j.Suv.squaredNorm() / (b * b) +
                j.Svv.squaredNorm() / (c * c));
      }
  return sum * lengths[0] * lengths[1];
}

double curvature_variation(const Blend& blend) {
  const Interval v = blend.surface.domain().v;
  const QuadratureRule& rule = gauss_legendre(32);
  constexpr int cells = 128;
  constexpr double step = 1e-4;  // a difference of analytic curvature: error step^2 k''' / 6
  double sum = 0.0;
  for (int k = 0; k < cells; ++k)
    for (std::size_t i = 0; i < rule.x.size(); ++i) {
      const UV at{rule.x[i], v.at((k + 0.5) / cells)};
      const SurfaceJet j = blend.surface.jet(at);
      const auto bend = [&](double u) {
        const SurfaceJet s = blend.surface.jet({u, at.v});
        return normal_curvature(s, s.Su, unit_normal(s));
      };
      const double slope = (bend(at.u + step) - bend(at.u - step)) / (2.0 * step) / j.Su.norm();
      sum += rule.w[i] / cells * v.length() * slope * slope * j.Su.cross(j.Sv).norm();
    }
  return sum;
}

ObjectiveMeasure ball(const RollingBall& o, const Blend& blend) {
  const auto law = law_spline(o.radius, blend.surface.domain().v_closed);
  const Interval v = blend.surface.domain().v;
  double worst = 0.0, least = HUGE_VAL, most = 0.0, at = 0.0;
  for (int j = 0; j <= 256; ++j)
    for (int i = 0; i <= 4; ++i) {
      const double t = j / 256.0, R = law ? (*law)(t) : o.radius.front().value;
      const SurfaceJet s = blend.surface.jet({o.across.at(i / 4.0), v.at(t)});
      const double r = 1.0 / std::abs(normal_curvature(s, s.Su, unit_normal(s)));
      least = std::min(least, r);
      most = std::max(most, r);
      if (std::abs(r - R) / R > worst) worst = std::abs(r - R) / R, at = t;
    }
  ObjectiveMeasure m{"largest relative deviation of the radius", "", worst, worst <= 0.01, {}};
  m.against =
      "the radius in the middle runs from " + number_text(least, 4) + " to " + number_text(most, 4) +
      " and is farthest from the wanted one at " + number_text(at, 3) +
      " of the trimline; the trimlines are fixed, and the radius that fits between them is theirs to decide";
  return m;
}

ObjectiveMeasure distances(const std::vector<Vec3>& points, const Blend& blend, bool through) {
  const Interval v = blend.surface.domain().v;
  const Surface surface = blend.surface;
  constexpr int across = 12, along = 96;
  std::vector<Vec3> grid;
  std::vector<UV> places;
  for (int j = 0; j <= along; ++j)
    for (int i = 0; i <= across; ++i) {
      places.push_back({static_cast<double>(i) / across, v.at(static_cast<double>(j) / along)});
      grid.push_back(surface.point(places.back()));
    }
  std::vector<double> away(points.size());
  parallel_for(points.size(), 16, [&](std::size_t begin, std::size_t end) {
    for (std::size_t k = begin; k < end; ++k) {
      std::size_t best = 0;
      for (std::size_t i = 1; i < grid.size(); ++i)
        if ((grid[i] - points[k]).squaredNorm() < (grid[best] - points[k]).squaredNorm()) best = i;
      away[k] =
          std::min((grid[best] - points[k]).norm(), closest_point(surface, points[k], places[best]).distance);
    }
  });
  double largest = 0.0, squares = 0.0;
  std::size_t worst = 0;
  for (std::size_t k = 0; k < away.size(); ++k) {
    squares += away[k] * away[k];
    if (away[k] > largest) largest = away[k], worst = k;
  }
  double size = 0.0;
  for (const Vec3& g : grid) size = std::max(size, (g - grid.front()).norm());
  ObjectiveMeasure m{through ? "largest distance of a point" : "root mean square distance",
                     "model units",
                     through ? largest : std::sqrt(squares / static_cast<double>(away.size())),
                     true,
                     {}};
  if (through) m.fulfilled = largest <= 1e-6 * size;
  m.against = "point " + std::to_string(worst) + " stays " + number_text(largest, 4) +
              " away; fewer points, or more unknowns along v, can bring it closer";
  return m;
}

struct Measurer {
  const Blend& blend;
  const Vec2& lengths;
  ObjectiveMeasure operator()(const ThinPlate&) const {
    return {"thin-plate energy", "", thin_plate(blend, lengths), true, {}};
  }
  ObjectiveMeasure operator()(const CurvatureVariation&) const {
    return {"integral of (dk/ds)^2", "1/length^2", curvature_variation(blend), true, {}};
  }
  ObjectiveMeasure operator()(const RollingBall& o) const { return ball(o, blend); }
  ObjectiveMeasure operator()(const PassThrough& o) const { return distances(o.points, blend, true); }
  ObjectiveMeasure operator()(const ScannedPoints& o) const { return distances(o.points, blend, false); }
  ObjectiveMeasure operator()(const LargestCurvature& o) const {
    double most = 0.0, at = 0.0, u = 0.0;
    over_grid(blend, [&](const Sample& s) {
      const SurfaceCurvature k = curvature(s.jet);
      const double here = std::max(std::abs(k.k_min), std::abs(k.k_max));
      if (here > most) most = here, at = s.t, u = s.u;
    });
    const double radius = most > 0.0 ? 1.0 / most : std::numeric_limits<double>::infinity();
    ObjectiveMeasure m{
        "least radius of curvature", "model units", radius, radius >= 0.99 * o.least_radius, {}};
    m.against = "the least radius is " + number_text(radius, 4) + " at u = " + number_text(u, 3) + ", " +
                number_text(at, 3) + " of the trimline, wanted " + number_text(o.least_radius, 4);
    if (u == 0.0 || u == 1.0) m.against += "; there the primary decides it, which a blend cannot change";
    return m;
  }
  ObjectiveMeasure operator()(const Clearance& o) const {
    double least = HUGE_VAL, at = 0.0, u = 0.0;
    over_grid(blend, [&](const Sample& s) {
      const double here = o.obstacle(s.jet.S).distance;
      if (here < least) least = here, at = s.t, u = s.u;
    });
    ObjectiveMeasure m{"least distance", "model units", least, least >= 0.99 * o.distance, {}};
    m.against = "the blend comes as close as " + number_text(least, 4) + " at u = " + number_text(u, 3) +
                ", " + number_text(at, 3) + " of the trimline, wanted " + number_text(o.distance, 4);
    if (u == 0.0 || u == 1.0) m.against += "; that is the trimline itself, which cannot move";
    return m;
  }
  ObjectiveMeasure operator()(const NoFold& o) const {
    double least = 1.0;
    for (int j = 0; j < columns; ++j) {
      const double v = blend.surface.domain().v.at(static_cast<double>(j) / (columns - 1));
      const Vec3 n0 = unit_normal(blend.surface.jet({0.0, v})), n1 = unit_normal(blend.surface.jet({1.0, v}));
      for (int i = 0; i <= rows; ++i) {
        const double u = static_cast<double>(i) / rows;
        const Vec3 n = ((1.0 - u) * n0 + u * n1).normalized();
        least = std::min(least, unit_normal(blend.surface.jet({u, v})).dot(n));
      }
    }
    ObjectiveMeasure m{"least cosine to the normals of the ends", "", least, least >= o.margin - 0.01, {}};
    m.against = "the surface turns away to a cosine of " + number_text(least, 3) + ", wanted " +
                number_text(o.margin, 3);
    return m;
  }
};

}  // namespace

ObjectiveMeasure measured(const FitObjective& objective, const Blend& blend, const Vec2& lengths) {
  return std::visit(Measurer{blend, lengths}, objective);
}

}  // namespace blendwright::detail
