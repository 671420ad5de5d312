#include "verify/surface/body_deviation.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <queue>

#include "kernel/base/parallel_for.hpp"

namespace blendwright {
namespace {

using Weights = std::array<double, 3>;
constexpr std::size_t block = 4096;

/// One place of A, with the part of A's area that it stands for.
struct Sample {
  std::uint32_t triangle = 0;
  Weights weights{};
  double area = 0.0;
  Vec3 at = Vec3::Zero();
  ResultBody::Foot foot{};
  [[nodiscard]] double value(bool signs) const {
    return signs && foot.side < 0.0 ? -foot.distance : foot.distance;
  }
};

double area_of(const std::array<Vec3, 3>& t) { return 0.5 * (t[1] - t[0]).cross(t[2] - t[0]).norm(); }

/// Middles of the n x n equal parts of every triangle, n by its area.
std::vector<Sample> spread(const ResultBody& body, std::size_t wanted) {
  const auto count = static_cast<std::uint32_t>(body.tree().mesh().triangles.size());
  double whole = 0.0;
  for (std::uint32_t i = 0; i < count; ++i) whole += area_of(body.tree().corners(i));
  const double part = whole / static_cast<double>(wanted);
  std::vector<Sample> samples;
  for (std::uint32_t i = 0; i < count; ++i) {
    const double area = area_of(body.tree().corners(i));
    const double cells = part > 0.0 ? std::ceil(std::sqrt(area / part)) : 1.0;
    const int n = static_cast<int>(std::clamp(cells, 1.0, 512.0));
    for (int a = 0; a < n; ++a)
      for (int b = 0; a + b < n; ++b) {
        const auto add = [&](double third) {
          const double v = (a + third) / n, w = (b + third) / n;
          samples.push_back({i, {1.0 - v - w, v, w}, area / (n * n), Vec3::Zero(), {}});
        };
        add(1.0 / 3.0);
        if (a + b + 1 < n) add(2.0 / 3.0);
      }
  }
  return samples;
}

/// One sample per point of the mesh that a triangle has; the others stay where they are and count for
/// nothing.
std::vector<Sample> corners_of(const ResultBody& body) {
  const TriMesh& mesh = body.tree().mesh();
  std::vector<Sample> samples(mesh.points.size());
  std::vector<bool> known(mesh.points.size(), false);
  for (std::uint32_t i = 0; i < mesh.triangles.size(); ++i)
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t point = mesh.triangles[i][k];
      if (known[point]) continue;
      known[point] = true;
      samples[point].triangle = i;
      samples[point].weights[k] = 1.0;
    }
  return samples;
}

void measure(std::vector<Sample>& samples, const ResultBody& from, const ResultBody& to,
             const Progress& progress, double begin, double end) {
  for (std::size_t done = 0; done < samples.size(); done += block) {
    const double part = static_cast<double>(done) / static_cast<double>(samples.size());
    progress.at(begin + part * (end - begin), "measuring distances");
    parallel_for(std::min(block, samples.size() - done), 64, [&](std::size_t first, std::size_t last) {
      for (std::size_t i = done + first; i < done + last; ++i) {
        Sample& s = samples[i];
        s.at = from.point_at(s.triangle, s.weights);
        s.foot = to.closest(s.at);
        if (!s.at.allFinite()) s.foot.distance = std::numeric_limits<double>::quiet_NaN();
      }
    });
  }
}

/// The larger; one that is not a number wins and stays.
bool worse(const Sample& a, const Sample& b) {
  return !std::isnan(b.foot.distance) && !(a.foot.distance <= b.foot.distance);
}

/// Climbs from a sample over the triangle's own parameters and those of its neighbours.
Sample climbed(Sample best, const ResultBody& from, const ResultBody& to) {
  const double sag = 4.0 * from.sag() + 1e-12 * from.tree().size();
  double step = 0.5;
  for (int halving = 0; halving < 20; ++halving, step *= 0.5)
    for (int k = 0; k < 6; ++k) {
      Sample next = best;
      const auto i = static_cast<std::size_t>(k / 2), j = (i + 1) % 3;
      const double move = k % 2 == 0 ? step : -step;
      next.weights[i] += move, next.weights[j] -= move;
      next.at = from.point_at(next.triangle, next.weights);
      // The parameters of a triangle go on beyond it: only as far as the trimmed face does.
      if (!next.at.allFinite() || from.tree().closest(next.at).distance > sag) continue;
      next.foot = to.closest(next.at);
      if (next.foot.distance > best.foot.distance) best = next;
    }
  return best;
}

/// A part of a triangle of A in the proof of (2) and (3).
struct Part {
  std::array<Vec3, 3> corners;
  std::array<std::uint32_t, 3> next;  ///< the triangles of B that the corners are closest to
  std::array<double, 3> distance;
  std::uint32_t triangle = 0;
  std::size_t order = 0;
  double bound = 0.0;
  bool operator<(const Part& other) const {
    return bound != other.bound ? bound < other.bound : order > other.order;
  }
};

double bound_of(const Part& part, const MeshTree& to) {
  double bound = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < 3; ++i) {
    double convex = 0.0, reach = 0.0;
    for (std::size_t k = 0; k < 3; ++k) {
      convex = std::max(convex, part.next[k] == part.next[i]
                                    ? part.distance[k]
                                    : to.closest_on(part.next[i], part.corners[k]).distance);
      reach = std::max(reach, (part.corners[i] - part.corners[k]).norm());
    }
    bound = std::min({bound, convex, part.distance[i] + reach});
  }
  return bound;
}

