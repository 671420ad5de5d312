#include "implicit/polygonize/mesh_flips.hpp"

#include <algorithm>
#include <map>

namespace blendwright::detail {
namespace {

/// The faces around the vertices of some faces.
class Neighbourhood {
 public:
  Neighbourhood(std::vector<Triangle>& triangles, std::size_t points, const std::vector<std::size_t>& faces)
      : triangles_(triangles) {
    std::vector<bool> wanted(points, false);
    for (const std::size_t f : faces)
      for (const std::uint32_t v : triangles[f]) wanted[v] = true;
    for (std::size_t n = 0; n < triangles.size(); ++n)
      for (const std::uint32_t v : triangles[n])
        if (wanted[v]) around_[v].push_back(n);
  }

  /// The face that uses the edge from a to b in this direction.
  [[nodiscard]] const std::size_t* face_of(std::uint32_t a, std::uint32_t b) const {
    const auto found = around_.find(a);
    if (found == around_.end()) return nullptr;
    for (const std::size_t& n : found->second)
      for (std::size_t i = 0; i < 3; ++i)
        if (triangles_[n][i] == a && triangles_[n][(i + 1) % 3] == b) return &n;
    return nullptr;
  }
  void replace(std::size_t face, const Triangle& vertices) {
    for (const std::uint32_t v : triangles_[face])
      if (const auto found = around_.find(v); found != around_.end()) std::erase(found->second, face);
    triangles_[face] = vertices;
    for (const std::uint32_t v : vertices)
      if (const auto found = around_.find(v); found != around_.end()) found->second.push_back(face);
  }

 private:
  std::vector<Triangle>& triangles_;
  std::map<std::uint32_t, std::vector<std::size_t>> around_;
};

}  // namespace

void flip_unacceptable_faces(std::vector<Triangle>& triangles, std::size_t points,
                             const std::vector<std::size_t>& faces,
                             const std::function<bool(std::size_t, const Triangle&)>& acceptable) {
  Neighbourhood near(triangles, points, faces);
  const auto flipped = [&](std::size_t face, std::size_t edge) {
    // face = (a, b, c), its neighbour across a-b = (b, a, d): they become (a, d, c) and (d, b, c).
    const std::uint32_t a = triangles[face][edge], b = triangles[face][(edge + 1) % 3],
                        c = triangles[face][(edge + 2) % 3];
    const std::size_t* other = near.face_of(b, a);
    if (other == nullptr) return false;
    const std::size_t neighbour = *other;
    const Triangle& t = triangles[neighbour];
    const std::uint32_t d = t[0] != a && t[0] != b ? t[0] : t[1] != a && t[1] != b ? t[1] : t[2];
    if (d == c || near.face_of(c, d) != nullptr) return false;
    const Triangle first{a, d, c}, second{d, b, c};
    if (!acceptable(face, first) || !acceptable(neighbour, second)) return false;
    near.replace(face, first);
    near.replace(neighbour, second);
    return true;
  };
  for (const std::size_t face : faces) {
    if (acceptable(face, triangles[face])) continue;
    for (std::size_t edge = 0; edge < 3; ++edge)
      if (flipped(face, edge)) break;
  }
}

}  // namespace blendwright::detail
