#include "implicit/offset/offset_nodes.hpp"

#include <algorithm>
#include <cmath>

#include "implicit/offset/ball_offset.hpp"
#include "implicit/offset/normal_offset.hpp"
#include "implicit/offset/polyhedron.hpp"
#include "implicit/offset/quadric_ball.hpp"
#include "implicit/operators/sharp.hpp"
#include "implicit/scene/level_map.hpp"

namespace blendwright::detail {
namespace {

constexpr double rounding = 1e-12;  // of regions

NodePtr shared(Node node) { return std::make_shared<const Node>(std::move(node)); }

template <class Body>
std::function<StepIndex(TapeBuilder&, const Frame&)> emit_step(Body body, const Frame& inner = {}) {
  return
      [shared = std::make_shared<const Body>(std::move(body)), inner](TapeBuilder& tape, const Frame& frame) {
        return tape.add<Body>(shared, inner.after(frame), {});
      };
}

/// A field of the same level and no other facts.
Node of_level(const Node& of) {
  Node node;
  node.level = of.level;
  node.any_value = of.any_value;
  return node;
}

/// A box moved out by `length`; one that is moved in until nothing is left becomes a point.
Box moved_out(const Box& box, double length) {
  const Vec3 slack = rounding * (box.lo.cwiseAbs().cwiseMax(box.hi.cwiseAbs()).array() + std::abs(length));
  Box moved{box.lo - slack - Vec3::Constant(length), box.hi + slack + Vec3::Constant(length)};
  for (int i = 0; i < 3; ++i)
    if (moved.lo[i] > moved.hi[i]) moved.lo[i] = moved.hi[i] = box.centre()[i];
  return moved;
}

std::function<std::optional<Box>(double)> region_moved_out(const NodePtr& of, double length) {
  return [of, length](double value) -> std::optional<Box> {
    const std::optional<Box> box = of->region(value);
    if (!box) return std::nullopt;
    return moved_out(*box, length);
  };
}

/// The factor of lengths in a frame that keeps shapes; nullopt: it does not.
std::optional<double> length_factor(const Frame& frame) {
  const Eigen::Matrix3d square = frame.matrix * frame.matrix.transpose();
  const double factor = square.trace() / 3.0;
  if (!((square - factor * Eigen::Matrix3d::Identity()).cwiseAbs().maxCoeff() <= 1e-14 * factor))
    return std::nullopt;
  return std::sqrt(factor);
}

Node placed(const NodePtr& of, const Frame& frame) {
  Node node = of_level(*of);
  node.emit = [of, frame](TapeBuilder& tape, const Frame& outer) {
    return of->emit(tape, frame.after(outer));
  };
  node.region = [of, frame](double value) -> std::optional<Box> {
    const std::optional<Box> box = of->region(value);
    if (!box || !box->finite()) return std::nullopt;
    return frame.scene(*box);
  };
  node.under = of;
  node.detail = std::make_shared<const Frame>(frame);
  return node;
}

/// The node that was placed and the frame, when it keeps shapes.
struct Placement {
  NodePtr of;
  Frame frame;
  double factor;  ///< lengths of `of` per length outside
};
std::optional<Placement> placement_of(const Node& node) {
  if (!node.under || !node.detail) return std::nullopt;
  const Frame& frame = *static_cast<const Frame*>(node.detail.get());
  const std::optional<double> factor = length_factor(frame);
  if (!factor) return std::nullopt;
  return Placement{node.under, frame, *factor};
}

Node shifted(const NodePtr& of, double shift) {
  Node node = of_level(*of);
  node.any_value = node.any_value || of->level == Level::half;
  node.emit = [of, map = std::make_shared<const LevelMap>(LevelMap{1.0, shift})](TapeBuilder& tape,
                                                                                 const Frame& frame) {
    return tape.add<LevelMap>(map, Frame(), {of->emit(tape, frame)});
  };
  node.region = [of, shift](double value) { return of->region(value - shift); };
  if (of->quadric) {
    NodeQuadric quadric = *of->quadric;
    quadric.coefficients[9] += shift;
    node.quadric = std::make_shared<const NodeQuadric>(quadric);
  }
  return node;
}

/// Coordinates around the origin of a quadric's own ones, where its coefficients lose no digits; turned and
/// stretched as those of the node.
struct CentredQuadric {
  QuadricCoefficients coefficients;
  Frame frame;
  explicit CentredQuadric(const NodeQuadric& q) : coefficients(q.coefficients), frame(q.frame) {
    if (frame.identity) return;
    Frame turn = frame;
    turn.offset.setZero();
    turn.identity = turn.matrix == Eigen::Matrix3d::Identity();
    coefficients = seen_through(q.coefficients, turn);
    frame.offset = turn.matrix.transpose().inverse() * frame.offset;
    frame.matrix.setIdentity();
  }
  [[nodiscard]] bool plane() const {
    return std::all_of(coefficients.begin(), coefficients.begin() + 6, [](double a) { return a == 0.0; });
  }
  [[nodiscard]] Vec3 slope() const { return {coefficients[6], coefficients[7], coefficients[8]}; }
};

/// Of a union: around all regions; of an intersection: any of them.
std::function<std::optional<Box>(double)> joined_regions(const std::vector<NodePtr>& parts, bool unite) {
  return [parts, unite](double value) -> std::optional<Box> {
    std::optional<Box> all;
    for (const NodePtr& part : parts) {
      const std::optional<Box> one = part->region(value);
      if (!one && unite) return std::nullopt;
      if (one && all && unite) all = hull(*all, *one);
      if (one && !all) all = one;
    }
    return all;
  };
}

/// How deep routes look into a node: beyond it, and beyond this many parts, the search sees it as a whole.
struct Effort {
  int depth = 40;
  std::size_t parts = 10'000;
};

class BallOffsets {
 public:
  explicit BallOffsets(double tolerance) : tolerance_(tolerance) {}

