#include "tests/implicit/scenes/rays.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <stdexcept>

namespace blendwright::test {
namespace {

/// Even directions and their neighbours: an icosahedron, subdivided five times.
struct Icosphere {
  std::vector<Vec3> directions;
  std::vector<std::vector<std::uint32_t>> neighbours;
};

using Triangles = std::vector<std::array<std::uint32_t, 3>>;

Triangles icosahedron(std::vector<Vec3>& points) {
  const double g = std::numbers::phi;
  for (const auto& [a, b] : {std::pair{-1.0, g}, {1.0, g}, {-1.0, -g}, {1.0, -g}}) {
    points.push_back(Vec3(a, b, 0).normalized());
    points.push_back(Vec3(0, a, b).normalized());
    points.push_back(Vec3(b, 0, a).normalized());
  }
  Triangles faces;  // every triple at the edge length
  const auto near = [&](std::size_t i, std::size_t j) { return points[i].dot(points[j]) > 0.4; };
  for (std::uint32_t i = 0; i < 12; ++i)
    for (std::uint32_t j = i + 1; j < 12; ++j)
      for (std::uint32_t k = j + 1; k < 12; ++k)
        if (near(i, j) && near(j, k) && near(i, k)) faces.push_back({i, j, k});
  return faces;
}

Triangles subdivided(const Triangles& faces, std::vector<Vec3>& points) {
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> middles;
  const auto middle = [&](std::uint32_t a, std::uint32_t b) {
    const auto [place, fresh] =
        middles.try_emplace(std::minmax(a, b), static_cast<std::uint32_t>(points.size()));
    if (fresh) points.push_back((points[a] + points[b]).normalized());
    return place->second;
  };
  Triangles finer;
  for (const auto& [a, b, c] : faces) {
    const std::uint32_t ab = middle(a, b), bc = middle(b, c), ca = middle(c, a);
    finer.insert(finer.end(), {{a, ab, ca}, {b, bc, ab}, {c, ca, bc}, {ab, bc, ca}});
  }
  return finer;
}

const Icosphere& icosphere() {
  static const Icosphere sphere = [] {
    Icosphere s;
    Triangles faces = icosahedron(s.directions);
    for (int level = 0; level < 5; ++level) faces = subdivided(faces, s.directions);
    s.neighbours.resize(s.directions.size());
    for (const auto& f : faces)
      for (std::size_t i = 0; i < 3; ++i) s.neighbours[f[i]].push_back(f[(i + 1) % 3]);
    return s;
  }();
  return sphere;
}

/// Points of the sphere at an angle around each of the directions, `count` per direction.
std::vector<Vec3> around(std::span<const Peak> peaks, std::span<const double> angles, int count) {
  std::vector<Vec3> points;
  for (std::size_t i = 0; i < peaks.size(); ++i) {
    const Vec3& d = peaks[i].direction;
    const Vec3 u = d.unitOrthogonal(), v = d.cross(u);
    for (int k = 0; k < count; ++k) {
      const double t = 2.0 * std::numbers::pi * k / count;
      points.push_back(
          (std::cos(angles[i]) * d + std::sin(angles[i]) * (std::cos(t) * u + std::sin(t) * v)).normalized());
    }
  }
  return points;
}

/// Climbs from every start to its maximum by pattern search.
void climb(const PointFunction& height, std::vector<Peak>& peaks) {
  constexpr int pattern = 12;
  std::vector<double> step(peaks.size(), 0.03);
  for (int round = 0; round < 400 && *std::max_element(step.begin(), step.end()) > 1e-8; ++round) {
    const std::vector<Vec3> tries = around(peaks, step, pattern);
    const std::vector<double> found = height(tries);
    for (std::size_t i = 0; i < peaks.size(); ++i) {
      const auto first = found.begin() + static_cast<std::ptrdiff_t>(i * pattern);
      const auto best = std::max_element(first, first + pattern);
      if (*best > peaks[i].height)
        peaks[i] = {tries[static_cast<std::size_t>(best - found.begin())], *best};
      else
        step[i] *= 0.5;
    }
  }
}

/// Refined maxima among neighbours; those that climbed to the same place (1e-3 rad) are one.
std::vector<Peak> local_maxima(const PointFunction& height) {
  const Icosphere& sphere = icosphere();
  const std::vector<double> at = height(sphere.directions);
  std::vector<Peak> peaks;
  for (std::size_t i = 0; i < at.size(); ++i)
    if (std::all_of(sphere.neighbours[i].begin(), sphere.neighbours[i].end(),
                    [&](std::uint32_t j) { return at[i] >= at[j]; }))
      peaks.push_back({sphere.directions[i], at[i]});
  climb(height, peaks);
  std::vector<Peak> distinct;
  for (const Peak& p : peaks) {
    const auto same = std::find_if(distinct.begin(), distinct.end(),
                                   [&](const Peak& q) { return (p.direction - q.direction).norm() < 1e-3; });
    if (same == distinct.end())
      distinct.push_back(p);
    else if (p.height > same->height)
      *same = p;
  }
  return distinct;
}

}  // namespace

std::vector<double> radii(const PointFunction& depth, const Vec3& from, std::span<const Vec3> directions,
                          double reach) {
  std::vector<double> lo(directions.size(), 1e-6 * reach), hi(directions.size(), reach);
  std::vector<Vec3> points(directions.size());
  const auto at = [&](const std::vector<double>& r) {
    for (std::size_t i = 0; i < points.size(); ++i) points[i] = from + r[i] * directions[i];
    return depth(points);
  };
  for (const double d : at(lo))
    if (!(d > 0.0)) throw std::runtime_error("a ray does not start inside");
  for (const double d : at(hi))
    if (d > 0.0) throw std::runtime_error("a ray does not end outside");
  std::vector<double> middle(directions.size());
  for (int halving = 0; halving < 60; ++halving) {  // 2^-60: below the spacing of numbers
    for (std::size_t i = 0; i < middle.size(); ++i) middle[i] = 0.5 * (lo[i] + hi[i]);
    const std::vector<double> d = at(middle);
    for (std::size_t i = 0; i < middle.size(); ++i) (d[i] > 0.0 ? lo : hi)[i] = middle[i];
  }
  return middle;
}

double radius(const PointFunction& depth, const Vec3& from, const Vec3& direction, double reach) {
  const Vec3 unit = direction.normalized();
  return radii(depth, from, {&unit, 1}, reach)[0];
}

std::vector<double> section(const PointFunction& depth, double z, int count, double reach) {
  std::vector<Vec3> directions;
  for (int k = 0; k < count; ++k) {
    const double t = 2.0 * std::numbers::pi * k / count;
    directions.emplace_back(std::cos(t), std::sin(t), 0.0);
  }
  return radii(depth, {0.0, 0.0, z}, directions, reach);
}

int count_maxima(std::span<const double> periodic, double prominence) {
  const auto start =
      static_cast<std::size_t>(std::min_element(periodic.begin(), periodic.end()) - periodic.begin());
  int count = 0;
  double low = periodic[start], high = low;
  bool rising = true;  // towards the next maximum
  for (std::size_t k = 1; k <= periodic.size(); ++k) {
    const double r = periodic[(start + k) % periodic.size()];
    high = std::max(high, r);
    low = std::min(low, r);
    if (rising && high - r > prominence) {
      if (high - low > prominence) ++count;
      rising = false;
      low = r;
    } else if (!rising && r - low > prominence) {
      rising = true;
      high = r;
    }
  }
  return count;
}

double area(std::span<const double> radii) {
  // Half the sum of r^2 over even angles: the trapezoid rule of a periodic function.
  double sum = 0.0;
  for (const double r : radii) sum += r * r;
  return std::numbers::pi * sum / static_cast<double>(radii.size());
}

std::vector<Peak> isolated_maxima(const PointFunction& height) {
  const std::vector<Peak> peaks = local_maxima(height);
  // On a ridge of equal height the circle comes within pi / 256 of its radius to the ridge, where a ridge
  // with a cross curvature of its own height has fallen by 3e-8; a peak as round has fallen by 2e-4.
  constexpr int circle = 256;
  const std::vector<double> ring = height(around(peaks, std::vector<double>(peaks.size(), 0.02), circle));
  std::vector<Peak> alone;
  for (std::size_t i = 0; i < peaks.size(); ++i) {
    const auto first = ring.begin() + static_cast<std::ptrdiff_t>(i * circle);
    if (*std::max_element(first, first + circle) < peaks[i].height - 1e-6 * std::abs(peaks[i].height))
      alone.push_back(peaks[i]);
  }
  return alone;
}

Peak highest(const PointFunction& height) {
  const std::vector<Peak> peaks = local_maxima(height);
  return *std::max_element(peaks.begin(), peaks.end(),
                           [](const Peak& a, const Peak& b) { return a.height < b.height; });
}

Peak lowest(const PointFunction& height) {
  Peak peak = highest([&](std::span<const Vec3> directions) {
    std::vector<double> h = height(directions);
    for (double& x : h) x = -x;
    return h;
  });
  peak.height = -peak.height;
  return peak;
}

}  // namespace blendwright::test