/// Halves triangles until h is known; leads `worst` on to it. Returns the bound that is left.
double prove(const ResultBody& from, const ResultBody& to, const std::vector<Sample>& corners,
             const DeviationOptions& options, const Progress& progress, Sample& worst) {
  const MeshTree &a = from.tree(), &b = to.tree();
  const auto count = static_cast<std::uint32_t>(a.mesh().triangles.size());
  std::vector<std::uint32_t> nearest(corners.size());
  parallel_for(corners.size(), 256, [&](std::size_t first, std::size_t last) {
    for (std::size_t i = first; i < last; ++i) nearest[i] = b.closest(corners[i].at).triangle;
  });
  std::vector<Part> parts(count);
  parallel_for(count, 256, [&](std::size_t first, std::size_t last) {
    for (std::size_t i = first; i < last; ++i) {
      Part& p = parts[i];
      p.triangle = static_cast<std::uint32_t>(i);
      p.corners = a.corners(p.triangle);
      p.order = i;
      for (std::size_t k = 0; k < 3; ++k) {
        const std::uint32_t point = a.mesh().triangles[i][k];
        p.next[k] = nearest[point];
        p.distance[k] = corners[point].foot.distance;
      }
      p.bound = bound_of(p, b);
    }
  });
  std::priority_queue<Part> open(std::less<Part>(), std::move(parts));
  // Rounding of coordinates; closer than that nothing is known of a distance.
  const double rounding = 1e-14 * (a.size() + b.size());
  std::size_t order = count;
  for (std::size_t halvings = 0; halvings < options.max_halvings; ++halvings) {
    const Part top = open.top();
    const double known = worst.foot.distance;
    if (top.bound <= known * (1.0 + 1e-6) + rounding) break;
    if (options.limit && (known > *options.limit || top.bound <= *options.limit) &&
        halvings > options.max_halvings / 8)
      break;
    if (halvings % block == 0) progress.at(0.9, "proving the largest distance");
    open.pop();
    std::size_t longest = 0;
    double length = -1.0;
    for (std::size_t k = 0; k < 3; ++k) {
      const double side = (top.corners[k] - top.corners[(k + 1) % 3]).squaredNorm();
      if (side > length) length = side, longest = k;
    }
    const std::size_t other = (longest + 1) % 3;
    const Vec3 middle = 0.5 * (top.corners[longest] + top.corners[other]);
    const MeshFoot foot = b.closest(middle);
    if (foot.distance > known) {
      worst.triangle = top.triangle;
      worst.at = middle;
      worst.foot = {foot.point, foot.distance, (middle - foot.point).dot(b.side_normal(foot))};
    }
    for (const std::size_t replaced : {longest, other}) {
      Part half = top;
      half.corners[replaced] = middle;
      half.next[replaced] = foot.triangle;
      half.distance[replaced] = foot.distance;
      half.order = order++;
      half.bound = std::min(top.bound, bound_of(half, b));
      open.push(half);
    }
  }
  return std::max(open.top().bound, worst.foot.distance) + rounding;
}

/// The value below which 95 % of the area lies.
double percentile(std::vector<Sample>& samples, double whole) {
  std::stable_sort(samples.begin(), samples.end(),
                   [](const Sample& a, const Sample& b) { return a.foot.distance < b.foot.distance; });
  double area = 0.0;
  for (const Sample& s : samples)
    if ((area += s.area) >= 0.95 * whole) return s.foot.distance;
  return samples.empty() ? 0.0 : samples.back().foot.distance;
}

}  // namespace

BodyDeviation deviation(const ResultBody& from, const ResultBody& to, const DeviationOptions& options,
                        const Progress& progress) {
  BodyDeviation result;
  result.signs = to.tree().oriented();
  std::vector<Sample> corners = corners_of(from), samples = spread(from, options.samples);
  measure(corners, from, to, progress, 0.0, 0.4);
  measure(samples, from, to, progress, 0.4, 0.8);
  Sample worst = samples.front();
  for (const auto* some : {&samples, &corners})
    for (const Sample& s : *some)
      if (worse(s, worst)) worst = s;
  const bool meshes = !from.has_surfaces() && !to.has_surfaces();
  if (std::isfinite(worst.foot.distance)) {
    if (meshes)
      result.proven = prove(from, to, corners, options, progress, worst);
    else
      worst = climbed(worst, from, to);
  }
  result.largest = worst.foot.distance;
  result.at = worst.at, result.foot = worst.foot.point;
  result.piece = from.name_of(worst.triangle);
  result.other_piece = to.name_of(to.tree().closest(worst.foot.point).triangle);

  result.samples = corners.size() + samples.size();
  result.least = result.most = worst.value(result.signs);
  for (const Sample& s : corners) {
    const double value = s.value(result.signs);
    result.at_points.push_back(value);
    result.least = std::min(result.least, value), result.most = std::max(result.most, value);
  }
  double whole = 0.0;
  for (const Sample& s : samples) {
    const double value = s.value(result.signs);
    result.least = std::min(result.least, value), result.most = std::max(result.most, value);
    whole += s.area;
    result.mean += s.area * s.foot.distance;
    result.rms += s.area * s.foot.distance * s.foot.distance;
    result.signed_mean += s.area * value;
  }
  if (whole > 0.0) {
    result.mean /= whole, result.signed_mean /= whole;
    result.rms = std::sqrt(result.rms / whole);
  }
  result.percentile95 = percentile(samples, whole);
  return result;
}

}  // namespace blendwright
