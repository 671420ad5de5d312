#include "parametric/shape_fit/boundary_rows.hpp"

#include <algorithm>
#include <cmath>
#include <type_traits>

#include "parametric/cross_tangent/side_frame.hpp"
#include "parametric/shape_fit/dual_series.hpp"

namespace blendwright::detail {
namespace {

void put(RowsAt& R, Row row, const Series3& value) {
  for (std::size_t b = 0; b < 3; ++b) R[b][row] = derivative(value, static_cast<int>(b));
}
Series3 values(const Dual3& a) { return {a[0].v, a[1].v, a[2].v}; }
const Series3& values(const Series3& a) { return a; }
Series3 changes(const Dual3& a, std::size_t i) { return {a[0].d[i], a[1].d[i], a[2].d[i]}; }

RowsAt empty_rows(const Vec3& anchor) {
  RowsAt R;
  for (auto& b : R) b.fill(Vec3::Zero());
  R[0][anchor_row] = anchor;
  return R;
}

class LiteralRows final : public BoundaryRows {
 public:
  LiteralRows(const EndCondition& end0, const EndCondition& end1, const Vec3& anchor)
      : ends_{end0, end1}, anchor_(anchor) {}
  [[nodiscard]] Section at(double t, const double*, bool) const override {
    const Interval range = ends_[0].domain.v;
    Section s;
    s.R = empty_rows(anchor_);
    s.least_law = 1.0;
    for (std::size_t i = 0; i < 2; ++i) {
      const EndSeries e = ends_[i].series(range.at(t));
      put(s.R, i == 0 ? C0 : C1, e.C);
      put(s.R, i == 0 ? T0 : T1, e.T);
      put(s.R, i == 0 ? D0 : D1, e.D);
    }
    const double length = range.length();
    for (std::size_t r = 0; r < row_count; ++r) {
      s.R[1][r] *= length;
      s.R[2][r] *= length * length;
    }
    return s;
  }
  [[nodiscard]] bool closed() const override { return ends_[0].domain.closed && ends_[1].domain.closed; }
  [[nodiscard]] std::array<Continuity, 2> continuity() const override {
    return {ends_[0].continuity, ends_[1].continuity};
  }

 private:
  std::array<EndCondition, 2> ends_;
  Vec3 anchor_;
};

/// What one line gives at a place: position, conormal, unit tangent, normal, and the bends (k, k), (k, c),
/// (c, c).
constexpr std::size_t channels = 15;
using Channels = std::array<double, channels>;

class LineTable {
 public:
  LineTable(const Trimline& line, double sign) : range_(line.domain().v), closed_(line.domain().closed) {
    std::vector<double> harmless;
    for (const DegeneratePoint& p : degenerate_points(line))
      if (p.harmless()) harmless.push_back(p.v);
    const double quarter = std::atan(1.0);
    for (const double psi : {0.0, quarter, -quarter})
      frames_.emplace_back(line, sign, Radians(psi), harmless);
    constexpr int most_spans = 1024;
    for (int spans = 64;; spans *= 2) {
      tabulate(spans);
      error_ = measured_error(spans);
      if (error_ <= 1e-11 || spans >= most_spans) break;
    }
  }
  [[nodiscard]] double error() const { return error_; }

  /// Channel c at g(t), with its derivative by g when that is unknown.
  template <class D>
  [[nodiscard]] D at(std::size_t c, const Series& g, bool by_g) const {
    if constexpr (std::is_same_v<D, Series>) return splines_[c](g);
    const Series local = splines_[c](Series::variable(g.value()));
    D r(compose_scalar(local.c, g));
    if constexpr (std::is_same_v<D, Dual>)
      if (by_g) r.d[2] = compose_scalar(local.differentiated().c, g);
    return r;
  }
  template <class D>
  [[nodiscard]] std::array<D, 3> vector(std::size_t first, const Series& g, bool by_g) const {
    return {at<D>(first, g, by_g), at<D>(first + 1, g, by_g), at<D>(first + 2, g, by_g)};
  }

