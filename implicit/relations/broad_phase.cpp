#define BOOST_ALLOW_DEPRECATED_HEADERS  // some of Boost.Geometry's own headers include others that say so
#include "implicit/relations/broad_phase.hpp"

#include <algorithm>
#include <boost/geometry/geometries/box.hpp>
#include <boost/geometry/geometries/point.hpp>
#include <boost/geometry/index/rtree.hpp>
#include <iterator>

namespace blendwright::detail {
namespace {

namespace bg = boost::geometry;
using Corner = bg::model::point<double, 3, bg::cs::cartesian>;
using TreeBox = bg::model::box<Corner>;
using Entry = std::pair<TreeBox, std::size_t>;

TreeBox tree_box(const Box& b) {
  return {Corner(b.lo.x(), b.lo.y(), b.lo.z()), Corner(b.hi.x(), b.hi.y(), b.hi.z())};
}

constexpr double round_off = std::numeric_limits<double>::epsilon();

/// What `box` has in common with the box of the part of it that lies in `solid`.
std::optional<Box> clipped(const Box& box, const OrientedBox& solid) {
  const Vec3 c = solid.axes.transpose() * (box.centre() - solid.centre);
  const Vec3 h = solid.axes.transpose().cwiseAbs() * (0.5 * box.size());
  const Vec3 slack = Vec3::Constant((32.0 * round_off + solid.uncertainty) *
                                    (box.lo.cwiseAbs().cwiseMax(box.hi.cwiseAbs()).sum() +
                                     solid.centre.cwiseAbs().sum() + solid.half.sum()));
  const auto own = common({c - h - slack, c + h + slack}, {-solid.half, solid.half});
  if (!own) return std::nullopt;
  const Vec3 back = solid.centre + solid.axes * own->centre();
  const Vec3 reach = solid.axes.cwiseAbs() * (0.5 * own->size()) + slack;
  return common(box, {back - reach, back + reach});
}

}  // namespace

std::vector<std::pair<std::size_t, std::size_t>> meeting_boxes(std::span<const Box> boxes) {
  std::vector<Entry> entries;
  entries.reserve(boxes.size());
  for (std::size_t i = 0; i < boxes.size(); ++i) entries.emplace_back(tree_box(boxes[i]), i);
  const bg::index::rtree<Entry, bg::index::rstar<16>> tree(entries);  // packed: all entries at once
  std::vector<std::pair<std::size_t, std::size_t>> pairs;
  std::vector<Entry> found;
  for (const auto& [box, i] : entries) {
    found.clear();
    tree.query(bg::index::intersects(box), std::back_inserter(found));
    for (const Entry& other : found)
      if (i < other.second) pairs.emplace_back(i, other.second);
  }
  std::ranges::sort(pairs);
  return pairs;
}

OrientedBox moved(const Box& box, const RigidMotion& motion) {
  const double uncertainty =
      4.0 * (motion.R.transpose() * motion.R - Eigen::Matrix3d::Identity()).cwiseAbs().maxCoeff();
  const double size = box.centre().cwiseAbs().sum() + box.size().sum() + motion.t.cwiseAbs().sum();
  return {motion(box.centre()), motion.R,
          0.5 * box.size() + Vec3::Constant((32.0 * round_off + uncertainty) * size), uncertainty};
}

bool apart(const OrientedBox& a, const OrientedBox& b) {
  // In the coordinates of a: b's axes are the columns of R, its centre is t.
  const Eigen::Matrix3d R = a.axes.transpose() * b.axes;
  const Vec3 t = a.axes.transpose() * (b.centre - a.centre);
  const double slack = (64.0 * round_off + a.uncertainty + b.uncertainty) *
                       (a.centre.cwiseAbs().sum() + b.centre.cwiseAbs().sum() + a.half.sum() + b.half.sum());
  const Eigen::Matrix3d M = R.cwiseAbs();
  const Vec3 along_a = a.half + M * b.half, along_b = b.half + M.transpose() * a.half;
  if ((t.cwiseAbs().array() > along_a.array() + slack).any()) return true;
  if (((R.transpose() * t).cwiseAbs().array() > along_b.array() + slack).any()) return true;
  // The axes e_i x R e_j; unit vectors at most, so one slack serves them all.
  for (int i = 0; i < 3; ++i) {
    const int i1 = (i + 1) % 3, i2 = (i + 2) % 3;
    for (int j = 0; j < 3; ++j) {
      const int j1 = (j + 1) % 3, j2 = (j + 2) % 3;
      const double distance = std::abs(t[i2] * R(i1, j) - t[i1] * R(i2, j));
      const double reach =
          a.half[i1] * M(i2, j) + a.half[i2] * M(i1, j) + b.half[j1] * M(i, j2) + b.half[j2] * M(i, j1);
      if (distance > reach + slack) return true;
    }
  }
  return false;
}

std::optional<Box> common_box(const Box& box, const OrientedBox& a, const OrientedBox& b) {
  const std::optional<Box> first = clipped(box, a);
  return first ? clipped(*first, b) : std::nullopt;
}

}  // namespace blendwright::detail
