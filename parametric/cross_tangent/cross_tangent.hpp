#pragma once
// Cross tangents and second derivatives from the primaries (formula sheet: conormal choice and linkage-curve
// theorem).
//
//   n = Pu x Pv / |Pu x Pv|,  k = +-n x C'/|C'|  (unit conormal),  T = m (cos psi k + sin psi C'/|C'|) (1)
//   Suu = II(T, T) n: equal normal curvature across the trimline; with equal tangent planes this is G2 (2)
// m(v) > 0: magnitude, model units per unit of u. psi: direction angle within the tangent plane, |psi| <= 60
// deg. Sign: T0 points out of the kept part of primary 0, T1 into the kept part of primary 1; by default the
// side for which int T_i . (C1 - C0) dv > 0. Sources: You et al., Sweeping based controllable surface
// blending; Pegna and Wolter 1992.
#include <array>
#include <map>
#include <string>
#include <vector>

#include "parametric/cross_tangent/end_condition.hpp"
#include "parametric/trimline/correspondence.hpp"

namespace blendwright {

enum class MagnitudeRule {
  chord,        ///< m = factor |C1 - C0|
  circle_like,  ///< factor 2/(1 + cos(theta/2)) |C1 - C0|, theta = angle(T0, T1) < 170 deg (default)
  arc_length,  ///< factor * length of the u-line of the cubic blend, iterated 5 times; length in [0.1, 4] |C1
               ///< - C0|
  minimum_bending,  ///< the pair (m0, m1) in [0.1, 4] |C1 - C0| with the least int |Suu|^2 du of the cubic,
                    ///< times factor
  constant          ///< m = factor, model units
};

struct SideSpec {
  Continuity continuity = Continuity::G1;
  MagnitudeRule rule = MagnitudeRule::circle_like;
  std::vector<LawPoint> factor{
      {0.0, 1.0}};             ///< one point: constant; more: quintic spline, periodic on closed lines
  Radians tangent_angle{0.0};  ///< psi in (1); with G0, T has the direction of C1 - C0 and psi is not used
  enum class Keep { automatic, left, right } keep = Keep::automatic;
  ///< which side of the trimline of the primary stays: left = towards n x C' seen along increasing v of the
  ///< *given* line
};

struct CrossTangents {
  std::array<EndCondition, 2> ends;
  std::array<bool, 2> kept_left{};  ///< n x C' of the corresponded line points into the kept part
  std::array<std::vector<double>, 2>
      magnitude;  ///< m at 65 equally spaced v, both ends included, for reports and plots
};

/// The two ends share their work: the pair is evaluated once per v and thread.
/// Where |C'| or |n| vanishes but both limits agree to 1e-6 rad (a harmless degenerate point), T is continued
/// from 1e-3 of the range away. Throws GeometryError: zero tangent without such limits (names v and the
/// point), trimlines that touch (|C1 - C0| < 100 tolerance), theta >= 170 deg with circle_like, a kept side
/// that the sign rule cannot decide; InputError (where: "sides/0/factor", ...): factor <= 0, |psi| > 60 deg,
/// a law that leaves t in [0, 1] or does not increase in t, no continuity.
[[nodiscard]] CrossTangents cross_tangents(const Correspondence& lines, const std::array<SideSpec, 2>& sides,
                                           double tolerance);

/// Boundary data typed as formulas of v: C and T (and D for G2), each three texts; domain and named constants
/// given.
struct LiteralEnd {
  std::vector<std::string> C, T, D{};
};
/// Without D the end is G1. Throws InputError (where: "C/0", "D", ...) with all problems of the nine texts.
[[nodiscard]] EndCondition literal_end(const LiteralEnd& data, CurveDomain domain,
                                       const std::map<std::string, double>& constants);

}  // namespace blendwright
