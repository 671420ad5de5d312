#include "kernel/brep/trim_region.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "kernel/base/number_text.hpp"
#include "kernel/brep/cut_pieces.hpp"

namespace blendwright::detail {
namespace {

double cross(const Vec2& a, const Vec2& b) { return a.x() * b.y() - a.y() * b.x(); }

/// Corners of a wire and the samples of its cuts.
std::vector<Vec2> polygon(const std::vector<CutPiece>& pieces, const RegionWire& wire) {
  std::vector<Vec2> points;
  for (const RegionSegment& s : wire) {
    if (s.kind != RegionSegment::Kind::cut) {
      points.push_back(s.from);
      continue;
    }
    std::vector<Vec2> piece = pieces[s.piece].points;
    if (s.backward) std::reverse(piece.begin(), piece.end());
    points.insert(points.end(), piece.begin(), piece.end() - 1);
  }
  return points;
}

bool inside(const Vec2& q, const std::vector<Vec2>& p) {
  bool in = false;
  for (std::size_t i = 0, j = p.size() - 1; i < p.size(); j = i++)
    if ((p[i].y() > q.y()) != (p[j].y() > q.y()) &&
        q.x() < p[i].x() + (q.y() - p[i].y()) / (p[j].y() - p[i].y()) * (p[j].x() - p[i].x()))
      in = !in;
  return in;
}

/// A piece in its running direction: kept part on the left.
struct Link {
  std::size_t piece = 0;
  bool backward = false;
  Vec2 from, to;
  bool from_on_border = false, to_on_border = false;
};

struct Chain {
  RegionWire segments;
  Vec2 from, to;
  bool loop = false;
};

class Region {
 public:
  Region(const RegionBox& box, const std::vector<RegionCut>& cuts) : box_(box), cuts_(cuts) {
    result_.pieces = cut_pieces(box, cuts);
    make_chains();
    make_faces();
  }
  [[nodiscard]] TrimRegion take() { return std::move(result_); }

 private:
  [[nodiscard]] double length(const Vec2& d) const { return d.cwiseProduct(box_.scale).norm(); }

  // ---- chains: pieces that continue each other inside the rectangle

  void make_chains() {
    std::vector<Link> links;
    for (std::size_t i = 0; i < result_.pieces.size(); ++i) {
      const CutPiece& p = result_.pieces[i];
      Link l{i, !cuts_[p.cut].kept_left, p.points.front(), p.points.back(), p.lo_on_border, p.hi_on_border};
      if (l.backward) {
        std::swap(l.from, l.to);
        std::swap(l.from_on_border, l.to_on_border);
      }
      links.push_back(l);
    }
    std::vector<int> next(links.size(), -1), previous(links.size(), -1);
    for (std::size_t i = 0; i < links.size(); ++i) {
      if (links[i].to_on_border) continue;
      double best = 10.0 * box_.slack;
      for (std::size_t j = 0; j < links.size(); ++j) {
        const double d = length(links[i].to - links[j].from);
        if (links[j].from_on_border || previous[j] >= 0 || d > best) continue;
        best = d;
        next[i] = static_cast<int>(j);
      }
      if (next[i] >= 0) previous[static_cast<std::size_t>(next[i])] = static_cast<int>(i);
    }
    std::vector<char> used(links.size(), 0);
    const auto follow = [&](std::size_t start) {
      Chain chain{{}, links[start].from, links[start].to, false};
      for (std::size_t i = start;;) {
        used[i] = 1;
        chain.segments.push_back(
            {RegionSegment::Kind::cut, links[i].from, links[i].to, links[i].piece, links[i].backward, 0});
        chain.to = links[i].to;
        if (next[i] < 0) break;
        i = static_cast<std::size_t>(next[i]);
        if (i == start) {
          chain.loop = true;
          break;
        }
      }
      if (!chain.loop) {
        if (!links[start].from_on_border) extend(chain, true);
        if (!links[chain_last(chain, links)].to_on_border) extend(chain, false);
      }
      chains_.push_back(std::move(chain));
    };
    for (std::size_t i = 0; i < links.size(); ++i)
      if (previous[i] < 0) follow(i);
    for (std::size_t i = 0; i < links.size(); ++i)
      if (!used[i]) follow(i);
  }

  static std::size_t chain_last(const Chain& chain, const std::vector<Link>& links) {
    for (auto s = chain.segments.rbegin(); s != chain.segments.rend(); ++s)
      if (s->kind == RegionSegment::Kind::cut)
        for (std::size_t i = 0; i < links.size(); ++i)
          if (links[i].piece == s->piece) return i;
    return 0;
  }

