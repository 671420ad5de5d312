// Seeds of spines: a box of centres is halved until a box is given up or small, and small boxes are
// corrected.
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "kernel/base/error.hpp"
#include "kernel/base/number_text.hpp"
#include "parametric/rolling_ball/ball_cover.hpp"
#include "parametric/rolling_ball/interference.hpp"
#include "parametric/rolling_ball/spine_trace.hpp"

namespace blendwright {
namespace {

using Cause = BallFailure::Cause;
using Cells = std::vector<const CoverCell*>;

constexpr int seed_corrections = 40;

/// A small box of centres with the cells that a ball in it may touch.
struct Candidate {
  Vec3 centre;
  double reach = 0.0;  ///< half diagonal of the box
  std::array<Cells, 2> cells;
};

class Subdivision {
 public:
  Subdivision(const BallPair& pair, double radius, double seed_size)
      : pair_(pair), radius_(radius), seed_size_(seed_size) {}

  [[nodiscard]] std::vector<Candidate> run(const Box& box, const std::array<Cells, 2>& cells) const {
    std::vector<Candidate> found;
    descend(box, cells, found);
    return found;
  }

 private:
  void descend(const Box& box, const std::array<Cells, 2>& cells, std::vector<Candidate>& found) const {
    const Vec3 m = box.centre();
    const double reach = 0.5 * box.size().norm();
    Candidate here{m, reach, {}};
    for (std::size_t i = 0; i < 2; ++i) {
      // The distance changes by no more than the centre: no ball of this box touches a cell farther away.
      for (const CoverCell* cell : cells[i])
        if ((cell->centre - m).norm() - cell->radius <= radius_ + reach) here.cells[i].push_back(cell);
      if (here.cells[i].empty() || wrong_side(i, box)) return;
      if (reach < radius_ && too_near(i, here)) return;
    }
    if (2.0 * reach <= seed_size_) {
      found.push_back(std::move(here));
      return;
    }
    for (int k = 0; k < 8; ++k) {
      Box part;
      for (int i = 0; i < 3; ++i) {
        const bool upper = (k >> i) & 1;
        part.lo[i] = upper ? m[i] : box.lo[i];
        part.hi[i] = upper ? box.hi[i] : m[i];
      }
      descend(part, here.cells, found);
    }
  }

  /// No centre of the box is on the ball's side of a field.
  [[nodiscard]] bool wrong_side(std::size_t i, const Box& box) const {
    const ScalarField* field = pair_.primaries[i].field();
    if (!field || radius_ == 0.0) return false;
    const Range range = field->range(box);
    const double a = inside(field->level(), range.lo), b = inside(field->level(), range.hi);
    return pair_.radius[i] > 0.0 ? std::min(a, b) > 0.0 : std::max(a, b) < 0.0;
  }

  /// A point of the primary is in every ball of the box: the foot from the nearest cell is an upper bound of
  /// the distance from the box's centre.
  [[nodiscard]] bool too_near(std::size_t i, const Candidate& here) const {
    for (const CoverCell* cell : here.cells[i])
      if (cell->point && (*cell->point - here.centre).norm() < radius_ - here.reach) return true;
    return false;
  }

