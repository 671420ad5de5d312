#pragma once
// Curvature combs: at points of lines on a surface, hairs along the normal whose length is the normal
// curvature along the line, with an envelope through their tips.
//
//   tip = p + scale k n,  k the normal curvature along the line, positive where the surface is convex seen
//   from the side of n: hairs stand out of convex places and sink into hollow ones, or the other way round
//   where most places are hollow (1)
#include <string>
#include <vector>

#include "app/pipeline/picture_input.hpp"
#include "kernel/exchange/picture.hpp"

namespace blendwright {

/// A line with its normal curvature.
struct CombLine {
  std::vector<Vec3> points, normals;
  std::vector<double> curvature;  ///< 1/unit, as in (1); NaN: no hair
  bool closed = false;
};

/// Of a blend: `lines` lines across it (v constant), exact.
/// @param outward  +1 when the comb's side is that of Su x Sv, else -1
[[nodiscard]] std::vector<CombLine> comb_across(const Surface& surface, std::size_t lines, std::size_t hairs,
                                                double outward);
/// Of any surface: where planes across the longest axis of the meshes cut them. Curvatures come from the
/// turn of the meshes' normals along the cut; of a scene from its field's second derivatives. Meshes without
/// normals give none.
[[nodiscard]] std::vector<CombLine> comb_of_sections(const std::vector<const TriMesh*>& meshes,
                                                     std::size_t planes, std::size_t hairs,
                                                     const ScalarField* field);

struct Comb {
  PictureMesh hairs, envelope;
  double scale = 0.0;  ///< length of a hair over its curvature, model units^2
  double shown = 0.0;  ///< a round curvature for the scale bar
  double least = 0.0, most = 0.0;
  bool inward = false;  ///< hairs stand out of hollow places: most of the curvature is there
};
/// `size` of the object; the hair of the 98th percentile is an eighth of it. Longer ones are cut at a
/// quarter.
[[nodiscard]] Comb comb_of(const std::vector<CombLine>& lines, double size);

}  // namespace blendwright
