#include <algorithm>
#include <cmath>
#include <limits>

#include "app/json/job_parts.hpp"
#include "kernel/base/number_text.hpp"

namespace blendwright {
namespace {

/// A number for all components, or one for each.
std::optional<std::array<double, 3>> number_or_3(ObjectReader& object, const char* key, Reading& reading) {
  const JsonValue* value = object.find(key);
  if (!value) return std::nullopt;
  if (value->items()) {
    const auto x = reading.numbers(*value, object.at(key), 3);
    return x ? std::optional(std::array{(*x)[0], (*x)[1], (*x)[2]}) : std::nullopt;
  }
  const auto x = reading.number(*value, object.at(key));
  return x ? std::optional(std::array{*x, *x, *x}) : std::nullopt;
}

void read_coefficients(ObjectReader& object, BlendShape& shape, Reading& reading) {
  const auto b = number_or_3(object, "b", reading), c = number_or_3(object, "c", reading),
             d = number_or_3(object, "d", reading);
  if (b && std::any_of(b->begin(), b->end(), [](double x) { return x == 0.0; }))
    object.problem("b", "is 0, must not be 0: b X'''' is the highest derivative of the sweep equation");
  for (std::size_t i = 0; i < 3; ++i) {
    if (b) shape.ode[i].b = (*b)[i];
    if (c) shape.ode[i].c = (*c)[i];
    if (d) shape.ode[i].d = (*d)[i];
  }
}

/// Shape controls that exclude each other, whatever their values.
void refuse_contradictions(ObjectReader& object, const std::vector<std::string>& asks_g2) {
  object.exclude("q", "tension", "both choose the roots of the sweep equation");
  for (const char* key : {"b", "c", "d"}) {
    object.exclude(key, "tension", "both choose the roots of the sweep equation");
    object.exclude(key, "q", "both choose the roots of the sweep equation");
  }
  if (!asks_g2.empty()) {
    for (const char* key : {"b", "c", "d", "q", "frame"})
      if (object.has(key))
        object.problem(key,
                       "contradicts G2 at " + asks_g2.front() +
                           ": a blend with G2 is of sixth order and has \"tension\" and \"family\" instead");
  } else if (object.has("family")) {
    object.problem("family", "has no effect: no side asks for G2; remove it or ask for G2");
  }
}

Eigen::Matrix3d read_axes(const JsonValue& value, const std::string& where, Reading& reading) {
  ObjectReader object(value, where, job_object("frame_axes"), reading);
  Eigen::Matrix3d axes = Eigen::Matrix3d::Identity();
  const JsonValue* fixed = object.find("fixed");
  if (!fixed) return axes;
  const auto vectors = reading.points(*fixed, object.at("fixed"), 3);
  if (!vectors) return axes;
  if (vectors->size() != 3) {
    object.problem("fixed", described(*fixed) + ", must be three vectors");
    return axes;
  }
  for (Eigen::Index i = 0; i < 3; ++i) axes.col(i) = (*vectors)[static_cast<std::size_t>(i)];
  // A person types six digits; the directions are then made exact. Exact ones stay as they are.
  const double error = (axes.transpose() * axes - Eigen::Matrix3d::Identity()).cwiseAbs().maxCoeff();
  if (!(error < 1e-5) || axes.col(0).cross(axes.col(1)).dot(axes.col(2)) < 0.0) {
    object.problem("fixed", "must be three perpendicular unit vectors, right-handed (they are off by " +
                                number_text(error, 2) + ")");
    return axes;
  }
  if (error <= 8.0 * std::numeric_limits<double>::epsilon()) return axes;
  axes.col(0).normalize();
  axes.col(1) = (axes.col(1) - axes.col(0).dot(axes.col(1)) * axes.col(0)).normalized();
  axes.col(2) = axes.col(0).cross(axes.col(1));
  return axes;
}

void read_frame(ObjectReader& object, BlendShape& shape, Reading& reading) {
  const JsonValue* frame = object.find("frame");
  if (!frame) return;
  if (frame->members()) {
    shape.frame = BlendFrame::fixed;
    shape.axes = read_axes(*frame, object.at("frame"), reading);
  } else if (const auto chosen = reading.choice(*frame, object.at("frame"), frame_choices())) {
    shape.frame = *chosen;
    if (shape.frame == BlendFrame::fixed)
      object.problem("frame", "needs its vectors; must be {\"fixed\": [[x,y,z], [x,y,z], [x,y,z]]}");
  }
}

}  // namespace

BlendShape read_shape(const JsonValue& value, const std::string& where,
                      const std::vector<std::string>& asks_g2, Reading& reading) {
  ObjectReader object(value, where, job_object("shape"), reading);
  BlendShape shape;
  refuse_contradictions(object, asks_g2);
  if (const auto tension = object.number("tension")) {
    shape.tension = *tension;
    shape.ode.fill(SweepOde::tension(*tension));
  }
  read_coefficients(object, shape, reading);
  shape.repeated_root = object.number("q");
  shape.mode = object.choice("mode", mode_choices()).value_or(BlendMode::chord);
  if (const auto anchor = object.point("anchor")) shape.anchor = *anchor;
  if (object.has("anchor") && shape.mode != BlendMode::anchor)
    object.problem("anchor", "is only used by mode \"anchor\"; remove it or set " + object.at("mode"));
  if (!object.has("anchor") && shape.mode == BlendMode::anchor)
    object.problem("anchor", "is missing; mode \"anchor\" needs a point [x, y, z]");
  read_frame(object, shape, reading);
  shape.family = object.choice("family", family_choices()).value_or(SixthOrderFamily::tension1);
  if (shape.family == SixthOrderFamily::quintic && object.has("tension"))
    object.problem("tension",
                   "contradicts " + object.at("family") + ": quintic has no tension; remove one of them");
  return shape;
}

}  // namespace blendwright
