#include "implicit/relations/moving_bodies.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "implicit/relations/broad_phase.hpp"
#include "implicit/relations/contact_point.hpp"
#include "implicit/relations/linear_refutation.hpp"
#include "kernel/base/number_text.hpp"
#include "kernel/base/parallel_for.hpp"

namespace blendwright {
namespace {

using detail::ContactPoint;
using detail::Half;
using detail::OrientedBox;

/// What is remembered of a pair: where it was in contact or nearest, in the coordinates of each body.
struct Memory {
  std::size_t first = 0, second = 0;
  Vec3 in_first = Vec3::Zero(), in_second = Vec3::Zero();
  bool contact = false;
};
bool before(const Memory& a, const Memory& b) {
  return a.first != b.first ? a.first < b.first : a.second < b.second;
}

/// All bodies where they are now.
struct Placed {
  std::vector<ScalarField> fields;
  std::vector<Box> boxes;
  std::vector<OrientedBox> oriented;
};

/// A point near the deepest or nearest one, and which of them it was.
struct Start {
  Vec3 point;
  bool contact;
};

/// What was found of a pair, and where to start at the next step.
struct Decision {
  Collision collision;
  std::optional<Vec3> start;
};

/// Two bodies, and the box that holds whatever they may have in common.
class NearPair {
 public:
  NearPair(const ScalarField& first, const ScalarField& second, const SearchOptions& options)
      : halves_{Half{&first}, Half{&second}}, options_(options) {}

  /// What can be said from where the pair was in contact or nearest: a contact that a search without a start
  /// cannot miss, or a gap.
  [[nodiscard]] std::optional<Decision> from(const Start& last) const {
    return last.contact ? still_in_contact(last.point) : still_apart(last.point);
  }

  [[nodiscard]] Decision search(const Progress& progress) const {
    Decision found{collide(*halves_[0].field, *halves_[1].field, options_, std::nullopt, progress), {}};
    found.start = found.collision.point;
    if (!found.start && found.collision.boxes > 1)
      if (const auto place = near(options_.domain->centre(), 3)) found.start = place->point;
    return found;
  }

 private:
  /// From step to step the place follows the deepest point, a step of Newton's method each time.
  [[nodiscard]] std::optional<Decision> still_in_contact(const Vec3& start) const {
    const auto place = near(start, 1);
    if (place && certain(place->point)) return at_point(Contact::contact, *place, 1);
    for (const Vec3& point : {start, options_.domain->centre()})
      if (certain(point)) return at_point(Contact::contact, values_at(halves_[0], halves_[1], point), 1);
    return still_apart(place ? place->point : start);
  }

  [[nodiscard]] std::optional<Decision> still_apart(const Vec3& start) const {
    if (separated_around(start)) {
      Decision found;
      found.collision.contact = Contact::disjoint;
      found.collision.boxes = 1;
      found.start = start;
      return found;
    }
    const auto place = near(start, 3);
    if (place && place->depth < 0.0) {
      if (separated_around(place->point)) return at_point(Contact::disjoint, *place, 2);
    } else if (place && certain(place->point)) {
      return at_point(Contact::contact, *place, 2);
    }
    return std::nullopt;
  }

  [[nodiscard]] std::optional<ContactPoint> near(const Vec3& start, int steps) const {
    return contact_point_near(halves_[0], halves_[1], start, options_.domain->size().maxCoeff(), steps);
  }

  /// Whether a convex combination of both is < 0 on the box around the domain that has this centre. At the
  /// nearest points the gradients are opposite, so there the linear parts cancel on the largest boxes.
  [[nodiscard]] bool separated_around(const Vec3& centre) const {
    const Box& domain = *options_.domain;
    const Vec3 half = (domain.hi - centre).cwiseMax(centre - domain.lo).cwiseMax(0.0);
    const Box box = hull({centre - half, centre + half}, domain);
    std::array<LinearBound, 2> bounds;
    for (std::size_t i = 0; i < 2; ++i) {
      const double sign = halves_[i].sign(), shift = -sign * surface_value(halves_[i].field->level());
      bounds[i] = sign * halves_[i].field->linear(box);
      if (shift != 0.0) bounds[i] = bounds[i] + constant_bound({shift, shift});
    }
    return detail::highest_point(bounds, half.maxCoeff()).upper < 0.0;
  }

  /// Whether a whole cube of the tolerance's size around the point belongs to both.
  [[nodiscard]] bool certain(const Vec3& point) const {
    if (!options_.domain->contains(point)) return false;
    const Vec3 half = Vec3::Constant(options_.tolerance);
    const Box cube{point - half, point + half};
    return std::ranges::all_of(halves_, [&](const Half& h) { return h.holds(h.psi(h.field->range(cube))); });
  }

  [[nodiscard]] static Decision at_point(Contact contact, const ContactPoint& place, std::size_t boxes) {
    Decision found;
    found.collision.contact = contact;
    found.collision.point = found.start = place.point;
    found.collision.normal = place.normal();
    if (std::isfinite(place.gap())) found.collision.gap = place.gap();
    found.collision.boxes = boxes;
    return found;
  }

  std::array<Half, 2> halves_;
  const SearchOptions& options_;
};

}  // namespace

struct MovingBodies::State {
  std::vector<ScalarField> bodies;
  SearchOptions options;
  std::vector<Memory> last;  ///< in the order of before()

