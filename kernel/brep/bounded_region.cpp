#include "kernel/brep/bounded_region.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "kernel/brep/occt_geometry.hpp"
#include "kernel/brep/parameter_curves.hpp"
#include "kernel/brep/travel.hpp"
#include "kernel/geometry/spline_interpolation.hpp"

namespace blendwright::detail {
namespace {

using opencascade::handle;
using Kind = RegionSegment::Kind;
using Lines = std::vector<BoundaryLine>;

RegionBox region_box(const PrimaryGeometry& g, double tolerance) {
  gp_Pnt p;
  gp_Vec du, dv;
  g.geometry->D1(g.box.u.at(0.43), g.box.v.at(0.43), p, du, dv);
  return {g.box, {du.Magnitude(), dv.Magnitude()}, tolerance};
}

std::vector<RegionCut> line_cuts(const PrimaryGeometry& g, const Lines& lines) {
  std::vector<RegionCut> cuts;
  for (const BoundaryLine& line : lines)
    cuts.push_back({"an edge of the face",
                    [&line, shift = g.shift](double t) -> Vec2 { return line.jet(t).C() + shift; }, line.t,
                    line.kept_left});
  return cuts;
}

/// The seams' best places; `accept` may refuse a division.
template <class Cuts, class Accept>
std::optional<DividedPrimary> best_division(const PrimaryGeometry& plain, const SurfaceDomain& box,
                                            double tolerance, Cuts cuts_on, Accept accept) {
  std::optional<DividedPrimary> best;
  double best_score = std::numeric_limits<double>::infinity();
  const auto places = seam_candidates(plain.box, cuts_on(plain));
  for (const double u : places[0])
    for (const double v : places[1]) {
      const PrimaryGeometry g = with_seams(plain, {u, v});
      RegionBox frame = region_box(g, tolerance);
      if (!frame.box.u_closed) frame.box.u = box.u;
      if (!frame.box.v_closed) frame.box.v = box.v;
      const TrimRegion region = trim_region(frame, cuts_on(g));
      double score =
          100.0 * static_cast<double>(region.warnings.size()) + static_cast<double>(region.pieces.size());
      score += region.faces.size() == 1 ? 0.0 : region.faces.empty() ? 1e6 : 1000.0;
      for (const auto& f : region.faces) score += 0.1 * static_cast<double>(f.outer.size());
      if (score >= best_score || !accept(g, region)) continue;
      best_score = score;
      best = DividedPrimary{g, region, {}, false, false};
    }
  return best;
}

/// Whether all points of one line lie on lines of the other kind, in the parameters of `g`.
class Coincidence {
 public:
  Coincidence(const PrimaryGeometry& g, const RegionBox& box, const std::vector<RegionCut>& lines)
      : box_(box), closed_{g.box.u_closed, g.box.v_closed} {
    for (const RegionCut& line : lines) {
      std::vector<Vec2> points;
      for (int i = 0; i <= 512; ++i) points.push_back(line.at(line.v.at(i / 512.0)));
      lines_.push_back(std::move(points));
    }
  }
  [[nodiscard]] bool covers(const RegionCut& line) const {
    std::vector<Vec2> points;
    double length = 0.0;
    for (int i = 0; i <= 48; ++i) {
      points.push_back(line.at(line.v.at(i / 48.0)));
      if (i > 0)
        length +=
            scaled(points[static_cast<std::size_t>(i)] - points[static_cast<std::size_t>(i) - 1]).norm();
    }
    // Lines this near all along are one line: edges of a part are off by their tolerances.
    const double near = std::max(100.0 * box_.slack, 1e-3 * length);
    return std::all_of(points.begin(), points.end(), [&](const Vec2& p) { return distance(p) <= near; });
  }

