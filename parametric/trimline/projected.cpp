// Trimlines made by projecting a space curve: feet followed along v, exact derivatives by Newton on Taylor
// series.
#include <algorithm>
#include <cmath>

#include "kernel/base/error.hpp"
#include "kernel/base/number_text.hpp"
#include "kernel/geometry/enclosure.hpp"
#include "kernel/geometry/project.hpp"
#include "parametric/trimline/along_curve.hpp"
#include "parametric/trimline/line_point.hpp"
#include "parametric/trimline/trimline.hpp"

namespace blendwright {
namespace {

constexpr int spans = 128;  ///< nodes of the table of guesses, less one

Vec3 value(const Series3& a) { return derivative(a, 0); }

/// The foot equations (1) or (2) of the header for one primary and direction.
class FootEquations {
 public:
  FootEquations(Surface primary, const std::optional<Vec3>& direction)
      : primary_(std::move(primary)), along_direction_(direction.has_value()) {
    if (!direction) return;
    if (!(direction->norm() > 0.0) || !direction->allFinite())
      throw InputError("direction", "is zero or not finite, must be a direction to project along");
    const Vec3 d = direction->normalized();
    Eigen::Index least = 0;
    d.cwiseAbs().minCoeff(&least);
    e1_ = d.cross(Vec3(Vec3::Unit(least))).normalized();
    e2_ = d.cross(e1_);
  }

  /// Newton on the values from `guess`; nullopt when it does not settle or the equations are singular there.
  [[nodiscard]] std::optional<Vec2> foot(const Vec3& q, Vec2 guess) const {
    const SurfaceDomain box = primary_.domain();
    const double scale = box.u.length() + box.v.length();
    double last = std::numeric_limits<double>::infinity();
    for (int i = 0; i < 30; ++i) {
      const SurfaceJet s = primary_.jet({guess[0], guess[1]});
      const std::optional<Eigen::Matrix2d> inverse = inverse_jacobian(s, q);
      if (!inverse) return std::nullopt;
      const Vec2 step = *inverse * residual(s, q);
      guess -= step;
      const double size = step.norm();
      if (!(size <= 1e6 * scale)) return std::nullopt;
      // Quadratic convergence: once steps are this small, the next ones are rounding.
      if (size <= 1e-9 * scale && (size <= 1e-15 * scale || size >= 0.5 * last)) return guess;
      last = size;
    }
    return std::nullopt;
  }

  /// The foot's series from its constant term: with the Jacobian's constant term, each step gains one order.
  [[nodiscard]] Series2 lifted(const Series3& q, const Vec2& foot) const {
    const SurfacePartials P = primary_.partials({foot[0], foot[1]});
    const SurfaceJet s{P(0, 0), P(1, 0), P(0, 1), P(2, 0), P(1, 1), P(0, 2)};
    const Eigen::Matrix2d J = inverse_jacobian(s, value(q)).value_or(Eigen::Matrix2d::Zero());
    Series2 uv{Series(foot[0]), Series(foot[1])};
    for (std::size_t known = 1; known <= Series::order; ++known) {
      const AlongCurve along_foot(uv);
      const Series3 away = along_foot(P, 0, 0) - q;
      const Series F = along_direction_ ? dot(away, constant(e1_)) : dot(away, along_foot(P, 1, 0));
      const Series G = along_direction_ ? dot(away, constant(e2_)) : dot(away, along_foot(P, 0, 1));
      for (std::size_t k = known; k <= Series::order; ++k) {
        uv[0].c[k] -= J(0, 0) * F.c[k] + J(0, 1) * G.c[k];
        uv[1].c[k] -= J(1, 0) * F.c[k] + J(1, 1) * G.c[k];
      }
    }
    return uv;
  }

  /// The foot's curve over a piece of v, given the curve q there and the foot at the piece's middle. The
  /// polynomial that solves the equations to the models' order is made first; then Krawczyk's operator proves
  /// that for every v exactly one foot lies within a radius of it:
  ///   |Y F(p)| + |1 - Y J(p +- r)| r <= r,   Y: approximate inverse of the Jacobian J (3)
  /// Source: Moore, Kearfott, Cloud, Introduction to Interval Analysis, 2009, chapter 8.
  void enclose(const CurveEnclosure& q, const Vec2& foot, CurveEnclosure& out) const;

  [[nodiscard]] const Surface& primary() const { return primary_; }

 private:
  using Models2 = std::array<TaylorModel, 2>;
  struct EnclosedFoot {
    SurfaceEnclosure S;
    Models2 F;                       ///< left sides of (1) or (2)
    std::array<Models2, 2> J;        ///< their Jacobian
    std::array<ModelVector, 2> row;  ///< what the curve is multiplied by in each equation
  };
  [[nodiscard]] EnclosedFoot enclosed_foot(const Models2& p, const CurveEnclosure& q) const;

