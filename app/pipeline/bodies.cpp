#include "app/pipeline/bodies.hpp"

#include <filesystem>

#include "app/json/json_value.hpp"
#include "kernel/base/error.hpp"
#include "kernel/base/number_text.hpp"

namespace blendwright {
namespace {

double in_millimetres(LengthUnit unit) {
  switch (unit) {
    case LengthUnit::millimetre:
      return 1.0;
    case LengthUnit::centimetre:
      return 10.0;
    case LengthUnit::metre:
      return 1000.0;
    case LengthUnit::inch:
      return 25.4;
  }
  return 1.0;
}

/// The scene with its solid scaled by `factor` about the origin, in `unit`.
SceneFile scaled(const SceneFile& scene, double factor, LengthUnit unit) {
  SceneFile result{scene.name, scene.source_hash, scene.spec, scene.scene};
  const std::string converted = std::string("/in ") + name(unit);  // people's names do not start with "/"
  result.spec.nodes.push_back(
      {converted, "place", {{"of", NodeRef{scene.spec.solid}}, {"scale", factor}}, converted});
  result.spec.solid = converted;
  result.spec.unit = unit;
  result.scene = build_scene(result.spec);
  result.spec.solid = scene.spec.solid;  // what people call it
  return result;
}

}  // namespace

SolidPlace solid_place(const std::string& text) {
  const std::size_t hash = text.rfind('#');
  std::error_code ignored;
  if (hash == std::string::npos || std::filesystem::exists(text, ignored)) return {text, ""};
  return {text.substr(0, hash), text.substr(hash + 1)};
}

Body read_body(const SolidPlace& place) {
  SceneFile scene = build_scene_file(place.file, place.solid);
  std::string name = scene.name;
  if (!place.solid.empty()) name.append(1, '#').append(place.solid);
  return {std::move(name), std::move(scene)};
}

void make_names_unique(std::vector<Body>& bodies) {
  const auto taken = [&](const std::string& name, std::size_t before) {
    for (std::size_t i = 0; i < before; ++i)
      if (bodies[i].name == name) return true;
    return false;
  };
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    std::string name = bodies[i].name;
    for (std::size_t n = 2; taken(name, i); ++n) name = bodies[i].name + " (" + std::to_string(n) + ")";
    bodies[i].name = std::move(name);
  }
}

std::vector<std::string> to_unit_of_first(std::span<Body> bodies, bool convert) {
  std::vector<std::string> notes;
  std::vector<Problem> problems;
  const LengthUnit unit = bodies.front().scene.spec.unit;
  for (Body& body : bodies.subspan(1)) {
    const LengthUnit own = body.scene.spec.unit;
    if (own == unit) continue;
    if (!convert) {
      problems.push_back(
          {in_quotes(body.name), std::string("is in ") + name(own) + ", must be in " + name(unit) + " as " +
                                     in_quotes(bodies.front().name) +
                                     " is, since lengths are compared; --convert-units scales it"});
      continue;
    }
    const double factor = in_millimetres(own) / in_millimetres(unit);
    body.scene = scaled(body.scene, factor, unit);
    notes.push_back(body.name + " is in " + name(own) + ": its lengths are multiplied by " +
                    number_text(factor) + ", all results are in " + name(unit));
  }
  if (!problems.empty()) throw InputError(std::move(problems));
  return notes;
}

}  // namespace blendwright
