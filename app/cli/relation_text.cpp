#include "app/cli/relation_text.hpp"

#include <algorithm>
#include <cmath>

#include "app/cli/arguments.hpp"
#include "app/cli/text_table.hpp"
#include "kernel/base/error.hpp"
#include "kernel/base/number_text.hpp"

namespace blendwright {
namespace {

constexpr std::size_t most_shown = 3;

}  // namespace

SearchOptions search_options_of(const SearchCommand& command) {
  SearchOptions options;
  options.tolerance = command.tolerance;
  options.max_boxes = command.max_boxes;
  if (!command.domain.empty()) options.domain = box_argument(command.domain);
  return options;
}

std::vector<Body> read_bodies(const std::vector<std::string>& scenes, bool convert_units, bool quiet,
                              const Console& console, std::string& subject) {
  std::vector<Body> bodies;
  std::vector<SolidPlace> places;
  for (const std::string& scene : scenes) places.push_back(solid_place(scene));
  if (std::count_if(places.begin(), places.end(), [](const SolidPlace& p) { return p.file == "-"; }) > 1)
    throw InputError("SCENES", "names standard input twice, must name it once");
  const std::string all = subject;
  for (std::size_t i = 0; i < places.size(); ++i) {
    subject = shown_name(places[i].file);
    bodies.push_back(read_body(places[i]));
    if (!quiet)
      for (const Problem& w : bodies.back().scene.scene.warnings)
        console.warn(subject + ": " + w.where + ": " + w.message);
  }
  subject = all;
  make_names_unique(bodies);
  for (const std::string& note : to_unit_of_first(bodies, convert_units))
    if (!quiet) console.err() << note << '\n';
  return bodies;
}

std::string shown_names(const std::vector<std::string>& scenes) {
  std::string text;
  for (std::size_t i = 0; i < std::min(scenes.size(), most_shown); ++i)
    text += (i == 0 ? "" : ", ") + shown_name(scenes[i]);
  return scenes.size() > most_shown ? text + " and " + counted(scenes.size() - most_shown, "other") : text;
}

std::string shown_point(const Vec3& p) {
  const double least = 1e-9 * p.cwiseAbs().maxCoeff();  // nine digits of the largest
  std::string text;
  for (int k = 0; k < 3; ++k)
    text.append(k == 0 ? "(" : ", ").append(std::abs(p[k]) < least ? "0" : number_text(p[k], 9));
  return text.append(1, ')');
}

std::string undecided_text(std::size_t boxes, const std::optional<Box>& where, const SearchOptions& options,
                           const std::string& unit) {
  std::string text = "undecided ";
  if (boxes >= options.max_boxes)
    text += "after " + std::to_string(options.max_boxes) + " boxes, the work limit";
  else
    text += "below " + number_text(options.tolerance) + " " + unit;
  if (where) text += ", around " + shown_point(where->centre());
  return text;
}

}  // namespace blendwright
