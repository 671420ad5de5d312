#pragma once
// Parametric surfaces S(u, v) as immutable values.
#include <array>
#include <concepts>
#include <memory>
#include <type_traits>
#include <utility>

#include "kernel/base/units.hpp"

namespace blendwright {

class TaylorModel;
struct SurfaceEnclosure;

/// Position and derivatives to second order.
struct SurfaceJet {
  Vec3 S, Su, Sv, Suu, Suv, Svv;
};

/// All partial derivatives with i + j <= 4: what cross-boundary data and its second derivative along a
/// trimline need.
struct SurfacePartials {
  std::array<Vec3, 15> d;
  [[nodiscard]] static constexpr std::size_t index(int i, int j) {
    return static_cast<std::size_t>((i + j) * (i + j + 1) / 2 + j);
  }
  [[nodiscard]] const Vec3& operator()(int i, int j) const { return d[index(i, j)]; }
  [[nodiscard]] Vec3& operator()(int i, int j) { return d[index(i, j)]; }
};

struct SurfaceDomain {
  Interval u, v;
  bool u_closed = false;  ///< periodic: S and all derivatives agree at u.lo and u.hi, and S accepts any u
  bool v_closed = false;
};

/// What a type must offer to be a surface. Evaluation outside an open domain continues the formula where
/// there is one.
template <class T>
concept ParametricSurface = std::copyable<T> && requires(const T& s, UV p) {
  { s.jet(p) } -> std::same_as<SurfaceJet>;
  { s.partials(p) } -> std::same_as<SurfacePartials>;
  { s.domain() } -> std::convertible_to<SurfaceDomain>;
};

/// Any surface, as an immutable value: copies are cheap and may be used from several threads.
class Surface {
 public:
  template <class T>
  requires(!std::same_as<std::remove_cvref_t<T>, Surface> && ParametricSurface<std::remove_cvref_t<T>>)
      Surface(T&& shape)  // NOLINT: any surface is a Surface
      : model_(std::make_shared<const Model<std::remove_cvref_t<T>>>(std::forward<T>(shape))) {}

  [[nodiscard]] SurfaceJet jet(UV p) const { return model_->jet(p); }
  [[nodiscard]] Vec3 point(UV p) const { return model_->jet(p).S; }
  [[nodiscard]] SurfacePartials partials(UV p) const { return model_->partials(p); }
  [[nodiscard]] SurfaceDomain domain() const { return model_->domain(); }
  /// Encloses the surface along the curve (u, v) through its domain, see enclosure.hpp. False: the shape
  /// cannot say how it runs between points.
  [[nodiscard]] bool enclose(const TaylorModel& u, const TaylorModel& v, SurfaceEnclosure& out) const {
    return model_->enclose(u, v, out);
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
    virtual SurfaceJet jet(UV p) const = 0;
    virtual SurfacePartials partials(UV p) const = 0;
    virtual SurfaceDomain domain() const = 0;
    virtual bool enclose(const TaylorModel& u, const TaylorModel& v, SurfaceEnclosure& out) const = 0;
  };
  template <class T>
  struct Model final : Concept {
    explicit Model(T s) : shape(std::move(s)) {}
    SurfaceJet jet(UV p) const override { return shape.jet(p); }
    SurfacePartials partials(UV p) const override { return shape.partials(p); }
    SurfaceDomain domain() const override { return shape.domain(); }
    bool enclose(const TaylorModel& u, const TaylorModel& v, SurfaceEnclosure& out) const override {
      if constexpr (requires { shape.enclose(u, v, out); }) {
        shape.enclose(u, v, out);
        return true;
      }
      return false;
    }
    T shape;
  };
  std::shared_ptr<const Concept> model_;
};

}  // namespace blendwright
