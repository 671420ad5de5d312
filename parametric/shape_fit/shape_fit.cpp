#include "parametric/shape_fit/shape_fit.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "kernel/base/error.hpp"
#include "kernel/base/number_text.hpp"
#include "kernel/base/parallel_for.hpp"
#include "parametric/shape_fit/determination.hpp"
#include "parametric/shape_fit/fit_measure.hpp"
#include "parametric/shape_fit/fit_problem.hpp"
#include "parametric/shape_fit/fit_solver.hpp"

namespace blendwright {

using namespace detail;

namespace {

/// splitmix64, as a number in [0, 1): further starts are the same everywhere.
class Sequence {
 public:
  explicit Sequence(std::uint64_t seed) : state_(seed) {}
  double next() {
    std::uint64_t z = (state_ += 0x9e3779b97f4a7c15ull);
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9ull;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebull;
    return static_cast<double>((z ^ (z >> 31)) >> 11) * 0x1.0p-53;
  }

 private:
  std::uint64_t state_;
};

class Fit {
 public:
  Fit(FitInput input, const ShapeFitOptions& options, const Progress& progress, const FitStep& step)
      : options_(options),
        progress_(progress),
        step_(step),
        before_(started(input, options, progress)),
        problem_(fit_problem(std::move(input), before_, options)),
        residuals_(residuals_of()) {}

  ShapeFitResult run() && {
    setting();
    FitSolution best = solved(0, solver_start());
    std::vector<FitSolution> all{best};
    for (int k = 1; k < options_.starts; ++k) {
      try {
        all.push_back(solved(k, other_start(k)));
      } catch (const ConvergenceError&) {
        continue;  // that start is no blend; the others decide
      }
    }
    for (const FitSolution& s : all)
      if (s.costs.back() < best.costs.back()) best = s;
    ShapeFitResult result;
    const std::vector<double> x = model_x(best.x);
    result.spec = problem_.spec(x.data());
    result.costs = best.costs;
    result.converged = best.converged;
    const Determination d = determination(problem_, residuals_, best.x, options_.bounds.prior);
    result.condition = d.condition;
    result.singular_values = d.singular_values;
    result.not_unique = d.not_unique;
    compare(all, best, d, result);
    parameters(best.x, d, result);
    measure(result);
    return result;
  }

 private:
  static Blend started(const FitInput& input, const ShapeFitOptions& options, const Progress& progress) {
    std::vector<Problem> problems = check_fit(input, options);
    if (!problems.empty()) throw InputError(std::move(problems));
    progress.at(0.0, "building the start");
    Blend blend = input.made(input.spec);
    problems = check_against(blend, options);
    if (!problems.empty()) throw InputError(std::move(problems));
    return blend;
  }

  [[nodiscard]] FitResiduals residuals_of() const {
    return {*problem_.model, options_, model_x(scaled_start())};
  }
  /// The start in the solver's units.
  [[nodiscard]] std::vector<double> scaled_start() const { return problem_.x0; }
  [[nodiscard]] std::vector<double> solver_start() const { return problem_.x0; }
  [[nodiscard]] std::vector<double> model_x(std::vector<double> x) const {
    for (std::size_t p = 0; p < x.size(); ++p) x[p] *= problem_.scale[p];
    return x;
  }

  void setting() {
    setting_.scale = problem_.scale;
    setting_.max_iterations = options_.max_iterations;
    setting_.linear.assign(problem_.unknowns.size(), false);
    for (const Unknown& u : problem_.unknowns) setting_.bounds.push_back(u.bounds);
    const Layout& layout = problem_.model->layout();
    if (!residuals_.linear_in_laws()) return;
    for (std::size_t p = layout.law_start(0); p < layout.angle_start(0); ++p) setting_.linear[p] = true;
  }

