#include "parametric/cross_tangent/cross_tangent.hpp"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <memory>

#include "kernel/base/error.hpp"
#include "kernel/base/number_text.hpp"
#include "parametric/cross_tangent/magnitude.hpp"
#include "parametric/cross_tangent/side_frame.hpp"
#include "parametric/trimline/along_curve.hpp"
#include "parametric/trimline/line_point.hpp"

namespace blendwright {
namespace {

constexpr int steps = 128;  ///< of v, where the pair is checked and the sampled magnitude rules are solved

using Sides = std::array<SideSpec, 2>;

bool follows_chord(const SideSpec& side) { return side.continuity == Continuity::G0; }

/// Both ends as functions of v.
class Pair {
 public:
  Pair(std::array<SideFrame, 2> frames, const Sides& sides, Magnitudes magnitudes)
      : frames_(std::move(frames)), sides_(sides), magnitudes_(std::move(magnitudes)) {}

  [[nodiscard]] std::array<EndSeries, 2> operator()(double v) const {
    const std::array<SideSeries, 2> side{evaluated(0, v), evaluated(1, v)};
    const Series3 De = side[1].C - side[0].C;
    const Series square = dot(De, De), over = inverse_sqrt(square), chord = square * over;
    const Series3 along_chord = over * De;
    const auto direction = [&](std::size_t i) -> const Series3& {
      return follows_chord(sides_[i]) ? along_chord : side[i].direction;
    };
    const Series cos_theta = dot(direction(0), direction(1));
    std::array<EndSeries, 2> ends;
    for (std::size_t i = 0; i < 2; ++i) {
      const Series m = magnitudes_.at(static_cast<int>(i), v, chord, cos_theta);
      ends[i] = {side[i].C, m * direction(i), constant(Vec3::Zero())};
      if (sides_[i].continuity == Continuity::G2) ends[i].D = m * m * side[i].bend * side[i].normal;  // (2)
    }
    return ends;
  }

  [[nodiscard]] EndEnclosure enclosed(std::size_t side, const TaylorModel& v) const;

  /// The last v of each thread is remembered: a blend asks both ends at the same v in turn.
  [[nodiscard]] EndSeries end(std::size_t side, double v) const {
    struct Last {
      std::uint64_t pair = 0;
      double v = 0.0;
      std::array<EndSeries, 2> ends;
    };
    thread_local Last last;
    if (last.pair != id_ || last.v != v) {
      last.ends = (*this)(v);
      last.pair = id_;
      last.v = v;
    }
    return last.ends[side];
  }

 private:
  [[nodiscard]] SideSeries evaluated(std::size_t i, double v) const {
    if (follows_chord(sides_[i])) return {frames_[i].position(v), {}, {}, {}};
    return sides_[i].continuity == Continuity::G2 ? frames_[i].second_order(v) : frames_[i].first_order(v);
  }
  static std::uint64_t next_id() {
    static std::atomic<std::uint64_t> count{0};
    return ++count;
  }

