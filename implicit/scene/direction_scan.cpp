#include "implicit/scene/direction_scan.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <queue>

namespace blendwright::detail {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

std::shared_ptr<const Tape> tape_of(const Node& node) {
  TapeBuilder builder;
  return builder.finish(node.emit(builder, Frame()));
}

/// Ray-linear distances may be compared at any distance from their origin; this one keeps the digits of a far
/// origin.
double comparing_distance(const Node& node) { return 1.0 + node.origin.cwiseAbs().maxCoeff(); }

std::vector<double> values(const Tape& tape, const Node& node, const std::vector<Vec3>& directions) {
  const double distance = comparing_distance(node);
  std::vector<double> x, y, z, out(directions.size());
  for (const Vec3& u : directions) {
    const Vec3 p = node.origin + distance * u;
    x.push_back(p.x());
    y.push_back(p.y());
    z.push_back(p.z());
  }
  tape.evaluate(Order::value, {x, y, z}, out);
  for (double& value : out) value /= distance;
  return out;
}

/// A Fibonacci lattice, the axes and all diagonals.
std::vector<Vec3> scan_directions() {
  constexpr int count = 2562;
  std::vector<Vec3> list;
  for (int i = 0; i < count; ++i) {
    const double z = 1.0 - (2.0 * i + 1.0) / count, rho = std::sqrt(1.0 - z * z);
    const double angle = i * std::numbers::pi * (3.0 - std::sqrt(5.0));
    list.emplace_back(rho * std::cos(angle), rho * std::sin(angle), z);
  }
  for (int k = 0; k < 27; ++k)
    if (k != 13) list.push_back(Vec3(k % 3 - 1, k / 3 % 3 - 1, k / 9 - 1).normalized());
  return list;
}

class Ratio {
 public:
  Ratio(const Node& a, const Node& b) : a_(a), b_(b), tape_a_(tape_of(a)), tape_b_(tape_of(b)) {}
  [[nodiscard]] std::vector<double> operator()(const std::vector<Vec3>& directions) const {
    const std::vector<double> above = values(*tape_a_, a_, directions);
    const std::vector<double> below = values(*tape_b_, b_, directions);
    std::vector<double> ratios;
    for (std::size_t i = 0; i < directions.size(); ++i)
      ratios.push_back(above[i] == below[i] ? 1.0 : below[i] == 0.0 ? infinity : above[i] / below[i]);
    return ratios;
  }

 private:
  const Node &a_, &b_;
  std::shared_ptr<const Tape> tape_a_, tape_b_;
};

struct Best {
  double value;  ///< sign * ratio, to be small
  Vec3 direction;
};

/// Walks downhill on the sphere in steps that shrink from the lattice's spacing to 1e-7. Along the bottom of
/// a crooked valley that could take millions of steps for the last digits: there it stops early.
Best refined(const Ratio& ratio, double sign, Best best) {
  constexpr int most_steps_downhill = 200;
  double step = 0.07;
  for (int k = 0; k < most_steps_downhill && step > 1e-7; ++k) {
    const Vec3 u = best.direction.unitOrthogonal(), v = best.direction.cross(u);
    std::vector<Vec3> around;
    for (int eighth = 0; eighth < 8; ++eighth) {
      const double angle = 0.25 * std::numbers::pi * eighth;
      around.push_back((best.direction + step * (std::cos(angle) * u + std::sin(angle) * v)).normalized());
    }
    const std::vector<double> found = ratio(around);
    const double before = best.value;
    for (std::size_t i = 0; i < around.size(); ++i)
      if (sign * found[i] < best.value) best = {sign * found[i], around[i]};
    if (!(best.value < before)) step *= 0.5;
  }
  return best;
}

/// The least sign * ratio: the best few of the lattice, refined.
Best extreme(const Ratio& ratio, double sign, const std::vector<Vec3>& directions,
             const std::vector<double>& ratios) {
  constexpr std::size_t starts = 4;
  std::vector<std::size_t> order(directions.size());
  for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
  std::ranges::partial_sort(order, order.begin() + starts, {},
                            [&](std::size_t i) { return std::pair(sign * ratios[i], i); });
  Best best{infinity, directions[order[0]]};
  for (std::size_t k = 0; k < starts; ++k) {
    const Best found = refined(ratio, sign, {sign * ratios[order[k]], directions[order[k]]});
    if (found.value < best.value) best = found;
  }
  best.value *= sign;
  return best;
}

// ---- Bounds ----------------------------------------------------------------------------------------------

/// A piece of a face of the cube [-1, 1]^3, and bounds of |X|/d(X) on it.
struct Piece {
  Box box;
  Range radius;
};

class RadiusBounds {
 public:
  explicit RadiusBounds(const Node& node) : node_(node), tape_(tape_of(node)) {}

