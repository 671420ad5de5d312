// Deviations in the window: of two documents from each other, of one from its shape when it was opened.
#include <algorithm>

#include "app/pipeline/picture_deviation.hpp"
#include "app/view/window/controller.hpp"
#include "kernel/base/error.hpp"
#include "kernel/base/number_text.hpp"

namespace blendwright {
namespace {

struct MeasuredShape {
  std::vector<std::vector<float>> values;  ///< for each part
  DeviationFacts facts;
};

/// Pieces of the same name are compared with each other, as `compare` does; without any, everything with
/// everything. What is left out keeps its place, empty.
void keep_common(PictureInput& a, PictureInput& b) {
  const auto has = [](const PictureInput& input, const std::string& name) {
    return std::any_of(input.parts.begin(), input.parts.end(), [&](const PicturePart& p) {
      return !p.mesh.triangles.empty() && p.mesh.name == name;
    });
  };
  const PictureInput first = a;
  const bool common = std::any_of(first.parts.begin(), first.parts.end(), [&](const PicturePart& p) {
    return !p.mesh.triangles.empty() && has(b, p.mesh.name);
  });
  if (!common) return;
  for (PicturePart& p : a.parts)
    if (!has(b, p.mesh.name)) p.mesh = {};
  for (PicturePart& p : b.parts)
    if (!has(first, p.mesh.name)) p.mesh = {};
}

MeasuredShape measured(PictureInput shape, PictureInput to) {
  keep_common(shape, to);
  MeasuredShape m;
  m.facts = add_deviation(shape, to);
  for (const PicturePart& part : shape.parts) {
    const std::vector<double>& column = part.mesh.columns.back().values;
    m.values.emplace_back(column.begin(), column.end());
  }
  return m;
}

}  // namespace

std::optional<PictureInput> Controller::deviation_target(std::size_t index) const {
  if (documents_.size() > 1) return documents_[1 - index]->shape();
  if (const PictureInput* first = documents_[index]->first_shape()) return *first;
  return std::nullopt;
}

std::vector<std::vector<float>> Controller::colour_values(std::size_t index) const {
  const Document& d = *documents_[index];
  const std::vector<DrawnSurface> surfaces = d.surfaces();
  std::vector<std::vector<float>> all;
  if (state_.show == Show::deviation && index < deviations_.size()) all = deviations_[index];
  all.resize(surfaces.size());
  if (state_.show == Show::plain || state_.show == Show::deviation) return all;
  for (std::size_t i = 0; i < all.size(); ++i)
    // Primaries stand back behind the colours.
    if (surfaces[i].role != DrawnSurface::Role::primary) all[i] = d.values(i, state_.show, state_.options);
  return all;
}

void Controller::measure_deviations() {
  deviations_.clear();
  if (documents_.size() < 2 && !document().first_shape())
    return say("a deviation needs two files, or one that is changed here", true);
  const std::string from =
      documents_.size() > 1 ? documents_[1 - state_.active]->file().filename().string() : "what was opened";
  try {
    for (std::size_t k = 0; k < documents_.size(); ++k) {
      MeasuredShape m = measured(documents_[k]->shape(), *deviation_target(k));
      deviations_.push_back(std::move(m.values));
      if (k != state_.active) continue;
      const std::string unit = name(document().unit());
      say("deviation from " + from + ": largest " + number_text(m.facts.worst, 3) + " " + unit + ", rms " +
          number_text(m.facts.rms, 3) + " " + unit);
    }
  } catch (const InputError& e) {
    say("no deviation from " + from + ": " + e.problems().front().message, true);
  }
}

}  // namespace blendwright