  /// A straight parameter line from an end inside to the nearest border that it reaches without crossing a
  /// cut.
  void extend(Chain& chain, bool at_start) {
    const Vec2 end = at_start ? chain.from : chain.to;
    std::optional<Vec2> best;
    for (int d = 0; d < 2; ++d) {
      const bool closed = d == 0 ? box_.box.u_closed : box_.box.v_closed;
      const Interval range = d == 0 ? box_.box.u : box_.box.v;
      if (closed) continue;
      for (const double border : {range.lo, range.hi}) {
        Vec2 target = end;
        target[d] = border;
        if ((!best || length(target - end) < length(*best - end)) && !crosses_cut(end, target)) best = target;
      }
    }
    const std::string& name = cuts_[result_.pieces[chain.segments.front().piece].cut].name;
    if (!best) {
      result_.warnings.push_back(name + " ends inside, and no parameter line leads from its end to a border");
      broken_ = true;
      return;
    }
    result_.warnings.push_back(name + " ends inside; a straight parameter line of length " +
                               number_text(length(*best - end), 4) + " continues it to the border");
    RegionSegment line;
    line.kind = RegionSegment::Kind::extension;
    line.from = at_start ? *best : end;
    line.to = at_start ? end : *best;
    (at_start ? chain.from : chain.to) = *best;
    chain.segments.insert(at_start ? chain.segments.begin() : chain.segments.end(), line);
  }

  [[nodiscard]] bool crosses_cut(const Vec2& a, const Vec2& b) const {
    const Vec2 d = b - a;
    const double start = 1e-6 * length(d) + 10.0 * box_.slack;  // the line's own end is no crossing
    for (const CutPiece& p : result_.pieces)
      for (std::size_t i = 0; i + 1 < p.points.size(); ++i) {
        const Vec2 e = p.points[i + 1] - p.points[i], w = p.points[i] - a;
        const double det = cross(d, e);
        if (det == 0.0) continue;
        const double s = cross(w, e) / det, t = cross(w, d) / det;
        if (s >= 0.0 && s <= 1.0 && t >= 0.0 && t <= 1.0 && s * length(d) > start) return true;
      }
    return false;
  }

  // ---- faces

  /// Position along the border, counter-clockwise from the lower left corner, in [0, 4).
  [[nodiscard]] double perimeter(const Vec2& p) const {
    const Interval &u = box_.box.u, &v = box_.box.v;
    const double x = (p.x() - u.lo) / u.length(), y = (p.y() - v.lo) / v.length();
    const std::array<double, 4> off{std::abs(y), std::abs(x - 1.0), std::abs(y - 1.0), std::abs(x)};
    const auto side = std::min_element(off.begin(), off.end()) - off.begin();
    const std::array<double, 4> along{x, y, 1.0 - x, 1.0 - y};
    const double s = static_cast<double>(side) + std::clamp(along[static_cast<std::size_t>(side)], 0.0, 1.0);
    return s >= 4.0 - same ? 0.0 : s;
  }
  [[nodiscard]] Vec2 border_point(double s) const {
    const Interval &u = box_.box.u, &v = box_.box.v;
    s -= 4.0 * std::floor(s / 4.0);
    if (s <= 1.0) return {u.at(s), v.lo};
    if (s <= 2.0) return {u.hi, v.at(s - 1.0)};
    if (s <= 3.0) return {u.at(3.0 - s), v.hi};
    return {u.lo, v.at(4.0 - s)};
  }
  /// Border from s counter-clockwise by `distance`, split at corners; exact end points are given.
  void walk(RegionWire& wire, double s, double distance, const Vec2& from, const Vec2& to) const {
    const double end = s + distance;
    Vec2 at = from;
    while (s < end - same) {
      double corner = std::floor(s + same) + 1.0;
      const bool last = corner >= end - same;
      const Vec2 next = last ? to : border_point(corner);
      RegionSegment b;
      b.from = at;
      b.to = next;
      b.side = static_cast<int>(std::floor(s + same)) % 4;
      wire.push_back(b);
      at = next;
      s = last ? end : corner;
    }
  }

  /// Area inside a wire.
  [[nodiscard]] double area(const RegionWire& wire) const {
    const std::vector<Vec2> p = polygon(result_.pieces, wire);
    double twice = 0.0;
    for (std::size_t i = 0; i < p.size(); ++i) twice += cross(p[i], p[(i + 1) % p.size()]);
    return 0.5 * twice;
  }

