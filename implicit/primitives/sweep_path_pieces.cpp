#include "implicit/primitives/sweep_path_pieces.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "kernel/base/error.hpp"
#include "kernel/base/number_text.hpp"
#include "kernel/math/formula.hpp"

namespace blendwright::detail {
namespace {

/// The degree 7 polynomial on [-1, 1] with these derivatives 0 to 3 at -1 and 1.
std::array<Vec3, 8> hermite(const PathJet& l, const PathJet& r) {
  std::array<Vec3, 4> even, odd;  // of derivative k: half the sum and half the difference, by parity
  for (std::size_t k = 0; k < 4; ++k) {
    const Vec3 sum = 0.5 * (r[k] + l[k]), difference = 0.5 * (r[k] - l[k]);
    even[k] = k % 2 == 0 ? sum : difference;
    odd[k] = k % 2 == 0 ? difference : sum;
  }
  std::array<Vec3, 8> c;
  const Vec3 d = odd[1] - odd[0], f = odd[2] - 3.0 * d;
  c[7] = (odd[3] - odd[2] - 5.0 * f) / 48.0;
  c[5] = (f - 24.0 * c[7]) / 8.0;
  c[3] = (d - 4.0 * c[5] - 6.0 * c[7]) / 2.0;
  c[1] = odd[0] - c[3] - c[5] - c[7];
  const Vec3 g = even[2] - even[1];
  c[6] = (even[3] - 3.0 * g) / 48.0;
  c[4] = (g - 24.0 * c[6]) / 8.0;
  c[2] = (even[1] - 4.0 * c[4] - 6.0 * c[6]) / 2.0;
  c[0] = even[0] - c[2] - c[4] - c[6];
  return c;
}

class Formulas {
 public:
  explicit Formulas(const std::vector<std::string>& texts) {
    std::vector<Problem> problems;
    for (std::size_t i = 0; i < texts.size(); ++i) {
      try {
        formulas_.emplace_back(texts[i], std::vector<std::string>{"t"});
      } catch (const InputError& e) {
        problems.push_back({"curve/" + std::to_string(i), e.problems().front().message});
      }
    }
    if (!problems.empty()) throw InputError(std::move(problems));
  }
  /// Derivatives by (t - middle)/half.
  [[nodiscard]] PathJet jet(double t, double half) const {
    PathJet j;
    for (int i = 0; i < 3; ++i) {
      const Taylor<3> s = formulas_[static_cast<std::size_t>(i)](std::vector{Taylor<3>::variable(t)});
      double scale = 1.0;
      for (std::size_t k = 0; k < 4; ++k, scale *= half) j[k][i] = scale * s.derivative(static_cast<int>(k));
    }
    for (const Vec3& d : j)
      if (!d.allFinite())
        throw InputError("curve", "is not finite, or not three times differentiable, at t = " +
                                      number_text(t) + "; must be both on the whole range of t");
    return j;
  }

 private:
  std::vector<Formula> formulas_;
};

/// theta' by (2) of sweep_path.hpp.
double turn_rate(const PathPiece& p, const Vec3& e, double x) {
  const PathJet j = p.jet(x);
  const double speed = j[1].norm();
  const Vec3 W = j[1] / speed, bend = (j[2] - j[2].dot(W) * W) / speed;
  const double along = e.dot(W);
  // W'.B/|e - (e.W)W| = W'.(W x e)/|e - (e.W)W|^2
  return along * bend.dot(W.cross(e)) / (1.0 - along * along);
}

/// theta with theta(-1) = 0: (2) interpolated at the Chebyshev points and integrated.
std::array<double, 9> turn_angle(const PathPiece& p, const Vec3& e) {
  constexpr std::size_t n = 8;
  std::array<double, n> node{}, newton{};
  for (std::size_t i = 0; i < n; ++i) {
    node[i] = std::cos(std::numbers::pi * (2.0 * static_cast<double>(i) + 1.0) / (2.0 * n));
    newton[i] = turn_rate(p, e, node[i]);
  }
  for (std::size_t k = 1; k < n; ++k)  // divided differences
    for (std::size_t i = n - 1; i >= k; --i)
      newton[i] = (newton[i] - newton[i - 1]) / (node[i] - node[i - k]);
  std::array<double, n> rate{};  // powers of x
  for (std::size_t i = n; i-- > 0;) {
    for (std::size_t k = n - 1; k > 0; --k) rate[k] = rate[k - 1] - node[i] * rate[k];
    rate[0] = newton[i] - node[i] * rate[0];
  }
  std::array<double, 9> theta{};
  for (std::size_t k = 0; k < n; ++k) theta[k + 1] = rate[k] / static_cast<double>(k + 1);
  for (std::size_t k = 1; k <= n; ++k) theta[0] -= k % 2 == 0 ? theta[k] : -theta[k];
  return theta;
}

/// A unit vector perpendicular to the direction at the middle, as near as can be to `to`.
Vec3 across_the_middle(const PathPiece& p, const Vec3& to) {
  const Vec3 W = p.c[1].normalized();
  return (to - to.dot(W) * W).normalized();
}

/// Whether (2) is interpolated to 1e-13 (and what rounding adds) whatever the start direction.
bool frame_is_resolved(const PathPiece& p, double size) {
  int axis = 0;
  p.c[1].cwiseAbs().minCoeff(&axis);
  const Vec3 e = across_the_middle(p, Vec3::Unit(axis)), f = p.c[1].normalized().cross(e);
  const double tolerance = 1e-13 + 64.0 * std::numeric_limits<double>::epsilon() * size / p.c[1].norm();
  for (const Vec3& d : {e, f}) {
    const std::array<double, 9> theta = turn_angle(p, d);
    for (const double x : {-1.0, 0.0, 1.0}) {
      double rate = 0.0;
      for (std::size_t k = 9; k-- > 1;) rate = rate * x + static_cast<double>(k) * theta[k];
      if (!(std::abs(rate - turn_rate(p, d, x)) <= tolerance)) return false;
    }
  }
  return true;
}

/// Most halvings of an eighth of [t0, t1]: pieces of 8e-6 of it still show a jump of curvature by 1e-12.
constexpr int deepest = 14;

/// Cuts [t0, t1] until every piece is good; `size`: of the curve.
class Cutter {
 public:
  Cutter(const Formulas& curve, double size, double range) : curve_(curve), size_(size), range_(range) {}

