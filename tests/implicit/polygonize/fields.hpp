#pragma once
// Fields for tests of meshing, given by value and gradient in closed form and by a bound of the slope.
#include <atomic>
#include <functional>
#include <memory>
#include <vector>

#include "kernel/field/scalar_field.hpp"

namespace blendwright::test {

struct ValueAndGradient {
  double value = 0.0;
  Vec3 gradient = Vec3::Zero();
};
using PointFunction = std::function<ValueAndGradient(const Vec3&)>;

/// Second derivatives are central differences of the gradient; ranges come from the slope's bound: on a box
/// of half diagonal r around c, |f - f(c)| <= slope r.
class SlopeField final : public ScalarField::Model {
 public:
  SlopeField(PointFunction f, double slope) : f_(std::move(f)), slope_(slope) {}
  void evaluate(Order order, PointArrays points, std::span<double> out) const override;
  [[nodiscard]] Range range(const Box& box) const override;
  [[nodiscard]] Within within(const Box& box) const override { return {range(box), nullptr}; }
  void nearest_member(PointArrays points, std::span<std::uint32_t> out) const override;

 private:
  PointFunction f_;
  double slope_;
};

/// Largest of several models; over a box only those that can be the largest are kept.
class Union final : public ScalarField::Model {
 public:
  struct Member {
    std::shared_ptr<const ScalarField::Model> model;
    std::uint32_t index;
  };
  explicit Union(std::vector<Member> of) : of_(std::move(of)) {}
  void evaluate(Order order, PointArrays points, std::span<double> out) const override;
  [[nodiscard]] Range range(const Box& box) const override;
  [[nodiscard]] Within within(const Box& box) const override;
  void nearest_member(PointArrays points, std::span<std::uint32_t> out) const override;

 private:
  std::vector<Member> of_;
};

/// Passes everything on, and counts points that a model is asked for outside of the box it was made for.
class Guarded final : public ScalarField::Model {
 public:
  Guarded(std::shared_ptr<const ScalarField::Model> of, Box box, std::shared_ptr<std::atomic<int>> strays)
      : of_(std::move(of)), box_(std::move(box)), strays_(std::move(strays)) {}
  void evaluate(Order order, PointArrays points, std::span<double> out) const override;
  [[nodiscard]] Range range(const Box& box) const override;
  [[nodiscard]] Within within(const Box& box) const override;
  void nearest_member(PointArrays points, std::span<std::uint32_t> out) const override;

 private:
  void check(PointArrays points) const;
  std::shared_ptr<const ScalarField::Model> of_;
  Box box_;
  std::shared_ptr<std::atomic<int>> strays_;
};

// Solids f >= 0 (Level::function) with their bounds. Distances with sign, except where said.
[[nodiscard]] ScalarField ball(const Vec3& centre, double radius);
[[nodiscard]] ScalarField torus(const Vec3& centre, double ring, double tube);  ///< about z
[[nodiscard]] ScalarField cube(const Vec3& half);                         ///< min of six planes: creases
[[nodiscard]] ScalarField half_space(const Vec3& normal, double offset);  ///< normal . p <= offset; no bounds
[[nodiscard]] ScalarField gyroid(double period);                          ///< no bounds
[[nodiscard]] ScalarField union_of(const std::vector<ScalarField>& fields);
/// sum of exp(-|p - c|^2 / s^2) - 1/2 over random centres in [-2, 2]^3, s in [0.5, 1].
[[nodiscard]] ScalarField random_balls(std::uint64_t seed, int count);
[[nodiscard]] Box box_of(double half);

}  // namespace blendwright::test