  const BallPair& pair_;
  double radius_, seed_size_;
};

/// Different feet of the box's centre: from the nearest cell, and from the nearest one in a direction more
/// than 60 deg away from it.
std::vector<BallFoot> starts(const BallPair& pair, const Candidate& box, std::size_t i) {
  const auto place = [](const CoverCell* cell) { return cell->point.value_or(cell->centre); };
  const auto nearer = [&](const CoverCell* a, const CoverCell* b) {
    return (place(a) - box.centre).squaredNorm() < (place(b) - box.centre).squaredNorm();
  };
  const Cells& cells = box.cells[i];
  const CoverCell* first = *std::min_element(cells.begin(), cells.end(), nearer);
  const Vec3 d = place(first) - box.centre;
  const CoverCell* second = nullptr;
  for (const CoverCell* cell : cells) {
    const Vec3 e = place(cell) - box.centre;
    if (e.dot(d) < 0.5 * e.norm() * d.norm() && (!second || nearer(cell, second))) second = cell;
  }
  std::vector<BallFoot> found;
  for (const CoverCell* cell : {first, second}) {
    if (!cell) continue;
    const auto foot = pair.primaries[i].foot(box.centre, place(cell), cell->at);
    const bool same = foot && !found.empty() && (found[0].point - foot->point).norm() <= 1e-6 * box.reach;
    if (foot && !same) found.push_back(*foot);
  }
  return found;
}

/// Balls that touch both primaries, from a small box.
void correct(const BallPair& pair, const Candidate& box, std::vector<BallContact>& found,
             std::vector<BallFailure>& failures) {
  const std::vector<BallFoot> first = starts(pair, box, 0), second = starts(pair, box, 1);
  // A foot is a point of the primary: it must not be in every ball of the box.
  const auto in_all = [&](const BallFoot& foot) {
    return (foot.point - box.centre).norm() < std::abs(pair.radius[0]) - box.reach;
  };
  if (std::any_of(first.begin(), first.end(), in_all) || std::any_of(second.begin(), second.end(), in_all))
    return;
  for (const BallFoot& a : first)
    for (const BallFoot& b : second) {
      const Corrected there = corrected(pair, box.centre, {a, b}, seed_corrections);
      if (const auto* contact = std::get_if<BallContact>(&there)) {
        found.push_back(*contact);
      } else if (std::get<Cause>(there) == Cause::tangent || std::get<Cause>(there) == Cause::curvature) {
        failures.push_back(failure(std::get<Cause>(there), pair, box.centre));
      }
    }
}

/// From a point of the edge where the primaries meet: the start c = edge + N^T (N N^T)^-1 (r1, r2).
void from_edge(const BallPair& pair, const BallContact& edge, std::vector<BallContact>& found) {
  const Vec3 &n1 = edge.feet[0].normal, &n2 = edge.feet[1].normal;
  const double g = n1.dot(n2), w = n1.cross(n2).squaredNorm();
  const Vec3 c =
      edge.c + ((pair.radius[0] - g * pair.radius[1]) * n1 + (pair.radius[1] - g * pair.radius[0]) * n2) / w;
  if (!c.allFinite()) return;
  const Corrected there = corrected(pair, c, edge.feet, seed_corrections);
  if (const auto* contact = std::get_if<BallContact>(&there)) found.push_back(*contact);
}

double distance(const Vec3& a, const Vec3& b, const Vec3& c) {
  const Vec3 d = b - a;
  const double t = std::clamp((c - a).dot(d) / d.squaredNorm(), 0.0, 1.0);
  return (c - a - t * d).norm();
}

/// Whether a ball with the centre c is one of the spine's; chords keep off those that cannot be.
bool on(const Spine& spine, const Vec3& c, double chord_tolerance) {
  const auto& points = spine.points();
  double nearest = std::numeric_limits<double>::infinity();
  for (std::size_t k = 0; k + (spine.closed() ? 0 : 1) < points.size(); ++k)
    nearest = std::min(nearest, distance(points[k].centre, points[(k + 1) % points.size()].centre, c));
  return nearest <= 10.0 * chord_tolerance &&
         (spine.at(spine.nearest(c)).centre - c).norm() <= 1e-6 * spine.radius();
}

Box grown(const Box& box, double by) { return {box.lo - Vec3::Constant(by), box.hi + Vec3::Constant(by)}; }

Cells all(const std::vector<CoverCell>& cells) {
  Cells pointers;
  for (const CoverCell& c : cells) pointers.push_back(&c);
  return pointers;
}

/// Why nothing was found: the causes met on the way, nearest to the box's middle, or that there is no spine.
BallFailure nothing(const BallPair& pair, const Box& box, const std::vector<BallFailure>& met) {
  for (const Cause cause : {Cause::tangent, Cause::curvature}) {
    const auto first =
        std::find_if(met.begin(), met.end(), [&](const BallFailure& f) { return f.cause == cause; });
    if (first != met.end()) return *first;
  }
  return failure(Cause::no_spine, pair, box.centre());
}

class Search {
 public:
  Search(const BallPair& pair, const SpineSpec& spec)
      : pair_(pair), spec_(checked(pair, spec)), parts_(pair, spec_) {}

  [[nodiscard]] SpineSet run() {
    set_.seed_size = spec_.seed_size;
    using enum SpineSpec::Seeds;
    if (spec_.seeds != box) from_edges();
    if (spec_.seeds != edge) from_boxes();
    if (set_.spines.empty()) set_.failures.push_back(nothing(pair_, spec_.box, met_));
    return std::move(set_);
  }

