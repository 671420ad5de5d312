#include "implicit/relations/moving_bodies.hpp"

#include <algorithm>

#include "implicit/relations/broad_phase.hpp"
#include "kernel/base/number_text.hpp"
#include "kernel/base/parallel_for.hpp"

namespace blendwright {
namespace {

using detail::OrientedBox;

/// What is remembered of a pair that was not disjoint: where, in the coordinates of each body.
struct Memory {
  std::size_t first = 0, second = 0;
  Vec3 in_first = Vec3::Zero(), in_second = Vec3::Zero();
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

}  // namespace

struct MovingBodies::State {
  std::vector<ScalarField> bodies;
  SearchOptions options;
  std::vector<Memory> last;  ///< in the order of before()

  [[nodiscard]] Placed placed_at(std::span<const RigidMotion> placements) const;
  [[nodiscard]] const Memory* memory_of(std::size_t first, std::size_t second) const;
  [[nodiscard]] Collision decide(const Placed& now, std::span<const RigidMotion> placements,
                                 std::size_t first, std::size_t second, const Progress& progress) const;
  [[nodiscard]] bool fat(const ScalarField& first, const ScalarField& second, const Vec3& point) const;
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

const Memory* MovingBodies::State::memory_of(std::size_t first, std::size_t second) const {
  const auto found = std::ranges::lower_bound(last, Memory{first, second}, before);
  return found != last.end() && found->first == first && found->second == second ? &*found : nullptr;
}

/// Whether a whole cube of the tolerance's size around the point belongs to both: a search without a start
/// cannot miss that.
bool MovingBodies::State::fat(const ScalarField& first, const ScalarField& second, const Vec3& point) const {
  const Vec3 half = Vec3::Constant(options.tolerance);
  const Box cube{point - half, point + half};
  const auto belongs = [&cube](const ScalarField& f) {
    const Range r = f.range(cube);
    return std::min(inside(f.level(), r.lo), inside(f.level(), r.hi)) >= 0.0;
  };
  return belongs(first) && belongs(second);
}

Collision MovingBodies::State::decide(const Placed& now, std::span<const RigidMotion> placements,
                                      std::size_t first, std::size_t second, const Progress& progress) const {
  Collision apart;
  apart.contact = Contact::disjoint;
  if (detail::apart(now.oriented[first], now.oriented[second])) return apart;
  SearchOptions there = options;
  if (!there.domain) {
    const std::optional<Box> both = common(now.boxes[first], now.boxes[second]);
    there.domain = both ? detail::common_box(*both, now.oriented[first], now.oriented[second]) : both;
    if (!there.domain) return apart;
  }
  const ScalarField &a = now.fields[first], &b = now.fields[second];
  if (const Memory* m = memory_of(first, second)) {
    const Vec3 start = 0.5 * (placements[first](m->in_first) + placements[second](m->in_second));
    Collision found = collide(a, b, there, start, progress);
    if (found.contact != Contact::contact || fat(a, b, *found.point)) return found;
  }
  return collide(a, b, there, std::nullopt, progress);
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
  parallel_for(pairs.size(), 8, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      silent.at(0.0, "deciding pairs of bodies");
      const auto [first, second] = candidates[i];
      pairs[i] = {first, second, state_->decide(now, placements, first, second, silent)};
    }
  });

  std::vector<Memory> last;
  for (const BodyPair& p : pairs)
    if (p.collision.contact != Contact::disjoint && p.collision.point)
      last.push_back({p.first, p.second, inverse(placements[p.first])(*p.collision.point),
                      inverse(placements[p.second])(*p.collision.point)});
  state_->last = std::move(last);
  if (!all) std::erase_if(pairs, [](const BodyPair& p) { return p.collision.contact == Contact::disjoint; });
  progress.at(1.0, "deciding pairs of bodies");
  return pairs;
}

}  // namespace blendwright