  void cut(double a, double b, int depth) {
    const double half = 0.5 * (b - a), middle = a + half;
    PathPiece p;
    p.t_middle = middle;
    p.half = half;
    p.c = hermite(curve_.jet(a, half), curve_.jet(b, half));
    if (is_good(p)) {
      finish(p);
      return;
    }
    if (depth == deepest) refuse(middle);
    if (pieces_.size() > most_pieces)
      throw InputError("curve", "turns too often: it needs more than " + std::to_string(most_pieces) +
                                    " pieces; must be shorter");
    cut(a, middle, depth + 1);
    cut(middle, b, depth + 1);
  }
  [[nodiscard]] std::vector<PathPiece> pieces() && { return std::move(pieces_); }

 private:
  [[nodiscard]] bool is_good(const PathPiece& p) const {
    // |C' - c_1| <= |c_1|/4 on the piece: |C'| > 0, directions within 2 asin(1/4)/2 of c_1.
    double rest = 0.0;
    for (std::size_t k = 2; k < 8; ++k) rest += static_cast<double>(k) * p.c[k].norm();
    if (!(rest < 0.25 * p.c[1].norm())) return false;
    for (const double x : {-0.5, 0.0, 0.5}) {
      const Vec3 exact = curve_.jet(p.t_middle + p.half * x, p.half)[0];
      if (!((p.jet(x)[0] - exact).norm() <= 1e-14 * size_)) return false;
    }
    return frame_is_resolved(p, size_);
  }
  void finish(PathPiece& p) {
    const double slack = 1.0 + 1e-12;
    for (std::size_t k = 1; k < 8; ++k) {
      const double c = p.c[k].norm() * slack, n = static_cast<double>(k);
      p.radius += c;
      p.most[1] += n * c;
      p.most[2] += n * (n - 1.0) * c;
      p.most[3] += n * (n - 1.0) * (n - 2.0) * c;
    }
    pieces_.push_back(p);
  }
  [[noreturn]] void refuse(double t) const {
    const double speed = curve_.jet(t, 1.0)[1].norm();
    if (speed * range_ <= 1e-4 * size_)
      throw InputError("curve", "has C' = 0 (a cusp or a halt) near t = " + number_text(t) +
                                    "; must be regular, |C'| > 0 everywhere");
    throw InputError("curve", "has a corner or a jump of curvature near t = " + number_text(t) +
                                  "; must be twice continuously differentiable");
  }

  const Formulas& curve_;
  double size_, range_;
  std::vector<PathPiece> pieces_;
};

}  // namespace

std::vector<PathPiece> path_pieces(const std::vector<std::string>& formulas, double t0, double t1) {
  const Formulas curve(formulas);
  if (!(t0 < t1))
    throw InputError("t", "goes from " + number_text(t0) + " to " + number_text(t1) + ", must go up");
  constexpr int first_cut = 8;
  double size = 0.0, speed = 0.0;
  const Vec3 start = curve.jet(t0, 1.0)[0];
  const auto border = [&](int i) { return i == first_cut ? t1 : t0 + (t1 - t0) * i / first_cut; };
  for (int i = 0; i <= first_cut; ++i) {
    const PathJet j = curve.jet(border(i), t1 - t0);
    size = std::max({size, j[0].cwiseAbs().maxCoeff(), (j[0] - start).norm()});
    speed = std::max(speed, j[1].norm());
  }
  if (!(speed > 1e-9 * size))
    throw InputError("curve", "is one point, or too short for its place; must be a curve");
  Cutter cutter(curve, size, t1 - t0);
  for (int i = 0; i < first_cut; ++i) cutter.cut(border(i), border(i + 1), 0);
  return std::move(cutter).pieces();
}

void add_frame(PathPiece& p, const Vec3& U) {
  p.e = across_the_middle(p, U);
  p.theta = turn_angle(p, p.e);
  const PathFrame f = p.frame(-1.0);
  p.theta[0] += std::atan2(U.dot(f.V[0]), U.dot(f.U[0]));
}

}  // namespace blendwright::detail