  /// Wires of the chains that reach the border; empty when the kept sides contradict each other.
  [[nodiscard]] std::vector<RegionWire> border_wires() const {
    std::vector<std::size_t> open;
    for (std::size_t i = 0; i < chains_.size(); ++i)
      if (!chains_[i].loop) open.push_back(i);
    std::vector<RegionWire> wires;
    std::vector<char> used(chains_.size(), 0);
    for (const std::size_t first : open) {
      if (used[first]) continue;
      RegionWire wire;
      for (std::size_t i = first;;) {
        used[i] = 1;
        wire.insert(wire.end(), chains_[i].segments.begin(), chains_[i].segments.end());
        const double s = perimeter(chains_[i].to);
        const auto ahead = [&](double t) {
          const double d = t - s;
          const double wrapped = d - 4.0 * std::floor(d / 4.0);
          return wrapped > 4.0 - same ? 0.0 : wrapped;
        };
        std::size_t next = first;
        double start = std::numeric_limits<double>::infinity(), stop = start;
        for (const std::size_t j : open) {
          if (ahead(perimeter(chains_[j].from)) < start) {
            start = ahead(perimeter(chains_[j].from));
            next = j;
          }
          if (j != i) stop = std::min(stop, ahead(perimeter(chains_[j].to)));
        }
        if (stop < start - same || (used[next] && next != first)) return {};
        walk(wire, s, start, chains_[i].to, chains_[next].from);
        if (next == first) break;
        i = next;
      }
      wires.push_back(std::move(wire));
    }
    return wires;
  }

  void make_faces() {
    const double whole = box_.box.u.length() * box_.box.v.length();
    std::vector<RegionWire> outers, holes;
    for (const Chain& c : chains_)
      if (c.loop) (area(c.segments) > 0.0 ? outers : holes).push_back(c.segments);
    const bool open = std::any_of(chains_.begin(), chains_.end(), [](const Chain& c) { return !c.loop; });
    if (open && !broken_) {
      std::vector<RegionWire> wires = border_wires();
      std::erase_if(wires, [&](const RegionWire& w) { return area(w) <= 1e-9 * whole; });
      if (wires.empty())
        result_.warnings.push_back("the kept sides of its trimlines leave nothing");
      else if (!outers.empty())
        result_.warnings.push_back("its trimlines keep the inside of a loop and more");
      else
        outers = std::move(wires);
    }
    if (broken_) outers.clear(), holes.clear();
    if (outers.empty() && !open) {
      RegionWire whole_wire;
      walk(whole_wire, 0.0, 4.0, border_point(0.0), border_point(0.0));
      outers.push_back(std::move(whole_wire));
    }
    for (RegionWire& o : outers) result_.faces.push_back({std::move(o), {}});
    for (RegionWire& h : holes) {
      const Vec2 q = polygon(result_.pieces, h).front();
      const auto owner = std::find_if(result_.faces.begin(), result_.faces.end(), [&](const RegionFace& f) {
        return result_.faces.size() == 1 || inside(q, polygon(result_.pieces, f.outer));
      });
      if (owner != result_.faces.end()) owner->holes.push_back(std::move(h));
    }
  }

  static constexpr double same = 1e-9;  ///< of a side's length: equal places on the border

  const RegionBox& box_;
  const std::vector<RegionCut>& cuts_;
  TrimRegion result_;
  std::vector<Chain> chains_;
  bool broken_ = false;
};

}  // namespace

bool region_contains(const SurfaceDomain& box, const TrimRegion& region, Vec2 p) {
  if (box.u_closed) p.x() -= box.u.length() * std::floor((p.x() - box.u.lo) / box.u.length());
  if (box.v_closed) p.y() -= box.v.length() * std::floor((p.y() - box.v.lo) / box.v.length());
  return std::any_of(region.faces.begin(), region.faces.end(), [&](const RegionFace& f) {
    return inside(p, polygon(region.pieces, f.outer)) &&
           std::none_of(f.holes.begin(), f.holes.end(),
                        [&](const RegionWire& h) { return inside(p, polygon(region.pieces, h)); });
  });
}

TrimRegion trim_region(const RegionBox& box, const std::vector<RegionCut>& cuts) {
  return Region(box, cuts).take();
}

}  // namespace blendwright::detail
