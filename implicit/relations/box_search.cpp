#include "implicit/relations/box_search.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <queue>

#include "implicit/relations/linear_parts.hpp"
#include "implicit/relations/linear_refutation.hpp"
#include "kernel/base/number_text.hpp"

namespace blendwright::detail {
namespace {

using Model = ScalarField::Model;
using Verdict = SearchCell::Verdict;
using Models = std::array<std::shared_ptr<const Model>, 2>;

constexpr double round_off = std::numeric_limits<double>::epsilon();
/// Less of an edge is not worth a cut.
constexpr double worth = 0.05;
constexpr double infinity = std::numeric_limits<double>::infinity();

/// A box still to be decided, with models that hold on it.
struct Pending {
  Box box;
  Models models;
  double height;      ///< about how deep a common point can be
  Vec3 highest;       ///< about where
  std::size_t order;  ///< later boxes first among equals
};
struct LowerPriority {
  bool operator()(const Pending& a, const Pending& b) const {
    return a.height != b.height ? a.height < b.height : a.order < b.order;
  }
};

/// psi from the linear bounds of sign * f.
LinearParts psi_parts(const Half& half, const Model& model, const Box& box) {
  LinearParts parts = linear_parts(model, box, half.sign());
  const double shift = -half.sign() * surface_value(half.field->level());
  if (shift != 0.0)
    for (LinearBound& b : parts.bounds) b = b + constant_bound({shift, shift});
  return parts;
}

class Search {
 public:
  Search(std::span<const Half> halves, const SearchOptions& options, const Progress& progress,
         std::optional<int> depth_axis)
      : halves_(halves), options_(options), progress_(progress), depth_axis_(depth_axis) {}

  Found run(const Box& domain, const std::optional<Vec3>& start) {
    volume_ = volume_of(domain);
    const double reach = domain.size().maxCoeff();
    if (start && domain.contains(*start) && !prove(*start)) refine(*start, reach);
    Models all;
    for (std::size_t i = 0; i < halves_.size(); ++i) all[i] = halves_[i].field->shared_model();
    if (!witness_) examine(domain, all);
    while (!queue_.empty() && !witness_) {
      if (boxes_ >= options_.max_boxes) {
        for (; !queue_.empty(); queue_.pop()) leave(queue_.top().box);
        break;
      }
      const Pending next = queue_.top();
      queue_.pop();
      split(next);
    }
    return finish();
  }

 private:
  static double volume_of(const Box& box) { return box.size().cwiseMax(1e-100).prod(); }

  /// The box is decided.
  void record(const Box& box, Verdict verdict) {
    decided_ += volume_of(box);
    if (options_.keep_cells) cells_.push_back({verdict, box});
  }
  void leave(const Box& box) {
    undecided_ = undecided_ ? hull(*undecided_, box) : box;
    record(box, Verdict::undecided);
  }

  /// Decides the box, or puts it on the queue.
  void examine(const Box& box, Models models) {
    if (++boxes_ % 1024 == 0)
      progress_.at(std::clamp(decided_ / volume_, 0.0, 1.0), "looking for a common point");
    bool everywhere = true;
    for (std::size_t i = 0; i < halves_.size(); ++i) {
      Model::Within within = models[i]->within(box);
      const Range psi = halves_[i].psi(within.range);
      if (halves_[i].excludes(psi))
        return record(box, i == 0 ? Verdict::outside_first : Verdict::outside_second);
      everywhere = everywhere && halves_[i].holds(psi);
      if (within.model) models[i] = std::move(within.model);
    }
    Pending next{box, std::move(models), 0.0, box.centre(), boxes_};
    if (everywhere && prove(next.highest)) return record(box, Verdict::witness);
    if (options_.combination) {
      if (separated(next)) return record(box, Verdict::separated);
    } else {
      next.height = box.size().maxCoeff();
    }
    if (likely_witness(next) && prove(next.highest)) return record(box, Verdict::witness);
    queue_.push(std::move(next));
  }