  Node make(const NodePtr& of, double distance, int depth = 0) {
    ++parts_;
    if (distance == 0.0) return shifted(of, 0.0);
    if (of->exact_distance) return shifted(of, distance);
    const bool deeper = depth < Effort{}.depth && parts_ < Effort{}.parts;
    if (const auto placement = deeper ? placement_of(*of) : std::nullopt)
      return placed(shared(make(placement->of, placement->factor * distance, depth + 1)), placement->frame);
    if (of->quadric) return quadric(of, distance);
    if (of->lattice && deeper)
      if (std::optional<Node> node = lattice(*of, distance, depth)) return *node;
    Node node = of_level(*of);
    const double sign = sense(of->level) * (distance > 0.0 ? 1.0 : -1.0);
    node.emit = emit_step(BallOffset{tape_of(*of), std::abs(distance), sign, tolerance_});
    node.region = region_moved_out(of, distance);
    return node;
  }

 private:
  static Node quadric(const NodePtr& of, double distance) {
    const CentredQuadric q(*of->quadric);
    if (q.plane()) return shifted(of, distance * q.slope().stableNorm());
    Node node = of_level(*of);
    node.emit =
        emit_step(QuadricBall(q.coefficients, std::abs(distance), distance > 0.0 ? 1.0 : -1.0), q.frame);
    node.region = region_moved_out(of, distance);
    return node;
  }

  std::optional<Node> lattice(const Node& of, double distance, int depth) {
    using Kind = NodeLattice::Kind;
    const Kind kind = of.lattice->kind;
    const bool largest = sense(of.level) * distance > 0.0;
    if (kind == (largest ? Kind::smallest : Kind::largest)) return std::nullopt;
    std::vector<NodePtr> parts;
    for (const NodePtr& part : of.lattice->of)
      parts.push_back(shared(make(part, kind == Kind::complement ? -distance : distance, depth + 1)));
    Node node = of_level(of);
    if (kind == Kind::complement)
      node.emit = emit_complement(parts.front());
    else if (largest)
      node.emit = emit_chain<Maximum>(parts);
    else
      node.emit = emit_chain<Minimum>(parts);
    if (kind != Kind::complement)
      node.region = joined_regions(parts, (kind == Kind::largest) == (sense(of.level) > 0.0));
    return node;
  }

