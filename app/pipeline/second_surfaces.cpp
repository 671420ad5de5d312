#include "app/pipeline/second_surfaces.hpp"

#include <algorithm>
#include <cmath>

namespace blendwright {
namespace {

SecondSurface second_surface(const ExtremaSurface& surface) {
  return {[surface](UV at) { return surface.point(at); },
          [surface](const Vec3& q) -> SecondSurface::Closest {
            const ExtremaFoot foot = surface.closest(q);
            return {foot.at, foot.distance, foot.slack};
          },
          0.0};
}

/// The nearest of several faces.
SecondSurface::Closest nearest(const std::vector<ExtremaSurface>& faces, const Vec3& q) {
  ExtremaFoot best = faces.front().closest(q);
  for (const ExtremaSurface& face : faces) {
    const ExtremaFoot foot = face.closest(q);
    if (foot.distance < best.distance || std::isnan(best.distance)) best = foot;
  }
  return {best.at, best.distance, best.slack};
}

/// The CAD kernel writes numbers from 0.1 to 1000 with 12 decimals. Places are off by that, and by what it
/// turns axes, at the distance of the blend from where they start.
double rounding_of_file(const SecondSurface& blend, const SurfaceDomain& domain) {
  constexpr double number = 5e-13;
  double reach = 0.0;
  for (int i = 0; i <= 2; ++i)
    for (int j = 0; j <= 8; ++j)
      reach = std::max(reach, blend.point({domain.u.at(i / 2.0), domain.v.at(j / 8.0)}).norm());
  // Three coordinates of the origin and a radius; two directions of three coordinates each.
  return number * (4.0 + 6.0 * 2.0 * reach);
}

}  // namespace

BlendUnderTest::Second second_surfaces(const BlendUnderTest& under_test) {
  BlendUnderTest::Second second{second_surface(ExtremaSurface::of(under_test.blend)), {}};
  for (std::size_t side = 0; side < 2; ++side)
    if (under_test.seams[side].primary)
      second.primaries[side] = second_surface(ExtremaSurface::of(*under_test.seams[side].primary));
  return second;
}

BlendUnderTest::Second second_surfaces(const BlendUnderTest& under_test, const StepFace& blend,
                                       const StepContent& content,
                                       const std::array<std::string, 2>& primaries, double approximation) {
  BlendUnderTest::Second second = second_surfaces(under_test);
  if (blend.extrema) second.blend = second_surface(*blend.extrema);
  const double rounding = rounding_of_file(second.blend, under_test.blend.domain());
  for (std::size_t side = 0; side < 2; ++side) {
    std::vector<ExtremaSurface> faces;
    for (const StepFace& face : content.faces)
      if (face.name == primaries[side] && face.extrema) faces.push_back(*face.extrema);
    // A side of typed data has no primary, and what nothing is left of is in no file.
    if (primaries[side].empty() || faces.empty() || !under_test.seams[side].primary) continue;
    const bool exact = ExtremaSurface::of(*under_test.seams[side].primary).evaluates();
    second.primaries[side].closest = [faces](const Vec3& q) { return nearest(faces, q); };
    second.primaries[side].uncertainty = rounding + (exact ? 0.0 : approximation);
  }
  return second;
}

}  // namespace blendwright