  [[nodiscard]] Vec2 residual(const SurfaceJet& s, const Vec3& q) const {
    const Vec3 away = s.S - q;
    return along_direction_ ? Vec2(away.dot(e1_), away.dot(e2_)) : Vec2(away.dot(s.Su), away.dot(s.Sv));
  }
  /// nullopt where the foot is not unique: q at a centre of curvature, or `direction` in the tangent plane.
  [[nodiscard]] std::optional<Eigen::Matrix2d> inverse_jacobian(const SurfaceJet& s, const Vec3& q) const {
    const Vec3 away = s.S - q;
    Eigen::Matrix2d J;
    if (along_direction_) {
      J << s.Su.dot(e1_), s.Sv.dot(e1_), s.Su.dot(e2_), s.Sv.dot(e2_);
    } else {
      const double mixed = s.Su.dot(s.Sv) + away.dot(s.Suv);
      J << s.Su.squaredNorm() + away.dot(s.Suu), mixed, mixed, s.Sv.squaredNorm() + away.dot(s.Svv);
    }
    const double determinant = J(0, 0) * J(1, 1) - J(0, 1) * J(1, 0);
    if (!(std::abs(determinant) > 1e-12 * J.row(0).norm() * J.row(1).norm())) return std::nullopt;
    Eigen::Matrix2d inverse;
    inverse << J(1, 1), -J(0, 1), -J(1, 0), J(0, 0);
    return Eigen::Matrix2d(inverse / determinant);
  }

  Surface primary_;
  bool along_direction_;
  Vec3 e1_ = Vec3::Zero(), e2_ = Vec3::Zero();
};

FootEquations::EnclosedFoot FootEquations::enclosed_foot(const Models2& p, const CurveEnclosure& q) const {
  EnclosedFoot e;
  if (!primary_.enclose(p[0], p[1], e.S)) e.S.unproven = "the primary has no enclosure";
  const SurfaceEnclosure& S = e.S;
  const ModelVector away = S.S - q.D[0];
  if (along_direction_)
    e.row = {constant_model(e1_), constant_model(e2_)};
  else
    e.row = {S.Su, S.Sv};
  for (std::size_t i = 0; i < 2; ++i) {
    e.F[i] = dot(away, e.row[i]);
    e.J[i] = {dot(S.Su, e.row[i]), dot(S.Sv, e.row[i])};
  }
  if (along_direction_) return e;
  const TaylorModel mixed = dot(away, S.Suv);
  e.J[0][0] = e.J[0][0] + dot(away, S.Suu);
  e.J[0][1] = e.J[0][1] + mixed;
  e.J[1][0] = e.J[1][0] + mixed;
  e.J[1][1] = e.J[1][1] + dot(away, S.Svv);
  return e;
}

void FootEquations::enclose(const CurveEnclosure& q, const Vec2& foot, CurveEnclosure& out) const {
  out.D.fill(unknown_vector());
  Vec3 at;
  for (std::size_t d = 0; d < 3; ++d) at[static_cast<Eigen::Index>(d)] = q.D[0][d].centre();
  const auto Y = inverse_jacobian(primary_.jet({foot[0], foot[1]}), at);
  if (!Y) return;
  const auto corrected = [&](const Models2& F, std::size_t i) {
    const auto r = static_cast<Eigen::Index>(i);
    return (*Y)(r, 0) * F[0] + (*Y)(r, 1) * F[1];
  };
  Models2 p{foot[0], foot[1]};
  for (int step = 0; step <= TaylorModel::order; ++step) {
    const EnclosedFoot e = enclosed_foot(p, q);
    if (!e.S.unproven.empty()) {
      out.unproven = e.S.unproven;
      return;
    }
    for (std::size_t i = 0; i < 2; ++i) p[i] = (p[i] - corrected(e.F, i)).with_radius(0.0);
  }
  const Models2 F = enclosed_foot(p, q).F;
  std::array<double, 2> miss{}, radius{}, reached{};
  for (std::size_t i = 0; i < 2; ++i) {
    miss[i] = corrected(F, i).range().magnitude();
    radius[i] = 3.0 * miss[i] + 1e-15 * p[i].range().magnitude();
  }
  const EnclosedFoot wide = enclosed_foot({p[0].with_radius(radius[0]), p[1].with_radius(radius[1])}, q);
  for (std::size_t i = 0; i < 2; ++i) {
    Bounds sum(miss[i]);
    for (std::size_t k = 0; k < 2; ++k) {
      const TaylorModel product = corrected({wide.J[0][k], wide.J[1][k]}, i);
      const Bounds off = Bounds(i == k ? 1.0 : 0.0) - product.range();
      sum = sum + Bounds(off.magnitude()) * Bounds(radius[k]);
    }
    reached[i] = sum.hi;
    if (!(reached[i] <= radius[i])) return;  // (3) does not hold: a smaller piece may do
    p[i] = p[i].with_radius(radius[i]);
  }
  const EnclosedFoot e = enclosed_foot(p, q);
  const TaylorModel over = inverse(e.J[0][0] * e.J[1][1] - e.J[0][1] * e.J[1][0]);
  const auto solved = [&](const Models2& right) {
    return Models2{over * (e.J[1][1] * right[0] - e.J[0][1] * right[1]),
                   over * (e.J[0][0] * right[1] - e.J[1][0] * right[0])};
  };
  const auto set = [&](std::size_t k, const Models2& x) {
    out.D[k][0] = x[0];
    out.D[k][1] = x[1];
  };
  set(0, p);
  const Models2 p1 = solved({dot(q.D[1], e.row[0]), dot(q.D[1], e.row[1])});
  set(1, p1);
  if (!along_direction_) return;  // the second derivative of (1) needs third derivatives of the primary
  const ModelVector bend =
      (p1[0] * p1[0]) * e.S.Suu + (2.0 * (p1[0] * p1[1])) * e.S.Suv + (p1[1] * p1[1]) * e.S.Svv;
  const ModelVector rest = q.D[2] - bend;
  set(2, solved({dot(rest, e.row[0]), dot(rest, e.row[1])}));
}

Vec2 evaluate(const Series2& s, double h) {
  const auto horner = [h](const Series& a) { return a.c[0] + h * (a.c[1] + h * (a.c[2] + h * a.c[3])); };
  return {horner(s[0]), horner(s[1])};
}

/// The pcurve of the feet. Immutable: Newton starts from a table of the foot's Taylor polynomials.
struct ProjectedCurve {
  FootEquations equations;
  Curve3 curve;
  CurveDomain range;
  std::vector<Series2> table;  ///< at spans + 1 equal steps of the range
  Vec2 turn = Vec2::Zero();    ///< advance per period of a closed curve

