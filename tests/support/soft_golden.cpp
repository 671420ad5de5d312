#include "tests/support/soft_golden.hpp"

#include <algorithm>
#include <fstream>
#include <limits>
#include <nlohmann/json.hpp>
#include <numbers>
#include <set>
#include <stdexcept>

namespace blendwright::test {
namespace {

using Json = nlohmann::json;

/// Turns the schema's nested nodes into the named nodes of a scene.
class NodeMaker {
 public:
  explicit NodeMaker(SceneSpec& scene) : scene_(scene) {}

  NodeRef make(const Json& node, const std::string& name) {
    const std::string op = node.at("op");
    return make(op, node, name);
  }

  NodeRef make(const std::string& op, const Json& node, const std::string& name) {
    NodeSpec spec{.name = name, .kind = op, .values = {}};
    for (const auto& [key, value] : node.items())
      if (key != "op") set(spec, key, value);
    finish(op, spec);
    scene_.nodes.push_back(std::move(spec));
    return {name};
  }

 private:
  void set(NodeSpec& spec, const std::string& key, const Json& value) {
    const std::string child = spec.name + "." + key;
    if (key == "args" || key == "arg") {
      set_arguments(spec, value);
    } else if (key == "distance" || key == "contour") {
      spec.values[key] = make(value, child);
    } else if (key == "potential") {
      if (value.contains("s")) spec.values["softness"] = value["s"].get<double>();
      spec.values[key] = value.at("name").get<std::string>();
    } else if (key == "range_map") {
      set_range_map(spec, value);
    } else if (key == "profile") {
      const std::string kind = value.at("kind");
      Json rest = value;
      rest.erase("kind");
      spec.values[key] = make(kind == "lp" ? "lp_profile" : kind, rest, child);
    } else if (key == "axes") {
      const char* names[] = {"x", "y", "z"};
      for (std::size_t i = 0; i < 3; ++i) spec.values[names[i]] = value.at(i).get<std::vector<double>>();
    } else if (key == "twist") {
      spec.values["twist_deg"] = value.get<double>() * 180.0 / std::numbers::pi;
    } else if (key == "angles") {
      const auto a = value.get<std::vector<double>>();
      spec.values["angles_deg"] =
          std::vector<double>{a.at(0) * 180.0 / std::numbers::pi, a.at(1) * 180.0 / std::numbers::pi};
    } else if (key == "normalise") {
      if (value != true) throw std::runtime_error(spec.name + " does not normalise");
    } else if (value.is_number()) {
      spec.values[key] = value.get<double>();
    } else if (value.is_string()) {
      spec.values[key] = value.get<std::string>();
    } else if (value.is_array() && value.at(0).is_number()) {
      spec.values[key] = value.get<std::vector<double>>();
    } else if (value.is_array()) {
      spec.values[key] = value.get<std::vector<std::vector<double>>>();
    } else {
      throw std::runtime_error(spec.name + " has the unknown key " + key);
    }
  }

  void set_arguments(NodeSpec& spec, const Json& value) {
    if (value.is_object()) {
      spec.values["of"] = make(value, spec.name + ".of");
      return;
    }
    std::vector<NodeRef> refs;
    for (std::size_t i = 0; i < value.size(); ++i)
      refs.push_back(make(value[i], spec.name + "." + std::to_string(i)));
    static const std::map<std::string, std::vector<const char*>> keyed{
        {"dilation", {"of", "by"}},
        {"erosion", {"of", "by"}},
        {"ray_scaling", {"of", "by"}},
        {"erosion_after_dilation", {"of", "dilate_by", "erode_by"}}};
    const auto row = keyed.find(spec.kind);
    if (row == keyed.end()) {
      spec.values["of"] = refs;
      return;
    }
    if (refs.size() != row->second.size()) throw std::runtime_error(spec.name + " has too few arguments");
    for (std::size_t i = 0; i < refs.size(); ++i) spec.values[row->second[i]] = refs[i];
  }

  void set_range_map(NodeSpec& spec, const Json& map) {
    const std::string op = map.at("op");
    for (const auto& [key, value] : map.items()) {
      if (key == "op") continue;
      set(spec, key, value);
    }
    if (op == "vir") {
      spec.values["w1"] = spec.values.at("contour");
      spec.values.erase("contour");
    } else if (op != "constant") {
      throw std::runtime_error(spec.name + " has the unknown range map " + op);
    }
  }

  static void finish(const std::string& op, NodeSpec& spec) {
    if (op == "field") spec.kind = "soft_object";
  }

  SceneSpec& scene_;
};

SoftCase read_case(const Json& c) {
  SoftCase r;
  r.id = c.at("id");
  r.kind = c.at("kind");
  r.function = c.at("function");
  static const std::set<std::string> kinds{"potential", "range_map", "vir_map",
                                           "operator",  "distance",  "field"};
  if (!kinds.contains(r.kind)) throw std::runtime_error("unknown kind " + r.kind);
  const Json& params = c.at("params");
  for (const auto& [key, value] : params.items()) {
    if (value.is_number()) r.numbers[key] = value;
    if (value.is_string()) r.words[key] = value;
  }
  if (r.kind == "distance" || r.kind == "field") {
    r.scene.strict = false;
    r.scene.solid = "case";
    NodeMaker maker(r.scene);
    if (r.kind == "field")
      (void)maker.make(params.at("tree"), "case");
    else
      (void)maker.make(r.function, params, "case");
  }
  for (const Json& p : c.at("points")) {
    SoftPoint point{.at = p.at("at").get<std::vector<double>>(),
                    .gradient = p.at("gradient").get<std::vector<double>>(),
                    .smooth = p.at("smooth")};
    const Json& value = p.at("value");
    if (value.is_string() && value != "inf") throw std::runtime_error("unknown value " + value.dump());
    point.value = value.is_string() ? std::numeric_limits<double>::infinity() : value.get<double>();
    if (point.gradient.size() != point.at.size()) throw std::runtime_error("gradient of the wrong length");
    r.points.push_back(std::move(point));
  }
  if (r.points.empty()) throw std::runtime_error("no points");
  return r;
}

}  // namespace

std::vector<SoftCase> read_soft_golden(const std::filesystem::path& folder) {
  std::vector<SoftCase> all;
  std::vector<std::filesystem::path> files;
  for (const auto& entry : std::filesystem::directory_iterator(folder))
    if (entry.path().extension() == ".json") files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  for (const auto& path : files) {
    std::string where = path.filename().string();
    try {
      std::ifstream in(path);
      const Json file = Json::parse(in);
      if (!file.contains("schema") || file["schema"] != "soft-objects/1") continue;
      for (const Json& c : file.at("cases")) {
        where = path.filename().string() + " case " + c.at("id").get<std::string>();
        all.push_back(read_case(c));
      }
    } catch (const std::exception& e) {
      throw std::runtime_error(where + ": " + e.what());
    }
  }
  return all;
}

}  // namespace blendwright::test
