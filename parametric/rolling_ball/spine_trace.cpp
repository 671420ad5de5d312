#include "parametric/rolling_ball/spine_trace.hpp"

#include <algorithm>
#include <cmath>

#include "kernel/base/error.hpp"
#include "kernel/base/number_text.hpp"
#include "parametric/trimline/line_point.hpp"

namespace blendwright {
namespace {

using Cause = BallFailure::Cause;

const double cos_turn = std::cos(degrees(4.0).value);        ///< of the spine's tangent in one step
const double cos_foot_turn = std::cos(degrees(20.0).value);  ///< of the primaries' normals
constexpr double growth = 1.3;
constexpr int corrections = 4;              ///< in one step
constexpr std::size_t max_points = 200000;  ///< of one component

struct Walk {
  std::vector<BallContact> contacts;  ///< the first is the start
  SpineEnd end;
  std::array<Vec2, 2> turns{Vec2(0.0, 0.0), Vec2(0.0, 0.0)};
};

/// What a step leads to: a contact, or why it may not be taken. `wound`: the tangent turned too far, or the
/// correction was too long.
struct Step {
  std::optional<BallContact> contact{};
  std::optional<Cause> cause{};
  bool out_of_box = false, wound = false;
};

class Walker {
 public:
  Walker(const BallPair& pair, const SpineSpec& spec, const BallContact& start, double direction)
      : pair_(pair),
        spec_(spec),
        direction_(direction),
        start_(start),
        longest_(spec.box.size().norm() / 32.0),
        shortest_(1e-10 * spec.box.size().norm()) {}

  [[nodiscard]] Walk walk() const {
    Walk way;
    way.contacts.push_back(start_);
    double h = std::min(longest_, 0.05 * std::abs(pair_.radius[0]));
    while (way.contacts.size() < max_points) {
      h = std::min({h, longest_, chord_limit(way.contacts.back())});
      const Step step = stepped(way.contacts.back(), h, corrections);
      if (step.contact) {
        if (closes(way.contacts.back(), *step.contact, h)) return closed(std::move(way), h);
        way.contacts.push_back(*step.contact);
        h *= growth;
      } else if (step.out_of_box || step.cause == Cause::domain || h <= shortest_) {
        return ended(std::move(way), h, step);
      } else {
        h *= 0.5;
      }
    }
    way.end = {SpineEnd::Kind::failure, failure(Cause::lost, pair_, way.contacts.back().c)};
    return way;
  }

 private:
  [[nodiscard]] Vec3 tangent(const BallContact& at) const { return direction_ * spine_tangent(at); }

  /// Steps whose chord stays within the tolerance of an arc of the spine's curvature.
  [[nodiscard]] double chord_limit(const BallContact& at) const {
    const double kappa = spine_curvature(at);
    return kappa > 0.0 ? std::sqrt(8.0 * spec_.chord_tolerance / kappa) : longest_;
  }

  [[nodiscard]] Step stepped(const BallContact& from, double h, int iterations) const {
    const Vec3 T = tangent(from), predicted = from.c + h * T;
    const Corrected found = corrected(pair_, predicted, from.feet, iterations);
    if (const auto* cause = std::get_if<Cause>(&found)) return {.cause = *cause};
    const auto& next = std::get<BallContact>(found);
    if (!spec_.box.contains(next.c)) return {.out_of_box = true};
    if (parallel(next, parallel_normals)) return {.cause = Cause::tangent};
    const double turn = T.dot(tangent(next));
    if (turn <= 0.0) return {.cause = Cause::tangent};
    const bool feet_turn = from.feet[0].normal.dot(next.feet[0].normal) < cos_foot_turn ||
                           from.feet[1].normal.dot(next.feet[1].normal) < cos_foot_turn;
    if (turn < cos_turn || feet_turn || (next.c - predicted).norm() > 0.2 * h) return {.wound = true};
    return {.contact = next};
  }

