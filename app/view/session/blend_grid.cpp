#include "app/view/session/blend_grid.hpp"

#include <algorithm>

#include "kernel/base/parallel_for.hpp"
#include "kernel/geometry/curvature.hpp"
#include "verify/continuity/seam_probe.hpp"

namespace blendwright {
namespace {

double fraction(std::size_t i, std::size_t count) {
  return static_cast<double>(i) / static_cast<double>(count - 1);
}

/// The rows of (1) at one v, and the line taken off, each with its derivative along v.
struct Section {
  std::array<Vec3, 6> row{}, row_v{};
  std::array<Vec3, 2> line{Vec3::Zero(), Vec3::Zero()}, line_v{Vec3::Zero(), Vec3::Zero()};
};

Section section_at(const OdeBlend& blend, double v) {
  Section s;
  const BlendShape& shape = blend.shape();
  const int half = blend.order() / 2;
  for (int side = 0; side < 2; ++side) {
    const SurfacePartials P = blend.partials({static_cast<double>(side), v});
    for (int k = 0; k < half; ++k) {
      const auto at = static_cast<std::size_t>(side * half + k);
      s.row[at] = P(k, 0);
      s.row_v[at] = P(k, 1);
    }
    if (shape.mode == BlendMode::chord) s.line_v[static_cast<std::size_t>(side)] = P(0, 1);
    if (shape.mode == BlendMode::chord) s.line[static_cast<std::size_t>(side)] = P(0, 0);
    if (shape.mode == BlendMode::anchor) s.line[static_cast<std::size_t>(side)] = shape.anchor;
  }
  const Vec3 slope = s.line[1] - s.line[0], slope_v = s.line_v[1] - s.line_v[0];
  for (std::size_t side = 0; side < 2; ++side) {
    const std::size_t at = side * static_cast<std::size_t>(half);
    s.row[at] -= s.line[side];
    s.row_v[at] -= s.line_v[side];
    s.row[at + 1] -= slope;
    s.row_v[at + 1] -= slope_v;
  }
  const Eigen::Matrix3d turn = shape.axes.transpose();
  if (shape.frame == BlendFrame::fixed)
    for (std::size_t k = 0; k < 6; ++k) {
      s.row[k] = turn * s.row[k];
      s.row_v[k] = turn * s.row_v[k];
    }
  return s;
}

void put(const Vec3& S, const Vec3& n, std::size_t point, SessionGrid& grid) {
  for (std::size_t x = 0; x < 3; ++x) {
    const auto axis = static_cast<Eigen::Index>(x);
    grid.positions[3 * point + x] = static_cast<float>(S[axis] - grid.origin[axis]);
    grid.normals[3 * point + x] = static_cast<float>(n[axis]);
  }
}

void fill_separable(const OdeBlend& blend, const std::vector<Section>& sections, std::size_t i,
                    SessionGrid& grid) {
  const double u = fraction(i, grid.nu);
  const bool turned = blend.shape().frame == BlendFrame::fixed;
  const auto order = static_cast<std::size_t>(blend.order());
  const std::array<CardinalValues, 3> phi = blend.cardinals(u);
  std::array<Vec3, 6> value, slope;
  for (std::size_t k = 0; k < order; ++k) {
    value[k] = {phi[0].value[0][k], phi[1].value[0][k], phi[2].value[0][k]};
    slope[k] = {phi[0].value[1][k], phi[1].value[1][k], phi[2].value[1][k]};
  }
  for (std::size_t j = 0; j < grid.nv; ++j) {
    const Section& s = sections[j];
    Vec3 S = Vec3::Zero(), Su = Vec3::Zero(), Sv = Vec3::Zero();
    for (std::size_t k = 0; k < order; ++k) {
      S += value[k].cwiseProduct(s.row[k]);
      Su += slope[k].cwiseProduct(s.row[k]);
      Sv += value[k].cwiseProduct(s.row_v[k]);
    }
    if (turned) {
      const Eigen::Matrix3d& axes = blend.shape().axes;
      S = axes * S;
      Su = axes * Su;
      Sv = axes * Sv;
    }
    SurfaceJet jet;
    jet.S = S + (1.0 - u) * s.line[0] + u * s.line[1];
    jet.Su = Su + s.line[1] - s.line[0];
    jet.Sv = Sv + (1.0 - u) * s.line_v[0] + u * s.line_v[1];
    put(jet.S, unit_normal(jet), i * grid.nv + j, grid);
  }
}

struct SeamFigures {
  double gap = 0.0, angle = 0.0, curvature = 0.0;
};

std::vector<SeamFigures> measured(const Seam& seam, const Interval& v, std::size_t count) {
  std::vector<SeamFigures> all(count);
  if (!seam.primary) return all;
  const detail::SeamProbe probe(seam);
  parallel_for(count, 16, [&](std::size_t begin, std::size_t end) {
    for (std::size_t j = begin; j < end; ++j) {
      const detail::SeamSample s = probe.measure(v.at(fraction(j, count)), std::nullopt);
      all[j] = {s.gap, Radians(s.angle).degrees(), s.curvature};
    }
  });
  return all;
}

void fill_errors(const std::array<Seam, 2>& seams, const Interval& v, SessionGrid& grid) {
  const std::vector<SeamFigures> from = measured(seams[0], v, grid.nv), to = measured(seams[1], v, grid.nv);
  parallel_for(grid.nu, 16, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const double u = fraction(i, grid.nu);
      const auto mixed = [&](double a, double b) { return static_cast<float>((1.0 - u) * a + u * b); };
      for (std::size_t j = 0; j < grid.nv; ++j) {
        const std::size_t point = i * grid.nv + j;
        grid.gap[point] = mixed(from[j].gap, to[j].gap);
        grid.angle_deg[point] = mixed(from[j].angle, to[j].angle);
        grid.curvature_jump[point] = mixed(from[j].curvature, to[j].curvature);
      }
    }
  });
}

}  // namespace

void fill_grid(const OdeBlend& blend, const std::array<Seam, 2>& seams, SessionGrid& grid) {
  const std::size_t points = grid.nu * grid.nv;
  grid.positions.resize(3 * points);
  grid.normals.resize(3 * points);
  for (auto* column : {&grid.gap, &grid.angle_deg, &grid.curvature_jump}) column->resize(points);
  const Interval v = blend.domain().v;
  grid.origin = blend.jet({0.5, v.at(0.5)}).S;
  std::vector<Section> sections(blend.separable() ? grid.nv : 0);
  parallel_for(sections.size(), 16, [&](std::size_t begin, std::size_t end) {
    for (std::size_t j = begin; j < end; ++j) sections[j] = section_at(blend, v.at(fraction(j, grid.nv)));
  });
  parallel_for(grid.nu, 8, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      if (blend.separable()) {
        fill_separable(blend, sections, i, grid);
        continue;
      }
      for (std::size_t j = 0; j < grid.nv; ++j) {
        const SurfaceJet jet = blend.jet({fraction(i, grid.nu), v.at(fraction(j, grid.nv))});
        put(jet.S, unit_normal(jet), i * grid.nv + j, grid);
      }
    }
  });
  fill_errors(seams, v, grid);
}

}  // namespace blendwright
