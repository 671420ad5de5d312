#include "app/json/job_keys.hpp"

#include <algorithm>
#include <stdexcept>

#include "app/json/choices.hpp"

namespace blendwright {
namespace {

using Keys = std::vector<KeyInfo>;

KeyInfo positive(std::string name, std::string description) {
  return {std::move(name), "number", std::move(description), false, 0.0, false};
}
KeyInfo not_negative(std::string name, std::string description) {
  return {std::move(name), "number", std::move(description), false, 0.0, true};
}

void add(Keys& keys, Keys more) { keys.insert(keys.end(), more.begin(), more.end()); }

Keys placement_keys() {
  return {{"axis", "axis", "where the surface's own axes lie"},
          {"placement", "axis", "another word for \"axis\", for surfaces that have none"}};
}

/// Keys of a row that are not plain numbers.
Keys special_keys(const PrimaryInfo& row) {
  Keys keys;
  const std::string count = std::to_string(row.text_count);
  if (!row.texts.empty())
    keys.push_back({std::string(row.texts), "formulas" + count,
                    count + " formulas of " +
                        (row.variables.size() == 2 ? "u and v" : std::string(row.variables.front())),
                    !row.takes_points});
  if (!row.texts.empty() && row.takes_points)
    add(keys, {{"points", "points" + count, "points of the profile, instead of formulas"},
               {"closed", "boolean", "true: the profile through the points closes smoothly"}});
  if (row.texts.empty() && row.takes_points)
    add(keys, {{"points", "grid", "control points, one row per u index", true},
               {"degree", "degrees", "degree in u and v; default [3, 3]"},
               {"knots", "knots", "flat knot vectors of u and v; default uniform on [0, 1]"}});
  if (closed_by_direction(row))
    keys.push_back({"closed", "closed_pair", "whether u and v are periodic; default [false, false]"});
  if (row.kind == "extrusion")
    keys.push_back({"direction", "point", "direction of extrusion; default [0, 0, 1]"});
  return keys;
}

ObjectInfo primary_object(const PrimaryInfo& row) {
  ObjectInfo object{"primary " + std::string(row.kind), std::string(row.equation), {}};
  object.keys.push_back({"kind", "primary_kind", "the surface's kind", true});
  for (const ParamInfo& p : row.numbers)
    object.keys.push_back({std::string(p.name), "number", std::string(p.description),
                           p.fallback != p.fallback, p.min, p.min_allowed, p.max});
  add(object.keys, special_keys(row));
  for (std::size_t i = 0; i < 2; ++i)
    object.keys.push_back(
        {parameter_key(row, i), "range",
         std::string("range of ") + (i == 0 ? "u" : "v") + (row.angular[i] ? ", degrees" : ""),
         !row.domain[i].has_value()});
  add(object.keys, placement_keys());
  return object;
}

ObjectInfo step_face_object() {
  ObjectInfo object{"primary step_face",
                    "a face of a STEP file",
                    {{"kind", "primary_kind", "the surface's kind", true},
                     {"file", "text", "the STEP file, relative to the job file's folder", true},
                     {"select", "face_selector", "which face; not needed when there is only one"}}};
  add(object.keys, placement_keys());
  return object;
}

Keys curve_keys(const char* formulas, const char* points, const char* what) {
  return {{"curve", formulas, std::string(what) + " as formulas of v"},
          {"points", points, std::string(what) + ": points it runs through, instead of formulas"},
          {"v", "range", "range of v of the formulas; default [0, 2 pi]"},
          {"closed", "boolean", "true: the curve closes smoothly; default: whether it does"}};
}

ObjectInfo trimline_object(const Choice<TrimlineSpec::Kind>& kind) {
  using enum TrimlineSpec::Kind;
  ObjectInfo object{"trimline " + std::string(kind.name),
                    std::string(kind.description),
                    {{"kind", "trimline", "the trimline's kind", true}}};
  switch (kind.value) {
    case isoline:
      for (const PrimaryInfo& row : primaries_table())
        for (std::size_t i = 0; i < 2; ++i)
          for (const std::string& key : {parameter_key(row, i), parameter_key(row, i, "_rad")})
            if (!object.find(key))
              object.keys.push_back({key, "number", "value of this parameter of the primary"});
      for (const char* key : {"u", "v"})
        if (!object.find(key))
          object.keys.push_back({key, "number", "value of this parameter of the primary"});
      add(object.keys, {{"range", "range", "range of the other parameter; default: all of it"},
                        {"range_deg", "range", "range of the other parameter when it is an angle"},
                        {"range_rad", "range", "the same in radians"}});
      break;
    case parameters:
      add(object.keys, curve_keys("formulas2", "points2", "u and v of the primary"));
      break;
    case projected:
      add(object.keys, curve_keys("formulas3", "points3", "x, y, z of the curve"));
      object.keys.push_back(
          {"direction", "point", "project along this direction; default: to the closest point"});
      break;
    case edge:
    case edge_chain:
      add(object.keys, {{"near", "point", "a point near the edge"},
                        {"curve", "edge_kind", "kind of the edge's curve; default: any"}});
      break;
  }
  object.keys.push_back({"shift", "shifts",
                         "[[t, du, dv], ...]: moves the line along its primary, smoothly between the "
                         "fractions t of its range; in the primary's parameters, angles in radians"});
  return object;
}

Keys side_keys() {
  return {{"primary", "text", "name of the primary"},
          {"trimline", "trimline_object", "where the blend meets the primary"},
          {"continuity", "continuity", "what this side must reach; default G1"},
          {"magnitude", "magnitude", "length of the cross tangent"},
          {"tangent_angle_deg", "number", "turns the cross tangent within the tangent plane", false, -60.0,
           true, 60.0},
          {"tangent_angle_rad", "number", "the same in radians", false, -degrees(60.0).value, true,
           degrees(60.0).value},
          {"keep", "keep", "which part of the primary stays"},
          {"C", "formulas3", "literal boundary data: position as formulas of v"},
          {"T", "formulas3", "literal boundary data: cross tangent as formulas of v"},
          {"D", "formulas3", "literal boundary data: second cross derivative as formulas of v, for G2"}};
}

Keys shape_keys() {
  return {not_negative("tension", "pulls the blend taut; default 0"),
          {"b", "number_or_3", "of b X'''' + c X'' + d X = 0; default 1, must not be 0"},
          {"c", "number_or_3", "default 0"},
          {"d", "number_or_3", "default 0"},
          not_negative("q", "repeated root, instead of b, c, d: c = -2 q^2, d = q^4"),
          {"mode", "mode", "what the sweep equation holds for"},
          {"anchor", "point", "point of mode anchor"},
          {"frame", "frame_or_axes", "axes of b, c and d"},
          {"family", "family", "sixth-order family, used when a side asks for G2"}};
}

ObjectInfo objective_object(const Choice<ObjectiveKind>& kind) {
  ObjectInfo object{"objective " + std::string(kind.name),
                    std::string(kind.description),
                    {{"kind", "objective", "the objective's kind", true},
                     not_negative("weight", "how much it counts among the others; default 1")}};
  using enum ObjectiveKind;
  switch (kind.value) {
    case thin_plate:
    case curvature_variation:
      break;
    case rolling_ball:
      add(object.keys,
          {{"radius", "law", "radius of the ball: a number, or a law [[t, value], ...] along v", true},
           {"across", "range", "part of u in [0, 1] that is to be curved so; default [0.45, 0.55]"}});
      break;
    case pass_through:
      object.keys.push_back({"points", "points", "points of the surface", true});
      break;
    case largest_curvature:
      object.keys.push_back(positive("least_radius", "least radius of curvature, model units"));
      object.keys.back().required = true;
      break;
    case clearance:
      add(object.keys,
          {positive("distance", "least distance, model units"),
           {"to", "text",
            "the obstacle, relative to the job file's folder: a mesh (.stl, .vtp, .ply, .obj) or "
            "a solid (\"scene.json\", \"scene.json#node\")",
            true}});
      object.keys[2].required = true;
      break;
    case no_fold:
      object.keys.push_back({"margin", "number",
                             "least cosine between the normal and that of the start; default 0.05", false,
                             0.0, true, 0.99});
      break;
    case scanned_points:
      add(object.keys,
          {{"file", "text",
            "the points, relative to the job file's folder: lines of x, y, z (.csv), .vtp, .ply, "
            ".stl or .obj",
            true},
           positive("robust_scale",
                    "distances well beyond this one count less and less, model units; default: "
                    "all count")});
      break;
  }
  return object;
}

std::vector<ObjectInfo> fit_objects() {
  return {
      {"fit",
       "What is wanted of the blend's shape: `blendwright fit` finds the parameters",
       {{"objectives", "objectives", "what is wanted, each with its weight", true},
        {"unknowns", "fit_unknowns", "what may change"},
        {"bounds", "fit_bounds", "how far it may change"},
        {"samples", "counts",
         "points across and along the blend where surfaces are looked at; default [12, 48]"},
        {"iterations", "number", "at most so many steps; default 60", false, 1.0, true, 10'000.0},
        {"starts", "number", "further starts, to see whether there is one optimum; default 1", false, 1.0,
         true, 1000.0}}},
      {"fit_unknowns",
       "What a fit may change",
       {{"tension", "boolean", "the tension, or q; default true"},
        {"tension_per_component", "boolean", "three tensions, without G2; default false"},
        {"coefficients", "boolean", "c and d, without G2, instead of the tension; default false"},
        {"magnitudes", "counts",
         "values of the magnitude's law along v, of both sides or [from, to]: 0 keeps it, 1 is constant; "
         "default 6"},
        {"tangent_angle", "booleans",
         "the angle of the cross tangent, of both sides or [from, to]; default false"},
        {"correspondence", "number", "inner values of the map along v; default 0: kept", false, 0.0, true,
         64.0}}},
      {"fit_bounds",
       "How far the unknowns may go",
       {{"tension", "range", "default [0.001, 50]"},
        {"magnitude", "range", "of the cross tangent over the distance of the trimlines; default [0.05, 5]"},
        {"tangent_angle_deg", "number", "largest angle; default 60", false, 0.0, false, 60.0},
        {"least_speed", "number", "least slope of the map along v; default 0.05", false, 0.0, false, 1.0},
        not_negative("prior", "weight of the pull towards the start; default 0.001")}}};
}

std::vector<ObjectInfo> plain_objects() {
  return {
      {"job",
       "A job of blendwright: surfaces and the blends between them",
       {{"$schema", "text", "for editors"},
        {"description", "text", "for people"},
        {"unit", "unit", "unit of all lengths; default mm"},
        {"let", "constants", "named constants for formulas; later ones may use earlier ones"},
        {"primaries", "primaries", "surfaces, by name"},
        {"blends", "blends", "blends, by name", true},
        {"tolerance", "tolerance", "what counts as continuous"},
        {"output", "output", "files to write"}}},
      {"blend",
       "A blend from one trimline (u = 0) to another (u = 1)",
       {{"from", "side", "the side u = 0", true},
        {"to", "side", "the side u = 1", true},
        {"shape", "shape", "how the blend runs between its sides"},
        {"correspondence", "correspondence", "which points of the trimlines are joined"},
        {"fit", "fit", "what is wanted of the shape; only `blendwright fit` acts on it"},
        {"v", "range", "literal boundary data: range of v"},
        {"closed", "boolean",
         "literal boundary data: true when they close smoothly; default: whether they do"}}},
      {"side", "One side of a blend", side_keys()},
      {"magnitude",
       "Length of the cross tangent",
       {{"rule", "magnitude_rule", "default circle_like"},
        {"factor", "law",
         "factor of the rule: a number, or a law [[t, value], ...] with t in [0, 1] along v"}}},
      {"shape", "Shape controls", shape_keys()},
      {"frame_axes",
       "A fixed frame",
       {{"fixed", "axes", "three perpendicular unit vectors, right-handed", true}}},
      {"correspondence",
       "Which points of the trimlines are joined",
       {{"rule", "correspondence_rule", "default arc_length"},
        {"reverse", "boolean",
         "true: the second trimline runs backwards; default: decided from the geometry"},
        {"seam_offset", "number",
         "closed trimlines: where the second one starts, as a fraction of its length; default: nearest"},
        {"map", "pairs",
         "rule mapped: [[t, fraction of the second trimline that is joined to the fraction t of the first], "
         "...]"}}},
      {"tolerance",
       "What counts as continuous",
       {positive("position", "largest gap, model units; default 1e-6"),
        positive("angle_deg", "largest angle between tangent planes; default 1e-3"),
        positive("curvature", "largest jump of normal curvature, 1/model unit; default 1e-4")}},
      {"output",
       "Files to write",
       {{"formats", "formats", "default [\"step\", \"vtp\", \"png\"]"},
        {"step_schema", "step_schema", "default AP242"}}},
      {"axis",
       "A placement",
       {{"origin", "point", "where its origin lies; default [0, 0, 0]"},
        {"direction", "point", "where the surface's z axis points; default [0, 0, 1]"},
        {"x_direction", "point", "where its x axis points, as far as the direction allows"}}},
      {"face_selector",
       "Chooses one face by geometry",
       {{"surface", "face_kind", "kind of its surface; default: any"},
        {"near", "point", "a point near the face"}}}};
}

}  // namespace

const KeyInfo* ObjectInfo::find(std::string_view key) const {
  const auto at = std::find_if(keys.begin(), keys.end(), [&](const KeyInfo& k) { return k.name == key; });
  return at == keys.end() ? nullptr : &*at;
}

const std::vector<ObjectInfo>& job_objects() {
  static const std::vector<ObjectInfo> all = [] {
    std::vector<ObjectInfo> objects = plain_objects();
    for (const PrimaryInfo& row : primaries_table()) objects.push_back(primary_object(row));
    objects.push_back(step_face_object());
    for (const auto& kind : trimline_choices()) objects.push_back(trimline_object(kind));
    for (ObjectInfo& object : fit_objects()) objects.push_back(std::move(object));
    for (const auto& kind : objective_choices()) objects.push_back(objective_object(kind));
    return objects;
  }();
  return all;
}

const ObjectInfo& job_object(std::string_view name) {
  for (const ObjectInfo& object : job_objects())
    if (object.name == name) return object;
  throw std::out_of_range("no object of a job is named " + std::string(name));
}

const std::vector<std::string>& primary_kinds() {
  static const std::vector<std::string> kinds = [] {
    std::vector<std::string> names;
    for (const PrimaryInfo& row : primaries_table()) names.emplace_back(row.kind);
    names.emplace_back(step_face_kind);
    return names;
  }();
  return kinds;
}

bool closed_by_direction(const PrimaryInfo& row) {
  return row.variables.size() == 2 || (row.texts.empty() && row.takes_points);
}

std::string parameter_key(const PrimaryInfo& row, std::size_t direction, const char* unit) {
  return std::string(row.parameters[direction]) + (row.angular[direction] ? unit : "");
}

}  // namespace blendwright
