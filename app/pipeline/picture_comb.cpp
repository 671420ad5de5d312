#include "app/pipeline/picture_comb.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "kernel/field/scalar_field.hpp"
#include "kernel/geometry/curvature.hpp"

namespace blendwright {
namespace {

constexpr double typical_hair = 0.12, longest_hair = 0.25;  // of the object's size
constexpr std::uint32_t none = std::numeric_limits<std::uint32_t>::max();
constexpr double nan = std::numeric_limits<double>::quiet_NaN();
const Colour hair_colour{0.13, 0.35, 0.62}, envelope_colour{0.80, 0.15, 0.15};

/// A point of a cut: on an edge of the mesh, with its interpolated normal.
struct CutPoint {
  Vec3 point, normal;
};
using EdgeKey = std::pair<std::uint32_t, std::uint32_t>;

/// The cut of a mesh with the plane x_k = at as chains of points.
class PlaneCut {
 public:
  PlaneCut(const TriMesh& mesh, int k, double at) : mesh_(mesh), k_(k), at_(at) {
    for (const auto& t : mesh.triangles) {
      std::vector<EdgeKey> crossed;
      for (std::size_t i = 0; i < 3; ++i)
        if (above(t[i]) != above(t[(i + 1) % 3])) crossed.push_back(std::minmax(t[i], t[(i + 1) % 3]));
      if (crossed.size() != 2) continue;
      next_[crossed[0]].push_back(crossed[1]);
      next_[crossed[1]].push_back(crossed[0]);
    }
  }

  /// Open chains first, from one of their ends; then closed ones.
  std::vector<std::pair<std::vector<CutPoint>, bool>> chains() {
    std::vector<std::pair<std::vector<CutPoint>, bool>> found;
    for (const bool open : {true, false})
      for (const auto& [edge, neighbours] : next_)
        if (!used_[edge] && (!open || neighbours.size() == 1)) found.push_back(chain_from(edge));
    return found;
  }

 private:
  [[nodiscard]] bool above(std::uint32_t i) const { return mesh_.points[i][k_] > at_; }

  [[nodiscard]] CutPoint at(const EdgeKey& edge) const {
    const Vec3 &a = mesh_.points[edge.first], &b = mesh_.points[edge.second];
    const double w = (at_ - a[k_]) / (b[k_] - a[k_]);
    return {a + w * (b - a),
            (mesh_.normals[edge.first] + w * (mesh_.normals[edge.second] - mesh_.normals[edge.first]))
                .normalized()};
  }

  std::pair<std::vector<CutPoint>, bool> chain_from(const EdgeKey& first) {
    std::vector<CutPoint> points;
    bool closed = false;
    EdgeKey edge = first;
    for (;;) {
      used_[edge] = true;
      points.push_back(at(edge));
      const EdgeKey* following = nullptr;
      for (const EdgeKey& n : next_[edge]) {
        if (!used_[n]) following = &n;
        if (n == first && points.size() > 2) closed = true;
      }
      if (!following) return {std::move(points), closed};
      edge = *following;
    }
  }

  const TriMesh& mesh_;
  int k_;
  double at_;
  std::map<EdgeKey, std::vector<EdgeKey>> next_;
  std::map<EdgeKey, bool> used_;
};

/// Points at equal steps of arc length.
CombLine resampled(std::vector<CutPoint> chain, bool closed, double step) {
  CombLine line;
  line.closed = closed;
  if (closed) chain.push_back(chain.front());
  std::vector<double> s{0.0};
  for (std::size_t i = 1; i < chain.size(); ++i)
    s.push_back(s.back() + (chain[i].point - chain[i - 1].point).norm());
  const auto steps = static_cast<std::size_t>(std::lround(s.back() / step));
  if (steps < 3) return line;
  const std::size_t count = closed ? steps : steps + 1;
  std::size_t k = 0;
  for (std::size_t i = 0; i < count; ++i) {
    const double wanted = s.back() * static_cast<double>(i) / static_cast<double>(steps);
    while (k + 2 < s.size() && s[k + 1] < wanted) ++k;
    const double length = s[k + 1] - s[k], w = length > 0.0 ? (wanted - s[k]) / length : 0.0;
    line.points.push_back(chain[k].point + w * (chain[k + 1].point - chain[k].point));
    line.normals.push_back((chain[k].normal + w * (chain[k + 1].normal - chain[k].normal)).normalized());
  }
  return line;
}

/// Tangent and step at point i, by central differences.
struct Neighbours {
  std::size_t before, after;
};
Neighbours neighbours(const CombLine& line, std::size_t i) {
  const std::size_t n = line.points.size();
  if (line.closed) return {(i + n - 1) % n, (i + 1) % n};
  return {i == 0 ? 0 : i - 1, i + 1 == n ? i : i + 1};
}

/// k = dn/ds . t: a convex surface's normals spread.
void curvature_of_normals(CombLine& line) {
  for (std::size_t i = 0; i < line.points.size(); ++i) {
    const auto [a, b] = neighbours(line, i);
    const Vec3 d = line.points[b] - line.points[a];
    line.curvature.push_back((line.normals[b] - line.normals[a]).dot(d) / d.squaredNorm());
  }
}

/// With g the gradient, H the second derivatives and t the tangent, k = -sense t.H t/|g|; normals become
/// -sense g/|g|.
void curvature_of_field(CombLine& line, const ScalarField& field) {
  const FieldValues values = field.evaluate(Order::hessian, line.points);
  const double side = sense(field.level());
  for (std::size_t i = 0; i < line.points.size(); ++i) {
    const auto [a, b] = neighbours(line, i);
    const Vec3 g = values.gradient(i);
    const std::array<double, 6> h = values.hessian(i);
    if (!(g.norm() > 0.0) || !g.allFinite()) {
      line.curvature.push_back(nan);
      continue;
    }
    const Vec3 n = -side * g / g.norm();
    Vec3 t = line.points[b] - line.points[a];
    t = (t - t.dot(n) * n).normalized();
    const double tHt = h[0] * t.x() * t.x() + h[1] * t.y() * t.y() + h[2] * t.z() * t.z() +
                       2.0 * (h[3] * t.x() * t.y() + h[4] * t.x() * t.z() + h[5] * t.y() * t.z());
    line.normals[i] = n;
    line.curvature.push_back(-side * tHt / g.norm());
  }
}

double percentile(std::vector<double> values, double part) {
  if (values.empty()) return 0.0;
  const auto i = static_cast<std::ptrdiff_t>(part * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), values.begin() + i, values.end());
  return values[static_cast<std::size_t>(i)];
}

/// The largest of 1, 2, 5 times a power of ten that is at most x > 0.
double round_below(double x) {
  const double power = std::pow(10.0, std::floor(std::log10(x)));
  const double digit = x / power;
  return power * (digit >= 5.0 ? 5.0 : digit >= 2.0 ? 2.0 : 1.0);
}

void add_line(Comb& comb, const CombLine& line, double size) {
  std::uint32_t previous = none, first = none;
  for (std::size_t i = 0; i < line.points.size(); ++i) {
    const double k = line.curvature[i];
    if (!std::isfinite(k)) {
      previous = none;
      continue;
    }
    const double length =
        std::clamp((comb.inward ? -1.0 : 1.0) * comb.scale * k, -longest_hair * size, longest_hair * size);
    const auto root = static_cast<std::uint32_t>(comb.hairs.mesh.points.size());
    const auto tip = static_cast<std::uint32_t>(comb.envelope.mesh.points.size());
    comb.hairs.mesh.points.push_back(line.points[i]);
    comb.hairs.mesh.points.push_back(line.points[i] + length * line.normals[i]);  // (1)
    comb.hairs.edges.push_back({root, root + 1});
    comb.envelope.mesh.points.push_back(comb.hairs.mesh.points.back());
    if (previous != none) comb.envelope.edges.push_back({previous, tip});
    previous = tip;
    if (i == 0) first = tip;
  }
  if (line.closed && previous != none && first != none) comb.envelope.edges.push_back({previous, first});
}

}  // namespace