  [[nodiscard]] Range operator()() {
    std::vector<Piece> faces;
    for (int axis = 0; axis < 3; ++axis)
      for (const double side : {-1.0, 1.0}) {
        Box box{Vec3::Constant(-1.0), Vec3::Constant(1.0)};
        box.lo[axis] = box.hi[axis] = side;
        faces.push_back(piece(box));
      }
    const auto below = [](const Piece& p) { return p.radius.lo; };
    const auto above = [](const Piece& p) { return -p.radius.hi; };
    // Ranges are rounded outward, but d is compared at another distance than it is used at.
    return Range{least(faces, below), -least(faces, above)}.widened(1e-9);
  }

 private:
  [[nodiscard]] Piece piece(const Box& box) const {
    const double distance = comparing_distance(node_);
    const Range d = tape_->range({node_.origin + distance * box.lo, node_.origin + distance * box.hi});
    Vec3 nearest, farthest;
    for (int i = 0; i < 3; ++i) {
      nearest[i] = magnitude(box.axis(i)).lo;
      farthest[i] = magnitude(box.axis(i)).hi;
    }
    return {box,
            {d.hi > 0.0 ? distance * nearest.norm() / d.hi : infinity,
             d.lo > 0.0 ? distance * farthest.norm() / d.lo : infinity}};
  }

  /// The least key(piece): the piece that has it is cut in four, until pieces are small or many.
  template <class Key>
  [[nodiscard]] double least(const std::vector<Piece>& faces, Key key) const {
    constexpr int most_pieces = 1500;
    const auto later = [&](const Piece& a, const Piece& b) { return key(a) > key(b); };
    std::priority_queue<Piece, std::vector<Piece>, decltype(later)> queue(later, faces);
    for (int k = 0; k < most_pieces && queue.top().box.size().maxCoeff() > 1e-3; k += 4) {
      const Box box = queue.top().box;
      queue.pop();
      const int flat = box.lo[0] == box.hi[0] ? 0 : box.lo[1] == box.hi[1] ? 1 : 2;
      const int i = (flat + 1) % 3, j = (flat + 2) % 3;
      for (int quarter = 0; quarter < 4; ++quarter) {
        Box part = box;
        (quarter % 2 == 0 ? part.hi : part.lo)[i] = box.centre()[i];
        (quarter / 2 == 0 ? part.hi : part.lo)[j] = box.centre()[j];
        queue.push(piece(part));
      }
    }
    return key(queue.top());
  }

  const Node& node_;
  std::shared_ptr<const Tape> tape_;
};

}  // namespace

RatioScan scan_ratio(const Node& a, const Node& b) {
  const Ratio ratio(a, b);
  const std::vector<Vec3> directions = scan_directions();
  const std::vector<double> ratios = ratio(directions);
  const Best least = extreme(ratio, 1.0, directions, ratios);
  const Best greatest = extreme(ratio, -1.0, directions, ratios);
  return {least.value, greatest.value, least.direction, greatest.direction};
}

Range radius_bounds(const Node& d) { return RadiusBounds(d)(); }

}  // namespace blendwright::detail