  FitSolution solved(int start, std::vector<double> x) {
    const auto accepted = [&](int iteration, double cost, const double* at) {
      const double share = 1.0 / options_.starts;
      progress_.at(share * (start + std::min(0.95, static_cast<double>(iteration) / options_.max_iterations)),
                   "fitting");
      if (step_ && start == 0) step_(iteration, cost, problem_.input.made(problem_.spec(at)));
    };
    if (start > 0) residuals_.find_feet(model_x(x).data());
    FitSolution s = solve_fit(residuals_, setting_, std::move(x), accepted);
    // Foot points that were followed into another part of the surface are searched anew.
    for (int round = 0; round < 3 && s.usable && residuals_.find_feet(model_x(s.x).data()); ++round) {
      FitSolution next = solve_fit(residuals_, setting_, s.x, accepted);
      if (!next.usable) break;
      s.costs.insert(s.costs.end(), next.costs.begin() + 1, next.costs.end());
      s.x = std::move(next.x);
      s.converged = next.converged;
    }
    if (!s.usable || s.costs.empty() || !std::isfinite(s.costs.back()))
      throw ConvergenceError(
          "the fit finds no blend with a finite cost at its start; check the start, the bounds "
          "and the objectives");
    return s;
  }

  /// Within the bounds; shape unknowns and magnitudes over the middle of their range, the others near the
  /// start.
  [[nodiscard]] std::vector<double> other_start(int k) const {
    Sequence sequence(static_cast<std::uint64_t>(k));
    std::vector<double> x = problem_.x0;
    const Layout& layout = problem_.model->layout();
    for (std::size_t p = 0; p < x.size(); ++p) {
      const double f = sequence.next();
      const Interval& b = problem_.unknowns[p].bounds;
      if (p < layout.law_start(0)) {
        x[p] = std::log1p(0.1) + f * (std::min(b.hi, std::log1p(25.0)) - std::log1p(0.1));
      } else if (p < layout.angle_start(0)) {
        x[p] *= std::exp((2.0 * f - 1.0) * std::log(1.6));
      } else if (p < layout.map_start()) {
        x[p] += 0.4 * (2.0 * f - 1.0);
      } else {
        x[p] += 0.2 * (2.0 * f - 1.0);
      }
      x[p] = b.clamp(x[p]);
    }
    return x;
  }

  /// Whether all starts came to the same place, apart from directions that nothing determines.
  void compare(const std::vector<FitSolution>& all, const FitSolution& best, const Determination& d,
               ShapeFitResult& result) const {
    std::vector<const FitSolution*> distinct;
    for (const FitSolution& s : all) {
      const bool known = std::any_of(distinct.begin(), distinct.end(),
                                     [&](const FitSolution* other) { return same(s, *other, d.free); });
      if (!known) distinct.push_back(&s);
    }
    if (options_.starts > 1 && all.size() < static_cast<std::size_t>(options_.starts))
      result.warnings.push_back(std::to_string(options_.starts - static_cast<int>(all.size())) + " of " +
                                std::to_string(options_.starts) + " starts are no blend and were left out");
    if (distinct.size() < 2) return;
    std::string text = std::to_string(all.size()) + " starts reach " + std::to_string(distinct.size()) +
                       " different optima (cost ";
    for (std::size_t i = 0; i < distinct.size(); ++i) {
      if (i > 0) text += i + 1 == distinct.size() ? " and " : ", ";
      text += scientific_text(distinct[i]->costs.back());
    }
    (void)best;
    result.not_unique.push_back(text + "); the best is returned");
  }

  static bool same(const FitSolution& a, const FitSolution& b, const Eigen::MatrixXd& free) {
    const auto n = static_cast<Eigen::Index>(a.x.size());
    Eigen::VectorXd away =
        Eigen::Map<const Eigen::VectorXd>(a.x.data(), n) - Eigen::Map<const Eigen::VectorXd>(b.x.data(), n);
    for (Eigen::Index k = 0; k < free.cols(); ++k) away -= free.col(k).dot(away) * free.col(k);
    return away.cwiseAbs().maxCoeff() <= 1e-3;
  }

  void parameters(const std::vector<double>& x, const Determination& d, ShapeFitResult& result) const {
    for (std::size_t p = 0; p < x.size(); ++p) {
      const Unknown& u = problem_.unknowns[p];
      FittedParameter f;
      f.name = u.name;
      f.start = u.value(problem_.x0[p]);
      f.value = u.value(x[p]);
      f.bounds = u.value_bounds();
      const double width = u.bounds.length();
      f.at_bound = x[p] - u.bounds.lo <= 1e-9 * width || u.bounds.hi - x[p] <= 1e-9 * width;
      const double deviation = p < d.deviation.size() ? d.deviation[p] : 0.0;
      f.deviation = deviation == 0.0 ? 0.0 : std::abs(u.slope(x[p])) * deviation;
      if (f.at_bound)
        result.warnings.push_back(f.name + " stands at its bound " + number_text(f.value, 6) +
                                  "; wider bounds may give a better blend");
      result.parameters.push_back(std::move(f));
    }
  }