  std::array<SideFrame, 2> frames_;
  Sides sides_;
  Magnitudes magnitudes_;
  std::uint64_t id_ = next_id();
};

using Jets = std::array<ModelJet, 3>;

Jets operator-(const Jets& a, const Jets& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }
Jets operator*(const ModelJet& s, const Jets& a) { return {s * a[0], s * a[1], s * a[2]}; }
ModelJet dot(const Jets& a, const Jets& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
ModelVector coefficient(const Jets& a, std::size_t k, double factor = 1.0) {
  return {factor * a[0].c[k], factor * a[1].c[k], factor * a[2].c[k]};
}

EndEnclosure Pair::enclosed(std::size_t i, const TaylorModel& v) const {
  const std::array<SideEnclosure, 2> side{frames_[0].enclosed(v), frames_[1].enclosed(v)};
  EndEnclosure end;
  for (const SideEnclosure& s : side)
    if (!s.unproven.empty()) end.unproven = s.unproven;
  if (!end.unproven.empty()) return end;
  const Jets De = side[1].C - side[0].C;
  const ModelJet square = dot(De, De), over = pow(square, -0.5), chord = square * over;
  const auto direction = [&](std::size_t k) {
    return follows_chord(sides_[k]) ? over * De : side[k].direction;
  };
  const ModelJet cos_theta = dot(direction(0), direction(1));
  const ModelJet m = magnitudes_.at(static_cast<int>(i), ModelJet::u_variable(v), chord, cos_theta);
  const Jets T = m * direction(i);
  end.C = {coefficient(side[i].C, 0), coefficient(side[i].C, 1), coefficient(side[i].C, 3, 2.0)};
  end.T = {coefficient(T, 0), coefficient(T, 1)};
  if (sides_[i].continuity == Continuity::G2)
    end.D = (m.c[0] * m.c[0] * side[i].bend) * coefficient(side[i].normal, 0);  // (2)
  return end;
}

void check_sides(const Sides& sides, bool closed) {
  std::vector<Problem> problems;
  for (std::size_t i = 0; i < 2; ++i) {
    const SideSpec& side = sides[i];
    const std::string where = "sides/" + std::to_string(i);
    if (side.continuity == Continuity::none)
      problems.push_back({where + "/continuity", "is none, must be G0, G1 or G2"});
    for (Problem& p : check_law(side.factor, closed, where + "/factor")) problems.push_back(std::move(p));
    if (!(std::abs(side.tangent_angle.value) <= degrees(60.0).value * (1.0 + 1e-12)))
      problems.push_back({where + "/tangent_angle", "is " + number_text(side.tangent_angle.degrees(), 6) +
                                                        " deg, must lie in [-60, 60] deg"});
  }
  if (!problems.empty()) throw InputError(std::move(problems));
}

std::string on_line(std::size_t side) { return std::string(side_name(side)) + ": "; }

GeometryError zero_tangent(std::size_t side, const DegeneratePoint& p) {
  const std::string what = p.kind == DegeneratePoint::Kind::cusp
                               ? "the trimline stops (|C'| = 0)"
                               : "the primary has no normal (|Su x Sv| = 0)";
  return GeometryError(on_line(side) + what + " " + place(p.v, p.point) +
                       " and the limits from both sides differ; split the blend there");
}

/// Both lines at steps + 1 equal steps of v.
struct Samples {
  std::vector<double> v;
  std::array<std::vector<LinePoint>, 2> point;
};

Samples sampled(const std::array<Trimline, 2>& line) {
  Samples s;
  for (int i = 0; i <= steps; ++i) {
    s.v.push_back(line[0].domain().v.at(static_cast<double>(i) / steps));
    for (std::size_t k = 0; k < 2; ++k) s.point[k].push_back(line_point(line[k], s.v.back()));
  }
  return s;
}

void check_apart(const Samples& samples, double tolerance) {
  for (std::size_t i = 0; i < samples.v.size(); ++i) {
    const Vec3& C0 = samples.point[0][i].C;
    const double chord = (samples.point[1][i].C - C0).norm();
    if (chord > 0.0 && chord >= 100.0 * tolerance) continue;
    throw GeometryError(
        "the trimlines touch " + place(samples.v[i], C0) + ": they are " + scientific_text(chord) +
        " apart, must be at least 100 times the position tolerance, " + scientific_text(100.0 * tolerance));
  }
}

/// Places where the cross direction must be continued; throws at corners. Lines that stay clear of both kinds
/// of zero are not scanned.
std::vector<double> harmless_places(const Trimline& line, std::size_t side,
                                    const std::vector<LinePoint>& points) {
  double least_speed = points.front().C1.norm(), least_area = points.front().n.norm();
  double speeds = 0.0, areas = 0.0, reaches = 0.0, squares = 0.0;
  for (const LinePoint& p : points) {
    least_speed = std::min(least_speed, p.C1.norm());
    least_area = std::min(least_area, p.n.norm());
    speeds += p.C1.norm();
    areas += p.n.norm();
    reaches += p.reach;
    squares += p.scale * p.scale;
  }
  const double count = static_cast<double>(points.size());
  const bool runs = least_speed > 0.25 * speeds / count && speeds > 1e-9 * reaches;
  const bool regular = least_area > 0.25 * areas / count && areas > 1e-9 * squares;
  if (runs && regular) return {};
  std::vector<double> places;
  for (const DegeneratePoint& p : degenerate_points(line)) {
    if (!p.harmless()) throw zero_tangent(side, p);
    places.push_back(p.v);
  }
  return places;
}

std::vector<PairSample> directed(const std::array<SideFrame, 2>& frames, const Sides& sides,
                                 const Samples& samples) {
  std::vector<PairSample> pairs;
  for (std::size_t i = 0; i < samples.v.size(); ++i) {
    PairSample s{samples.v[i], samples.point[1][i].C - samples.point[0][i].C, {}};
    for (std::size_t k = 0; k < 2; ++k)
      s.direction[k] =
          follows_chord(sides[k]) ? Vec3(s.De.normalized()) : frames[k].direction(s.v, samples.point[k][i]);
    pairs.push_back(s);
  }
  return pairs;
}

/// The sign of n x C' in k on each side: given by the user, else int T.(C1 - C0) dv > 0, which only k can
/// change.
double sign_of(std::size_t side, const SideFrame& conormal, const Samples& samples, const SideSpec& spec,
               bool reversed) {
  if (spec.keep != SideSpec::Keep::automatic) {
    // Left means n x C' of the given line points into the kept part: T0 points out of it, T1 into it.
    const double given = (spec.keep == SideSpec::Keep::left) == (side == 1) ? 1.0 : -1.0;
    return reversed && side == 1 ? -given : given;
  }
  double towards = 0.0, all = 0.0;
  for (std::size_t i = 0; i < samples.v.size(); ++i) {
    const Vec3 De = samples.point[1][i].C - samples.point[0][i].C;
    towards += conormal.direction(samples.v[i], samples.point[side][i]).dot(De);
    all += De.norm();
  }
  if (!follows_chord(spec) && !(std::abs(towards) > 1e-6 * all))
    throw GeometryError(
        on_line(side) +
        "which part of its primary stays cannot be decided, because the other trimline lies at a "
        "right angle to the primary; say which side to keep, left or right");
  return towards < 0.0 ? -1.0 : 1.0;
}

void check_turn(const std::vector<PairSample>& samples, const Sides& sides, const Trimline& line0) {
  const bool circle =
      sides[0].rule == MagnitudeRule::circle_like || sides[1].rule == MagnitudeRule::circle_like;
  if (!circle) return;
  for (const PairSample& s : samples) {
    const double theta =
        std::atan2(s.direction[0].cross(s.direction[1]).norm(), s.direction[0].dot(s.direction[1]));
    if (theta < degrees(170.0).value) continue;
    throw GeometryError(
        "the blend would turn by " + number_text(Radians(theta).degrees(), 4) + " deg " +
        place(s.v, line_point(line0, s.v).C) +
        ", circle_like magnitudes need less than 170 deg; take another magnitude rule or trimline");
  }
}

}  // namespace

CrossTangents cross_tangents(const Correspondence& lines, const Sides& sides, double tolerance) {
  const CurveDomain domain = lines.line0.domain();
  check_sides(sides, domain.closed);
  const std::array<Trimline, 2> line{lines.line0, lines.line1};
  const Samples points = sampled(line);
  check_apart(points, tolerance);
  std::array<std::vector<double>, 2> harmless;
  for (std::size_t i = 0; i < 2; ++i)
    if (!follows_chord(sides[i])) harmless[i] = harmless_places(line[i], i, points.point[i]);
  const auto frame = [&](std::size_t i, double sign, Radians psi) {
    return SideFrame(line[i], sign, psi, harmless[i]);
  };
  std::array<double, 2> sign{};
  for (std::size_t i = 0; i < 2; ++i)
    sign[i] = sign_of(i, frame(i, 1.0, Radians(0.0)), points, sides[i], lines.reversed);
  const std::array<SideFrame, 2> frames{frame(0, sign[0], sides[0].tangent_angle),
                                        frame(1, sign[1], sides[1].tangent_angle)};
  const std::vector<PairSample> samples = directed(frames, sides, points);
  check_turn(samples, sides, line[0]);
  Magnitudes magnitudes(sides, domain, samples);
  CrossTangents result;
  for (std::size_t i = 0; i < 2; ++i)
    for (std::size_t k = 0; k < samples.size(); k += 2)
      result.magnitude[i].push_back(magnitudes.at(static_cast<int>(i), samples[k]));
  const auto pair = std::make_shared<const Pair>(frames, sides, std::move(magnitudes));
  for (std::size_t i = 0; i < 2; ++i)
    result.ends[i] = {domain, sides[i].continuity, [pair, i](double v) { return pair->end(i, v); },
                      [pair, i](const TaylorModel& v) { return pair->enclosed(i, v); }};
  result.kept_left = {sign[0]<0.0, sign[1]> 0.0};
  return result;
}

}  // namespace blendwright
