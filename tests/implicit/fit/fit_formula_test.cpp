// The formulas that are differentiated are those of the scenes.
#include <gtest/gtest.h>

#include "implicit/fit/fit_formula.hpp"
#include "implicit/fit/fit_solver.hpp"
#include "tests/implicit/fit/scan.hpp"

namespace blendwright::detail {
namespace {

using test::node;
using test::Rng;
using test::uniform;

double scale_of(Rng& rng) { return test::log_uniform(rng, 0.5, 3.0); }

NodeSpec random_form(Rng& rng, const std::string& name) {
  const double n = test::log_uniform(rng, 0.7, 12.0), m = test::log_uniform(rng, 0.7, 12.0);
  switch (test::integer(rng, 0, 2)) {
    case 0:
      return node(name, "lp_metric",
                  {{"a", scale_of(rng)}, {"b", scale_of(rng)}, {"c", scale_of(rng)}, {"n", n}});
    case 1:
      return node(name, "superquadric",
                  {{"a", scale_of(rng)}, {"b", scale_of(rng)}, {"c", scale_of(rng)}, {"n1", n}, {"n2", m}});
    default:
      return node(name, "asymmetric_superellipsoid",
                  {{"x", std::vector<double>{scale_of(rng), scale_of(rng)}},
                   {"y", std::vector<double>{scale_of(rng), scale_of(rng)}},
                   {"z", std::vector<double>{scale_of(rng), scale_of(rng)}},
                   {"n", n}});
  }
}

/// A form, perhaps scaled ray by ray, placed; as a distance or as a soft object.
std::string random_member(Rng& rng, SceneSpec& spec, const std::string& tag, bool soft) {
  spec.nodes.push_back(random_form(rng, tag + " form"));
  std::string top = tag + " form";
  if (test::integer(rng, 0, 1) == 1) {
    spec.nodes.push_back(random_form(rng, tag + " by"));
    spec.nodes.push_back(
        node(tag + " scaled", "ray_scaling",
             {{"of", NodeRef{top}}, {"by", NodeRef{tag + " by"}}, {"n", uniform(rng, -1.5, 1.5)}}));
    top = tag + " scaled";
  }
  spec.nodes.push_back(
      node(tag + " placed", "place",
           {{"of", NodeRef{top}},
            {"move", std::vector<double>{uniform(rng, -1, 1), uniform(rng, -1, 1), uniform(rng, -1, 1)}},
            {"axis", std::vector<double>{uniform(rng, -1, 1), uniform(rng, -1, 1), 1.0}},
            {"turn_deg", uniform(rng, -170, 170)},
            {"scale", test::log_uniform(rng, 0.5, 2.0)}}));
  top = tag + " placed";
  if (!soft) return top;
  const char* potentials[] = {"blanc", "wyvill", "gaussian_windowed"};
  spec.nodes.push_back(node(tag + " soft", "soft_object",
                            {{"distance", NodeRef{top}},
                             {"potential", std::string(potentials[test::integer(rng, 0, 2)])},
                             {"softness", uniform(rng, 0.0, 2.0)},
                             {"w1", uniform(rng, 0.6, 1.5)},
                             {"w2", uniform(rng, 0.3, 1.0)}}));
  return tag + " soft";
}

SceneSpec random_scene(Rng& rng, bool soft) {
  SceneSpec spec;
  if (!soft) {
    spec.solid = random_member(rng, spec, "one", false);
    return spec;
  }
  std::vector<NodeRef> members;
  for (const char* tag : {"one", "two"}) members.push_back({random_member(rng, spec, tag, true)});
  spec.nodes.push_back(node("both", "soft_blend", {{"of", members}}));
  spec.solid = "both";
  return spec;
}

Vec3 random_point(Rng& rng) { return {uniform(rng, -4, 4), uniform(rng, -4, 4), uniform(rng, -4, 4)}; }

std::vector<double> values_of(const FitModel& model) {
  std::vector<double> values;
  for (const FitSlot& slot : model.slots) values.push_back(slot.value);
  return values;
}

TEST(FitFormula, IsTheSceneItself) {
  test::for_all(
      [](Rng& rng) {
        const bool soft = test::integer(rng, 0, 1) == 1;
        const SceneSpec spec = random_scene(rng, soft);
        const Scene scene = build_scene(spec);
        const FitModel model = fit_model(spec);
        EXPECT_EQ(model.blend, soft);
        const std::vector<double> values = values_of(model);
        const FitEvaluation<double> ours(model, values.data());
        for (int i = 0; i < 40; ++i) {
          const Vec3 p = random_point(rng);
          double nearest = 1e300;
          const Point<double> X{p.x(), p.y(), p.z()};
          const double f = soft ? ours.field(model.nodes.size() - 1, X, nearest)
                                : ours.distance(model.nodes.size() - 1, X).d;
          const double wanted = scene.field.value(p);
          EXPECT_NEAR(f, wanted, 1e-11 * (1.0 + std::abs(wanted))) << p.transpose();
        }
      },
      100);
}

TEST(FitFormula, ChangedNumbersMakeTheChangedScene) {
  test::for_all(
      [](Rng& rng) {
        const SceneSpec spec = random_scene(rng, true);
        const FitModel model = fit_model(spec);
        std::vector<double> values = values_of(model);
        for (std::size_t i = 0; i < values.size(); ++i) {
          if (!model.slots[i].free) continue;
          if (model.slots[i].scale == FitSlot::Scale::logarithmic)
            values[i] *= uniform(rng, 1.0, 1.2);
          else
            values[i] += uniform(rng, -0.3, 0.3);
        }
        const Scene changed = build_scene(with_values(spec, model, values));
        const FitEvaluation<double> ours(model, values.data());
        double moved = 0.0;
        for (int i = 0; i < 20; ++i) {
          const Vec3 p = random_point(rng);
          double nearest = 1e300;
          const double f = ours.field(model.nodes.size() - 1, {p.x(), p.y(), p.z()}, nearest);
          EXPECT_NEAR(f, changed.field.value(p), 1e-10);
          moved = std::max(moved, std::abs(f - build_scene(spec).field.value(p)));
        }
        static_cast<void>(moved);
      },
      40);
}

TEST(FitFormula, DerivativesAreThoseOfTheResiduals) {
  int compared = 0;
  test::for_all(
      [&](Rng& rng) {
        const SceneSpec spec = random_scene(rng, false);
        const FitModel model = fit_model(spec);
        const std::vector<double> values = values_of(model);
        const std::vector<std::size_t> free = model.free();
        std::vector<Vec3> points;
        while (points.size() < 10) {
          const Vec3 p = random_point(rng);
          if (build_scene(spec).field.value(p) > 0.3) points.push_back(p);
        }
        const Linearised at = linearised(model, values, points);
        for (std::size_t k = 0; k < free.size(); ++k) {
          // Fourth-order differences of step h: truncation h^4 f^(5)/30 and rounding 1e-16/h are both below
          // 1e-9 for residuals of size 1 whose derivatives grow by less than 20 each; kinks of |x| are
          // avoided by skipping points where halving the step changes the difference.
          const auto difference = [&](double h) {
            const auto shifted = [&](double by) {
              std::vector<double> v = values;
              double& x = v[free[k]];
              x = model.slots[free[k]].scale == FitSlot::Scale::logarithmic ? x * std::exp(by) : x + by;
              return residuals(model, v, points);
            };
            const auto a = shifted(-2 * h), b = shifted(-h), c = shifted(h), d = shifted(2 * h);
            std::vector<double> slope(points.size());
            for (std::size_t i = 0; i < points.size(); ++i)
              slope[i] = (a[i] - 8 * b[i] + 8 * c[i] - d[i]) / (12 * h);
            return slope;
          };
          const auto coarse = difference(1e-3), fine = difference(5e-4);
          for (std::size_t i = 0; i < points.size(); ++i) {
            if (std::abs(coarse[i] - fine[i]) > 1e-7) continue;
            const double ours = at.J(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(k));
            EXPECT_NEAR(ours, fine[i], 2e-7 * (1.0 + std::abs(ours))) << model.slots[free[k]].key;
            ++compared;
          }
        }
      },
      30);
  EXPECT_GT(compared, 1500);  // nearly all: 30 scenes of 10 points and 10 to 19 unknowns
}

}  // namespace
}  // namespace blendwright::detail
