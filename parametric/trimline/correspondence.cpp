#include "parametric/trimline/correspondence.hpp"

#include <algorithm>
#include <cmath>

#include "kernel/base/error.hpp"
#include "kernel/base/number_text.hpp"
#include "parametric/trimline/given_map.hpp"
#include "parametric/trimline/line_map.hpp"
#include "parametric/trimline/line_point.hpp"
#include "parametric/trimline/twist_map.hpp"

namespace blendwright {
namespace {

constexpr int samples = 256;

/// A line by a fraction x of it, in the rule's sense.
struct FractionLine {
  Trimline line;
  FractionMap map;
  /// C and its first two derivatives with respect to x.
  [[nodiscard]] LinePoint at(double x) const {
    const Series v = map(Series::variable(x));
    LinePoint p = line_point(line, v.value());
    p.C2 = v.derivative(1) * v.derivative(1) * p.C2 + v.derivative(2) * p.C1;
    p.C1 *= v.derivative(1);
    return p;
  }
};

struct Samples {
  std::vector<Vec3> C, C1;  ///< C - mean and C' at x = j / 256; closed: j < 256, open: j <= 256
  Vec3 mean = Vec3::Zero();
  double spread = 0.0;  ///< sum |C - mean|^2
};

Samples sampled(const FractionLine& line) {
  Samples s;
  const int n = line.line.domain().closed ? samples : samples + 1;
  for (int j = 0; j < n; ++j) {
    const LinePoint p = line.at(static_cast<double>(j) / samples);
    s.C.push_back(p.C);
    s.C1.push_back(p.C1);
    s.mean += p.C / n;
  }
  for (Vec3& C : s.C) {
    C -= s.mean;
    s.spread += C.squaredNorm();
  }
  return s;
}

Vec3 area_vector(const Samples& s) {
  Vec3 N = Vec3::Zero();
  for (std::size_t j = 0; j < s.C.size(); ++j) N += 0.5 / samples * s.C[j].cross(s.C1[j]);
  return N;
}

struct Placement {
  double offset = 0.0;
  double gain = 0.0;  ///< sum C0 . C1(o +- x) about the means: J = constant - 2 gain / 256
};

/// Newton on the derivative of the gain, from the best sampled offset; stays there when the gain bends less
/// than `flat`.
double refined(const FractionLine& line1, const Samples& s0, double flat, double offset, double sign) {
  for (int i = 0; i < 20; ++i) {
    double slope = 0.0, bend = 0.0;
    for (int j = 0; j < samples; ++j) {
      const LinePoint p = line1.at(offset + sign * j / samples);
      const Vec3& C0 = s0.C[static_cast<std::size_t>(j)];
      slope += C0.dot(p.C1);
      bend += C0.dot(p.C2);
    }
    if (!(bend < -flat)) return offset;
    const double step = std::clamp(-slope / bend, -1.0 / samples, 1.0 / samples);
    offset += step;
    if (std::abs(step) < 1e-7) break;  // convergence is quadratic: the next step would be rounding
  }
  return offset;
}

/// The offset in [0, 1) with the largest gain; of equal ones the nearest to 0, so that symmetric lines stay
/// in place.
Placement best_offset(const FractionLine& line1, const Samples& s0, const Samples& s1, bool reversed) {
  // The gain of offset o is a product of s0 with a window of s1 that starts at o; reversed: s0 from the back.
  Eigen::VectorXd window0(3 * samples), round1(6 * samples);
  for (int j = 0; j < samples; ++j) {
    const int k = reversed ? (samples - j) % samples : j;
    window0.segment<3>(3 * k) = s0.C[static_cast<std::size_t>(j)];
    round1.segment<3>(3 * j) = round1.segment<3>(3 * (j + samples)) = s1.C[static_cast<std::size_t>(j)];
  }
  std::vector<double> gain;
  for (int o = 0; o < samples; ++o) gain.push_back(window0.dot(round1.segment(3 * o, 3 * samples)));
  const double most = *std::max_element(gain.begin(), gain.end());
  const double equal = 1e-9 * std::sqrt(s0.spread * s1.spread);
  int best = 0;
  for (int d = 0; d <= samples / 2; ++d) {
    const int forward = d, backward = (samples - d) % samples;
    best = gain[static_cast<std::size_t>(forward)] >= most - equal ? forward : backward;
    if (gain[static_cast<std::size_t>(best)] >= most - equal) break;
  }
  double offset = refined(line1, s0, equal, static_cast<double>(best) / samples, reversed ? -1.0 : 1.0);
  offset -= std::floor(offset);
  // An offset below the rounding of the sums is no offset: the map stays exact.
  if (offset < 1e-13 || offset > 1.0 - 1e-13) offset = 0.0;
  return {offset, gain[static_cast<std::size_t>(best)]};
}

double gain_at(const FractionLine& line1, const Samples& s0, const Samples& s1, double offset,
               bool reversed) {
  double gain = 0.0;
  for (std::size_t j = 0; j < s0.C.size(); ++j) {
    const double x = static_cast<double>(j) / samples;
    gain += s0.C[j].dot(line1.at(reversed ? offset - x : offset + x).C - s1.mean);
  }
  return gain;
}

struct Arrangement {
  bool reversed = false;
  double offset = 0.0;  ///< x1 = offset +- x
};

Arrangement arranged_closed(const FractionLine& line1, const Samples& s0, const Samples& s1,
                            const CorrespondenceSpec& spec) {
  const auto placed = [&](bool reversed) {
    if (!spec.seam_offset) return best_offset(line1, s0, s1, reversed);
    const double offset = *spec.seam_offset - std::floor(*spec.seam_offset);
    return Placement{offset, gain_at(line1, s0, s1, offset, reversed)};
  };
  const Vec3 N0 = area_vector(s0), N1 = area_vector(s1);
  const bool clear = std::abs(N0.dot(N1)) >= 0.1 * N0.norm() * N1.norm() && N0.norm() * N1.norm() > 0.0;
  if (spec.reverse || clear) {
    const bool reversed = spec.reverse.value_or(N0.dot(N1) < 0.0);
    return {reversed, placed(reversed).offset};
  }
  const Placement forward = placed(false), backward = placed(true);
  const bool reversed = backward.gain > forward.gain + 1e-9 * std::sqrt(s0.spread * s1.spread);
  return {reversed, (reversed ? backward : forward).offset};
}

Arrangement arranged_open(const FractionLine& line1, const Samples& s0, const Samples& s1,
                          const CorrespondenceSpec& spec) {
  const bool cheaper = gain_at(line1, s0, s1, 1.0, true) >
                       gain_at(line1, s0, s1, 0.0, false) + 1e-9 * std::sqrt(s0.spread * s1.spread);
  const bool reversed = spec.reverse.value_or(cheaper);
  return {reversed, reversed ? 1.0 : 0.0};
}

Arrangement arranged(const FractionLine& line0, const FractionLine& line1, const CorrespondenceSpec& spec) {
  const bool closed = line0.line.domain().closed;
  if (spec.rule == CorrespondenceRule::as_given) {
    const bool reversed = spec.reverse.value_or(false);
    const double offset = spec.seam_offset.value_or(0.0);
    return {reversed, closed ? offset - std::floor(offset) : (reversed ? 1.0 : 0.0)};
  }
  if (spec.reverse && (!closed || spec.seam_offset)) {
    const double offset = spec.seam_offset.value_or(0.0);
    return {*spec.reverse, closed ? offset - std::floor(offset) : (*spec.reverse ? 1.0 : 0.0)};
  }
  const Samples s0 = sampled(line0), s1 = sampled(line1);
  return closed ? arranged_closed(line1, s0, s1, spec) : arranged_open(line1, s0, s1, spec);
}

/// The line over `range` with x = offset + sign t, t the fraction of the range; itself when nothing changes.
Trimline mapped(const FractionLine& line, double offset, double sign, const Interval& range) {
  const CurveDomain domain{range, line.line.domain().closed};
  const bool same_map = !line.map.p && line.map.a == range.lo && line.map.b == range.length();
  if (same_map && offset == 0.0 && sign > 0.0 && range == line.line.domain().v) return line.line;
  const double d = sign / range.length();
  return reparametrised(line.line, LineMap{line.map, offset - d * range.lo, d, domain});
}

double twist(const Trimline& line0, const Trimline& line1) {
  constexpr int places = 128;
  double worst = 0.0;
  for (int i = 0; i <= places; ++i) {
    const double v = line0.domain().v.at(static_cast<double>(i) / places);
    const LinePoint a = line_point(line0, v), b = line_point(line1, v);
    const Vec3 De = b.C - a.C;
    const double size = De.norm() * a.C1.norm() * b.C1.norm();
    if (size > 0.0) worst = std::max(worst, std::abs(De.dot(a.C1.cross(b.C1))) / size);
  }
  return std::asin(std::min(worst, 1.0));
}

/// What joins the ends of an open line whose ends meet; empty for other lines.
std::string meeting_ends(const Trimline& line, std::size_t side) {
  const Interval range = line.domain().v;
  if (line.domain().closed) return "";
  const LinePoint first = line_point(line, range.lo), last = line_point(line, range.hi);
  double size = 0.0;
  for (int i = 1; i < 8; ++i) size = std::max(size, (line_point(line, range.at(i / 8.0)).C - first.C).norm());
  if (!((last.C - first.C).norm() <= 1e-6 * size)) return "";
  const Radians corner(std::atan2(first.C1.cross(last.C1).norm(), first.C1.dot(last.C1)));
  const std::string meets =
      std::string(". The ends of \"") + side_name(side) + "\" meet at " + point_text(first.C);
  if (!(first.C1.norm() > 0.0 && last.C1.norm() > 0.0))
    return meets + ", but the line stops there (|C'| = 0), so that it cannot be closed smoothly";
  if (corner.value <= 1e-6) return meets + " without a corner: it can be given as closed";
  return meets + ", but with a corner of " + number_text(corner.degrees(), 4) +
         " deg at this seam, so that it cannot be closed smoothly: round the corner, or make both trimlines "
         "open";
}

void check(const Trimline& line0, const Trimline& line1, const CorrespondenceSpec& spec) {
  const auto kind = [](const Trimline& line) { return line.domain().closed ? "closed" : "open"; };
  if (line0.domain().closed != line1.domain().closed)
    throw GeometryError(std::string("the trimline of \"") + side_name(0) + "\" is " + kind(line0) +
                        " and that of \"" + side_name(1) + "\" is " + kind(line1) +
                        "; both must be closed or both open" + meeting_ends(line0, 0) +
                        meeting_ends(line1, 1));
  if (spec.seam_offset && !std::isfinite(*spec.seam_offset))
    throw InputError("seam_offset", "is not a finite number, must be a fraction of the period");
  if (spec.seam_offset && !line0.domain().closed)
    throw InputError("seam_offset",
                     "is " + number_text(*spec.seam_offset) +
                         ", but the trimlines are open; an offset belongs to closed trimlines");
  const bool is_mapped = spec.rule == CorrespondenceRule::mapped;
  if (!is_mapped && !spec.map.empty())
    throw InputError("map", "is given, but the rule is not mapped; take that rule or leave the map out");
  if (!is_mapped) return;
  std::vector<Problem> problems = check_map(spec.map, line0.domain().closed);
  if (!problems.empty()) throw InputError(std::move(problems));
}

}  // namespace

Correspondence correspond(const Trimline& line0, const Trimline& line1, const CorrespondenceSpec& spec) {
  check(line0, line1, spec);
  const bool as_given = spec.rule == CorrespondenceRule::as_given;
  const auto fraction = [as_given](const Trimline& line) {
    return FractionLine{line, as_given ? parameter_fraction(line) : arc_length_fraction(line)};
  };
  const FractionLine f0 = fraction(line0), f1 = fraction(line1);
  const Arrangement a = arranged(f0, f1, spec);
  const Interval range = as_given ? line0.domain().v : Interval{0.0, 1.0};
  Correspondence c{mapped(f0, 0.0, 1.0, range), mapped(f1, a.offset, a.reversed ? -1.0 : 1.0, range),
                   a.reversed, line0.domain().closed ? a.offset : 0.0, 0.0};
  const bool closed = line0.domain().closed, is_mapped = spec.rule == CorrespondenceRule::mapped;
  if (is_mapped || spec.rule == CorrespondenceRule::minimal_twist) {
    const FractionMap g = is_mapped ? given_map(spec.map, closed)
                                    : least_twist_map(c.line0, c.line1, closed && !spec.seam_offset);
    const double start = g(Series(0.0)).value();
    c.line1 = mapped({c.line1, g}, 0.0, 1.0, range);
    if (closed) {
      c.seam_offset += a.reversed ? -start : start;
      c.seam_offset -= std::floor(c.seam_offset);
    }
  }
  c.twist = twist(c.line0, c.line1);
  return c;
}

}  // namespace blendwright
