#include "implicit/fit/fit_model.hpp"

#include <algorithm>
#include <limits>
#include <map>

#include "implicit/scene/node_values.hpp"
#include "kernel/base/error.hpp"
#include "kernel/base/number_text.hpp"

namespace blendwright::detail {
namespace {

using Kind = FitNode::Kind;
using Scale = FitSlot::Scale;

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr Interval lengths{1e-9, 1e9}, exponents{0.1, 60.0}, anywhere{-infinity, infinity};

constexpr const char* what_is_fitted =
    "lp_metric, superquadric, asymmetric_superellipsoid, ray_scaling, place, soft_object or soft_blend";

/// Reads nodes into formulas, children first.
class ModelReader {
 public:
  explicit ModelReader(const SceneSpec& scene) {
    for (const NodeSpec& node : scene.nodes) by_name_[node.name] = &node;
  }

  std::size_t read(const std::string& name) {
    if (const auto known = index_.find(name); known != index_.end()) return known->second;
    const NodeSpec& spec = *by_name_.at(name);
    FitNode node;
    node.name = name;
    if (spec.kind == "lp_metric") {
      form(node, spec, Kind::form_lp, {"a", "b", "c"}, {"n"});
    } else if (spec.kind == "superquadric") {
      form(node, spec, Kind::form_superquadric, {"a", "b", "c"}, {"n1", "n2"});
    } else if (spec.kind == "asymmetric_superellipsoid") {
      asymmetric(node, spec);
    } else if (spec.kind == "ray_scaling") {
      ray_scaling(node, spec);
    } else if (spec.kind == "place") {
      place(node, spec);
    } else if (spec.kind == "soft_object") {
      soft_object(node, spec);
    } else if (spec.kind == "soft_blend") {
      node.kind = Kind::soft_blend;
      for (const std::string& member : names(spec, "of")) node.of.push_back(read(member));
      node.slot = model_.slots.size();
    } else {
      problems_.push_back({pointer_of(spec), "is of kind " + spec.kind + ", must be " + what_is_fitted});
    }
    model_.nodes.push_back(std::move(node));
    return index_[name] = model_.nodes.size() - 1;
  }

  FitModel finish(const SceneSpec& scene) {
    const std::size_t solid = read(scene.solid);
    if (!problems_.empty()) throw InputError(std::move(problems_));
    model_.blend = is_field(solid);
    return std::move(model_);
  }

 private:
  [[nodiscard]] bool is_field(std::size_t i) const {
    const FitNode& n = model_.nodes[i];
    if (n.kind == Kind::place) return is_field(n.of[0]);
    return n.kind == Kind::soft_object || n.kind == Kind::soft_blend;
  }

  static double number(const NodeSpec& spec, const std::string& key, double otherwise) {
    const auto found = spec.values.find(key);
    const double* x = found == spec.values.end() ? nullptr : std::get_if<double>(&found->second);
    return x ? *x : otherwise;
  }
  static std::vector<double> numbers(const NodeSpec& spec, const std::string& key,
                                     std::vector<double> otherwise) {
    const auto found = spec.values.find(key);
    const auto* x = found == spec.values.end() ? nullptr : std::get_if<std::vector<double>>(&found->second);
    return x ? *x : std::move(otherwise);
  }
  static std::vector<std::string> names(const NodeSpec& spec, const std::string& key) {
    const NodeValue& value = spec.values.at(key);
    if (const auto* text = std::get_if<std::string>(&value)) return {*text};
    if (const auto* ref = std::get_if<NodeRef>(&value)) return {ref->name};
    if (const auto* texts = std::get_if<std::vector<std::string>>(&value)) return *texts;
    std::vector<std::string> list;
    if (const auto* refs = std::get_if<std::vector<NodeRef>>(&value))
      for (const NodeRef& r : *refs) list.push_back(r.name);
    return list;
  }

  void slot(const std::string& node, const std::string& key, int index, Scale scale, double value,
            Interval widest, bool free = true) {
    model_.slots.push_back({node, key, index, scale, value, widest, widest, free});
  }

