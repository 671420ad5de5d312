// Starts from the points alone: box and principal axes. A scan of one side shows half of the solid only: then
// the box is doubled beyond each of its faces in turn.
#include <algorithm>
#include <numbers>

#include "implicit/fit/fit_model.hpp"
#include "kernel/math/dense_solve.hpp"

namespace blendwright::detail {
namespace {

using Kind = FitNode::Kind;

struct Box3 {
  Vec3 centre, half;  ///< in the principal frame
};

/// The form that the points show: the solid's own, below placements, soft objects and ray scalings.
std::optional<std::size_t> single_form(const FitModel& model, std::optional<std::size_t>& place,
                                       double& level) {
  std::size_t i = model.nodes.size() - 1;
  level = 1.0;
  while (true) {
    const FitNode& n = model.nodes[i];
    if (n.kind == Kind::soft_blend) {
      if (n.of.size() != 1) return std::nullopt;
    } else if (n.kind == Kind::soft_object) {
      level = 0.5;
    } else if (n.kind == Kind::place) {
      if (place) return std::nullopt;
      place = i;
    } else if (n.kind != Kind::ray_scaling) {
      return i;
    }
    i = n.of[0];
  }
}

Box3 box_in(const Eigen::Matrix3d& axes, std::span<const Vec3> points) {
  Box3 box{};
  for (Eigen::Index k = 0; k < 3; ++k) {
    std::vector<double> along;
    along.reserve(points.size());
    for (const Vec3& p : points) along.push_back(p.dot(axes.col(k)));
    std::sort(along.begin(), along.end());  // the outermost hundredth may be noise
    const std::size_t skip = along.size() / 100;
    const double lo = along[skip], hi = along[along.size() - 1 - skip];
    box.centre[k] = 0.5 * (lo + hi);
    box.half[k] = std::max(0.5 * (hi - lo), 1e-9);
  }
  return box;
}

double median(std::vector<double> x) {
  const auto middle = x.begin() + static_cast<std::ptrdiff_t>(x.size() / 2);
  std::nth_element(x.begin(), middle, x.end());
  return *middle;
}

/// Without those that are more than 2.5 times as far from the median point as half of the points are: on
/// forms up to 2.5 times as long as wide none is.
std::vector<Vec3> without_outliers(std::span<const Vec3> points) {
  Vec3 centre;
  for (Eigen::Index k = 0; k < 3; ++k) {
    std::vector<double> along;
    for (const Vec3& p : points) along.push_back(p[k]);
    centre[k] = median(std::move(along));
  }
  std::vector<double> distances;
  for (const Vec3& p : points) distances.push_back((p - centre).norm());
  const double most = 2.5 * median(distances);
  std::vector<Vec3> kept;
  for (std::size_t i = 0; i < points.size(); ++i)
    if (distances[i] <= most) kept.push_back(points[i]);
  return kept;
}

/// Columns: directions of x, y and z of the form, z along principal axis k.
Eigen::Matrix3d frame(const Eigen::Matrix3d& axes, Eigen::Index k) {
  Eigen::Matrix3d R;
  R.col(0) = axes.col((k + 1) % 3);
  R.col(1) = axes.col((k + 2) % 3);
  R.col(2) = R.col(0).cross(R.col(1));
  return R;
}

void set_axes(FitStart& start, const FitNode& form, const Vec3& half) {
  for (std::size_t k = 0; k < 3; ++k) {
    const double h = half[static_cast<Eigen::Index>(k)];
    if (form.kind == Kind::form_asymmetric)
      start.values[form.slot + 2 * k] = start.values[form.slot + 2 * k + 1] = h;
    else
      start.values[form.slot + k] = h;
  }
  const std::size_t first = form.slot + (form.kind == Kind::form_asymmetric ? 6 : 3),
                    powers = form.kind == Kind::form_superquadric ? 2 : 1;
  for (std::size_t i = 0; i < powers; ++i) start.values[first + i] = 2.0;
}

}  // namespace

std::vector<FitStart> starts_from_points(const FitModel& model, std::span<const Vec3> all, bool outliers) {
  const std::vector<Vec3> points =
      outliers ? without_outliers(all) : std::vector<Vec3>(all.begin(), all.end());
  std::optional<std::size_t> place;
  double level = 1.0;
  const auto form = single_form(model, place, level);
  if (!form || !place) return {};
  Vec3 mean = Vec3::Zero();
  for (const Vec3& p : points) mean += p;
  mean /= static_cast<double>(points.size());
  Eigen::MatrixXd spread(static_cast<Eigen::Index>(points.size()), 3);
  for (std::size_t i = 0; i < points.size(); ++i)
    spread.row(static_cast<Eigen::Index>(i)) = (points[i] - mean).transpose();
  Eigen::Matrix3d axes = singular_values(spread).V;
  if (axes.determinant() < 0.0) axes.col(2) *= -1.0;
  const Box3 box = box_in(axes, points);

  const FitNode& f = model.nodes[*form];
  std::vector<FitStart> starts;
  for (int doubled = -1; doubled < 6; ++doubled) {
    Box3 b = box;
    if (doubled >= 0) {
      const Eigen::Index k = doubled / 2;
      b.centre[k] += doubled % 2 == 0 ? b.half[k] : -b.half[k];
      b.half[k] *= 2.0;
    }
    for (Eigen::Index k = 0; k < (f.kind == Kind::form_superquadric ? 3 : 1); ++k)
      for (const double about_z : {0.0, 0.25 * std::numbers::pi}) {
        FitStart start{model, {}};
        for (const FitSlot& slot : model.slots) start.values.push_back(slot.value);
        const Vec3 half(b.half[(k + 1) % 3], b.half[(k + 2) % 3], b.half[k]);
        set_axes(start, f, half / (level * start.values[model.nodes[*place].slot + 6]));
        FitNode& at = start.model.nodes[*place];
        at.turn = frame(axes, k) * Eigen::AngleAxisd(about_z, Vec3::UnitZ()).toRotationMatrix();
        const Vec3 centre = axes * b.centre;
        for (std::size_t i = 0; i < 3; ++i) start.values[at.slot + i] = centre[static_cast<Eigen::Index>(i)];
        starts.push_back(std::move(start));
      }
  }
  return starts;
}

}  // namespace blendwright::detail