  /// The step leads through the plane across the start, and the spine meets that plane at the start.
  [[nodiscard]] bool closes(const BallContact& from, const BallContact& to, double h) const {
    const Vec3 T0 = tangent(start_);
    const double before = (from.c - start_.c).dot(T0), after = (to.c - start_.c).dot(T0);
    if (!(before < 0.0 && after >= 0.0) || (to.c - start_.c).norm() > 3.0 * h) return false;
    const Vec3 crossing = from.c + before / (before - after) * (to.c - from.c);
    const Corrected there = corrected_in_plane(pair_, crossing, start_.c, T0, from.feet);
    const auto* contact = std::get_if<BallContact>(&there);
    return contact && (contact->c - start_.c).norm() <= 1e-6 * h;
  }

  [[nodiscard]] Walk closed(Walk way, double h) const {
    const BallContact last = way.contacts.back();
    const Corrected again = feet_of(pair_, start_.c, last.feet);
    if (const auto* contact = std::get_if<BallContact>(&again))
      for (std::size_t i = 0; i < 2; ++i) way.turns[i] = turn_of(i, contact->feet[i].at);
    if (way.contacts.size() > 8 && (last.c - start_.c).norm() < 0.3 * h) way.contacts.pop_back();
    way.end.kind = SpineEnd::Kind::closed;
    return way;
  }

  /// Whole periods between the parameters at the start and after one turn.
  [[nodiscard]] Vec2 turn_of(std::size_t i, UV after) const {
    const Surface* surface = pair_.primaries[i].surface();
    if (!surface) return Vec2(0.0, 0.0);
    const SurfaceDomain d = surface->domain();
    const auto whole = [](double gained, const Interval& range, bool closed) {
      return closed ? range.length() * std::round(gained / range.length()) : 0.0;
    };
    const UV first = start_.feet[i].at;
    return {whole(after.u - first.u, d.u, d.u_closed), whole(after.v - first.v, d.v, d.v_closed)};
  }

  /// Bisects for the last ball before what stopped the step.
  [[nodiscard]] Walk ended(Walk way, double h, const Step& stop) const {
    const BallContact from = way.contacts.back();
    double good = 0.0, bad = h;
    std::optional<BallContact> last;
    for (int k = 0; k < 60 && bad - good > 1e-4 * shortest_; ++k) {
      const double middle = 0.5 * (good + bad);
      const Step step = stepped(from, middle, 4 * corrections);
      if (step.contact) last = step.contact;
      (step.contact ? good : bad) = middle;
    }
    if (last) way.contacts.push_back(*last);
    drop_crowd(way.contacts, h);
    if (stop.out_of_box)
      way.end.kind = SpineEnd::Kind::box;
    else if (stop.cause == Cause::domain)
      way.end.kind = SpineEnd::Kind::domain;
    else
      way.end = {SpineEnd::Kind::failure,
                 failure(named(way.contacts.back(), stop.cause), pair_, way.contacts.back().c)};
    return way;
  }

  /// Points next to the end, where steps became ever shorter, only make the curve between them uncertain.
  void drop_crowd(std::vector<BallContact>& contacts, double h) const {
    const double apart = std::max(0.1 * h, 1e-4 * std::abs(pair_.radius[0]));
    while (contacts.size() > 2 && (contacts[contacts.size() - 2].c - contacts.back().c).norm() < apart)
      contacts.erase(contacts.end() - 2);
  }

  /// The cause, where the steps say it; else what the last ball is next to. Close to a place where the ball
  /// is as curved as the hollow the spine has a cusp, and feet are hard to reach: 1 + r kappa is then of the
  /// order of the root of the distance.
  [[nodiscard]] static Cause named(const BallContact& at, std::optional<Cause> cause) {
    if (cause && *cause != Cause::lost) return *cause;
    if (std::min(at.feet[0].room, at.feet[1].room) < 1e-2) return Cause::curvature;
    return parallel(at, 1e-6) ? Cause::tangent : Cause::lost;
  }

