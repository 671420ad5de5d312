#include "implicit/polygonize/cube_table.hpp"

namespace blendwright::detail {
namespace {

constexpr std::size_t max_triangles = 5, max_loop = 12;
using Point = std::array<double, 3>;

struct Triangles {
  std::size_t size = 0;
  std::array<CubeTriangle, max_triangles> list{};
};

/// For every edge with a crossing the edge that follows it on its loop; -1 where there is no crossing.
constexpr std::array<int, 12> successors(unsigned inside) {
  std::array<int, 12> next{};
  next.fill(-1);
  for (int axis = 0; axis < 3; ++axis)
    for (int side = 0; side < 2; ++side) {
      const auto ring = cube_face(axis, side);
      const auto corner = [&](int i) { return ring[static_cast<std::size_t>(i & 3)]; };
      const auto in = [&](int i) { return (inside >> corner(i) & 1u) != 0; };
      for (int i = 0; i < 4; ++i) {
        if (in(i - 1 + 4) || !in(i)) continue;
        int last = i;  // of the run of inside corners that starts at i
        while (in(last + 1)) ++last;
        const int enters = cube_edge_between(corner(i + 3), corner(i));
        next[static_cast<std::size_t>(enters)] = cube_edge_between(corner(last), corner(last + 1));
      }
    }
  return next;
}

constexpr Point midpoint(int edge) {
  const CubeEdge& e = cube_edges[static_cast<std::size_t>(edge)];
  Point p{};
  for (std::size_t a = 0; a < 3; ++a) p[a] = e.low[a];
  p[static_cast<std::size_t>(e.axis)] += 0.5;
  return p;
}
constexpr bool share_a_face(int a, int b) {
  const Point p = midpoint(a), q = midpoint(b);
  for (std::size_t k = 0; k < 3; ++k)
    if (p[k] == q[k] && p[k] != 0.5) return true;
  return false;
}
constexpr Point minus(const Point& a, const Point& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }
constexpr double dot(const Point& a, const Point& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
constexpr Point cross(const Point& a, const Point& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

struct Loop {
  std::size_t size = 0;
  std::array<int, max_loop> edges{};
};

constexpr Point area_vector(const Loop& loop) {
  Point sum{};
  for (std::size_t i = 1; i + 1 < loop.size; ++i) {
    const Point o = midpoint(loop.edges[0]);
    const Point n = cross(minus(midpoint(loop.edges[i]), o), minus(midpoint(loop.edges[i + 1]), o));
    for (std::size_t a = 0; a < 3; ++a) sum[a] += n[a];
  }
  return sum;
}

/// Best triangulation of a loop by dynamic programming over its intervals [i, j]: the largest possible value
/// of the smallest triangle quality, where a chord in a face of the cell is worth nothing at all.
class Triangulation {
 public:
  constexpr explicit Triangulation(const Loop& loop) : loop_(loop), normal_(area_vector(loop)) {
    for (std::size_t length = 2; length < loop.size; ++length)
      for (std::size_t i = 0; i + length < loop.size; ++i) solve(i, i + length);
  }
  constexpr void append(Triangles& out) const { append(0, loop_.size - 1, out); }

 private:
  static constexpr double forbidden = -1e9;

  constexpr void solve(std::size_t i, std::size_t j) {
    best_[i][j] = 2.0 * forbidden;
    const bool is_chord = j - i + 1 < loop_.size;
    for (std::size_t k = i + 1; k < j; ++k) {
      double quality = triangle(i, k, j);
      if (k - i > 1 && best_[i][k] < quality) quality = best_[i][k];
      if (j - k > 1 && best_[k][j] < quality) quality = best_[k][j];
      if (is_chord && share_a_face(loop_.edges[i], loop_.edges[j])) quality = forbidden;
      if (quality > best_[i][j]) {
        best_[i][j] = quality;
        apex_[i][j] = k;
      }
    }
  }
  constexpr double triangle(std::size_t a, std::size_t b, std::size_t c) const {
    const Point p = midpoint(loop_.edges[a]);
    return dot(cross(minus(midpoint(loop_.edges[b]), p), minus(midpoint(loop_.edges[c]), p)), normal_);
  }
  constexpr void append(std::size_t i, std::size_t j, Triangles& out) const {
    if (j - i < 2) return;
    const std::size_t k = apex_[i][j];
    out.list[out.size++] = {static_cast<std::uint8_t>(loop_.edges[i]),
                            static_cast<std::uint8_t>(loop_.edges[k]),
                            static_cast<std::uint8_t>(loop_.edges[j])};
    append(i, k, out);
    append(k, j, out);
  }

  Loop loop_;
  Point normal_;
  std::array<std::array<double, max_loop>, max_loop> best_{};
  std::array<std::array<std::size_t, max_loop>, max_loop> apex_{};
};

constexpr Triangles triangulate(unsigned inside) {
  Triangles out;
  std::array<int, 12> next = successors(inside);
  for (int start = 0; start < 12; ++start) {
    if (next[static_cast<std::size_t>(start)] < 0) continue;
    Loop loop;
    for (int e = start; next[static_cast<std::size_t>(e)] >= 0;) {
      loop.edges[loop.size++] = e;
      const int following = next[static_cast<std::size_t>(e)];
      next[static_cast<std::size_t>(e)] = -1;
      e = following;
    }
    Triangulation(loop).append(out);
  }
  return out;
}

constexpr Triangles triangulate_square(unsigned inside) {
  Triangles out;
  const auto in = [&](unsigned i) { return (inside >> (i & 3u) & 1u) != 0; };
  if (inside == 15u) {
    out.list = {CubeTriangle{0, 1, 2}, CubeTriangle{0, 2, 3}};
    out.size = 2;
    return out;
  }
  for (unsigned i = 0; i < 4; ++i) {
    if (in(i + 3) || !in(i)) continue;
    unsigned last = i;
    while (in(last + 1)) ++last;
    // The polygon: the crossing before i, the corners i..last, the crossing after last. Its fan starts at the
    // second corner: no triangle has three points on one side of the square.
    std::array<std::uint8_t, 5> ring{static_cast<std::uint8_t>(4 + ((i + 3) & 3u))};
    unsigned size = 1;
    for (unsigned c = i; c <= last; ++c) ring[size++] = static_cast<std::uint8_t>(c & 3u);
    ring[size++] = static_cast<std::uint8_t>(4 + (last & 3u));
    for (unsigned k = 1; k + 1 < size; ++k)
      out.list[out.size++] = {ring[2], ring[(2 + k) % size], ring[(3 + k) % size]};
  }
  return out;
}

template <std::size_t N, class Make>
constexpr std::array<Triangles, N> table_of(Make make) {
  std::array<Triangles, N> table{};
  for (unsigned c = 0; c < N; ++c) table[c] = make(c);
  return table;
}

constexpr auto cube_table = table_of<256>(triangulate);
constexpr auto square_table = table_of<16>(triangulate_square);

}  // namespace

std::span<const CubeTriangle> cube_triangles(unsigned inside_corners) {
  const Triangles& t = cube_table[inside_corners];
  return {t.list.data(), t.size};
}
std::span<const CubeTriangle> square_triangles(unsigned inside_corners) {
  const Triangles& t = square_table[inside_corners];
  return {t.list.data(), t.size};
}

}  // namespace blendwright::detail