  /// Tries all pairs of alternatives; else finds where the highest of them is.
  bool separated(Pending& p) {
    for (std::size_t i = 0; i < halves_.size(); ++i) parts_[i] = psi_parts(halves_[i], *p.models[i], p.box);
    const double length = p.box.size().maxCoeff();
    const std::size_t n1 = halves_.size() > 1 ? parts_[1].alternatives() : 1;
    LinearPoint best{-infinity, Vec3::Zero(), -infinity};
    bool all = true;
    for (std::size_t k = 0; k < parts_[0].alternatives() * n1; ++k) {
      const auto first = parts_[0].alternative(k / n1);
      both_.assign(first.begin(), first.end());
      if (halves_.size() > 1) {
        const auto second = parts_[1].alternative(k % n1);
        both_.insert(both_.end(), second.begin(), second.end());
      }
      const LinearPoint point = highest_point(both_, length);
      if (point.upper < 0.0) continue;
      if (all || point.height > best.height) best = point;
      all = false;
    }
    p.height = best.height;
    p.highest = inside_of(p.box, p.box.centre() + 0.5 * p.box.size().cwiseProduct(best.t));
    if (!all && !depth_axis_) {
      clip(p);
      p.highest = inside_of(p.box, p.highest);
    }
    return all;
  }

  /// Cuts off the ends of the box where a linear bound leaves nothing of one solid.
  void clip(Pending& p) {
    const Box whole = p.box;
    for (std::size_t i = 0; i < halves_.size(); ++i) {
      if (parts_[i].alternatives() != 1) continue;
      for (const LinearBound& b : parts_[i].bounds) {
        const Box left = left_of(b, whole);
        for (int axis = 0; axis < 3; ++axis) {
          if (left.lo[axis] > p.box.lo[axis] + worth * p.box.size()[axis])
            cut(p.box, axis, left.lo[axis], true, i);
          if (left.hi[axis] < p.box.hi[axis] - worth * p.box.size()[axis])
            cut(p.box, axis, left.hi[axis], false, i);
        }
      }
    }
  }

  /// Encloses the points of the box where the bound can be >= 0.
  static Box left_of(const LinearBound& b, const Box& box) {
    Box left = box;
    const double reach = b.slope.lpNorm<1>(), top = b.value + b.rest.hi + reach;
    const double size = std::abs(b.value) + std::abs(b.rest.hi) + reach;
    if (!std::isfinite(size)) return left;
    for (int axis = 0; axis < 3; ++axis) {
      const double slope = std::abs(b.slope[axis]);
      // At the distance t from its higher end the bound is at most top - slope t.
      const double depth = (top + 16.0 * round_off * size) / slope * (1.0 + 4.0 * round_off);
      if (!(depth < 2.0)) continue;
      const double length = 0.5 * depth * box.size()[axis] +
                            4.0 * round_off * (std::abs(box.lo[axis]) + std::abs(box.hi[axis]));
      if (b.slope[axis] > 0.0)
        left.lo[axis] = std::max(box.lo[axis], box.hi[axis] - length);
      else
        left.hi[axis] = std::min(box.hi[axis], box.lo[axis] + length);
    }
    return left;
  }

  void cut(Box& box, int axis, double at, bool low_end, std::size_t by) {
    if (!(at > box.lo[axis] && at < box.hi[axis])) return;
    Box off = box;
    (low_end ? off.hi : off.lo)[axis] = at;
    (low_end ? box.lo : box.hi)[axis] = at;
    record(off, by == 0 ? Verdict::outside_first : Verdict::outside_second);
  }

  static Vec3 inside_of(const Box& box, const Vec3& x) { return x.cwiseMax(box.lo).cwiseMin(box.hi); }

  /// The cheap models' word for the point.
  bool likely_witness(const Pending& p) const {
    const Box at{p.highest, p.highest};
    for (std::size_t i = 0; i < halves_.size(); ++i)
      if (!halves_[i].holds(halves_[i].psi(p.models[i]->range(at)))) return false;
    return true;
  }

  /// Whether the point is proven to be common; it is the witness then.
  bool prove(const Vec3& point) {
    if (!common(halves_, point)) return false;
    witness_ = point;
    return true;
  }

  /// Newton from the point; its result is kept as the nearest place, and tried as a witness.
  void refine(const Vec3& from, double reach) {
    if (halves_.size() != 2) return;
    const std::optional<ContactPoint> found = contact_point(halves_[0], halves_[1], from, reach);
    if (!found) return;
    if (found->settled && (!nearest_ || found->gap() < nearest_->gap())) nearest_ = found;
    if (found->depth >= 0.0) (void)prove(found->point);
  }

