// Nearest points of a path.
//
// On a piece, with w = X - C(x): f = |w|^2, F = w.C' = -f'/2, D = |C'|^2 - w.C'' = -F'.
#include <algorithm>
#include <cmath>
#include <limits>

#include "implicit/primitives/sweep_path.hpp"

namespace blendwright::detail {
namespace {

struct Slope {
  double f, F, D;
  double w;  ///< |w|
};
Slope slope(const PathPiece& p, const Vec3& X, double x) {
  Vec3 C = p.c[7], C1 = Vec3::Zero(), C2 = Vec3::Zero();  // C2: half of C''
  for (std::size_t k = 7; k-- > 0;) {
    C2 = C2 * x + C1;
    C1 = C1 * x + C;
    C = C * x + p.c[k];
  }
  const Vec3 w = X - C;
  const double f = w.squaredNorm();
  return {f, w.dot(C1), C1.squaredNorm() - 2.0 * w.dot(C2), std::sqrt(f)};
}
/// Bound of |dD/dx| = |3 C'.C'' - w.C'''| within h of a place where |w| is this.
double bend(const PathPiece& p, double w, double h) {
  return 3.0 * p.most[1] * p.most[2] + (w + p.most[1] * h) * p.most[3];
}
/// A smaller f than this counts as a nearer point, to leave searches that rounding would prolong.
double improved(double f) { return f * (1.0 - 1e-13); }

}  // namespace

class Path::Search {
 public:
  Search(const Path& path, const Vec3& X) : path_(path), X_(X) { descend(0, gap(0)); }
  [[nodiscard]] Foot best() const { return best_; }

 private:
  [[nodiscard]] double gap(std::size_t ball) const {
    const Ball& b = path_.balls_[ball];
    return (X_ - b.centre).norm() - b.radius;
  }
  void descend(std::size_t at, double g) {
    if (g > 0.0 && g * g >= improved(f_)) return;
    const Ball& ball = path_.balls_[at];
    if (ball.count == 1) {
      piece_ = ball.first;
      part(-1.0, 1.0, 0);
      return;
    }
    const double left = gap(at + 1), right = gap(ball.right);
    if (left <= right) {
      descend(at + 1, left);
      descend(ball.right, right);
    } else {
      descend(ball.right, right);
      descend(at + 1, left);
    }
  }
  void part(double a, double b, int depth) {
    const PathPiece& p = path_.pieces_[piece_];
    const double m = 0.5 * (a + b), h = 0.5 * (b - a);
    const Slope s = slope(p, X_, m);
    consider(m, s.f);
    const double M = bend(p, s.w, h) * h;
    if (s.f - 2.0 * std::abs(s.F) * h - (std::abs(s.D) + M) * h * h >= improved(f_)) return;
    if (s.D > M) {
      solve(a, b, s);
    } else if (s.D < -M || depth == 16) {
      consider(a, slope(p, X_, a).f);
      consider(b, slope(p, X_, b).f);
    } else if (s.F > 0.0) {
      part(m, b, depth + 1);
      part(a, m, depth + 1);
    } else {
      part(a, m, depth + 1);
      part(m, b, depth + 1);
    }
  }
  /// The only minimum of f on [a, b], where F falls: Newton's method, kept within the bracket.
  void solve(double a, double b, const Slope& middle) {
    const PathPiece& p = path_.pieces_[piece_];
    double x = 0.5 * (a + b);
    Slope s = middle;
    const double end = s.F > 0.0 ? b : a;
    const Slope at_end = slope(p, X_, end);
    if ((at_end.F > 0.0) == (s.F > 0.0)) {
      consider(end, at_end.f);
      return;
    }
    for (int i = 0; i < 60 && b > a; ++i) {
      (s.F > 0.0 ? a : b) = x;
      double next = x + s.F / s.D;
      if (!(next >= a && next <= b)) next = 0.5 * (a + b);
      if (std::abs(next - x) <= 1e-15) break;
      x = next;
      s = slope(p, X_, x);
    }
    consider(x, s.f);
  }
  void consider(double x, double f) {
    if (!(f < f_)) return;
    f_ = f;
    best_ = {piece_, x, std::sqrt(f), 0};
  }