  void measure(ShapeFitResult& result) const {
    result.warnings.insert(result.warnings.begin(), problem_.warnings.begin(), problem_.warnings.end());
    progress_.at(0.97, "measuring");
    const Blend after = problem_.input.made(result.spec);
    for (const FitObjective& o : options_.objectives) {
      const ObjectiveMeasure a = measured(o, before_, residuals_.lengths()),
                             b = measured(o, after, residuals_.lengths());
      result.objectives.push_back({name(o), b.measure, b.unit, weight(o), a.value, b.value, b.fulfilled});
      if (!b.fulfilled) result.warnings.push_back(std::string(name(o)) + " is not fulfilled: " + b.against);
    }
    if (!result.converged)
      result.warnings.push_back("the fit had not converged after " + std::to_string(result.costs.size() - 1) +
                                " accepted steps; allow more iterations");
    progress_.at(1.0, "fitted");
  }

  const ShapeFitOptions& options_;
  const Progress& progress_;
  const FitStep& step_;
  Blend before_;
  FitProblem problem_;
  FitResiduals residuals_;
  SolverSetting setting_{};
};

/// Makes a limit that was missed weigh more; false for objectives that are no limits.
struct WeighMore {
  bool operator()(LargestCurvature& o) const { return o.weight > 0.0 && (o.weight *= 30.0) > 0.0; }
  bool operator()(Clearance& o) const { return o.weight > 0.0 && (o.weight *= 30.0) > 0.0; }
  bool operator()(NoFold& o) const { return o.weight > 0.0 && (o.weight *= 30.0) > 0.0; }
  template <class Other>
  bool operator()(Other&) const {
    return false;
  }
};

/// Limits are meant everywhere, but are kept at samples and against what else is wanted. When one is missed,
/// the fit is repeated on twice as many samples each way, with that limit weighing thirty times as much;
/// twice at most.
ShapeFitResult fitted(const FitInput& input, const ShapeFitOptions& options, const Progress& progress,
                      const FitStep& step) {
  const ThreadLimit limit(std::max(1, options.threads));
  constexpr std::array share{0.0, 0.3, 0.6, 1.0};
  ShapeFitOptions stricter = options;
  for (std::size_t round = 0;; ++round) {
    Progress part{.stop = progress.stop};
    part.report = [&](double fraction, std::string_view stage) {
      progress.report(share[round] + (share[round + 1] - share[round]) * fraction, stage);
    };
    ShapeFitResult result = Fit(input, stricter, part, step).run();
    bool missed = false;
    for (std::size_t i = 0; i < options.objectives.size(); ++i) {
      result.objectives[i].weight = weight(options.objectives[i]);
      if (!result.objectives[i].fulfilled) missed = std::visit(WeighMore{}, stricter.objectives[i]) || missed;
    }
    if (round == 2 || !missed) {
      progress.report(1.0, "fitted");
      return result;
    }
    stricter.samples_u *= 2;
    stricter.samples_v *= 2;
  }
}

}  // namespace

const char* name(const FitObjective& objective) {
  constexpr std::array names{"thin plate",        "curvature variation", "rolling ball", "pass through",
                             "largest curvature", "clearance",           "no fold",      "scanned points"};
  return names[objective.index()];
}

ShapeFitResult fit_shape(const Trimline& line0, const Trimline& line1, const BlendSpec& start,
                         double tolerance, const ShapeFitOptions& options, const Progress& progress,
                         const FitStep& step) {
  FitInput input;
  input.lines = {line0, line1};
  input.spec = start;
  input.tolerance = tolerance;
  return fitted(input, options, progress, step);
}

ShapeFitResult fit_literal_shape(const EndCondition& end0, const EndCondition& end1, const BlendShape& start,
                                 const ShapeFitOptions& options, const Progress& progress,
                                 const FitStep& step) {
  FitInput input;
  input.ends = {end0, end1};
  input.spec.shape = start;
  return fitted(input, options, progress, step);
}

}  // namespace blendwright