  void form(FitNode& node, const NodeSpec& spec, Kind kind, const std::vector<const char*>& axes,
            const std::vector<const char*>& powers) {
    node.kind = kind;
    node.slot = model_.slots.size();
    for (const char* key : axes)
      slot(spec.name, key, -1, Scale::logarithmic, number(spec, key, 1.0), lengths);
    for (const char* key : powers)
      slot(spec.name, key, -1, Scale::logarithmic, number(spec, key, 2.0), exponents);
  }

  void asymmetric(FitNode& node, const NodeSpec& spec) {
    node.kind = Kind::form_asymmetric;
    node.slot = model_.slots.size();
    for (const char* key : {"x", "y", "z"}) {
      const std::vector<double> both = numbers(spec, key, {1.0, 1.0});
      for (int i = 0; i < 2; ++i)
        slot(spec.name, key, i, Scale::logarithmic, both[static_cast<std::size_t>(i)], lengths);
    }
    slot(spec.name, "n", -1, Scale::logarithmic, number(spec, "n", 2.0), exponents);
  }

  void ray_scaling(FitNode& node, const NodeSpec& spec) {
    node.kind = Kind::ray_scaling;
    for (const char* key : {"of", "by"}) {
      node.of.push_back(read(names(spec, key).at(0)));
      if (model_.nodes[node.of.back()].kind == Kind::place)
        problems_.push_back(
            {pointer_of(spec) + "/" + key, "is a place, must be a form: scale first, place the whole then"});
    }
    node.slot = model_.slots.size();
    slot(spec.name, "n", -1, Scale::linear, number(spec, "n", 0.0), {-60.0, 60.0});
  }

  void place(FitNode& node, const NodeSpec& spec) {
    node.kind = Kind::place;
    node.of.push_back(read(names(spec, "of").at(0)));
    node.slot = model_.slots.size();
    const std::vector<double> move = numbers(spec, "move", {0.0, 0.0, 0.0}),
                              axis = numbers(spec, "axis", {0.0, 0.0, 1.0});
    const double turn = degrees(number(spec, "turn_deg", 0.0)).value;
    if (turn != 0.0)
      node.turn =
          Eigen::AngleAxisd(turn, Vec3(axis[0], axis[1], axis[2]).stableNormalized()).toRotationMatrix();
    for (int i = 0; i < 3; ++i)
      slot(spec.name, "move", i, Scale::linear, move[static_cast<std::size_t>(i)], anywhere);
    for (int i = 0; i < 3; ++i) slot(spec.name, "turn", i, Scale::turn, 0.0, anywhere);
    slot(spec.name, "scale", -1, Scale::logarithmic, number(spec, "scale", 1.0), lengths, false);
  }

  void soft_object(FitNode& node, const NodeSpec& spec) {
    node.kind = Kind::soft_object;
    node.of.push_back(read(names(spec, "distance").at(0)));
    if (const auto w1 = spec.values.find("w1");
        w1 != spec.values.end() && !std::holds_alternative<double>(w1->second))
      problems_.push_back({pointer_of(spec) + "/w1", "is a contour, must be a number to be fitted"});
    const auto potential = spec.values.find("potential");
    const auto* word =
        potential == spec.values.end() ? nullptr : std::get_if<std::string>(&potential->second);
    using Potential = FitNode::Potential;
    const std::map<std::string, Potential> known{{"blanc", Potential::blanc},
                                                 {"wyvill", Potential::wyvill},
                                                 {"gaussian", Potential::gaussian},
                                                 {"gaussian_windowed", Potential::gaussian_windowed}};
    if (word) node.potential = known.at(*word);
    node.slot = model_.slots.size();
    const double w2 = number(spec, "w2", 1.0);
    slot(spec.name, "w1", -1, Scale::logarithmic, number(spec, "w1", 1.0), {std::max(1e-3, 0.5 * w2), 50.0});
    slot(spec.name, "w2", -1, Scale::logarithmic, w2, {1e-9, 1.0}, false);
    slot(spec.name, "softness", -1, Scale::linear, number(spec, "softness", 0.0), {0.0, 1e6}, false);
  }