  const Path& path_;
  const Vec3& X_;
  std::size_t piece_ = 0;
  double f_ = std::numeric_limits<double>::infinity();
  Foot best_;
};

Foot Path::nearest(const Vec3& point) const { return polished(point, Search(*this, point).best()); }

// Where two pieces meet the search may stop at the border, f being flat there: a last few steps lead across.
Foot Path::polished(const Vec3& X, Foot foot) const {
  const std::size_t last = pieces_.size() - 1;
  Slope s = slope(pieces_[foot.piece], X, foot.x);
  for (int i = 0; i < 4 && s.D > 0.0; ++i) {
    Foot next = foot;
    next.x = foot.x + s.F / s.D;
    if (!(std::abs(next.x - foot.x) <= 1e-3)) break;  // not a matter of rounding
    if (std::abs(next.x) > 1.0) {
      const bool up = next.x > 0.0;
      const bool seam = foot.piece == (up ? last : 0);
      if (seam && !closed_) {
        next.x = up ? 1.0 : -1.0;
      } else {
        next.piece = seam ? (up ? 0 : last) : (up ? foot.piece + 1 : foot.piece - 1);
        const double over = (std::abs(next.x) - 1.0) * pieces_[foot.piece].half / pieces_[next.piece].half;
        next.x = up ? over - 1.0 : 1.0 - over;
      }
    }
    const Slope t = slope(pieces_[next.piece], X, next.x);
    if (!(std::abs(t.F) * pieces_[foot.piece].half < std::abs(s.F) * pieces_[next.piece].half)) break;
    foot = next;
    s = t;
  }
  foot.distance = s.w;
  if (closed_) return foot;
  if (foot.piece == 0 && foot.x == -1.0 && s.F < 0.0) foot.end = -1;
  if (foot.piece == last && foot.x == 1.0 && s.F > 0.0) foot.end = 1;
  return foot;
}

/// Which stretches of the path hold the feet of a ball's points, in rising order.
class Path::Survey {
 public:
  Survey(const Path& path, const Vec3& X, double radius, double distance)
      : path_(path), X_(X), radius_(radius), limit_(distance + 2.0 * radius) {
    descend(0);
  }
  bool sure = true;           ///< every stretch has one foot at most
  std::size_t stretches = 0;  ///< how many
  double rate = 0.0;
  bool from_start = false, to_end = false;

 private:
  void descend(std::size_t at) {
    const Ball& ball = path_.balls_[at];
    if (!sure || (X_ - ball.centre).norm() - ball.radius > limit_) return;
    if (ball.count == 1) {
      piece_ = ball.first;
      part(-1.0, 1.0, 0);
      return;
    }
    descend(at + 1);
    descend(ball.right);
  }
  void part(double a, double b, int depth) {
    const PathPiece& p = path_.pieces_[piece_];
    const double m = 0.5 * (a + b), h = 0.5 * (b - a);
    const Slope s = slope(p, X_, m);
    if (!sure || s.w - p.most[1] * h > limit_) return;
    // D over the part and the ball.
    const double least = s.D - bend(p, s.w + radius_, h) * h - radius_ * p.most[2];
    const bool within = s.w + p.most[1] * h <= limit_ || p.most[1] * h <= 0.5 * radius_;
    if (least > 0.0 && (within || depth == 5)) {
      keep(a, b, p.half * p.most[1] / least);
    } else if (depth == 5) {
      sure = false;
    } else {
      part(a, m, depth + 1);
      part(m, b, depth + 1);
    }
  }
  void keep(double a, double b, double by_t) {
    const bool first = piece_ == 0 && a == -1.0;
    const bool joins =
        piece_ == end_piece_ ? a == end_x_ : piece_ == end_piece_ + 1 && end_x_ == 1.0 && a == -1.0;
    if (stretches == 0 || !joins) ++stretches;
    from_start = from_start || first;
    to_end = piece_ + 1 == path_.pieces_.size() && b == 1.0;
    end_piece_ = piece_;
    end_x_ = b;
    rate = std::max(rate, by_t);
  }

  const Path& path_;
  const Vec3& X_;
  double radius_, limit_;
  std::size_t piece_ = 0, end_piece_ = 0;
  double end_x_ = 0.0;
};

std::optional<Path::Stretch> Path::stretch(const Vec3& centre, double radius, const Foot& foot,
                                           bool wraps) const {
  const Survey survey(*this, centre, radius, foot.distance);
  const bool seam = closed_ && wraps && survey.from_start && survey.to_end;
  if (!survey.sure || survey.stretches > (seam ? 2u : 1u)) return std::nullopt;
  return Stretch{survey.rate};
}

}  // namespace blendwright::detail