  template <class Body>
  static std::function<StepIndex(TapeBuilder&, const Frame&)> emit_chain(const std::vector<NodePtr>& parts) {
    return [parts, body = std::make_shared<const Body>()](TapeBuilder& tape, const Frame& frame) {
      StepIndex all = parts.front()->emit(tape, frame);
      for (std::size_t i = 1; i < parts.size(); ++i)
        all = tape.add<Body>(body, Frame(), {all, parts[i]->emit(tape, frame)});
      return all;
    };
  }

 public:
  template <class Body>
  static std::function<StepIndex(TapeBuilder&, const Frame&)> emit_unary(const NodePtr& of) {
    return [of, body = std::make_shared<const Body>()](TapeBuilder& tape, const Frame& frame) {
      return tape.add<Body>(body, Frame(), {of->emit(tape, frame)});
    };
  }
  /// As the node complement.
  static std::function<StepIndex(TapeBuilder&, const Frame&)> emit_complement(const NodePtr& of) {
    if (of->level == Level::one) return emit_unary<Reciprocal>(of);
    if (of->level == Level::half) return emit_unary<OneMinus>(of);
    return emit_unary<Negative>(of);
  }

 private:
  double tolerance_;
  std::size_t parts_ = 0;
};

/// The half-spaces of a plane or of a smallest (largest) of planes, in `list`; false: there is something
/// else.
bool collect_planes(const Node& node, NodeLattice::Kind kind, std::vector<HalfSpace>& list, int depth = 0) {
  if (node.level != Level::function || list.size() > most_planes) return false;
  if (node.lattice) {
    if (node.lattice->kind != kind || depth > Effort{}.depth) return false;
    return std::ranges::all_of(
        node.lattice->of, [&](const NodePtr& part) { return collect_planes(*part, kind, list, depth + 1); });
  }
  if (!node.quadric) return false;
  const CentredQuadric q(*node.quadric);
  const double size = q.slope().stableNorm();
  if (!q.plane() || !(size > 0.0)) return false;
  // n.(X + frame offset) + c
  const Vec3 n = q.slope() / size;
  list.push_back({n, q.coefficients[9] / size + n.dot(q.frame.offset)});
  return list.size() <= most_planes;
}

/// The opening (sign 1) of an intersection of half-spaces, the closing (sign -1) of a union of them.
std::optional<Node> rounded_planes(const NodePtr& of, double radius, double sign) {
  using Kind = NodeLattice::Kind;
  if (!of->lattice) return std::nullopt;
  PolyhedronDistance body{{}, sign, sign * radius};
  if (!collect_planes(*of, sign > 0.0 ? Kind::smallest : Kind::largest, body.planes)) return std::nullopt;
  for (HalfSpace& p : body.planes) p = {sign * p.normal, sign * p.offset - radius};
  if (empty(body.planes)) return std::nullopt;
  Node node = of_level(*of);
  node.exact_distance = true;
  node.emit = emit_step(std::move(body));
  return node;
}

/// sign 1: opening, -1: closing.
Node rounded(const NodePtr& of, double radius, double sign, double tolerance, int depth) {
  const auto with_region = [&](Node node) {
    // An opening lies in the solid, a closing in every box around it.
    node.region = [of](double value) {
      return inside(of->level, value) >= 0.0 ? of->region(surface_value(of->level)) : std::nullopt;
    };
    return node;
  };
  if (of->exact_distance && of->parallel)
    if (const NodePtr first = of->parallel(-sign * radius); first && first->parallel)
      if (const NodePtr second = first->parallel(sign * radius)) return *second;
  const auto placement = depth < Effort{}.depth ? placement_of(*of) : std::nullopt;
  if (placement)
    return placed(shared(rounded(placement->of, placement->factor * radius, sign, tolerance, depth + 1)),
                  placement->frame);
  if (std::optional<Node> node = rounded_planes(of, radius, sign)) return with_region(*node);
  if (of->lattice && of->lattice->kind == NodeLattice::Kind::complement && depth < Effort{}.depth) {
    Node node = of_level(*of);
    node.emit = BallOffsets::emit_complement(
        shared(rounded(of->lattice->of.front(), radius, -sign, tolerance, depth + 1)));
    return with_region(node);
  }
  const NodePtr first = shared(BallOffsets(tolerance).make(of, -sign * radius));
  return with_region(BallOffsets(tolerance).make(first, sign * radius));
}

}  // namespace

std::shared_ptr<const Tape> tape_of(const Node& node) {
  TapeBuilder builder;
  const StepIndex result = node.emit(builder, Frame());
  return builder.finish(result);
}

Node iso_offset(const NodePtr& of, double value) { return shifted(of, sense(of->level) * value); }

Node normal_offset(const NodePtr& of, double distance) {
  if (distance == 0.0) return shifted(of, 0.0);
  Node node = of_level(*of);
  node.emit = emit_step(NormalOffset{tape_of(*of), sense(of->level) * distance});
  node.region = region_moved_out(of, std::abs(distance));
  return node;
}

Node ball_offset(const NodePtr& of, double distance, double tolerance) {
  return BallOffsets(tolerance).make(of, distance);
}

Node opening(const NodePtr& of, double radius, double tolerance) {
  return rounded(of, radius, 1.0, tolerance, 0);
}
Node closing(const NodePtr& of, double radius, double tolerance) {
  return rounded(of, radius, -1.0, tolerance, 0);
}

Node shell(const NodePtr& outer, const NodePtr& inner) {
  Node hole = of_level(*inner);
  hole.emit = BallOffsets::emit_complement(inner);
  const NodePtr rest = shared(std::move(hole));
  Node node = of_level(*outer);
  const auto join = [&](auto body) {
    node.emit = [outer, rest, shared = std::make_shared<const decltype(body)>(body)](TapeBuilder& tape,
                                                                                     const Frame& frame) {
      return tape.add(shared, Frame(), {outer->emit(tape, frame), rest->emit(tape, frame)});
    };
  };
  if (sense(outer->level) > 0.0)
    join(Minimum{});
  else
    join(Maximum{});
  node.region = [outer](double value) { return outer->region(value); };
  return node;
}

bool provably_empty(const Node& node) {
  constexpr std::size_t most_boxes = 256;
  const std::optional<Box> region = node.region(surface_value(node.level));
  if (!region || !region->finite()) return false;
  const std::shared_ptr<const Tape> tape = tape_of(node);
  std::vector<Box> waiting{*region};
  for (std::size_t k = 0; k < waiting.size(); ++k) {
    const Box box = waiting[k];
    const Range range = tape->range(box);
    if (std::max(inside(node.level, range.lo), inside(node.level, range.hi)) < 0.0) continue;
    const Vec3 c = box.centre();
    double value = 0.0;
    tape->evaluate(Order::value, {{&c.x(), 1}, {&c.y(), 1}, {&c.z(), 1}}, {&value, 1});
    if (!(inside(node.level, value) < 0.0) || waiting.size() + 2 > most_boxes) return false;
    int longest = 0;
    if (!(box.size().maxCoeff(&longest) > 0.0)) return false;
    Box below = box, above = box;
    below.hi[longest] = above.lo[longest] = c[longest];
    waiting.push_back(below);
    waiting.push_back(above);
  }
  return true;
}

}  // namespace blendwright::detail