  const BallPair& pair_;
  const SpineSpec& spec_;
  double direction_;
  BallContact start_;
  double longest_, shortest_;
};

/// At least `count` points: the interpolation between them has full degree.
void refine(const BallPair& pair, std::vector<BallContact>& contacts, bool closed, std::size_t count) {
  while (contacts.size() < count && contacts.size() >= 2) {
    std::vector<BallContact> finer;
    for (std::size_t k = 0; k + (closed ? 0 : 1) < contacts.size(); ++k) {
      const BallContact &a = contacts[k], &b = contacts[(k + 1) % contacts.size()];
      finer.push_back(a);
      const Vec3 middle = 0.5 * (a.c + b.c);
      const Corrected found = corrected_in_plane(pair, middle, middle, b.c - a.c, a.feet);
      if (const auto* contact = std::get_if<BallContact>(&found)) finer.push_back(*contact);
    }
    if (!closed) finer.push_back(contacts.back());
    if (finer.size() == contacts.size()) return;
    contacts = std::move(finer);
  }
}

}  // namespace

SpineSpec checked(const BallPair& pair, const SpineSpec& spec) {
  std::vector<Problem> problems;
  const double r = std::abs(pair.radius[0]);
  if (!(r > 0.0) || !std::isfinite(r) || std::abs(pair.radius[1]) != r)
    problems.push_back({"radius", "is " + number_text(pair.radius[0]) + " and " +
                                      number_text(pair.radius[1]) +
                                      ", must be two numbers of the same size, not 0"});
  if (!spec.box.finite() || !((spec.box.size().array() > 0.0).all()))
    problems.push_back({"box", "is empty or not finite, must be a box of ball centres"});
  for (const auto& [key, value] :
       {std::pair("chord_tolerance", spec.chord_tolerance), std::pair("seed_size", spec.seed_size)})
    if (!(value >= 0.0) || !std::isfinite(value))
      problems.push_back({key, "is " + number_text(value) + ", must be >= 0"});
  if (!problems.empty()) throw InputError(std::move(problems));
  SpineSpec full = spec;
  if (full.chord_tolerance == 0.0) full.chord_tolerance = 1e-3 * r;
  if (full.seed_size == 0.0) full.seed_size = std::max(0.25 * r, 0.01 * spec.box.size().norm());
  return full;
}

BallFailure failure(Cause cause, const BallPair& pair, const Vec3& at) {
  const std::string r = number_text(std::abs(pair.radius[0]), 6), where = " at " + point_text(at);
  std::string text;
  switch (cause) {
    case Cause::tangent:
      text = "the ball of radius " + r + " touches both primaries in one direction" + where +
             ": their normals are parallel, so the spine is singular or the blend vanishes";
      break;
    case Cause::curvature:
      text = "the ball of radius " + r + " does not fit into a hollow of a primary" + where +
             ": 1 + r kappa is not positive; take a smaller radius";
      break;
    case Cause::no_spine:
      text = "no ball of radius " + r + " in the box touches both primaries on these sides";
      break;
    case Cause::interference:
      text = "the ball of radius " + r + " meets a primary or another part elsewhere" + where;
      break;
    case Cause::domain:
      text = "the ball of radius " + r + " touches a surface beyond its domain" + where;
      break;
    case Cause::lost:
      text = "the ball of radius " + r + " cannot be followed" + where;
      break;
  }
  return {cause, at, 0.0, text};
}

std::optional<Spine> traced(const BallPair& pair, const SpineSpec& spec, const BallContact& start) {
  constexpr std::size_t fewest = 12;
  Walk on = Walker(pair, spec, start, 1.0).walk();
  const bool closed = on.end.kind == SpineEnd::Kind::closed;
  std::array<SpineEnd, 2> ends{on.end, on.end};
  std::vector<BallContact> contacts = std::move(on.contacts);
  if (!closed) {
    Walk back = Walker(pair, spec, start, -1.0).walk();
    ends[0] = back.end;
    std::reverse(back.contacts.begin(), back.contacts.end());
    back.contacts.pop_back();
    contacts.insert(contacts.begin(), back.contacts.begin(), back.contacts.end());
  }
  refine(pair, contacts, closed, fewest);
  if (contacts.size() < fewest) return std::nullopt;
  std::vector<SpinePoint> points;
  for (const BallContact& c : contacts) points.push_back(spine_point(pair, c));
  return Spine(pair, std::move(points), closed, on.turns, std::move(ends));
}

}  // namespace blendwright
