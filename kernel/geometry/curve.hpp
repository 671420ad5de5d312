#pragma once
// Curves in space (Curve3) and in a surface's parameters (Curve2), as immutable values.
#include <Eigen/Core>
#include <array>
#include <concepts>
#include <memory>
#include <type_traits>
#include <utility>

#include "kernel/base/units.hpp"

namespace blendwright {

class TaylorModel;
struct CurveEnclosure;

/// C(v) and its derivatives: D[k] = d^k C / dv^k, k = 0..3.
template <int Dim>
struct CurveJet {
  using Point = Eigen::Matrix<double, Dim, 1>;
  std::array<Point, 4> D;
  [[nodiscard]] const Point& C() const { return D[0]; }
  [[nodiscard]] const Point& C1() const { return D[1]; }
  [[nodiscard]] const Point& C2() const { return D[2]; }
  [[nodiscard]] const Point& C3() const { return D[3]; }
};

struct CurveDomain {
  Interval v;
  bool closed = false;  ///< C and all derivatives agree at both ends: the curve is periodic in v
};

/// What a type must offer to be a curve: jets to third order over a domain.
template <class T, int Dim>
concept ParametricCurve = std::copyable<T> && requires(const T& c, double v) {
  { c.jet(v) } -> std::same_as<CurveJet<Dim>>;
  { c.domain() } -> std::convertible_to<CurveDomain>;
};

/// Any curve, as an immutable value: copies are cheap and may be used from several threads.
template <int Dim>
class Curve {
 public:
  using Point = Eigen::Matrix<double, Dim, 1>;
  template <class T>
  requires(!std::same_as<std::remove_cvref_t<T>, Curve> && ParametricCurve<std::remove_cvref_t<T>, Dim>)
      Curve(T&& shape)  // NOLINT: any curve is a Curve
      : model_(std::make_shared<const Model<std::remove_cvref_t<T>>>(std::forward<T>(shape))) {}

  [[nodiscard]] CurveJet<Dim> jet(double v) const { return model_->jet(v); }
  [[nodiscard]] Point point(double v) const { return model_->jet(v).D[0]; }
  [[nodiscard]] CurveDomain domain() const { return model_->domain(); }
  /// Encloses the curve over a piece of its parameter, see enclosure.hpp. False: the shape cannot say how it
  /// runs between points.
  [[nodiscard]] bool enclose(const TaylorModel& v, CurveEnclosure& out) const {
    return model_->enclose(v, out);
  }
  /// The held shape when it is a T, else nullptr.
  template <class T>
  [[nodiscard]] const T* target() const {
    const auto* m = dynamic_cast<const Model<T>*>(model_.get());
    return m ? &m->shape : nullptr;
  }

 private:
  struct Concept {
    virtual ~Concept() = default;
    virtual CurveJet<Dim> jet(double v) const = 0;
    virtual CurveDomain domain() const = 0;
    virtual bool enclose(const TaylorModel& v, CurveEnclosure& out) const = 0;
  };
  template <class T>
  struct Model final : Concept {
    explicit Model(T s) : shape(std::move(s)) {}
    CurveJet<Dim> jet(double v) const override { return shape.jet(v); }
    CurveDomain domain() const override { return shape.domain(); }
    bool enclose(const TaylorModel& v, CurveEnclosure& out) const override {
      if constexpr (requires { shape.enclose(v, out); }) {
        shape.enclose(v, out);
        return true;
      }
      return false;
    }
    T shape;
  };
  std::shared_ptr<const Concept> model_;
};

using Curve2 = Curve<2>;  ///< (u, v) of a surface's parameters, as (x, y)
using Curve3 = Curve<3>;

}  // namespace blendwright
