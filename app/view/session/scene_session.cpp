#include "app/view/session/scene_session.hpp"

#include <algorithm>
#include <cmath>
#include <set>

#include "app/json/scene_writer.hpp"
#include "kernel/base/error.hpp"
#include "kernel/base/number_text.hpp"

namespace blendwright {
namespace {

constexpr double wide = 20.0;  // ratio from which on a slider moves by factors

/// The values of the controls: all that a state of the history has.
using Values = std::vector<double>;

void add_references(const NodeValue& value, std::vector<std::string>& names) {
  if (const auto* one = std::get_if<NodeRef>(&value)) names.push_back(one->name);
  if (const auto* many = std::get_if<std::vector<NodeRef>>(&value))
    for (const NodeRef& r : *many) names.push_back(r.name);
}

std::set<std::string> used_nodes(const SceneSpec& spec) {
  std::set<std::string> used;
  std::vector<std::string> next{spec.solid};
  while (!next.empty()) {
    const std::string name = std::move(next.back());
    next.pop_back();
    if (!used.insert(name).second) continue;
    for (const NodeSpec& node : spec.nodes)
      if (node.name == name)
        for (const auto& [key, value] : node.values) add_references(value, next);
  }
  return used;
}

/// One line for the status line.
std::string reason(const Error& e) {
  const auto* input = dynamic_cast<const InputError*>(&e);
  if (!input || input->problems().empty()) return e.what();
  const Problem& first = input->problems().front();
  return first.where.empty() ? first.message : first.where + " " + first.message;
}

}  // namespace

struct SceneSession::State {
  std::string text, name, source_hash;
  SceneSpec opened;
  std::vector<SceneAdjust> adjust;  ///< of nodes that the solid uses
  SceneCells cells;

  Values first, now, committed, saved;
  std::vector<Values> past, future;
  SceneSpec spec;
  MeshResult made;
  bool coarse = false;

  [[nodiscard]] SceneSpec spec_of(const Values& values) const {
    SceneSpec s = opened;
    for (std::size_t i = 0; i < adjust.size(); ++i)  // a key that was left out stays so until it differs
      if (values[i] != first[i]) s = with_number(std::move(s), adjust[i], values[i]);
    return s;
  }

  /// Becomes these values with this mesh, or throws and stays.
  void show(Values values, bool coarsely, const Progress& progress = {}) {
    SceneSpec next = spec_of(values);
    const SceneFile file{name, source_hash, next, build_scene(next)};
    MeshJob job;
    job.cells = cells.fine;
    if (coarsely) job.cells = cells.coarse;
    try {
      made = run_mesh_job(file, job, progress);
    } catch (const GeometryError&) {
      if (!coarsely) throw;
      job.cells = cells.fine;  // what is thinner than a coarse cell
      made = run_mesh_job(file, job, progress);
      coarsely = false;
    }
    coarse = coarsely;
    spec = std::move(next);
    now = std::move(values);
  }

  void end_gesture() {
    if (now == committed) return;
    past.push_back(std::exchange(committed, now));
    future.clear();
  }

  bool step(std::vector<Values>& from, std::vector<Values>& to) {
    end_gesture();
    if (from.empty()) return false;
    try {
      show(from.back(), false);
    } catch (const Error&) {
      return false;  // there was a mesh before: only memory can be short now
    }
    to.push_back(std::exchange(committed, now));
    from.pop_back();
    return true;
  }
};

SceneSession::SceneSession(std::string text, const std::filesystem::path& file, SceneCells cells,
                           const Progress& progress)
    : state_(std::make_unique<State>()) {
  State& s = *state_;
  s.text = std::move(text);
  SceneFile opened = build_scene_text(s.text, file);
  s.name = std::move(opened.name);
  s.source_hash = std::move(opened.source_hash);
  s.opened = std::move(opened.spec);
  s.cells = cells;
  const std::set<std::string> used = used_nodes(s.opened);
  for (SceneAdjust& a : opened.adjust)
    if (used.contains(a.node)) s.adjust.push_back(std::move(a));
  for (const SceneAdjust& a : s.adjust) s.first.push_back(adjusted_number(s.opened, a));
  s.committed = s.saved = s.first;
  s.show(s.first, false, progress);
}
SceneSession::~SceneSession() = default;
SceneSession::SceneSession(SceneSession&&) noexcept = default;
SceneSession& SceneSession::operator=(SceneSession&&) noexcept = default;

std::vector<SessionControl> SceneSession::controls() const {
  std::vector<SessionControl> all;
  for (std::size_t i = 0; i < state_->adjust.size(); ++i) {
    const SceneAdjust& a = state_->adjust[i];
    const bool by_factors = a.range.lo > 0.0 && a.range.hi >= wide * a.range.lo;
    all.push_back({a.name,
                   a.name,
                   0,
                   SessionControl::Kind::number,
                   state_->now[i],
                   a.range.lo,
                   a.range.hi,
                   by_factors,
                   {}});
  }
  return all;
}

const SceneSpec& SceneSession::spec() const { return state_->spec; }
const TriMesh& SceneSession::mesh() const { return state_->made.made.mesh; }
bool SceneSession::coarse() const { return state_->coarse; }

SceneSession::Outcome SceneSession::set(std::size_t control, double value) {
  State& s = *state_;
  const SceneAdjust& a = s.adjust.at(control);
  if (!std::isfinite(value)) return {false, a.name + ": is not a finite number"};
  Values next = s.now;
  next[control] = std::clamp(value, a.range.lo, a.range.hi);
  if (next == s.now) return {};
  try {
    s.show(next, true);
    return {};
  } catch (const Error& e) {
    return {false, a.name + " = " + number_text(next[control], 4) + ": " + reason(e)};
  }
}

SceneSession::Outcome SceneSession::commit() {
  State& s = *state_;
  s.end_gesture();
  if (!s.coarse) return {};
  try {
    s.show(s.now, false);
    return {};
  } catch (const Error& e) {
    return {false, "no fine mesh: " + reason(e)};
  }
}

bool SceneSession::undo() { return state_->step(state_->past, state_->future); }
bool SceneSession::redo() { return state_->step(state_->future, state_->past); }
bool SceneSession::changed() const { return state_->now != state_->saved; }

std::string SceneSession::saved_text() const { return scene_text(state_->text, state_->spec); }
void SceneSession::mark_saved() { state_->saved = state_->now; }

}  // namespace blendwright
