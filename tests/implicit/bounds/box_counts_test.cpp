// What linear bounds are for: how many boxes tell two bodies apart, with them and with ranges alone.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "implicit/relations/collision.hpp"
#include "implicit/scene/scene.hpp"
#include "tests/implicit/support/scene_parts.hpp"

namespace blendwright::test {
namespace {

/// The same field, of whose bounds only the ranges are used.
class RangesOnly final : public ScalarField::Model {
 public:
  explicit RangesOnly(std::shared_ptr<const Model> model) : model_(std::move(model)) {}
  void evaluate(Order order, PointArrays points, std::span<double> out) const override {
    model_->evaluate(order, points, out);
  }
  [[nodiscard]] Range range(const Box& box) const override { return model_->range(box); }
  [[nodiscard]] Within within(const Box& box) const override {
    Within w = model_->within(box);
    if (w.model) w.model = std::make_shared<RangesOnly>(w.model);
    return w;
  }
  void nearest_member(PointArrays points, std::span<std::uint32_t> out) const override {
    model_->nearest_member(points, out);
  }

 private:
  std::shared_ptr<const Model> model_;
};
ScalarField with_ranges_only(const ScalarField& f) {
  return {std::make_shared<RangesOnly>(f.shared_model()), f.level(), f.bounds(), f.members()};
}

Values axes(double a, double b, double c) { return {{"a", a}, {"b", b}, {"c", c}}; }
Values with(Values values, Values more) {
  values.merge(more);
  return values;
}
std::vector<double> list(double x, double y, double z) { return {x, y, z}; }

/// The body whose last node is named "body".
using Body = std::vector<NodeSpec>;

Body soft_ball() { return {part("d", "lp_metric", with(axes(1, 1, 1), {{"n", 2.0}})), soft("body", "d")}; }
Body superquadric(double n1, double n2) {
  return {part("body", "superquadric", with(axes(1, 0.7, 0.5), {{"n1", n1}, {"n2", n2}}))};
}
Body soft_superquadric() {
  return {part("d", "superquadric", with(axes(1, 0.8, 0.6), {{"n1", 3.0}, {"n2", 2.5}})), soft("body", "d")};
}
/// Three balls, the first towards +x, put together by an operation of the half level.
Body three(const std::string& operation, const Values& more) {
  Body nodes;
  const std::vector<std::vector<double>> centres{list(0, 0, 0), list(-0.7, 0.5, 0.1), list(-0.7, -0.5, -0.1)};
  std::vector<std::string> names;
  for (std::size_t i = 0; i < 3; ++i) {
    const std::string n = std::to_string(i);
    nodes.push_back(part("d" + n, "lp_metric", with(axes(1, 1, 1), {{"n", 2.0}})));
    nodes.push_back(soft("s" + n, "d" + n));
    nodes.push_back(part("p" + n, "place", {{"of", ref("s" + n)}, {"move", centres[i]}}));
    names.push_back("p" + n);
  }
  nodes.push_back(part("body", operation, with({{"of", refs(names)}}, more)));
  return nodes;
}
Body rose_bar() {
  return {part("r", "rose", {{"k", 5.0}, {"a", 1.0}, {"eps", 0.2}}),
          part("body", "polar_bar", {{"profile", ref("r")}, {"c", 1.5}, {"n", 4.0}})};
}

ScalarField placed(Body body, double turn_deg, double move) {
  body.push_back(part(
      "turned", "place",
      {{"of", ref("body")}, {"move", list(move, 0, 0)}, {"axis", list(0, 0, 1)}, {"turn_deg", turn_deg}}));
  // Both bodies at an angle to the boxes.
  body.push_back(part("aslant", "place",
                      {{"of", ref("turned")},
                       {"move", list(0.1, 0.2, 0.3)},
                       {"axis", list(2.0 / 7, 3.0 / 7, 6.0 / 7)},
                       {"turn_deg", 40.0}}));
  return build_scene(scene_of(std::move(body))).field;
}

/// How far the body reaches along x: the largest x of its surface, by ascent from the x axis.
double reach_of(const Body& body) {
  const ScalarField f = build_scene(scene_of(body)).field;
  const auto root = [&](double y, double z) {
    double in = 0.0, out = 5.0;
    for (int i = 0; i < 100; ++i) {
      const double x = 0.5 * (in + out);
      (inside(f.level(), f.value({x, y, z})) >= 0.0 ? in : out) = x;
    }
    return out;
  };
  double y = 0.0, z = 0.0, best = root(0.0, 0.0);
  for (double step = 0.3; step > 1e-10; step *= 0.5)
    for (bool moved = true; moved;) {
      moved = false;
      for (const auto& [dy, dz] : {std::pair(1.0, 0.0), {-1.0, 0.0}, {0.0, 1.0}, {0.0, -1.0}})
        if (const double x = root(y + step * dy, z + step * dz); x > best) {
          best = x;
          y += step * dy;
          z += step * dz;
          moved = true;
        }
    }
  return best;
}

/// most: boxes that are allowed at 10^-6; 0: any, the body has a cusp there.
struct Pair {
  std::string name;
  Body body;
  std::size_t most;
};
std::vector<Pair> pairs() {
  return {{"soft balls", soft_ball(), 1000},
          {"superquadrics 2, 3", superquadric(2, 3), 1000},
          {"superquadrics 1.2, 2", superquadric(1.2, 2), 4000},
          {"superquadrics 0.8, 2", superquadric(0.8, 2), 0},
          {"soft superquadrics", soft_superquadric(), 2000},
          {"soft blends of 3", three("soft_blend", {}), 1000},
          {"Ricci blends of 3", three("ricci_union_half", {{"n", 3.0}}), 1000},
          {"scale blends of 3", three("scale_union_half", {{"r1", 0.6}, {"r2", 0.6}, {"p", 0.0}}), 1000},
          {"rose bars", rose_bar(), 6000}};
}

std::string text(const Collision& c) {
  return std::to_string(c.boxes) + (c.contact == Contact::disjoint    ? ""
                                    : c.contact == Contact::undecided ? " ?"
                                                                      : " contact");
}

TEST(BoxCount, OfBodiesNextToEachOther) {
  constexpr double gaps[] = {1e-1, 1e-2, 1e-3, 1e-4, 1e-5, 1e-6};
  constexpr std::size_t limit = 20'000;
  std::printf(
      "boxes to tell a body from its mirror image at a gap, first with linear bounds, then with ranges\n"
      "alone; ?: undecided at the limit of %zu boxes\n%-22s",
      limit, "gap");
  for (const double gap : gaps) std::printf("%10.0e", gap);
  std::printf("\n");
  for (const auto& [name, body, most] : pairs()) {
    const double reach = reach_of(body);
    std::string ranges;
    std::printf("%-22s", name.c_str());
    for (const double gap : gaps) {
      const ScalarField a = placed(body, 0.0, 0.0), b = placed(body, 180.0, 2.0 * reach + gap);
      SearchOptions options;
      options.tolerance = 1e-10;
      options.max_boxes = limit;
      const Collision linear = collide(a, b, options);
      std::printf("%10s", text(linear).c_str());
      const Collision plain = collide(with_ranges_only(a), with_ranges_only(b), options);
      EXPECT_NE(plain.contact, Contact::contact) << name << " at " << gap;
      ranges += std::string(text(plain).size() < 10 ? 10 - text(plain).size() : 1, ' ') + text(plain);
      EXPECT_NE(linear.contact, Contact::contact) << name << " at " << gap;
      if (most == 0) continue;
      EXPECT_EQ(linear.contact, Contact::disjoint) << name << " at " << gap;
      EXPECT_LE(linear.boxes, most) << name << " at " << gap;
      if (gap <= 1e-4) {
        EXPECT_TRUE(plain.contact == Contact::undecided || plain.boxes > 10 * linear.boxes)
            << name << " at " << gap;
      }
    }
    std::printf("\n%-22s%s\n", "  ranges alone", ranges.c_str());
  }
}

}  // namespace
}  // namespace blendwright::test
