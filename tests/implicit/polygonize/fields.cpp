#include "tests/implicit/polygonize/fields.hpp"

#include <cmath>
#include <numbers>

#include "tests/support/for_all.hpp"

namespace blendwright::test {
namespace {
Vec3 point(PointArrays points, std::size_t i) { return {points.x[i], points.y[i], points.z[i]}; }

ScalarField solid(PointFunction f, double slope, std::optional<Box> bounds) {
  return {std::make_shared<SlopeField>(std::move(f), slope), Level::function, bounds};
}
}  // namespace

Box box_of(double half) { return {Vec3::Constant(-half), Vec3::Constant(half)}; }

void SlopeField::evaluate(Order order, PointArrays points, std::span<double> out) const {
  const std::size_t n = points.size();
  for (std::size_t i = 0; i < n; ++i) {
    const Vec3 p = point(points, i);
    const ValueAndGradient f = f_(p);
    out[i] = f.value;
    if (order == Order::value) continue;
    for (int a = 0; a < 3; ++a) out[static_cast<std::size_t>(1 + a) * n + i] = f.gradient[a];
    if (order == Order::gradient) continue;
    constexpr double h = 1e-5;
    Vec3 column[3];
    for (int a = 0; a < 3; ++a)
      column[a] = (f_(p + h * Vec3::Unit(a)).gradient - f_(p - h * Vec3::Unit(a)).gradient) / (2.0 * h);
    const double second[6] = {column[0][0], column[1][1], column[2][2],
                              column[0][1], column[0][2], column[1][2]};
    for (std::size_t c = 0; c < 6; ++c) out[(4 + c) * n + i] = second[c];
  }
}

Range SlopeField::range(const Box& box) const {
  const double middle = f_(box.centre()).value,
               reach = slope_ * 0.5 * box.size().norm() * (1.0 + 1e-12) + 1e-14;
  return {middle - reach, middle + reach};
}

void SlopeField::nearest_member(PointArrays, std::span<std::uint32_t> out) const {
  std::fill(out.begin(), out.end(), 0u);
}

void Union::evaluate(Order order, PointArrays points, std::span<double> out) const {
  const std::size_t n = points.size(), numbers = components(order);
  of_.front().model->evaluate(order, points, out);
  std::vector<double> other(numbers * n);
  for (std::size_t m = 1; m < of_.size(); ++m) {
    of_[m].model->evaluate(order, points, other);
    for (std::size_t i = 0; i < n; ++i)
      if (other[i] > out[i])
        for (std::size_t c = 0; c < numbers; ++c) out[c * n + i] = other[c * n + i];
  }
}

Range Union::range(const Box& box) const {
  Range r = of_.front().model->range(box);
  for (const auto& m : of_) {
    const Range o = m.model->range(box);
    r = {std::max(r.lo, o.lo), std::max(r.hi, o.hi)};
  }
  return r;
}

ScalarField::Model::Within Union::within(const Box& box) const {
  const Range all = range(box);
  std::vector<Member> left;
  for (const auto& m : of_)
    if (m.model->range(box).hi >= all.lo) left.push_back(m);
  if (left.size() == of_.size()) return {all, nullptr};
  return {all, std::make_shared<Union>(left)};
}

void Union::nearest_member(PointArrays points, std::span<std::uint32_t> out) const {
  const std::size_t n = points.size();
  std::vector<double> best(n, std::numeric_limits<double>::infinity()), value(n);
  for (std::size_t m = 0; m < of_.size(); ++m) {
    of_[m].model->evaluate(Order::value, points, value);
    for (std::size_t i = 0; i < n; ++i)
      if (std::abs(value[i]) < best[i]) {
        best[i] = std::abs(value[i]);
        out[i] = of_[m].index;
      }
  }
}

void Guarded::check(PointArrays points) const {
  for (std::size_t i = 0; i < points.size(); ++i)
    if (!box_.contains(point(points, i))) ++*strays_;
}
void Guarded::evaluate(Order order, PointArrays points, std::span<double> out) const {
  check(points);
  of_->evaluate(order, points, out);
}
Range Guarded::range(const Box& box) const {
  if (!box_.contains(box.lo) || !box_.contains(box.hi)) ++*strays_;
  return of_->range(box);
}
ScalarField::Model::Within Guarded::within(const Box& box) const {
  if (!box_.contains(box.lo) || !box_.contains(box.hi)) ++*strays_;
  const Within of = of_->within(box);
  return {of.range, std::make_shared<Guarded>(of.model ? of.model : of_, box, strays_)};
}
void Guarded::nearest_member(PointArrays points, std::span<std::uint32_t> out) const {
  check(points);
  of_->nearest_member(points, out);
}

ScalarField ball(const Vec3& centre, double radius) {
  return solid(
      [=](const Vec3& p) {
        const Vec3 d = p - centre;
        const double r = d.norm();
        return ValueAndGradient{radius - r, r > 0.0 ? Vec3(-d / r) : Vec3(Vec3::Zero())};
      },
      1.0, Box{centre - Vec3::Constant(radius), centre + Vec3::Constant(radius)});
}

ScalarField torus(const Vec3& centre, double ring, double tube) {
  const Vec3 reach(ring + tube, ring + tube, tube);
  return solid(
      [=](const Vec3& p) {
        const Vec3 d = p - centre;
        const double rho = std::hypot(d.x(), d.y()), a = rho - ring, r = std::hypot(a, d.z());
        if (r == 0.0 || rho == 0.0) return ValueAndGradient{tube - r, Vec3::Zero()};
        return ValueAndGradient{tube - r, Vec3(-a / r * d.x() / rho, -a / r * d.y() / rho, -d.z() / r)};
      },
      1.0, Box{centre - reach, centre + reach});
}

ScalarField cube(const Vec3& half) {
  return solid(
      [=](const Vec3& p) {
        ValueAndGradient f{std::numeric_limits<double>::infinity(), Vec3::Zero()};
        for (int a = 0; a < 3; ++a)
          if (half[a] - std::abs(p[a]) < f.value)
            f = {half[a] - std::abs(p[a]), p[a] < 0.0 ? Vec3(Vec3::Unit(a)) : Vec3(-Vec3::Unit(a))};
        return f;
      },
      1.0, Box{-half, half});
}

ScalarField half_space(const Vec3& normal, double offset) {
  return solid(
      [=](const Vec3& p) {
        return ValueAndGradient{offset - normal.dot(p), -normal};
      },
      normal.norm(), std::nullopt);
}

ScalarField gyroid(double period) {
  const double k = 2.0 * std::numbers::pi / period;
  return solid(
      [=](const Vec3& p) {
        const double sx = std::sin(k * p.x()), cx = std::cos(k * p.x()), sy = std::sin(k * p.y()),
                     cy = std::cos(k * p.y()), sz = std::sin(k * p.z()), cz = std::cos(k * p.z());
        return ValueAndGradient{sx * cy + sy * cz + sz * cx,
                                k * Vec3(cx * cy - sz * sx, cy * cz - sx * sy, cz * cx - sy * sz)};
      },
      2.0 * std::sqrt(3.0) * k, std::nullopt);
}

ScalarField union_of(const std::vector<ScalarField>& fields) {
  std::vector<Union::Member> models;
  Box bounds = *fields.front().bounds();
  for (const ScalarField& f : fields) {
    models.push_back({f.shared_model(), static_cast<std::uint32_t>(models.size())});
    bounds = hull(bounds, *f.bounds());
  }
  return {std::make_shared<Union>(models), Level::function, bounds};
}

ScalarField random_balls(std::uint64_t seed, int count) {
  struct Ball {
    Vec3 centre;
    double size;
  };
  Rng rng(seed);
  std::vector<Ball> balls;
  double slope = 0.0;
  for (int n = 0; n < count; ++n) {
    const double x = uniform(rng, -2.0, 2.0), y = uniform(rng, -2.0, 2.0), z = uniform(rng, -2.0, 2.0);
    balls.push_back({Vec3(x, y, z), uniform(rng, 0.5, 1.0)});
    slope +=
        std::sqrt(2.0 / std::numbers::e) / balls.back().size;  // of exp(-u^2): sqrt(2/e) at u = sqrt(1/2)
  }
  // |p - c| >= s sqrt(ln(2 count)) for all balls: the sum is at most 1/2.
  const double reach = 2.0 + std::sqrt(std::log(2.0 * count));
  return solid(
      [balls](const Vec3& p) {
        ValueAndGradient f{-0.5, Vec3::Zero()};
        for (const Ball& b : balls) {
          const Vec3 d = p - b.centre;
          const double e = std::exp(-d.squaredNorm() / (b.size * b.size));
          f.value += e;
          f.gradient += -2.0 * e / (b.size * b.size) * d;
        }
        return f;
      },
      slope, box_of(reach));
}

}  // namespace blendwright::test