std::vector<CombLine> comb_across(const Surface& surface, std::size_t lines, std::size_t hairs,
                                  double outward) {
  const SurfaceDomain domain = surface.domain();
  const std::size_t last = domain.v_closed ? lines : lines - 1;
  std::vector<CombLine> all;
  for (std::size_t j = 0; j < lines; ++j) {
    CombLine line;
    const double v = domain.v.at(static_cast<double>(j) / static_cast<double>(last));
    for (std::size_t i = 0; i <= hairs; ++i) {
      const SurfaceJet jet =
          surface.jet({domain.u.at(static_cast<double>(i) / static_cast<double>(hairs)), v});
      const Vec3 n = outward * unit_normal(jet);
      line.points.push_back(jet.S);
      line.normals.push_back(n);
      line.curvature.push_back(n.isZero(0.0) ? nan : -normal_curvature(jet, jet.Su, n));
    }
    all.push_back(std::move(line));
  }
  return all;
}

std::vector<CombLine> comb_of_sections(const std::vector<const TriMesh*>& meshes, std::size_t planes,
                                       std::size_t hairs, const ScalarField* field) {
  Vec3 lo = Vec3::Constant(std::numeric_limits<double>::max()), hi = -lo;
  for (const TriMesh* mesh : meshes)
    for (const Vec3& p : mesh->points) {
      lo = lo.cwiseMin(p);
      hi = hi.cwiseMax(p);
    }
  std::vector<CombLine> lines;
  if (!(lo.x() <= hi.x())) return lines;
  int k = 0;
  (hi - lo).maxCoeff(&k);
  const double step = (hi - lo).norm() / static_cast<double>(hairs);
  for (std::size_t j = 0; j < planes; ++j) {
    // Between the ends, and never at a round place, where meshes have whole rows of points.
    const double at = lo[k] + (hi - lo)[k] * (static_cast<double>(j) + 0.5017) / static_cast<double>(planes);
    for (const TriMesh* mesh : meshes) {
      if (mesh->normals.empty()) continue;
      for (auto& [chain, closed] : PlaneCut(*mesh, k, at).chains()) {
        CombLine line = resampled(std::move(chain), closed, step);
        if (line.points.empty()) continue;
        if (field)
          curvature_of_field(line, *field);
        else
          curvature_of_normals(line);
        lines.push_back(std::move(line));
      }
    }
  }
  return lines;
}

Comb comb_of(const std::vector<CombLine>& lines, double size) {
  Comb comb;
  std::vector<double> magnitudes;
  double sum = 0.0;
  bool any = false;
  for (const CombLine& line : lines)
    for (const double k : line.curvature) {
      if (!std::isfinite(k)) continue;
      magnitudes.push_back(std::abs(k));
      sum += k;
      comb.least = any ? std::min(comb.least, k) : k;
      comb.most = any ? std::max(comb.most, k) : k;
      any = true;
    }
  comb.hairs.edge_colour = hair_colour;
  comb.envelope.edge_colour = envelope_colour;
  comb.envelope.edge_width = 1.6;
  const double typical = percentile(magnitudes, 0.98);
  if (!(typical > 0.0)) return comb;
  comb.scale = typical_hair * size / typical;
  comb.shown = round_below(typical);
  comb.inward = sum < 0.0;
  for (const CombLine& line : lines) add_line(comb, line, size);
  return comb;
}

}  // namespace blendwright