  std::map<std::string, const NodeSpec*> by_name_;
  std::map<std::string, std::size_t> index_;
  FitModel model_;
  std::vector<Problem> problems_;
};

bool named(const FitSlot& slot, const SceneUnknown& unknown) {
  return slot.node == unknown.node && slot.key == unknown.key;
}

}  // namespace

std::vector<std::size_t> FitModel::free() const {
  std::vector<std::size_t> list;
  for (std::size_t i = 0; i < slots.size(); ++i)
    if (slots[i].free) list.push_back(i);
  return list;
}

FitModel fit_model(const SceneSpec& scene) { return ModelReader(scene).finish(scene); }

void choose_unknowns(FitModel& model, const std::vector<SceneUnknown>& unknowns,
                     std::vector<Problem>& problems) {
  for (FitSlot& slot : model.slots) slot.free = false;
  for (std::size_t i = 0; i < unknowns.size(); ++i) {
    const SceneUnknown& u = unknowns[i];
    const std::string where = "unknowns/" + std::to_string(i), name = u.node + "/" + u.key;
    bool found = false;
    std::vector<std::string> names;
    for (FitSlot& slot : model.slots) {
      names.push_back(slot.node + "/" + slot.key);
      if (!named(slot, u)) continue;
      if (!found && slot.scale != Scale::turn && !(u.bounds.lo < u.bounds.hi))
        problems.push_back({where, name + " is to lie within " + number_text(u.bounds.lo) + " and " +
                                       number_text(u.bounds.hi) +
                                       ", must have a lower bound below its upper one"});
      found = slot.free = true;
      if (slot.scale == Scale::turn) continue;
      slot.bounds = {std::max(u.bounds.lo, slot.widest.lo), std::min(u.bounds.hi, slot.widest.hi)};
      if (u.bounds.lo < u.bounds.hi && !(slot.bounds.lo < slot.bounds.hi))
        problems.push_back({where, name + " must lie within " + number_text(slot.widest.lo) + " and " +
                                       number_text(slot.widest.hi) + ", which its bounds leave out"});
    }
    if (!found)
      problems.push_back({where, name + " is not a number that can be fitted" + suggestion(name, names)});
  }
}

SceneSpec with_values(const SceneSpec& scene, const FitModel& model, std::span<const double> values) {
  SceneSpec out = scene;
  std::map<std::string, NodeSpec*> nodes;
  for (NodeSpec& node : out.nodes) nodes[node.name] = &node;
  for (std::size_t i = 0; i < model.slots.size(); ++i) {
    const FitSlot& slot = model.slots[i];
    if (!slot.free || slot.scale == Scale::turn) continue;
    NodeSpec& node = *nodes.at(slot.node);
    if (slot.index < 0) {
      node.values[slot.key] = values[i];
      continue;
    }
    auto& list = node.values.try_emplace(slot.key, std::vector<double>(3, 0.0)).first->second;
    std::get<std::vector<double>>(list)[static_cast<std::size_t>(slot.index)] = values[i];
  }
  for (const FitNode& n : model.nodes) {
    if (n.kind != Kind::place || !model.slots[n.slot + 3].free) continue;
    const Vec3 w(values[n.slot + 3], values[n.slot + 4], values[n.slot + 5]);
    const Eigen::Matrix3d added = w.norm() > 0.0
                                      ? Eigen::AngleAxisd(w.norm(), w.normalized()).toRotationMatrix()
                                      : Eigen::Matrix3d::Identity();
    const Eigen::AngleAxisd whole(Eigen::Matrix3d(added * n.turn));
    NodeSpec& node = *nodes.at(n.name);
    if (whole.angle() == 0.0) {
      node.values.erase("axis");
      node.values.erase("turn_deg");
    } else {
      node.values["axis"] = std::vector<double>{whole.axis().x(), whole.axis().y(), whole.axis().z()};
      node.values["turn_deg"] = Radians(whole.angle()).degrees();
    }
  }
  return out;
}

}  // namespace blendwright::detail