 private:
  [[nodiscard]] Channels exact(double t) const {
    const double v = range_.at(t);
    const SideSeries s = frames_[0].second_order(v);
    const Vec3 C = derivative(s.C, 0), k = derivative(s.direction, 0), n = derivative(s.normal, 0);
    Vec3 c = n.cross(k);
    if (c.dot(derivative(s.C, 1)) < 0.0) c = -c;
    // II at 45 deg on both sides of k: (II(k,k) +- 2 II(k,c) + II(c,c))/2.
    const double kk = s.bend.value(), plus = frames_[1].second_order(v).bend.value(),
                 minus = frames_[2].second_order(v).bend.value();
    return {C[0],
            C[1],
            C[2],
            k[0],
            k[1],
            k[2],
            c[0],
            c[1],
            c[2],
            n[0],
            n[1],
            n[2],
            kk,
            0.5 * (plus - minus),
            plus + minus - kk};
  }
  void tabulate(int spans) {
    std::vector<double> t;
    std::vector<std::vector<double>> f(channels);
    for (int i = 0; i <= spans; ++i) {
      t.push_back(static_cast<double>(i) / spans);
      if (i == spans && closed_) break;
      const Channels at = exact(t.back());
      for (std::size_t c = 0; c < channels; ++c) f[c].push_back(at[c]);
    }
    splines_.clear();
    for (const std::vector<double>& values_of : f)
      splines_.push_back(closed_ ? ScalarSpline::closed(t, values_of) : ScalarSpline::open(t, values_of));
  }
  /// Of positions, relative to the largest coordinate.
  [[nodiscard]] double measured_error(int spans) const {
    double worst = 0.0, size = 0.0;
    for (int i = 0; i < spans; ++i) {
      const double t = (i + 0.37) / spans;
      const Channels at = exact(t);
      for (std::size_t c = 0; c < 12; ++c) {
        if (c < 3) size = std::max(size, std::abs(at[c]));
        worst = std::max(worst, std::abs(splines_[c](t) - at[c]) / (c < 3 ? std::max(size, 1e-300) : 1.0));
      }
    }
    return worst;
  }

  Interval range_;
  bool closed_;
  std::vector<SideFrame> frames_;
  std::vector<ScalarSpline> splines_;
  double error_ = 0.0;
};

class LineRows final : public BoundaryRows {
 public:
  LineRows(const Correspondence& lines, std::array<bool, 2> kept_left, const std::array<SideSpec, 2>& sides,
           const Layout& layout, const Vec3& anchor)
      : tables_{LineTable(lines.line0, kept_left[0] ? -1.0 : 1.0),
                LineTable(lines.line1, kept_left[1] ? 1.0 : -1.0)},
        closed_(lines.line0.domain().closed),
        sides_(sides),
        layout_(layout),
        anchor_(anchor) {}

  [[nodiscard]] bool closed() const override { return closed_; }
  [[nodiscard]] std::array<Continuity, 2> continuity() const override {
    return {sides_[0].continuity, sides_[1].continuity};
  }
  [[nodiscard]] double table_error() const override {
    return std::max(tables_[0].error(), tables_[1].error());
  }

  [[nodiscard]] Section at(double t, const double* x, bool with_derivatives) const override {
    if (!with_derivatives) {
      Section s;
      fill(pair<Series>(t, x), s);
      return s;
    }
    Section s;
    const Pair<Dual> p = pair<Dual>(t, x);
    fill(p, s);
    differentiate(t, p, s);
    return s;
  }

 private:
  template <class D>
  struct Pair {
    Series g;
    std::array<std::array<D, 3>, 2> C, U, V;
    std::array<Series, 2> law;
    double cos_theta = 1.0;
  };
  [[nodiscard]] bool second(std::size_t i) const { return sides_[i].continuity == Continuity::G2; }

  template <class D>
  void fill(const Pair<D>& p, Section& s) const {
    s.R = empty_rows(anchor_);
    s.map_slope = p.g.derivative(1);
    for (const SideSpec& side : sides_)
      if (side.rule == MagnitudeRule::circle_like) s.cos_theta = p.cos_theta;
    put(s.R, C0, values(p.C[0]));
    put(s.R, C1, values(p.C[1]));
    for (std::size_t i = 0; i < 2; ++i) {
      put(s.R, i == 0 ? T0 : T1, p.law[i] * values(p.U[i]));
      if (second(i)) put(s.R, i == 0 ? D0 : D1, p.law[i] * p.law[i] * values(p.V[i]));
    }
    s.least_law = std::min(p.law[0].value(), p.law[1].value());
  }