  [[nodiscard]] CurveDomain domain() const { return range; }
  [[nodiscard]] Vec2 guess_at(double inside) const {
    const double step = range.v.length() / spans;
    const double node = std::min(std::max(std::round((inside - range.v.lo) / step), 0.0), double{spans});
    return evaluate(table[static_cast<std::size_t>(node)], inside - range.v.at(node / spans));
  }
  void enclose(const TaylorModel& v, CurveEnclosure& out) const {
    double turns = 0.0;
    const TaylorModel inside = inside_range(v, range.v.lo, range.v.hi, range.closed, &turns);
    CurveEnclosure q;
    out.D.fill(unknown_vector());
    if (!curve.enclose(inside, q)) q.unproven = "the projected curve has no enclosure";
    out.unproven = q.unproven;
    if (!out.unproven.empty() || !inside.finite()) return;
    const Vec2 guess = guess_at(inside.centre());
    const std::optional<Vec2> foot = equations.foot(curve.point(inside.centre()), guess);
    if (!foot) return;
    equations.enclose(q, *foot, out);
    for (std::size_t d = 0; d < 2; ++d)
      out.D[0][d] = out.D[0][d] + TaylorModel(Bounds(turns) * Bounds(turn[static_cast<Eigen::Index>(d)]));
  }
  [[nodiscard]] CurveJet<2> jet(double v) const {
    const Wrapped w = wrapped(range, v);
    const Vec2 guess = guess_at(w.inside);
    const Series3 q = to_series<3>(curve.jet(w.inside));
    // The table was followed at construction, so Newton converges; past the end of an open range the
    // polynomial continues where the foot is lost.
    CurveJet<2> jet = to_jet(equations.lifted(q, equations.foot(value(q), guess).value_or(guess)));
    jet.D[0] += w.turns * turn;
    return jet;
  }
};

class Follower {
 public:
  Follower(const FootEquations& equations, const Curve3& curve, const std::optional<Vec3>& direction)
      : equations_(equations), curve_(curve), direction_(direction) {}

  [[nodiscard]] Series2 first(double v) const {
    const Surface& primary = equations_.primary();
    const Vec3 q = curve_.point(v);
    const std::optional<Foot> seed = direction_ ? shoot(primary, q, *direction_) : closest_point(primary, q);
    if (!seed || !seed->interior) throw no_projection(v);
    const std::optional<Vec2> foot = equations_.foot(q, {seed->at.u, seed->at.v});
    if (!foot) throw no_projection(v);
    return lifted_inside(v, *foot);
  }

