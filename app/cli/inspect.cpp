#include <cmath>

#include "app/cli/text_table.hpp"
#include "app/cli/verbs.hpp"
#include "app/json/json_value.hpp"
#include "kernel/base/number_text.hpp"
#include "kernel/brep/step_part.hpp"

namespace blendwright {
namespace {

/// Six digits find a face again; what is only rounding of the part's size is 0.
double near_number(double x, double size) {
  if (std::abs(x) <= 1e-9 * size) return 0.0;
  return std::stod(number_text(x, 6));
}

double size_of(const StepPart& part) {
  double size = 0.0;
  for (const FaceInfo& f : part.faces()) size = std::max(size, f.anchor.cwiseAbs().maxCoeff());
  for (const EdgeInfo& e : part.edges()) size = std::max(size, e.anchor.cwiseAbs().maxCoeff());
  return size;
}

JsonValue near_point(const Vec3& p, double size) {
  return JsonValue::array({near_number(p[0], size), near_number(p[1], size), near_number(p[2], size)});
}

std::string near_text(const Vec3& p, double size) {
  std::string text(1, '[');
  for (Eigen::Index i = 0; i < 3; ++i) {
    if (i > 0) text += ", ";
    text += number_text(near_number(p[i], size));
  }
  return text += ']';
}

std::string with_size(std::string kind, const std::string& size) {
  if (!size.empty()) kind.append(", ").append(size);
  return kind;
}

std::string indices(const std::vector<std::size_t>& faces) {
  std::string text;
  for (const std::size_t f : faces) {
    if (!text.empty()) text += ' ';
    text += std::to_string(f);
  }
  return text;
}

std::string part_table(const StepPart& part) {
  const double size = size_of(part);
  TextRows faces{{"face", "size", "area/mm^2", "\"select\": ..."}};
  for (const FaceInfo& f : part.faces())
    faces.push_back({std::to_string(f.index), with_size(f.surface, f.size), number_text(f.area, 4),
                     "{ \"surface\": \"" + f.surface + "\", \"near\": " + near_text(f.anchor, size) + " }"});
  TextRows edges{{"edge", "of faces", "size", "\"trimline\": ..."}};
  for (const EdgeInfo& e : part.edges())
    edges.push_back({std::to_string(e.index), indices(e.faces), with_size(e.curve, e.size),
                     "{ \"kind\": \"edge\", \"curve\": \"" + e.curve +
                         "\", \"near\": " + near_text(e.anchor, size) + " }"});
  return aligned(faces) + aligned(edges);
}

JsonValue part_json(const StepPart& part) {
  const double size = size_of(part);
  JsonValue::Array faces, edges;
  for (const FaceInfo& f : part.faces())
    faces.push_back(JsonValue::object(
        {{"index", f.index},
         {"surface", f.surface},
         {"size", f.size},
         {"name", f.name},
         {"solid", f.solid},
         {"area", f.area},
         {"reversed", f.reversed},
         {"select", JsonValue::object({{"surface", f.surface}, {"near", near_point(f.anchor, size)}})}}));
  for (const EdgeInfo& e : part.edges()) {
    JsonValue::Array of_faces;
    for (const std::size_t f : e.faces) of_faces.emplace_back(f);
    edges.push_back(JsonValue::object(
        {{"index", e.index},
         {"curve", e.curve},
         {"size", e.size},
         {"length", e.length},
         {"closed", e.closed},
         {"faces", std::move(of_faces)},
         {"trimline",
          JsonValue::object({{"kind", "edge"}, {"curve", e.curve}, {"near", near_point(e.anchor, size)}})}}));
  }
  return JsonValue::object({{"valid", part.valid()},
                            {"solids", part.solids()},
                            {"tolerance", part.tolerance()},
                            {"unit", "mm"},
                            {"faces", std::move(faces)},
                            {"edges", std::move(edges)}});
}

}  // namespace

int inspect(const InspectCommand& command, const Console& console) {
  return guarded(console, shown_name(command.part), [&] {
    const StepPart part = StepPart::read(command.part);
    if (command.json) {
      console.out() << json_text(part_json(part));
      return exit_done;
    }
    console.out() << shown_name(command.part) << ": " << counted(part.faces().size(), "face") << ", "
                  << counted(part.edges().size(), "edge") << ", " << counted(part.solids(), "solid") << ", "
                  << (part.valid() ? "valid" : "not valid") << ", largest tolerance "
                  << scientific_text(part.tolerance()) << " mm\n"
                  << part_table(part);
    return exit_done;
  });
}

}  // namespace blendwright
