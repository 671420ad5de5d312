#include "app/pipeline/show.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "kernel/base/error.hpp"

namespace blendwright {
namespace {

constexpr ShowRow rows[] = {
    {Show::plain, "plain", "the shaded surface", false},
    {Show::gap, "gap", "distance between blend and primary at the trimlines", false},
    {Show::angle, "angle", "angle between the tangent planes at the trimlines", false},
    {Show::curvature, "curvature", "curvature of the surface, or its jump at the trimlines", false},
    {Show::zebra, "zebra", "reflections of parallel strips of light", true},
    {Show::isophotes, "isophotes", "lines of equal angle to the light", true},
    {Show::comb, "comb", "curvature combs along lines of the surface", false},
    {Show::draft, "draft", "angle between the wall and the direction that a mould opens in", false},
    {Show::radius, "radius", "least radius of curvature", false},
    {Show::deviation, "deviation", "signed distance to another input", false},
    {Show::field, "field", "values of a scene's field on a plane", false},
};

constexpr CurvatureRow curvatures[] = {
    {CurvatureFigure::mean, "mean", "mean of the principal curvatures"},
    {CurvatureFigure::gaussian, "gaussian", "product of the principal curvatures"},
    {CurvatureFigure::largest, "largest", "larger principal curvature, with its sign"},
    {CurvatureFigure::least, "least", "smaller principal curvature, with its sign"},
    {CurvatureFigure::jump, "jump", "jump of the normal curvature at the trimlines"},
};

struct Figure {
  std::string_view column, title;
  enum class Unit { none, length, degrees, per_length, per_length2 } unit = Unit::none;
  ScaleRule rule = ScaleRule::linear;
};

Figure curvature_figure(CurvatureFigure figure) {
  using Unit = Figure::Unit;
  switch (figure) {
    case CurvatureFigure::mean:
      return {"mean_curvature", "mean curvature", Unit::per_length, ScaleRule::diverging};
    case CurvatureFigure::gaussian:
      return {"gaussian_curvature", "Gaussian curvature", Unit::per_length2, ScaleRule::diverging};
    case CurvatureFigure::largest:
      return {"largest_curvature", "largest curvature", Unit::per_length, ScaleRule::diverging};
    case CurvatureFigure::least:
      return {"least_curvature", "least curvature", Unit::per_length, ScaleRule::diverging};
    case CurvatureFigure::jump:
      return {"curvature_jump", "curvature jump", Unit::per_length, ScaleRule::by_decades};
  }
  return {};
}

Figure figure_of(Show show, const ShowOptions& options) {
  using Unit = Figure::Unit;
  switch (show) {
    case Show::plain:
      return {};
    case Show::gap:
      return {"gap", "gap", Unit::length, ScaleRule::by_decades};
    case Show::angle:
      return {"angle_deg", "angle", Unit::degrees, ScaleRule::by_decades};
    case Show::curvature:
    case Show::comb:
      return curvature_figure(options.curvature);
    case Show::zebra:
      return {"zebra", "", Unit::none, ScaleRule::linear};
    case Show::isophotes:
      return {"light_angle_deg", "angle to the light", Unit::degrees, ScaleRule::linear};
    case Show::draft:
      return {"draft_deg", "draft angle", Unit::degrees, ScaleRule::diverging};
    case Show::radius:
      return {"least_radius", "least radius", Unit::length, ScaleRule::by_decades};
    case Show::deviation:
      return {"deviation", "deviation", Unit::length, ScaleRule::diverging};
    case Show::field:
      return {"value", "value of the field", Unit::none, ScaleRule::diverging};
  }
  return {};
}

double degrees_of(double radians) { return Radians(radians).degrees(); }

/// sqrt(H^2 - K), which rounding may make negative at umbilics.
double half_difference(double mean, double gaussian) {
  const double d = mean * mean - gaussian;
  return d > 0.0 || std::isnan(d) ? std::sqrt(d) : 0.0;
}

Column derived(const TriMesh& mesh, double (*of)(double mean, double gaussian)) {
  Column column;
  const Column* mean = find_column(mesh, "mean_curvature");
  const Column* gaussian = find_column(mesh, "gaussian_curvature");
  if (!mean || !gaussian) return column;
  for (std::size_t i = 0; i < mean->values.size(); ++i)
    column.values.push_back(of(mean->values[i], gaussian->values[i]));
  return column;
}

using OfNormal = double (*)(const Vec3& normal, const ShowOptions& options);
OfNormal function_of_normal(Show show) {
  switch (show) {
    case Show::zebra:
      return zebra_value;
    case Show::isophotes:
      return light_angle_deg;
    case Show::draft:
      return draft_deg;
    default:
      return nullptr;
  }
}

}  // namespace

std::span<const ShowRow> show_table() { return rows; }
const ShowRow& row_of(Show show) { return rows[static_cast<std::size_t>(show)]; }

std::optional<Show> show_named(std::string_view name) {
  for (const ShowRow& row : rows)
    if (row.name == name) return row.show;
  return std::nullopt;
}

std::span<const CurvatureRow> curvature_table() { return curvatures; }

std::optional<CurvatureFigure> curvature_named(std::string_view name) {
  for (const CurvatureRow& row : curvatures)
    if (row.name == name) return row.figure;
  return std::nullopt;
}

std::string column_of(Show show, const ShowOptions& options) {
  return std::string(figure_of(show, options).column);
}

std::string unit_of(Show show, const ShowOptions& options) {
  const std::string length = name(options.unit);
  switch (figure_of(show, options).unit) {
    case Figure::Unit::none:
      return "";
    case Figure::Unit::length:
      return length;
    case Figure::Unit::degrees:
      return "deg";
    case Figure::Unit::per_length:
      return "1/" + length;
    case Figure::Unit::per_length2:
      return "1/" + length + "^2";
  }
  return "";
}

std::string bar_title(Show show, const ShowOptions& options) {
  std::string title(figure_of(show, options).title);
  const std::string unit = unit_of(show, options);
  if (!title.empty() && !unit.empty()) title.append(" (").append(unit).append(")");
  return title;
}

ScaleRule scale_rule(Show show, const ShowOptions& options) {
  return options.logarithmic ? ScaleRule::logarithmic : figure_of(show, options).rule;
}

ColourScale colour_scale(Show show, const ShowOptions& options, const std::vector<double>& values) {
  return ColourScale::over(values, scale_rule(show, options));
}

const Column* find_column(const TriMesh& mesh, std::string_view name) {
  const auto found =
      std::find_if(mesh.columns.begin(), mesh.columns.end(), [&](const Column& c) { return c.name == name; });
  return found == mesh.columns.end() ? nullptr : &*found;
}

bool add_column(TriMesh& mesh, Show show, const ShowOptions& options) {
  const std::string name = column_of(show, options);
  if (name.empty()) return true;
  const OfNormal of_normal = function_of_normal(show);
  if (of_normal) {  // anew: it depends on the options
    std::erase_if(mesh.columns, [&](const Column& c) { return c.name == name; });
  } else if (find_column(mesh, name)) {
    return true;
  }
  Column column;
  if (of_normal) {
    for (const Vec3& n : mesh.normals) column.values.push_back(of_normal(n, options));
  } else if (show == Show::radius) {
    column = derived(mesh, least_radius);
  } else if (name == "largest_curvature") {
    column = derived(mesh, largest_curvature);
  } else if (name == "least_curvature") {
    column = derived(mesh, least_curvature);
  }
  if (column.values.empty() || column.values.size() != mesh.points.size()) return false;
  column.name = name;
  column.unit = unit_of(show, options);
  mesh.columns.push_back(std::move(column));
  return true;
}

double zebra_phase(const Vec3& normal, const ShowOptions& options) {
  const Vec3 r = 2.0 * normal.dot(options.to_eye) * normal - options.to_eye;
  const double ahead = std::acos(std::clamp(r.dot(options.up), -1.0, 1.0)) / std::numbers::pi - 0.5;
  return options.stripes * ahead + 0.25;  // (1)
}

double zebra_value(const Vec3& normal, const ShowOptions& options) {
  const double phase = zebra_phase(normal, options);
  return phase - std::floor(phase) < 0.5 ? 1.0 : 0.0;
}

double light_angle_deg(const Vec3& normal, const ShowOptions& options) {
  return degrees_of(std::acos(std::min(std::abs(normal.dot(options.to_light)), 1.0)));  // (2)
}

double draft_deg(const Vec3& normal, const ShowOptions& options) {
  return degrees_of(std::asin(std::clamp(normal.dot(options.pull), -1.0, 1.0)));  // (3)
}

double least_radius(double mean, double gaussian) {
  return 1.0 / (std::abs(mean) + half_difference(mean, gaussian));  // (4)
}

double largest_curvature(double mean, double gaussian) { return mean + half_difference(mean, gaussian); }
double least_curvature(double mean, double gaussian) { return mean - half_difference(mean, gaussian); }

void values_of_normals(Show show, const ShowOptions& options, std::span<const float> normals,
                       std::span<float> out) {
  const OfNormal of_normal = function_of_normal(show);
  if (!of_normal)
    throw InputError("show", "is \"" + std::string(row_of(show).name) +
                                 "\", must be zebra, isophotes or draft: the others need more than normals");
  if (normals.size() != 3 * out.size())
    throw InputError("normals", "has " + std::to_string(normals.size()) +
                                    " elements, must have three for each of " + std::to_string(out.size()) +
                                    " values");
  for (std::size_t i = 0; i < out.size(); ++i) {
    const Vec3 n(static_cast<double>(normals[3 * i]), static_cast<double>(normals[3 * i + 1]),
                 static_cast<double>(normals[3 * i + 2]));
    out[i] = static_cast<float>(of_normal(n, options));
  }
}

}  // namespace blendwright