  /// The foot at v, followed from a known one at `from`; the step is halved where Newton strays from the
  /// prediction.
  [[nodiscard]] Series2 next(double from, const Series2& known, double v, int halvings = 10) const {
    const Vec2 predicted = evaluate(known, v - from);
    const SurfaceDomain box = equations_.primary().domain();
    const std::optional<Vec2> foot = equations_.foot(curve_.point(v), predicted);
    const Vec2 miss = foot ? Vec2(*foot - predicted) : Vec2::Zero();
    const bool near =
        foot && std::abs(miss[0]) <= 0.02 * box.u.length() && std::abs(miss[1]) <= 0.02 * box.v.length();
    if (near) return lifted_inside(v, *foot);
    if (halvings == 0) throw no_projection(v);
    const double middle = 0.5 * (from + v);
    return next(middle, next(from, known, middle, halvings - 1), v, halvings - 1);
  }

 private:
  [[nodiscard]] Series2 lifted_inside(double v, const Vec2& foot) const {
    const SurfaceDomain box = equations_.primary().domain();
    const bool inside = (box.u_closed || box.u.contains(foot[0], 1e-9 * box.u.length())) &&
                        (box.v_closed || box.v.contains(foot[1], 1e-9 * box.v.length()));
    if (!inside) throw no_projection(v);
    return equations_.lifted(to_series<3>(curve_.jet(v)), foot);
  }
  [[nodiscard]] GeometryError no_projection(double v) const {
    const Vec3 q = curve_.point(v);
    const std::string how = direction_ ? "along the given direction" : "to the closest point";
    if (meets_pole(q))
      return GeometryError("the projection of the curve " + how + " passes through a pole of its primary " +
                           place(v, q) + ", where the primary's parameters turn over; move the curve off it");
    return GeometryError("the curve has no projection on the primary's domain " + place(v, q) + " " + how +
                         ": the nearest point of the primary is " +
                         number_text(closest_point(equations_.primary(), q).distance, 6) +
                         " away; extend the primary or move the curve");
  }

  /// Whether the primary has a pole at the foot of q or so near that feet cannot be followed past it: one
  /// parameter hardly moves the point.
  [[nodiscard]] bool meets_pole(const Vec3& q) const {
    const Surface& primary = equations_.primary();
    const std::optional<Foot> foot =
        direction_ ? shoot(primary, q, *direction_) : std::optional(closest_point(primary, q));
    if (!foot) return false;
    const SurfaceDomain box = primary.domain();
    const SurfaceJet s = primary.jet(foot->at);
    const double u = s.Su.norm() * box.u.length(), v = s.Sv.norm() * box.v.length();
    return std::min(u, v) <= 1e-3 * std::max(u, v);
  }

  const FootEquations& equations_;
  const Curve3& curve_;
  const std::optional<Vec3>& direction_;
};

/// The advance of the closed curve's foot over one period: whole periods of the primary, or the projection is
/// torn.
Vec2 closing_turn(const ProjectedCurve& curve) {
  const SurfaceDomain box = curve.equations.primary().domain();
  Vec2 step, turn = Vec2::Zero();
  for (int axis = 0; axis < 2; ++axis) {
    const auto i = static_cast<std::size_t>(axis);
    const double period = axis == 0 ? box.u.length() : box.v.length();
    step[axis] = curve.table.back()[i].value() - curve.table.front()[i].value();
    if (axis == 0 ? box.u_closed : box.v_closed) turn[axis] = std::round(step[axis] / period) * period;
    if (std::abs(step[axis] - turn[axis]) <= 1e-7 * period) continue;
    const double v = curve.range.v.lo;
    throw GeometryError(
        "the curve is closed but its projection is not, " + place(v, curve.curve.point(v)) +
        ": the foot ends " + scientific_text(std::abs(step[axis] - turn[axis])) +
        " from its start in the primary's parameters; move the curve off the primary's axis or focal set");
  }
  return turn;
}

}  // namespace

Trimline projected(const Surface& primary, const Curve3& curve, std::optional<Vec3> direction) {
  const CurveDomain range = curve.domain();
  ProjectedCurve pcurve{FootEquations(primary, direction), curve, range, {}, Vec2::Zero()};
  const Follower follower(pcurve.equations, curve, direction);
  pcurve.table.reserve(spans + 1);
  pcurve.table.push_back(follower.first(range.v.lo));
  for (int i = 1; i <= spans; ++i)
    pcurve.table.push_back(follower.next(range.v.at((i - 1.0) / spans), pcurve.table.back(),
                                         range.v.at(static_cast<double>(i) / spans)));
  if (range.closed) pcurve.turn = closing_turn(pcurve);
  return Trimline(primary, std::move(pcurve));
}

}  // namespace blendwright
