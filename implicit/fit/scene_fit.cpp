#include "implicit/fit/scene_fit.hpp"

#include <algorithm>
#include <array>
#include <limits>
#include <numeric>

#include "implicit/fit/fit_determination.hpp"
#include "implicit/scene/scene.hpp"
#include "kernel/base/error.hpp"
#include "kernel/base/number_text.hpp"

namespace blendwright {

using namespace detail;

namespace {

double size_of(std::span<const Vec3> points) {
  Vec3 lo = points[0], hi = points[0];
  for (const Vec3& p : points) {
    lo = lo.cwiseMin(p);
    hi = hi.cwiseMax(p);
  }
  return (hi - lo).norm();
}

void check_points(std::span<const Vec3> points, std::size_t unknowns, std::vector<Problem>& problems) {
  std::size_t bad = 0, first = 0;
  for (std::size_t i = points.size(); i-- > 0;)
    if (!points[i].allFinite()) {
      ++bad;
      first = i;
    }
  if (bad > 0)
    problems.push_back({"points", std::to_string(bad) + " of " + std::to_string(points.size()) +
                                      " are not finite, the first is point " + std::to_string(first + 1) +
                                      "; every coordinate must be a number"});
  else if (points.size() < std::max<std::size_t>(unknowns, 4))
    problems.push_back({"points", "there are " + std::to_string(points.size()) + ", must be at least " +
                                      std::to_string(std::max<std::size_t>(unknowns, 4)) + ": there are " +
                                      std::to_string(unknowns) + " unknown numbers"});
  else if (!(size_of(points) > 0.0))
    problems.push_back({"points", "are all at one place, must show a surface"});
}

/// Every k-th point, at most `most`.
std::vector<Vec3> thinned(std::span<const Vec3> points, std::size_t most) {
  const std::size_t step = (points.size() + most - 1) / most;
  std::vector<Vec3> out;
  for (std::size_t i = 0; i < points.size(); i += step) out.push_back(points[i]);
  return out;
}

double median_magnitude(std::vector<double> r) {
  for (double& x : r) x = std::abs(x);
  const auto middle = r.begin() + static_cast<std::ptrdiff_t>(r.size() / 2);
  std::nth_element(r.begin(), middle, r.end());
  return *middle;
}

double rms(const std::vector<double>& r) {
  return std::sqrt(std::inner_product(r.begin(), r.end(), r.begin(), 0.0) / static_cast<double>(r.size()));
}

/// Largest relative difference of half-axes in order of size: descriptions that only exchange axes are equal.
double difference(const FitModel& model, const std::vector<double>& a, const std::vector<double>& b) {
  std::array<std::vector<double>, 2> lengths;
  for (std::size_t i = 0; i < a.size(); ++i)
    if (model.slots[i].free && model.slots[i].scale == FitSlot::Scale::logarithmic &&
        model.slots[i].widest.hi > 1e6) {
      lengths[0].push_back(a[i]);
      lengths[1].push_back(b[i]);
    }
  double worst = 0.0;
  for (auto& list : lengths) std::sort(list.begin(), list.end());
  for (std::size_t i = 0; i < lengths[0].size(); ++i)
    worst = std::max(worst, std::abs(std::log(lengths[0][i] / lengths[1][i])));
  return std::exp(worst) - 1.0;
}

/// Of superquadrics, whose z axis is not like the others: whether c is another half-axis.
bool z_axis_differs(const FitModel& model, const std::vector<double>& a, const std::vector<double>& b) {
  for (const FitNode& node : model.nodes)
    if (node.kind == FitNode::Kind::form_superquadric &&
        std::abs(std::log(a[node.slot + 2] / b[node.slot + 2])) > 0.02)
      return true;
  return false;
}

struct Best {
  FitModel model;
  Solved solved;
};

/// The best of several starts: a short run on few points each, then a whole one from the best two.
Best best_of(std::vector<FitStart> starts, std::span<const Vec3> points, const SolveOptions& options,
             const Progress& progress, std::vector<std::string>& not_unique) {
  const std::vector<Vec3> few = thinned(points, 300);
  const SolveOptions shorter{options.robust_scales, 12};
  std::vector<Best> tried;
  for (std::size_t i = 0; i < starts.size(); ++i) {
    progress.at(0.5 * static_cast<double>(i) / static_cast<double>(starts.size()), "looking for a start");
    tried.push_back({std::move(starts[i].model), {}});
    const Progress quiet{.stop = progress.stop};
    tried.back().solved = solve_fit(tried.back().model, std::move(starts[i].values), few, shorter, quiet);
  }
  const auto by_cost = [](const Best& a, const Best& b) { return a.solved.cost < b.solved.cost; };
  std::stable_sort(tried.begin(), tried.end(), by_cost);
  // The best, and the best that is something else: it may win on all points, or show that there are two
  // answers.
  const auto other = std::find_if(tried.begin() + 1, tried.end(), [&](const Best& b) {
    return difference(b.model, b.solved.values, tried[0].solved.values) > 0.05 ||
           z_axis_differs(b.model, b.solved.values, tried[0].solved.values);
  });
  if (other != tried.end()) std::iter_swap(tried.begin() + 1, other);
  tried.resize(std::min<std::size_t>(tried.size(), other != tried.end() ? 2 : 1));
  const std::vector<Vec3> some = thinned(points, 2000);
  const Progress quiet{.stop = progress.stop};
  const SolveOptions last{{options.robust_scales.back()}, options.max_iterations};
  for (std::size_t i = 0; i < tried.size(); ++i) {
    progress.at(0.5 + 0.1 * static_cast<double>(i), "fitting");
    tried[i].solved = solve_fit(tried[i].model, std::move(tried[i].solved.values), some, last, quiet);
  }
  std::stable_sort(tried.begin(), tried.end(), by_cost);
  if (tried.size() > 1 && tried[1].solved.cost <= 1.01 * tried[0].solved.cost) {
    const auto &a = tried[0].solved.values, &b = tried[1].solved.values;
    const double sorted = difference(tried[0].model, a, b);
    if (sorted > 0.02)
      not_unique.push_back("another solution is as good to 1 %: its half-axes differ by up to " +
                           number_text(100.0 * sorted, 2) + " %");
    else if (z_axis_differs(tried[0].model, a, b))
      not_unique.push_back(
          "the half-axes may change their names: another turn with another one as c is as good to 1 %");
  }
  progress.at(0.7, "fitting");
  tried[0].solved = solve_fit(tried[0].model, std::move(tried[0].solved.values), points, last, quiet);
  return std::move(tried[0]);
}

void list_numbers(const FitModel& model, const std::vector<double>& start, const std::vector<double>& values,
                  const Determination& known, SceneFitResult& result) {
  const std::vector<std::size_t> free = model.free();
  for (std::size_t k = 0; k < free.size(); ++k) {
    const FitSlot& slot = model.slots[free[k]];
    FittedNumber number;
    number.name = slot.node + "/" + slot.key;
    if (slot.index >= 0) number.name.append("/").append(std::to_string(slot.index));
    number.start = start[free[k]];
    number.value = values[free[k]];
    number.deviation = known.deviation[k] * (slot.scale == FitSlot::Scale::logarithmic ? number.value : 1.0);
    number.determined = known.determined[k];
    if (slot.scale == FitSlot::Scale::turn) {  // three components, one angle
      number.name = slot.node + "/turn";
      const Vec3 w(values[free[k]], values[free[k + 1]], values[free[k + 2]]);
      number.start = 0.0;
      number.value = Radians(w.norm()).degrees();
      for (std::size_t j = 1; j < 3; ++j) {
        number.deviation = std::max(number.deviation, known.deviation[k + j]);
        number.determined = number.determined && known.determined[k + j];
      }
      number.deviation = Radians(number.deviation).degrees();
      k += 2;
    } else {
      const double slack = 1e-6 * std::max(std::abs(number.value), 1e-12);
      number.at_bound = number.value <= slot.bounds.lo + slack || number.value >= slot.bounds.hi - slack;
      if (number.at_bound)
        result.warnings.push_back(number.name + " is at its bound, " + number_text(number.value, 6));
    }
    if (!number.determined)
      result.not_unique.push_back(number.name + " is not determined by these points: " +
                                  (std::isfinite(number.deviation)
                                       ? "its standard deviation is " + number_text(number.deviation, 2)
                                       : std::string("they look the same for every value")) +
                                  (slot.scale == FitSlot::Scale::turn ? " deg" : ""));
    result.numbers.push_back(std::move(number));
  }
}

void measure(const std::vector<double>& r, std::span<const Vec3> points, SceneFitResult& result) {
  result.points = r.size();
  result.rms = rms(r);
  const double reach = 3.0 * 1.4826 * median_magnitude(r) + 1e-300;
  for (std::size_t i = 0; i < r.size(); ++i) {
    if (std::abs(r[i]) <= reach) ++result.inliers;
    if (std::abs(r[i]) <= result.worst) continue;
    result.worst = std::abs(r[i]);
    result.worst_point = points[i];
  }
  if (10 * result.inliers < 8 * result.points)
    result.warnings.push_back(std::to_string(result.points - result.inliers) + " of " +
                              std::to_string(result.points) +
                              " points are far off; a robust scale keeps them from pulling");
}

}  // namespace

SceneFitResult fit_scene(const SceneSpec& start, std::span<const Vec3> points, const SceneFitOptions& options,
                         const Progress& progress) {
  static_cast<void>(build_scene(start));  // says what is wrong with the scene itself
  FitModel model = fit_model(start);
  std::vector<Problem> problems;
  if (!options.unknowns.empty()) choose_unknowns(model, options.unknowns, problems);
  check_points(points, model.free().size(), problems);
  if (options.robust_scale && !(*options.robust_scale > 0.0 && std::isfinite(*options.robust_scale)))
    problems.push_back({"robust_scale", "is " + number_text(*options.robust_scale) + ", must be > 0"});
  if (options.max_iterations < 1)
    problems.push_back(
        {"max_iterations", "is " + std::to_string(options.max_iterations) + ", must be at least 1"});
  std::vector<double> values;
  for (const FitSlot& slot : model.slots) values.push_back(slot.value);
  std::vector<FitStart> starts;
  if (problems.empty() && options.start_from_points) {
    starts = starts_from_points(model, points, options.robust_scale.has_value());
    if (starts.empty())
      problems.push_back({"start_from_points",
                          "needs one form under one place, as the solid of the scene; start from "
                          "the scene's own numbers instead"});
  }
  if (!problems.empty()) throw InputError(std::move(problems));

  SceneFitResult result;
  const double size = size_of(points);
  for (FitSlot& slot : model.slots)  // lengths far beyond the points only let the solver run away
    if (slot.free && slot.scale == FitSlot::Scale::logarithmic && slot.widest.hi > 1e6 &&
        slot.bounds.hi > 1e6)
      slot.bounds = {std::max(slot.bounds.lo, 1e-4 * size), (options.start_from_points ? 3.0 : 100.0) * size};
  for (FitStart& s : starts) s.model.slots = model.slots;
  result.rms_before = rms(residuals(model, values, points));
  const std::vector<double> own = values;
  if (starts.empty()) starts.push_back({model, values});
  SolveOptions how{{}, options.max_iterations};
  for (double scale = 0.1 * size; options.robust_scale && scale > *options.robust_scale; scale *= 0.1)
    how.robust_scales.push_back(scale);
  how.robust_scales.push_back(options.robust_scale.value_or(0.0));
  Best best = starts.size() == 1 ? Best{model, solve_fit(model, values, points, how, progress)}
                                 : best_of(std::move(starts), points, how, progress, result.not_unique);
  if (!std::isfinite(best.solved.cost))
    throw ConvergenceError(
        "the fit found no numbers for which the distances of all points are finite; start nearer");

  const std::vector<double> r = residuals(best.model, best.solved.values, points);
  measure(r, points, result);
  const Linearised at = linearised(best.model, best.solved.values, points);
  const double noise = options.robust_scale ? 1.4826 * median_magnitude(r) : result.rms;
  const Determination known = determination(best.model, at, noise, size);
  result.condition = known.condition;
  list_numbers(best.model, own, best.solved.values, known, result);
  result.converged = best.solved.converged;
  result.costs = best.solved.costs;
  if (!result.converged)
    result.warnings.push_back("the solver stopped after " + std::to_string(result.costs.size()) +
                              " iterations without converging");
  result.spec = with_values(start, best.model, best.solved.values);
  progress.at(1.0, "fitted");
  return result;
}

}  // namespace blendwright