  template <class D>
  [[nodiscard]] Pair<D> pair(double t, const double* x) const {
    using D3 = std::array<D, 3>;
    Pair<D> p;
    p.g = Series::variable(t);
    if (layout_.mapped) p.g = p.g + layout_.map(t, x + layout_.map_start());
    const bool by_g = layout_.mapped;
    for (std::size_t i = 0; i < 2; ++i) p.law[i] = layout_.law[i](t, x + layout_.law_start(i));
    const std::array<Series, 2> place{Series::variable(t), p.g};
    for (std::size_t i = 0; i < 2; ++i) p.C[i] = tables_[i].template vector<D>(0, place[i], by_g && i == 1);
    const D3 De = p.C[1] - p.C[0];
    const D chord = sqrt(dot(De, De));
    const D3 along_chord = reciprocal(chord) * De;
    std::array<D3, 2> d;
    std::array<D, 2> cosine, sine;
    for (std::size_t i = 0; i < 2; ++i) {
      if (sides_[i].continuity == Continuity::G0) {
        d[i] = along_chord;
        continue;
      }
      const double psi = layout_.angle[i] ? x[layout_.angle_start(i)] : sides_[i].tangent_angle.value;
      cosine[i] = D(std::cos(psi));
      sine[i] = D(std::sin(psi));
      if constexpr (std::is_same_v<D, Dual>)
        if (layout_.angle[i]) {
          cosine[i].d[i] = -sine[i].v;
          sine[i].d[i] = cosine[i].v;
        }
      d[i] = cosine[i] * tables_[i].template vector<D>(3, place[i], by_g && i == 1) +
             sine[i] * tables_[i].template vector<D>(6, place[i], by_g && i == 1);
    }
    const D cos_theta = dot(d[0], d[1]);
    p.cos_theta = value(cos_theta).value();
    for (std::size_t i = 0; i < 2; ++i) {
      const D rho = magnitude<D>(sides_[i].rule, chord, cos_theta);
      p.U[i] = rho * d[i];
      if (!second(i)) continue;
      const auto bend = [&](std::size_t c) {
        return tables_[i].template at<D>(12 + c, place[i], by_g && i == 1);
      };
      const D II = cosine[i] * cosine[i] * bend(0) + D(2.0) * cosine[i] * sine[i] * bend(1) +
                   sine[i] * sine[i] * bend(2);
      p.V[i] = rho * rho * II * tables_[i].template vector<D>(9, place[i], by_g && i == 1);
    }
    return p;
  }

  template <class D>
  static D magnitude(MagnitudeRule rule, const D& chord, const D& cos_theta) {
    if (rule == MagnitudeRule::constant) return D(1.0);
    if (rule == MagnitudeRule::chord) return chord;
    return D(2.0) * reciprocal(D(1.0) + sqrt(D(0.5) * (D(1.0) + cos_theta))) * chord;
  }

  void differentiate(double t, const Pair<Dual>& p, Section& s) const {
    s.by.resize(layout_.size());
    const auto add = [](Section::Change& c, Row row, const Series3& value) {
      c.rows[c.count] = row;
      for (std::size_t b = 0; b < 3; ++b) c.R[c.count][b] = derivative(value, static_cast<int>(b));
      ++c.count;
    };
    for (std::size_t i = 0; i < 2; ++i)
      for (std::size_t j = 0; j < layout_.law[i].unknowns(); ++j) {
        const Series row = layout_.law[i].row(j, t);
        Section::Change& c = s.by[layout_.law_start(i) + j];
        add(c, i == 0 ? T0 : T1, row * values(p.U[i]));
        if (second(i)) add(c, i == 0 ? D0 : D1, 2.0 * p.law[i] * row * values(p.V[i]));
      }
    // Through psi_0, psi_1 and g: `slot` of the duals, times the row of the map.
    const auto through = [&](std::size_t slot, const Series& factor, Section::Change& c) {
      for (std::size_t i = 0; i < 2; ++i) {
        add(c, i == 0 ? T0 : T1, factor * p.law[i] * changes(p.U[i], slot));
        if (second(i)) add(c, i == 0 ? D0 : D1, factor * p.law[i] * p.law[i] * changes(p.V[i], slot));
      }
    };
    for (std::size_t i = 0; i < 2; ++i)
      if (layout_.angle[i]) through(i, Series(1.0), s.by[layout_.angle_start(i)]);
    if (!layout_.mapped) return;
    for (std::size_t j = 0; j < layout_.map.unknowns(); ++j) {
      const Series row = layout_.map.row(j, t);
      Section::Change& c = s.by[layout_.map_start() + j];
      add(c, C1, row * changes(p.C[1], 2));
      through(2, row, c);
    }
  }

  std::array<LineTable, 2> tables_;
  bool closed_;
  std::array<SideSpec, 2> sides_;
  Layout layout_;
  Vec3 anchor_;
};

}  // namespace

std::shared_ptr<const BoundaryRows> literal_rows(const EndCondition& end0, const EndCondition& end1,
                                                 const Vec3& anchor) {
  return std::make_shared<LiteralRows>(end0, end1, anchor);
}

std::shared_ptr<const BoundaryRows> line_rows(const Correspondence& lines, std::array<bool, 2> kept_left,
                                              const std::array<SideSpec, 2>& sides, const Layout& layout,
                                              const Vec3& anchor) {
  return std::make_shared<LineRows>(lines, kept_left, sides, layout, anchor);
}

}  // namespace blendwright::detail