  [[nodiscard]] Placed placed_at(std::span<const RigidMotion> placements) const;
  [[nodiscard]] std::optional<Start> start_of(std::span<const RigidMotion> placements, std::size_t first,
                                              std::size_t second) const;
  [[nodiscard]] Decision decide(const Placed& now, std::span<const RigidMotion> placements, std::size_t first,
                                std::size_t second, const Progress& progress) const;
};

MovingBodies::MovingBodies(std::vector<ScalarField> bodies, SearchOptions options)
    : state_(std::make_unique<State>(State{std::move(bodies), std::move(options), {}})) {
  std::vector<Problem> problems;
  if (size() < 2) problems.push_back({"bodies", "has " + std::to_string(size()) + ", must have at least 2"});
  for (std::size_t i = 0; i < size(); ++i) {
    const std::optional<Box>& bounds = state_->bodies[i].bounds();
    if (bounds && bounds->finite()) continue;
    problems.push_back({"bodies/" + std::to_string(i), bounds
                                                           ? "is unbounded, must lie in a finite box"
                                                           : "has no known bounds, must lie in a known box"});
  }
  const double tolerance = state_->options.tolerance;
  if (!(tolerance > 0.0) || !std::isfinite(tolerance))
    problems.push_back({"tolerance", "is " + number_text(tolerance) + ", must be a length > 0"});
  if (!problems.empty()) throw InputError(std::move(problems));
}
MovingBodies::~MovingBodies() = default;
MovingBodies::MovingBodies(MovingBodies&&) noexcept = default;
MovingBodies& MovingBodies::operator=(MovingBodies&&) noexcept = default;

std::size_t MovingBodies::size() const { return state_->bodies.size(); }

Placed MovingBodies::State::placed_at(std::span<const RigidMotion> placements) const {
  const std::size_t n = bodies.size();
  Placed now;
  now.fields = bodies;
  now.boxes.resize(n);
  now.oriented.resize(n);
  std::vector<std::optional<InputError>> errors(n);
  parallel_for(n, 64, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) try {
        now.fields[i] = placed(bodies[i], placements[i]);
        now.boxes[i] = *now.fields[i].bounds();
        now.oriented[i] = detail::moved(*bodies[i].bounds(), placements[i]);
      } catch (const InputError& e) {
        errors[i] = e;
      }
  });
  std::vector<Problem> problems;
  for (std::size_t i = 0; i < n; ++i)
    if (errors[i])
      for (const Problem& p : errors[i]->problems())
        problems.push_back({"placements/" + std::to_string(i), p.message});
  if (!problems.empty()) throw InputError(std::move(problems));
  return now;
}

std::optional<Start> MovingBodies::State::start_of(std::span<const RigidMotion> placements, std::size_t first,
                                                   std::size_t second) const {
  const auto found = std::ranges::lower_bound(last, Memory{first, second}, before);
  if (found == last.end() || found->first != first || found->second != second) return std::nullopt;
  return Start{0.5 * (placements[first](found->in_first) + placements[second](found->in_second)),
               found->contact};
}

Decision MovingBodies::State::decide(const Placed& now, std::span<const RigidMotion> placements,
                                     std::size_t first, std::size_t second, const Progress& progress) const {
  Decision apart;
  apart.collision.contact = Contact::disjoint;
  if (detail::apart(now.oriented[first], now.oriented[second])) return apart;
  SearchOptions there = options;
  if (!there.domain) {
    const std::optional<Box> both = common(now.boxes[first], now.boxes[second]);
    there.domain = both ? detail::common_box(*both, now.oriented[first], now.oriented[second]) : both;
    if (!there.domain) return apart;
  }
  const NearPair pair(now.fields[first], now.fields[second], there);
  // Cells are kept by a search only.
  if (const std::optional<Start> start = start_of(placements, first, second); start && !there.keep_cells)
    if (std::optional<Decision> found = pair.from(*start)) return *std::move(found);
  return pair.search(progress);
}

std::vector<BodyPair> MovingBodies::at(std::span<const RigidMotion> placements, bool all,
                                       const Progress& progress) {
  if (placements.size() != size())
    throw InputError("placements", "has " + std::to_string(placements.size()) +
                                       ", must have one for each of " + std::to_string(size()) + " bodies");
  progress.at(0.0, "placing bodies");
  const Placed now = state_->placed_at(placements);
  const auto candidates = detail::meeting_boxes(now.boxes);
  progress.at(0.1, "deciding pairs of bodies");
  Progress silent;  // pairs are decided on many threads
  silent.stop = progress.stop;
  std::vector<BodyPair> pairs(candidates.size());
  std::vector<std::optional<Vec3>> starts(candidates.size());
  parallel_for(pairs.size(), 8, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      silent.at(0.0, "deciding pairs of bodies");
      const auto [first, second] = candidates[i];
      Decision found = state_->decide(now, placements, first, second, silent);
      pairs[i] = {first, second, std::move(found.collision)};
      starts[i] = found.start;
    }
  });

  std::vector<Memory> last;
  last.reserve(pairs.size());
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    if (!starts[i]) continue;
    const auto [first, second] = candidates[i];
    last.push_back({first, second, inverse(placements[first])(*starts[i]),
                    inverse(placements[second])(*starts[i]),
                    pairs[i].collision.contact != Contact::disjoint});
  }
  state_->last = std::move(last);
  if (!all) std::erase_if(pairs, [](const BodyPair& p) { return p.collision.contact == Contact::disjoint; });
  progress.at(1.0, "deciding pairs of bodies");
  return pairs;
}

}  // namespace blendwright
