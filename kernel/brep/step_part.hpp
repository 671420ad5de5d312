#pragma once
// A STEP file as a part: its faces and edges, chosen by geometry, evaluated behind the kernel's own
// interfaces.
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "kernel/geometry/curve.hpp"
#include "kernel/geometry/surface.hpp"

namespace blendwright {

/// Chooses one face: surface kind (empty: any) and the face nearest to a point. Fails closed: when none
/// matches, or two are equally near (within 1e-6 of the part's size), the error lists the candidates with
/// their selectors.
struct FaceSelector {
  std::string surface;  ///< plane, cylinder, cone, sphere, torus, bspline, revolution, extrusion, other
  std::optional<Vec3> near;
};
struct EdgeSelector {
  std::string curve;  ///< line, circle, ellipse, bspline, other; empty: any
  std::optional<Vec3> near;
};

struct FaceInfo {
  std::size_t index = 0;  ///< within this file and version only; never stored
  std::string surface;
  std::string size;         ///< "radius 3, length 12": what identifies the face
  std::string name, solid;  ///< STEP names, may be empty
  double area = 0.0;
  Vec3 anchor;  ///< a point inside the face: `near` of its selector
  bool reversed = false;
};
struct EdgeInfo {
  std::size_t index = 0;
  std::string curve;
  std::string size;
  double length = 0.0;
  Vec3 anchor;  ///< mid point of the edge
  std::vector<std::size_t> faces;
  bool closed = false;
};

/// A trimline taken from edges: on `surface`, the curve of parameters in `pcurve` (v is arc length from 0).
struct EdgeTrimline {
  Surface
      surface;  ///< faces of a chain that lie on one cylinder, cone, sphere, plane or torus are one surface
  Curve2 pcurve;
  double edge_deviation =
      0.0;  ///< largest distance from the 3-D edge to the curve on the surface: the part's own error
  bool kept_left = true;  ///< the face's material lies towards n x C'
  std::vector<std::size_t> faces, edges;
};

class StepPart {
 public:
  /// Throws IoError: missing, unreadable, no shape in it. Model unit of the part: millimetre, converted to
  /// `unit`.
  [[nodiscard]] static StepPart read(const std::filesystem::path& file,
                                     LengthUnit unit = LengthUnit::millimetre);

  [[nodiscard]] const std::vector<FaceInfo>& faces() const;
  [[nodiscard]] const std::vector<EdgeInfo>& edges() const;
  [[nodiscard]] double tolerance() const;  ///< largest tolerance of the shape as read
  [[nodiscard]] std::size_t solids() const;
  [[nodiscard]] bool valid() const;

  /// Throws InputError with the candidates listed.
  [[nodiscard]] std::size_t select(const FaceSelector& selector) const;
  [[nodiscard]] std::size_t select(const EdgeSelector& selector,
                                   std::optional<std::size_t> of_face = std::nullopt) const;

  /// The face's surface with location and orientation applied (a reversed face has its normal flipped by
  /// swapping the sense of v), evaluated through the CAD kernel; domain = the face's parameter box.
  [[nodiscard]] Surface surface(std::size_t face) const;
  /// The edge on its face; a chain: the edges that continue it tangentially (within 1 deg) along faces on the
  /// same surface, until it closes or ends.
  [[nodiscard]] EdgeTrimline trimline(std::size_t face, std::size_t edge, bool chain) const;

  struct Impl;

 private:
  std::shared_ptr<const Impl> impl_;
};

}  // namespace blendwright
