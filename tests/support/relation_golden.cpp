#include "tests/support/relation_golden.hpp"

#include <algorithm>
#include <fstream>
#include <nlohmann/json.hpp>
#include <stdexcept>

namespace blendwright::test {
namespace {

using Json = nlohmann::json;
using Keys = std::set<std::string>;

/// What a function's cases say. Keys in `optional` may be missing in a sample.
struct Function {
  Keys parameters, sample, optional;
};

const std::map<std::string, Function>& functions() {
  static const std::map<std::string, Function> all = [] {
    const Keys point{"x", "value", "gradient"}, foot{"x", "value", "gradient", "foot"},
        extreme{"x", "value", "gradient", "argument"}, hessian{"x", "value", "gradient", "hessian"},
        body{"base", "perturbations"}, trims{"centre", "trim_1", "trim_2"};
    const auto with = [](Keys a, const Keys& b) {
      a.insert(b.begin(), b.end());
      return a;
    };
    std::map<std::string, Function> m{
        {"quadric", {{"A"}, hessian, {}}},
        {"perturbation", {{"weight", "k", "q"}, point, {}}},
        {"freeform", {body, hessian, {}}},
        {"level_conversion", {{}, {"native", "frep", "zero_level", "constructive", "half_level"}, {}}},
        {"iso_offset", {with(body, {"C"}), point, {}}},
        {"along_normal_offset", {with(body, {"D"}), point, {}}},
        {"constant_radius_offset_quadric", {{"A", "D", "external"}, extreme, {}}},
        {"constant_radius_offset_freeform", {with(body, {"D", "external"}), extreme, {}}},
        {"opening_of_box", {{"half", "r"}, point, {}}},
        {"closing_of_right_angle", {{"r"}, point, {}}},
        {"r_alpha", {{"alpha", "union"}, point, {}}},
        {"r_0m", {{"m", "union"}, point, {}}},
        {"liming", {{"u"}, point, {}}},
        {"liming_clipped", {{"c_a", "c_b", "r", "u"}, point, {}}},
        {"rockwood", {{"r", "w"}, point, {}}},
        {"rockwood_displacement", {{"r", "w"}, point, {}}},
        {"pasko_savchenko_blend", {{"a", "union"}, point, {}}},
        {"bounded_blend", {{"a", "union"}, point, {}}},
        {"quadric_box",
         {{"A"}, {"centre", "half", "remapped", "sum_bound", "tight_bound", "exact_range"}, {}}},
        {"rolling_ball_sphere_plane", {{"sphere_radius", "sphere_height", "r"}, with(trims, {"angle"}), {}}},
        {"rolling_ball_two_cylinders",
         {{"radius_about_x", "radius_about_z", "r"}, with(trims, {"angle"}), {}}},
        {"rolling_ball_ellipsoid_plane",
         {{"semi_axes", "height", "r"}, with(trims, {"azimuth_parameter"}), {}}},
        {"rolling_ball_two_paraboloids",
         {{"a1", "b1", "a2", "b2", "x0", "r"}, with(trims, {"v", "parameters_1", "parameters_2"}), {}}},
        {"rolling_ball_sphere_paraboloid",
         {{"a1", "b1", "sphere_radius", "sphere_centre", "r"}, with(trims, {"azimuth"}), {}}},
        {"point_membership", {body, {"x", "value", "s2", "s3"}, {}}},
        {"collision",
         {{},
          {"kind", "gap", "collide", "witness"},
          {"r1", "c1", "r2", "c2", "midpoint", "semi_axes", "torus", "body_1", "body_2", "mirror_x",
           "x_extent"}}},
    };
    for (const char* solid : {"sphere", "ellipsoid", "torus", "box"})
      m[std::string("signed_distance_") + solid] = {{"size"}, foot, {}};
    for (const char* operation : {"ricci_intersection", "ricci_union", "ricci_difference"})
      m[operation] = {{"p"}, point, {}};
    return m;
  }();
  return all;
}

void check_keys(const Json& object, const Keys& required, const Keys& optional, const std::string& what) {
  for (const auto& [key, value] : object.items())
    if (!required.contains(key) && !optional.contains(key))
      throw std::runtime_error(what + " has the unknown key " + key);
  for (const std::string& key : required)
    if (!object.contains(key)) throw std::runtime_error(what + " has no " + key);
}

/// Bodies are read elsewhere.
const Keys body_keys{"base", "perturbations", "q", "body_1"};

void read_values(const Json& object, RelationValues& to) {
  for (const auto& [key, value] : object.items()) {
    if (body_keys.contains(key)) continue;
    if (value.is_null())
      to.nulls.insert(key);
    else if (value.is_boolean())
      to.flags[key] = value;
    else if (value.is_number())
      to.numbers[key] = value;
    else if (value.is_string())
      to.words[key] = value;
    else if (value.is_array())
      to.lists[key] = value.get<std::vector<double>>();
    else
      throw std::runtime_error(key + " has the wrong shape");
  }
}

NodeSpec quadric(std::string name, const Json& coefficients) {
  const auto a = coefficients.get<std::vector<double>>();
  if (a.size() != 10) throw std::runtime_error(name + " has not ten coefficients");
  return {.name = std::move(name), .kind = "quadric", .values = {{"coefficients", a}}};
}

/// Adds the perturbation `name` and its quadric.
void add_perturbation(SceneSpec& scene, const std::string& name, const Json& p) {
  check_keys(p, {"weight", "k", "q"}, {}, name);
  scene.nodes.push_back(quadric(name + " q", p.at("q")));
  scene.nodes.push_back({.name = name,
                         .kind = "perturbation",
                         .values = {{"of", NodeRef{name + " q"}},
                                    {"weight", p.at("weight").get<double>()},
                                    {"power", p.at("k").get<double>()}}});
}

SceneSpec freeform(const std::string& name, const Json& body) {
  SceneSpec scene;
  scene.solid = name;
  scene.nodes.push_back(quadric("base", body.at("base")));
  std::vector<NodeRef> bumps;
  for (const Json& p : body.at("perturbations")) {
    bumps.push_back({"bump " + std::to_string(bumps.size())});
    add_perturbation(scene, bumps.back().name, p);
  }
  NodeSpec node{.name = name, .kind = "freeform", .values = {{"base", NodeRef{"base"}}}};
  if (!bumps.empty()) node.values["bumps"] = bumps;
  scene.nodes.push_back(std::move(node));
  return scene;
}

SceneSpec one_node(const std::string& kind, std::map<std::string, NodeValue> values) {
  SceneSpec scene;
  scene.solid = "case";
  scene.nodes.push_back({.name = "case", .kind = kind, .values = std::move(values)});
  return scene;
}

SceneSpec exact_distance(const std::string& solid, const std::vector<double>& size) {
  if (solid == "sphere") return one_node(solid, {{"radius", size.at(0)}});
  if (solid == "ellipsoid") return one_node(solid, {{"a", size.at(0)}, {"b", size.at(1)}, {"c", size.at(2)}});
  if (solid == "torus") return one_node(solid, {{"ring", size.at(0)}, {"tube", size.at(1)}});
  return one_node(solid, {{"half", size}});
}

SceneSpec body_of(const std::string& function, const Json& parameters) {
  if (parameters.contains("A")) {
    SceneSpec scene;
    scene.solid = "case";
    scene.nodes.push_back(quadric("case", parameters.at("A")));
    return scene;
  }
  if (parameters.contains("base")) return freeform("case", parameters);
  if (function == "perturbation") {
    SceneSpec scene;
    scene.solid = "case";
    add_perturbation(scene, "case", parameters);
    return scene;
  }
  const std::string distance = "signed_distance_";
  if (function.starts_with(distance))
    return exact_distance(function.substr(distance.size()), parameters.at("size"));
  if (function == "opening_of_box") return exact_distance("box", parameters.at("half"));
  return {};
}

void check_shapes(const RelationSample& s) {
  const auto x = s.lists.find("x"), gradient = s.lists.find("gradient");
  if (x != s.lists.end() && gradient != s.lists.end() && x->second.size() != gradient->second.size())
    throw std::runtime_error("gradient of the wrong length");
  if (x != s.lists.end() && s.nulls.contains("x")) throw std::runtime_error("no x");
}

RelationCase read_case(const Json& c, std::size_t index) {
  RelationCase r;
  r.function = c.at("function");
  r.id = r.function + " " + std::to_string(index);
  const auto row = functions().find(r.function);
  if (row == functions().end()) throw std::runtime_error("unknown function " + r.function);
  check_keys(c, {"function", "parameters", "samples"}, {}, "case");
  check_keys(c.at("parameters"), row->second.parameters, {}, "parameters");
  read_values(c.at("parameters"), r.parameters);
  r.scene = body_of(r.function, c.at("parameters"));
  for (const Json& s : c.at("samples")) {
    check_keys(s, row->second.sample, row->second.optional, "sample");
    RelationSample sample;
    read_values(s, sample);
    if (s.contains("body_1")) sample.body = freeform("body_1", s.at("body_1"));
    check_shapes(sample);
    r.samples.push_back(std::move(sample));
  }
  if (r.samples.empty()) throw std::runtime_error("no samples");
  return r;
}

}  // namespace

std::set<std::string> relation_functions() {
  Keys names;
  for (const auto& [name, function] : functions()) names.insert(name);
  return names;
}

std::vector<RelationCase> read_relation_golden(const std::filesystem::path& folder) {
  std::vector<RelationCase> all;
  std::vector<std::filesystem::path> files;
  for (const auto& entry : std::filesystem::directory_iterator(folder))
    if (entry.path().extension() == ".json") files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  for (const auto& path : files) {
    std::string where = path.filename().string();
    try {
      std::ifstream in(path);
      const Json file = Json::parse(in);
      if (!file.contains("schema") || file["schema"] != "perturbation_offset/1") continue;
      std::size_t index = 0;
      for (const Json& c : file.at("cases")) {
        where = path.filename().string() + " case " + std::to_string(index);
        all.push_back(read_case(c, index++));
      }
    } catch (const std::exception& e) {
      throw std::runtime_error(where + ": " + e.what());
    }
  }
  return all;
}

}  // namespace blendwright::test