 private:
  void from_edges() {
    const BallPair bare{pair_.primaries, {0.0, 0.0}};
    const double r = std::abs(pair_.radius[0]);
    const Box where = grown(spec_.box, r);
    std::vector<BallContact> edges, found;
    std::vector<BallFailure> ignored;
    for (const Candidate& c : Subdivision(bare, 0.0, spec_.seed_size).run(where, cells()))
      correct(bare, c, edges, ignored);
    for (const BallContact& e : edges) from_edge(pair_, e, found);
    follow(found);
  }

  void from_boxes() {
    const Subdivision subdivision(pair_, std::abs(pair_.radius[0]), spec_.seed_size);
    std::vector<BallContact> found;
    for (const Candidate& c : subdivision.run(spec_.box, cells())) correct(pair_, c, found, met_);
    follow(found);
  }

  [[nodiscard]] std::array<Cells, 2> cells() const { return {all(parts_.cells(0)), all(parts_.cells(1))}; }

  void follow(const std::vector<BallContact>& found) {
    for (const BallContact& contact : found) {
      if (!spec_.box.contains(contact.c)) continue;
      const bool known = std::any_of(set_.spines.begin(), set_.spines.end(), [&](const Spine& spine) {
        return on(spine, contact.c, spec_.chord_tolerance);
      });
      if (known) continue;
      auto spine = traced(pair_, spec_, contact);
      if (!spine) {
        met_.push_back(failure(Cause::tangent, pair_, contact.c));
        continue;
      }
      spine->interference = parts_.interference(*spine);
      if (spine->interference) set_.failures.push_back(*spine->interference);
      for (const SpineEnd& end : spine->ends())
        if (end.failure) set_.failures.push_back(*end.failure);
      set_.spines.push_back(std::move(*spine));
    }
  }

  const BallPair& pair_;
  SpineSpec spec_;
  BallParts parts_;
  SpineSet set_;
  std::vector<BallFailure> met_;
};

/// Feet of c for the ball's sides, or why not.
Spine component_near(const BallPair& pair, const Vec3& c, const SpineSpec& spec) {
  std::array<BallFoot, 2> feet;
  for (std::size_t i = 0; i < 2; ++i) {
    const auto foot = pair.primaries[i].foot(c);
    if (!foot)
      throw GeometryError("no foot of " + std::string(i == 0 ? "the first" : "the second") +
                          " primary is reached from the given place");
    feet[i] = *foot;
  }
  const Corrected there = corrected(pair, c, feet, seed_corrections);
  const auto* contact = std::get_if<BallContact>(&there);
  if (!contact) throw GeometryError(failure(std::get<Cause>(there), pair, c).message);
  if (!spec.box.contains(contact->c)) throw GeometryError(failure(Cause::no_spine, pair, c).message);
  auto spine = traced(pair, spec, *contact);
  if (!spine) throw GeometryError(failure(Cause::tangent, pair, contact->c).message);
  return *std::move(spine);
}

}  // namespace

SpineSet find_spines(const BallPair& pair, const SpineSpec& spec) { return Search(pair, spec).run(); }

Spine spine_near(const BallPair& pair, const Vec3& c, const SpineSpec& spec) {
  const SpineSpec full = checked(pair, spec);
  Spine spine = component_near(pair, c, full);
  spine.interference = BallParts(pair, full).interference(spine);
  return spine;
}

std::optional<double> largest_radius(const BallPair& pair, const Vec3& c, const SpineSpec& spec) {
  const double limit = std::abs(pair.radius[0]);
  const auto works = [&](double r) {
    BallPair smaller = pair;
    for (double& x : smaller.radius) x = std::copysign(r, x);
    SpineSpec coarser = spec;
    coarser.chord_tolerance = 0.0;
    try {
      const Spine spine = spine_near(smaller, c, coarser);
      return !spine.interference && !spine.ends()[0].failure && !spine.ends()[1].failure;
    } catch (const GeometryError&) {
      return false;
    } catch (const ConvergenceError&) {
      return false;
    }
  };
  if (works(limit)) return limit;
  double bad = limit, good = 0.5 * limit;
  for (int k = 0; !works(good); ++k, good *= 0.5) {
    if (k == 10) return std::nullopt;
    bad = good;
  }
  while (bad - good > 0.01 * good) {
    const double middle = 0.5 * (good + bad);
    (works(middle) ? good : bad) = middle;
  }
  return good;
}

}  // namespace blendwright
