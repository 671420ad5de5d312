#pragma once
// How long the cross tangents are. Private to this module.
//
// chord: m = f |De|.  circle_like: m = f 2/(1 + cos(theta/2)) |De|, cos(theta/2) = sqrt((1 + t0.t1)/2) (3)
// arc_length: m = f length of the cubic with T_i = m_i t_i.  constant: m = f
// minimum_bending: 4 m0 + 2 (t0.t1) m1 = 6 De.t0,  2 (t0.t1) m0 + 4 m1 = 6 De.t1, then times f (4) De = C1 -
// C0; t_i: unit cross directions; theta: their angle; f: the side's factor. (3) makes a circular arc's cubic;
// (4) is the stationary point of int |G''|^2 du of the cubic.
#include <array>
#include <optional>

#include "parametric/cross_tangent/factor_law.hpp"

namespace blendwright {

/// Both sides at one v.
struct PairSample {
  double v = 0.0;
  Vec3 De;
  std::array<Vec3, 2> direction;
};

class Magnitudes {
 public:
  /// `samples` at equal steps of the whole range, both ends included: where arc_length and minimum_bending
  /// are solved. Their ratio m / (f |De|), clamped to [0.1, 4], is interpolated by a quintic spline.
  Magnitudes(const std::array<SideSpec, 2>& sides, CurveDomain domain,
             const std::vector<PairSample>& samples);

  [[nodiscard]] Series at(int side, double v, const Series& chord, const Series& cos_theta) const;
  [[nodiscard]] double at(int side, const PairSample& sample) const;
  /// v, chord and cos_theta in the first variable of the jets.
  [[nodiscard]] ModelJet at(int side, const ModelJet& v, const ModelJet& chord,
                            const ModelJet& cos_theta) const;

 private:
  template <class T>
  [[nodiscard]] T evaluated(std::size_t side, const T& v, const T& chord, const T& cos_theta) const;

  std::array<MagnitudeRule, 2> rules_;
  std::array<FactorLaw, 2> factors_;
  std::array<std::optional<ScalarSpline>, 2> ratios_;
};

}  // namespace blendwright
