#pragma once
// Random end conditions and blend shapes, for property tests.
#include <Eigen/Geometry>
#include <numbers>

#include "parametric/ode/ode_blend.hpp"
#include "tests/parametric/random_ode.hpp"

namespace blendwright::test {

inline Vec3 random_vector(Rng& rng, double size) {
  return {uniform(rng, -size, size), uniform(rng, -size, size), uniform(rng, -size, size)};
}

/// A rotation by a random angle about a random axis.
inline Eigen::Matrix3d random_rotation(Rng& rng) {
  return Eigen::AngleAxisd(uniform(rng, 0.3, 3.0), random_vector(rng, 1.0).normalized()).toRotationMatrix();
}

/// a + b cos v + c sin v.
struct Wave {
  Vec3 a, b, c;
  [[nodiscard]] Series3 at(double v) const {
    const Series t = Series::variable(v), cosine = cos(t), sine = sin(t);
    return constant(a) + cosine * constant(b) + sine * constant(c);
  }
  /// The k-th derivative, enclosed.
  [[nodiscard]] ModelVector over(const TaylorModel& v, int k) const {
    const TaylorModel C = cos(v), S = sin(v);
    const std::array<TaylorModel, 2> f = k == 0   ? std::array{C, S}
                                         : k == 1 ? std::array{-S, C}
                                                  : std::array{-C, -S};
    return (k == 0 ? constant_model(a) : ModelVector{}) + f[0] * constant_model(b) + f[1] * constant_model(c);
  }
};

inline EndCondition end_of(const Wave& C, const Wave& T, const Wave& D, Continuity continuity) {
  return {{{0.0, 2.0 * std::numbers::pi}, true},
          continuity,
          [C, T, D](double v) {
            return EndSeries{C.at(v), T.at(v), D.at(v)};
          },
          [C, T, D](const TaylorModel& v) {
            return EndEnclosure{
                {C.over(v, 0), C.over(v, 1), C.over(v, 2)}, {T.over(v, 0), T.over(v, 1)}, D.over(v, 0), {}};
          }};
}

/// A wavy circle of radius about 1 at height z with a steep cross tangent: nothing degenerates.
inline EndCondition random_end(Rng& rng, double z, Continuity continuity) {
  const Wave C{Vec3(0, 0, z) + random_vector(rng, 0.2), Vec3(1, 0, 0) + random_vector(rng, 0.2),
               Vec3(0, 1, 0) + random_vector(rng, 0.2)};
  const Wave T{Vec3(0, 0, 1.5) + random_vector(rng, 0.2), random_vector(rng, 0.3), random_vector(rng, 0.3)};
  return end_of(C, T, {random_vector(rng, 1.0), random_vector(rng, 1.0), random_vector(rng, 1.0)},
                continuity);
}

/// The same end seen after x -> scale R x + shift.
inline EndCondition moved(const EndCondition& end, const Eigen::Matrix3d& R, double scale,
                          const Vec3& shift) {
  EndCondition result = end;
  result.enclosure = {};
  result.series = [series = end.series, A = Eigen::Matrix3d(scale * R), shift](double v) {
    const auto apply = [&](const Series3& x) {
      Series3 y{};
      for (std::size_t i = 0; i < 3; ++i)
        for (std::size_t j = 0; j < 3; ++j)
          y[i] = y[i] + A(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j)) * x[j];
      return y;
    };
    const EndSeries e = series(v);
    return EndSeries{apply(e.C) + constant(shift), apply(e.T), apply(e.D)};
  };
  return result;
}

struct RandomShape {
  BlendShape shape;
  double kappa = 1.0;  ///< largest condition number of its fourth-order functions
};

/// Any mode, frame, family and regime; roots up to `stiff`; equations near a resonance (kappa > 100) are
/// redrawn.
inline RandomShape random_shape(Rng& rng, double stiff) {
  RandomShape r;
  r.shape.mode = static_cast<BlendMode>(integer(rng, 0, 2));
  r.shape.anchor = random_vector(rng, 1.0);
  r.shape.frame = static_cast<BlendFrame>(integer(rng, 0, 2));
  r.shape.axes = random_rotation(rng);
  r.shape.family = random_family(rng);
  r.shape.tension = log_uniform(rng, 1e-8, stiff);
  if (integer(rng, 0, 3) == 0) r.shape.repeated_root = log_uniform(rng, 1e-8, stiff);
  const bool common = integer(rng, 0, 2) == 0;
  for (std::size_t x = 0; x < 3; ++x) {
    std::optional<CardinalBasis> basis;
    while (!basis || basis->kappa() > 100.0) {
      r.shape.ode[x] = common && x > 0
                           ? r.shape.ode[0]
                           : random_ode(rng, all_regimes[static_cast<std::size_t>(integer(rng, 0, 8))], 1e-4,
                                        std::min(stiff, 50.0));
      basis = basis_unless_resonant(r.shape.ode[x]);
    }
    r.kappa = std::max(r.kappa, basis->kappa());
  }
  return r;
}

inline Continuity random_continuity(Rng& rng) {
  return integer(rng, 0, 1) == 0 ? Continuity::G1 : Continuity::G2;
}

inline OdeBlend random_blend(Rng& rng, const BlendShape& shape) {
  return {random_end(rng, 0.0, random_continuity(rng)), random_end(rng, 2.0, random_continuity(rng)), shape};
}

}  // namespace blendwright::test
