#include "app/pipeline/eval_job.hpp"

#include <limits>

#include "app/json/json_value.hpp"
#include "app/pipeline/result_facts.hpp"
#include "kernel/base/number_text.hpp"
#include "kernel/base/parallel_for.hpp"
#include "kernel/exchange/csv_text.hpp"

namespace blendwright {
namespace {

constexpr std::size_t chunk = 4096;
constexpr double undefined = std::numeric_limits<double>::quiet_NaN();

void sample_chunk(const ScalarField& field, std::span<const Vec3> points, std::span<FieldSample> samples) {
  std::vector<double> x[3];
  for (std::size_t k = 0; k < 3; ++k)
    for (const Vec3& p : points) x[k].push_back(p[static_cast<Eigen::Index>(k)]);
  const PointArrays arrays{x[0], x[1], x[2]};
  const FieldValues values = field.evaluate(Order::hessian, arrays);
  std::vector<std::uint32_t> members(field.members().empty() ? 0 : points.size());
  if (!members.empty()) field.model().nearest_member(arrays, members);
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Vec3 gradient = values.gradient(i);
    samples[i] = {points[i],
                  values.value(i),
                  inside(field.level(), values.value(i)) >= 0.0,
                  gradient,
                  level_curvature(gradient, values.hessian(i), field.level()),
                  members.empty() ? std::nullopt : std::optional(members[i])};
  }
}

std::string name_of(const FieldSample& s, const std::vector<std::string>& members) {
  return s.member && *s.member < members.size() ? members[*s.member] : "";
}

}  // namespace

std::vector<FieldSample> samples_at(const ScalarField& field, std::span<const Vec3> points) {
  std::vector<FieldSample> samples(points.size());
  parallel_for(points.size(), chunk, [&](std::size_t begin, std::size_t end) {
    sample_chunk(field, points.subspan(begin, end - begin), std::span(samples).subspan(begin, end - begin));
  });
  return samples;
}

std::string csv_header() { return "x,y,z,value,inside,gx,gy,gz,mean_curvature,gaussian_curvature,member\n"; }

std::string csv_lines(std::span<const FieldSample> samples, const std::vector<std::string>& members) {
  std::string text;
  const auto add = [&](double x) { text.append(number_text(x + 0.0)).append(1, ','); };  // no -0
  for (const FieldSample& s : samples) {
    for (int k = 0; k < 3; ++k) add(s.point[k]);
    add(s.value);
    text += s.inside ? "1," : "0,";
    for (int k = 0; k < 3; ++k) add(s.gradient[k]);
    if (s.curvature) {
      add(s.curvature->mean);
      add(s.curvature->gaussian);
    } else {
      text += ",,";
    }
    text.append(csv_field(name_of(s, members))).append(1, '\n');
  }
  return text;
}

std::string json_objects(std::span<const FieldSample> samples, const std::vector<std::string>& members) {
  std::string text;
  for (const FieldSample& s : samples) {
    JsonValue object = JsonValue::object(
        {{"point", JsonValue::array({s.point[0], s.point[1], s.point[2]})},
         {"value", s.value},
         {"inside", s.inside},
         {"gradient", JsonValue::array({s.gradient[0], s.gradient[1], s.gradient[2]})},
         {"mean_curvature", s.curvature ? JsonValue(s.curvature->mean) : JsonValue()},
         {"gaussian_curvature", s.curvature ? JsonValue(s.curvature->gaussian) : JsonValue()},
         {"member", s.member ? JsonValue(name_of(s, members)) : JsonValue()}});
    if (!text.empty()) text += ",\n";
    text += json_text(object);
    text.pop_back();  // its line end
  }
  return text;
}

TriMesh sample_cloud(const SceneFile& scene, std::span<const FieldSample> samples) {
  const std::string length = name(scene.spec.unit);
  TriMesh cloud;
  cloud.name = scene.spec.solid;
  cloud.facts = scene_facts(scene.spec);
  cloud.shown = "value";
  cloud.note = "scene " + scene.name + " (" + scene.source_hash + "), solid " + scene.spec.solid;
  Column value{"value", "", 1, {}}, inside{"inside", "", 1, {}}, gradient{"gradient", "1/" + length, 3, {}},
      mean{"mean_curvature", "1/" + length, 1, {}},
      gaussian{"gaussian_curvature", "1/" + length + "^2", 1, {}},
      member{"member", "", 1, {}, scene.scene.field.members()};
  for (const FieldSample& s : samples) {
    cloud.points.push_back(s.point);
    value.values.push_back(s.value);
    inside.values.push_back(s.inside ? 1.0 : 0.0);
    for (int k = 0; k < 3; ++k) gradient.values.push_back(s.gradient[k]);
    mean.values.push_back(s.curvature ? s.curvature->mean : undefined);
    gaussian.values.push_back(s.curvature ? s.curvature->gaussian : undefined);
    member.values.push_back(s.member ? static_cast<double>(*s.member) : -1.0);
  }
  cloud.columns = {std::move(value), std::move(inside),   std::move(gradient),
                   std::move(mean),  std::move(gaussian), std::move(member)};
  return cloud;
}

}  // namespace blendwright
