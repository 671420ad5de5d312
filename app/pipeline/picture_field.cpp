#include <algorithm>
#include <cmath>

#include "app/json/json_value.hpp"
#include "app/pipeline/picture_plan.hpp"
#include "kernel/base/number_text.hpp"

namespace blendwright {
namespace {

constexpr std::size_t cells = 320;
constexpr double margin = 0.18;  // around the solid, of its size

Box shown_box(const PictureInput& input, const PictureJob& job) {
  if (job.reading.box) return *job.reading.box;
  const std::optional<Box>& bounds = input.scene->scene.field.bounds();
  if (!bounds || !bounds->finite())
    throw InputError("--box",
                     "is missing: the solid is unbounded, or its bounds are not known; give the box to be "
                     "seen, as in --box=-10,-10,-10,10,10,10");
  const Vec3 around = Vec3::Constant(margin * bounds->size().maxCoeff());
  return {bounds->lo - around, bounds->hi + around};
}

SectionPlane shown_plane(const Box& box, const PictureJob& job) {
  SectionPlane plane;
  if (job.plane) {
    plane = *job.plane;
    if (!box.axis(plane.k).contains(plane.at))
      throw InputError("--plane", std::string("is ") + "xyz"[plane.k] + "=" + number_text(plane.at) +
                                      ", must be from " + number_text(box.lo[plane.k], 4) + " to " +
                                      number_text(box.hi[plane.k], 4) + ", where the solid is");
    return plane;
  }
  box.size().minCoeff(&plane.k);
  plane.at = box.centre()[plane.k];
  return plane;
}

/// The inside of the solid keeps half of the bar: values far outside may be any.
ColourScale field_scale(const PictureJob& job, const FieldSection& section) {
  std::vector<double> values = section.mesh.columns.front().values;
  if (job.range || job.options.logarithmic) return scale_of(job, std::move(values));
  const double most = section.most > 0.0 ? section.most : -section.least;
  for (double& x : values) x = std::clamp(x, -most, most);
  const ColourScale scale = ColourScale::over(values, ScaleRule::diverging);
  Axis axis = scale.axis();
  if (section.least < axis.lo) axis.ticks.front().label.insert(0, "< ");
  return {scale.map(), std::move(axis)};
}

}  // namespace

PicturePlan plan_of_field(const PictureInput& input, const PictureJob& job, const Progress& progress) {
  if (!input.scene)
    throw InputError("--show", "is \"field\", which only scenes have, and " + input.name + " is none");
  const ScalarField& field = input.scene->scene.field;
  const Box box = shown_box(input, job);
  const SectionPlane plane = shown_plane(box, job);
  FieldSection section = field_section(field, box, plane, cells, progress);
  PicturePlan plan;
  plan.notes = input.notes;
  plan.figure = PictureFigure{"value of the field", "", section.least, section.most};
  Picture& picture = plan.picture.emplace();
  set_up(picture, input, job);
  if (job.views.empty() && !job.from) {
    picture.view = Vec3::Unit(plane.k);
    if (plane.k == 1) *picture.view = -*picture.view;
  }
  const double level = surface_value(field.level());
  picture.title += std::string(": field on ") + "xyz"[plane.k] + " = " + number_text(plane.at, 4) +
                   (input.unit ? std::string(" ") + name(*input.unit) : "") + ", from " +
                   number_text(section.least, 3) + " to " + number_text(section.most, 3);
  picture.column = "value";
  picture.bar_title = sense(field.level()) > 0.0 ? "value" : "-value";
  if (level != 0.0)
    picture.bar_title =
        sense(field.level()) > 0.0 ? "value - " + number_text(level) : number_text(level) + " - value";
  picture.caption = "the solid is where it is >= 0; the line is its surface";
  picture.scale = field_scale(job, section);
  if (job.options.logarithmic)
    for (double& x : section.mesh.columns.front().values) x = std::abs(x);
  PictureMesh shown{std::move(section.mesh), {0.8, 0.8, 0.8}, 1.0, true};
  shown.unlit = true;
  picture.meshes.push_back(std::move(shown));
  picture.lines = std::move(section.outline);
  return plan;
}

}  // namespace blendwright