 private:
  [[nodiscard]] Vec2 scaled(const Vec2& d) const { return d.cwiseProduct(box_.scale); }
  [[nodiscard]] double distance(const Vec2& p) const {
    double best = std::numeric_limits<double>::infinity();
    for (const auto& line : lines_)
      for (std::size_t i = 0; i + 1 < line.size(); ++i) {
        Vec2 q = p;
        for (int d = 0; d < 2; ++d) {
          const double period = (d == 0 ? box_.box.u : box_.box.v).length();
          if (closed_[static_cast<std::size_t>(d)]) q[d] += period * std::round((line[i][d] - q[d]) / period);
        }
        const Vec2 a = scaled(line[i] - q), e = scaled(line[i + 1] - line[i]);
        const double s = e.squaredNorm() > 0.0 ? std::clamp(-a.dot(e) / e.squaredNorm(), 0.0, 1.0) : 0.0;
        best = std::min(best, (a + s * e).norm());
      }
    return best;
  }
  RegionBox box_;
  std::array<bool, 2> closed_;
  std::vector<std::vector<Vec2>> lines_;
};

enum class Stays { all, none, part };

/// How much of a line lies in a division.
Stays stays(const BoundaryLine& line, const DividedPrimary& division, const RegionBox& box) {
  constexpr int samples = 32;
  const Vec2 size = Vec2(box.box.u.length(), box.box.v.length()).cwiseProduct(box.scale);
  int in = 0;
  for (int i = 0; i < samples; ++i) {
    const CurveJet<2> j = line.jet(line.t.at((i + 0.5) / samples));
    const Vec2 along = j.C1().cwiseProduct(box.scale);
    Vec2 aside(-along.y(), along.x());  // a little into the face
    aside *= (line.kept_left ? 1e-4 : -1e-4) * size.minCoeff() / std::max(along.norm(), 1e-300);
    const Vec2 p = j.C() + division.geometry.shift + aside.cwiseQuotient(box.scale);
    in += region_contains(division.geometry.box, division.region, p) ? 1 : 0;
  }
  return in == samples ? Stays::all : in == 0 ? Stays::none : Stays::part;
}

/// The line on the surface where the part's own edge lies farther from it than `tolerance`; the gap stays
/// when that takes more points than are tried.
void lay_on_surface(BoundaryLine& line, const PrimaryGeometry& plain, double tolerance) {
  if (line.gap <= tolerance) return;
  const auto surface =
      handle<Geom_Surface>::DownCast(plain.geometry->Transformed(plain.placement.Inverted()));
  const auto image = [&](double t) {
    const Vec2 uv = line.jet(t).C();
    return vec(surface->Value(uv.x(), uv.y()));
  };
  for (const int spans : {8, 32, 128, 512}) {  // per smooth interval
    std::vector<BSplineCurve<3>> pieces;
    double gap = 0.0;
    for (std::size_t k = 0; k + 1 < line.breaks.size(); ++k) {
      const Interval part{line.breaks[k], line.breaks[k + 1]};
      std::vector<Vec3> points;
      std::vector<double> at;
      for (int i = 0; i <= spans; ++i) {
        at.push_back(part.at(static_cast<double>(i) / spans));
        points.push_back(image(at.back()));
      }
      pieces.push_back(interpolate_points<3>(points, at, false, 5));
      for (int i = 0; i < spans; ++i) {
        const double t = part.at((i + 0.5) / spans);
        gap = std::max(gap, (pieces.back().jet(t).C() - image(t)).norm());
      }
    }
    if (gap > 0.1 * tolerance) continue;
    line.curve = to_occt(joined(pieces, false));
    line.gap = gap;
    return;
  }
}

/// A border of the box that is one point in space: no edge of the part runs there.
bool is_pole(const PrimaryGeometry& g, int d, double border) {
  const auto at = [&](double t) {
    return d == 0 ? vec(g.geometry->Value(border, g.box.v.at(t)))
                  : vec(g.geometry->Value(g.box.u.at(t), border));
  };
  const Vec3 middle = vec(g.geometry->Value(g.box.u.middle(), g.box.v.middle()));
  return std::max((at(0.3) - at(0.0)).norm(), (at(0.7) - at(0.0)).norm()) <= 1e-9 * (middle - at(0.0)).norm();
}

/// The box of the face made larger, so that edges on its border are lines inside; poles stay.
SurfaceDomain around(const PrimaryGeometry& g) {
  SurfaceDomain box = g.box;
  for (const int d : {0, 1}) {
    Interval& range = d == 0 ? box.u : box.v;
    if (d == 0 ? box.u_closed : box.v_closed) continue;
    const double more = 0.1 * range.length();
    const bool lo = is_pole(g, d, range.lo), hi = is_pole(g, d, range.hi);
    range = {lo ? range.lo : range.lo - more, hi ? range.hi : range.hi + more};
  }
  return box;
}

/// Whether a division uses every piece once and no border but seams and those in `allowed`.
bool sound(const PrimaryGeometry& g, const TrimRegion& region, bool borders_allowed) {
  if (!region.warnings.empty() || region.faces.empty()) return false;
  std::size_t used = 0;
  for (const RegionFace& f : region.faces) {
    std::vector<const RegionWire*> wires{&f.outer};
    for (const RegionWire& h : f.holes) wires.push_back(&h);
    for (const RegionWire* wire : wires)
      for (const RegionSegment& s : *wire) {
        if (s.kind == Kind::extension) return false;
        if (s.kind == Kind::cut) {
          ++used;
          continue;
        }
        const int across = s.side % 2 == 0 ? 1 : 0;
        const bool seam = across == 0 ? g.box.u_closed : g.box.v_closed;
        if (!seam && !borders_allowed && !is_pole(g, across, s.from[across])) return false;
      }
  }
  return used == region.pieces.size();
}

}  // namespace

CutPcurve boundary_pcurve(const BoundaryLine& line, const PrimaryGeometry& g, const Vec2& shift,
                          const Interval& range, double tolerance) {
  const auto jet = [&](double t) {
    CurveJet<2> j = line.jet(t);
    j.D[0] += g.shift + shift;
    return j;
  };
  return cut_pcurve(jet, range, refined(line.breaks, std::max<std::size_t>(4, 64 / line.breaks.size())),
                    handle<Geom_Curve>::DownCast(line.curve->Transformed(g.placement)), g.geometry,
                    0.05 * tolerance, line.breaks);
}

DividedPrimary divide_primary(const PrimaryGeometry& plain, const CutsOn& trimlines, double tolerance) {
  const auto by_box = [&] {
    return *best_division(plain, plain.box, tolerance, trimlines,
                          [](const PrimaryGeometry&, const TrimRegion&) { return true; });
  };
  if (!plain.boundary || plain.boundary->lines.empty()) return by_box();

  const RegionBox box = region_box(plain, tolerance);
  const std::vector<RegionCut> cuts = trimlines(plain), edges = line_cuts(plain, plain.boundary->lines);
  const Coincidence on_trimlines(plain, box, cuts), on_edges(plain, box, edges);
  std::vector<std::size_t> inner;  // trimlines that replace no edge
  for (std::size_t i = 0; i < cuts.size(); ++i)
    if (!on_edges.covers(cuts[i])) inner.push_back(i);
  std::optional<DividedPrimary> kept;
  if (!inner.empty())
    kept = best_division(
        plain, plain.box, tolerance,
        [&](const PrimaryGeometry& g) {
          std::vector<RegionCut> some;
          for (const std::size_t i : inner) some.push_back(trimlines(g)[i]);
          return some;
        },
        [](const PrimaryGeometry&, const TrimRegion&) { return true; });

  Lines all, inside;  // edges that stay, and those of them not on the border of the box
  bool crossed = false, crossed_inside = false, precise = true, precise_inside = true;
  for (std::size_t i = 0; i < edges.size(); ++i) {
    BoundaryLine line = plain.boundary->lines[i];
    if (on_trimlines.covers(edges[i])) continue;
    const Stays stay = kept ? stays(line, *kept, box) : Stays::all;
    if (stay == Stays::none) continue;
    const bool border = on_border(line, plain.box);
    lay_on_surface(line, plain, tolerance);
    const bool close = line.gap <= tolerance &&
                       boundary_pcurve(line, plain, Vec2::Zero(), line.t, tolerance).gap <= tolerance;
    precise = precise && close;
    precise_inside = precise_inside && (border || close);
    all.push_back(line);
    if (!border) inside.push_back(line);
    crossed = crossed || stay == Stays::part;
    crossed_inside = crossed_inside || (stay == Stays::part && !border);
  }
  if (inside.empty()) return by_box();
  const auto divide = [&](const Lines& lines, const SurfaceDomain& frame, bool borders_allowed) {
    auto found = best_division(
        plain, frame, tolerance,
        [&](const PrimaryGeometry& g) {
          std::vector<RegionCut> both = trimlines(g);
          for (RegionCut& line : line_cuts(g, lines)) both.push_back(std::move(line));
          return both;
        },
        [&](const PrimaryGeometry& g, const TrimRegion& region) {
          return sound(g, region, borders_allowed);
        });
    if (found) found->lines = lines;
    if (found) found->bounded = true;
    return found;
  };
  std::optional<DividedPrimary> found;
  if (precise && !crossed) found = divide(all, around(plain), false);
  if (precise_inside && !found && !crossed_inside) found = divide(inside, plain.box, true);
  if (found) return *found;
  DividedPrimary boxed = by_box();
  boxed.loses = true;
  return boxed;
}

}  // namespace blendwright::detail
