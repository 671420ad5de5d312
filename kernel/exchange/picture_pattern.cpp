#include "kernel/exchange/picture_pattern.hpp"

#include <vtkActor.h>
#include <vtkShaderProperty.h>
#include <vtkUniforms.h>

#include <array>

#include "kernel/exchange/colour_scale.hpp"

namespace blendwright {
namespace {

constexpr const char* place = "//VTK::Light::Impl";

/// The eye looks along -z of the view's axes, so r.up = 2 n_z n_y; light strips lie about
/// r.up = 0. Stripes of a pixel's width blur to grey.
constexpr const char* zebra_code = R"(//VTK::Light::Impl
  vec3 patternNormal = normalize(normalVCVSOutput);
  if (patternNormal.z < 0.0) patternNormal = -patternNormal;
  float patternUp = clamp(2.0 * patternNormal.z * patternNormal.y, -1.0, 1.0);
  float patternWave = cos(2.0 * patternStripes * asin(patternUp));
  float patternWidth = max(fwidth(patternWave), 1e-4);
  float patternLight = smoothstep(-patternWidth, patternWidth, patternWave);
  fragOutput0.rgb = vec3(mix(0.05, 0.97, patternLight) * (0.62 + 0.38 * patternNormal.z));
)";

/// Each band has its colour; a darker line runs along its border.
constexpr const char* isophote_code = R"(//VTK::Light::Impl
  vec3 patternNormal = normalize(normalVCVSOutput);
  float patternAngle = degrees(acos(min(abs(dot(patternNormal, patternToLight)), 1.0)));
  float patternBand = patternAngle * float(patternBands) / 90.0;
  int patternIndex = min(int(patternBand), patternBands - 1);
  float patternEdge = abs(patternBand - floor(patternBand + 0.5));
  float patternShade = patternEdge < 0.8 * fwidth(patternBand) ? 0.6 : 1.0;
  fragOutput0.rgb = patternShade * patternColours[patternIndex];
)";

}  // namespace

void set_pattern(vtkActor& actor, SurfacePattern pattern, double stripes, const Vec3& to_light) {
  vtkShaderProperty& shader = *actor.GetShaderProperty();
  shader.ClearAllFragmentShaderReplacements();
  vtkUniforms& uniforms = *shader.GetFragmentCustomUniforms();
  uniforms.RemoveAllUniforms();
  if (pattern == SurfacePattern::zebra) {
    uniforms.SetUniformf("patternStripes", static_cast<float>(stripes));
    shader.AddFragmentShaderReplacement(place, true, zebra_code, false);
  }
  if (pattern == SurfacePattern::isophotes) {
    std::array<std::array<float, 3>, isophote_bands> colours{};
    for (int i = 0; i < isophote_bands; ++i) {
      const Colour c = colour_at(ColourMap::sequential, (i + 0.5) / isophote_bands);
      colours[static_cast<std::size_t>(i)] = {static_cast<float>(c.r), static_cast<float>(c.g),
                                              static_cast<float>(c.b)};
    }
    const Vec3 light = to_light.normalized();
    const std::array<float, 3> direction{static_cast<float>(light.x()), static_cast<float>(light.y()),
                                         static_cast<float>(light.z())};
    uniforms.SetUniformi("patternBands", isophote_bands);
    uniforms.SetUniform3f("patternToLight", direction.data());
    uniforms.SetUniform3fv("patternColours", isophote_bands,
                           reinterpret_cast<const float(*)[3]>(colours.data()));
    shader.AddFragmentShaderReplacement(place, true, isophote_code, false);
  }
}

}  // namespace blendwright
