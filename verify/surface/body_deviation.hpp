#pragma once
// How far two results are from each other, each a set of surfaces, a mesh, or both.
//
//   d(x, B) = min |x - y| over y in B,   h(A, B) = max d(x, B) over x in A,   H = max(h(A, B), h(B, A))   (1)
// H is the Hausdorff distance. Mean, root mean square and percentile of d are over A, by area.
//
// Meshes against meshes: d is exact, and h is proven. d(x, f) to one triangle f is convex in x, so that over
// a triangle with corners p_i
//   max d(x, B) <= min over f of max over i of d(p_i, f),   f the triangles next to the corners           (2)
//   max d(x, B) <= min over i of d(p_i, B) + max over j of |p_i - p_j|                                    (3)
// Triangles are halved until the largest bound is h, or is on the known side of a limit.
// Surfaces: the closest triangle of a mesh of the surface starts Newton's method on the surface itself; where
// the foot then lies beyond the trimmed border by more than the mesh is off (`sag`), the distance is the one
// to the mesh. h is the largest sample, led on to a local maximum: sampled, not proven.
// Source of (2): M. Guthe, P. Borodin, R. Klein, Fast and accurate Hausdorff distance calculation between
// meshes, 2005.
#include <optional>
#include <string>
#include <vector>

#include "kernel/base/progress.hpp"
#include "kernel/mesh/mesh_distance.hpp"

namespace blendwright {

/// Triangles, and the surface that their corners lie on where there is one: the mesh then has columns "u" and
/// "v", the parameters of its points.
struct ResultPiece {
  TriMesh mesh;
  std::optional<Surface> surface{};
};

class ResultBody {
 public:
  /// Throws InputError: no piece, and as MeshTree.
  explicit ResultBody(std::vector<ResultPiece> pieces);

  struct Foot {
    Vec3 point = Vec3::Zero();
    double distance = 0.0;
    double side = 0.0;  ///< > 0: on the side of the normals
  };
  [[nodiscard]] Foot closest(const Vec3& q) const;

  [[nodiscard]] const MeshTree& tree() const { return tree_; }
  [[nodiscard]] bool has_surfaces() const { return surfaces_; }
  /// Largest distance found between the triangles' middles and the surfaces; 0 without surfaces.
  [[nodiscard]] double sag() const { return sag_; }
  /// The name of the piece that a triangle belongs to.
  [[nodiscard]] const std::string& name_of(std::uint32_t triangle) const;
  /// The point of the surface, or of the triangle where there is none, at weights of its corners.
  [[nodiscard]] Vec3 point_at(std::uint32_t triangle, const std::array<double, 3>& weights) const;

 private:
  struct Piece {
    std::string name;
    std::optional<Surface> surface;
    std::uint32_t end = 0;  ///< of its triangles
  };
  [[nodiscard]] const Piece& piece_of(std::uint32_t triangle) const;
  [[nodiscard]] UV parameters(std::uint32_t triangle, const std::array<double, 3>& weights) const;

  std::vector<Piece> pieces_;
  std::vector<UV> uv_;  ///< of the points, when any piece is a surface
  MeshTree tree_;
  bool surfaces_ = false;
  double sag_ = 0.0;
};

/// h(A, B) of (1), and what is known of d over A. Not a number where a surface is not.
struct BodyDeviation {
  double largest = 0.0;
  Vec3 at = Vec3::Zero(), foot = Vec3::Zero();  ///< of the largest, on A and on B
  std::string piece, other_piece;               ///< their names
  std::optional<double> proven{};               ///< no point of A is further away; empty: sampled
  double mean = 0.0, rms = 0.0, percentile95 = 0.0;
  bool signs = false;  ///< B has sides: the three below count, and the values at the points are signed
  double signed_mean = 0.0, least = 0.0, most = 0.0;  ///< > 0: on the side of B's normals
  std::size_t samples = 0;
  std::vector<double> at_points;  ///< d at the points of A's mesh
};

struct DeviationOptions {
  std::optional<double> limit{};  ///< the proof goes on until h is known to be below or above
  std::size_t samples = 40000;    ///< at least, spread by area
  std::size_t max_halvings = 400000;
};

/// Throws Cancelled. The same for any number of threads.
[[nodiscard]] BodyDeviation deviation(const ResultBody& from, const ResultBody& to,
                                      const DeviationOptions& options = {}, const Progress& progress = {});

}  // namespace blendwright