  void split(const Pending& p) {
    // Newton costs as much as some boxes: it is tried at boxes 1, 2, 4, 8, ... of the search.
    if (boxes_ >= next_refinement_) {
      next_refinement_ = 2 * boxes_;
      refine(p.highest, p.box.size().maxCoeff());
      if (witness_) return record(p.box, Verdict::witness);
    }
    std::array<Box, 4> parts{p.box};
    std::size_t count = 1;
    for (int axis = 0; axis < 3; ++axis) {
      if (depth_axis_ ? axis == *depth_axis_ : axis != longest(p.box)) continue;
      const double middle = p.box.lo[axis] + 0.5 * p.box.size()[axis];
      const bool fine = p.box.size()[axis] <= options_.tolerance;
      if (fine || !(middle > p.box.lo[axis] && middle < p.box.hi[axis])) continue;
      for (std::size_t i = 0; i < count; ++i) {
        parts[count + i] = parts[i];
        parts[i].hi[axis] = middle;
        parts[count + i].lo[axis] = middle;
      }
      count *= 2;
    }
    if (count == 1) return leave(p.box);
    for (std::size_t i = 0; i < count && !witness_; ++i) examine(parts[i], p.models);
  }

  static int longest(const Box& box) {
    int axis = 0;
    (void)box.size().maxCoeff(&axis);
    return axis;
  }

  Found finish() {
    Found found;
    found.nearest = nearest_;
    found.proof.boxes = boxes_;
    found.proof.witness = witness_;
    found.proof.undecided = undecided_;
    found.proof.cells = std::move(cells_);
    found.proof.answer = witness_ ? Answer::refuted : undecided_ ? Answer::undecided : Answer::proven;
    return found;
  }

  std::span<const Half> halves_;
  const SearchOptions& options_;
  const Progress& progress_;
  std::optional<int> depth_axis_;
  std::priority_queue<Pending, std::vector<Pending>, LowerPriority> queue_;
  std::array<LinearParts, 2> parts_;
  std::vector<LinearBound> both_;
  std::size_t boxes_ = 0, next_refinement_ = 2;
  std::optional<Vec3> witness_;
  std::optional<Box> undecided_;
  std::optional<ContactPoint> nearest_;
  std::vector<SearchCell> cells_;
  double volume_ = 1.0, decided_ = 0.0;
};

void check_box(const std::optional<Box>& box, std::string_view must) {
  if (box && (!box->finite() || (box->lo.array() > box->hi.array()).any()))
    throw InputError("domain", std::string(must));
}

}  // namespace

bool common(std::span<const Half> halves, const Vec3& point) {
  const Box at{point, point};
  return std::ranges::all_of(halves,
                             [&](const Half& half) { return half.holds(half.psi(half.field->range(at))); });
}

std::optional<Box> search_domain(std::span<const Half> halves, const SearchOptions& options) {
  if (!(options.tolerance > 0.0) || !std::isfinite(options.tolerance))
    throw InputError("tolerance", "is " + number_text(options.tolerance) + ", must be a length > 0");
  if (options.max_boxes == 0) throw InputError("max_boxes", "is 0, must be at least 1");
  check_box(options.domain, "must be a finite box with lo <= hi");
  Box where{Vec3::Constant(-infinity), Vec3::Constant(infinity)};
  if (options.domain) where = *options.domain;
  for (const Half& half : halves) {
    if (half.outside || !half.field->bounds()) continue;
    const std::optional<Box> left = blendwright::common(where, *half.field->bounds());
    if (!left) return std::nullopt;
    where = *left;
  }
  check_box(where, "is missing: the solids have no known bounds; give the finite box to look in");
  return where;
}

Found find_common_point(std::span<const Half> halves, const Box& domain, const SearchOptions& options,
                        const Progress& progress, const std::optional<Vec3>& start,
                        std::optional<int> depth_axis) {
  progress.at(0.0, "looking for a common point");
  return Search(halves, options, progress, depth_axis).run(domain, start);
}

}  // namespace blendwright::detail
