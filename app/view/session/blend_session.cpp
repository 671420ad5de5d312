#include "app/view/session/blend_session.hpp"

#include <algorithm>
#include <cmath>

#include "app/json/job_writer.hpp"
#include "app/pipeline/build_blend.hpp"
#include "app/view/session/blend_changes.hpp"
#include "app/view/session/blend_grid.hpp"
#include "app/view/session/line_changes.hpp"
#include "kernel/base/error.hpp"
#include "kernel/geometry/curvature.hpp"

namespace blendwright {
namespace {

using Built = std::shared_ptr<const BuiltBlend>;

/// One state of the history: values only, shared where nothing changed.
struct Snapshot {
  std::vector<BlendEntry> entries;
  std::vector<Built> blends;
};

bool same(const Snapshot& a, const Snapshot& b) { return a.blends == b.blends; }

std::array<Seam, 2> seams_of(const BlendEntry& entry, const Blend& blend) {
  const Surface surface(blend.surface);
  return {blend_seam(entry, blend, surface, 0), blend_seam(entry, blend, surface, 1)};
}

}  // namespace

struct BlendSession::State {
  std::string text;
  JobSpec job;  ///< with the blends of `now`
  std::vector<BlendEntry> opened;
  std::vector<BuiltPrimary> built_primaries;
  std::vector<std::pair<std::string, Surface>> primaries;
  Snapshot now, committed, saved;
  std::vector<Snapshot> past, future;
  std::vector<SessionGrid> grids;

  void fill(std::size_t k) {
    const Blend& blend = now.blends[k]->blend;
    fill_grid(blend.surface, seams_of(now.entries[k], blend), grids[k]);
  }
  void show(Snapshot next) {
    const Snapshot before = std::exchange(now, std::move(next));
    job.blends = now.entries;
    for (std::size_t k = 0; k < grids.size(); ++k)
      if (k >= before.blends.size() || before.blends[k] != now.blends[k]) fill(k);
  }
  /// A blend whose trimlines stay where they are keeps them, and its boundary data if only the shape changed.
  [[nodiscard]] Built reshaped(std::size_t k, const BlendEntry& entry, bool sides, bool lines) const {
    std::vector<std::string> warnings;
    if (lines) return std::make_shared<BuiltBlend>(build_blend(entry, job, built_primaries, warnings));
    BuiltBlend b = *now.blends[k];
    if (sides) {
      std::array<SideSpec, 2> specs{entry.sides[0].side, entry.sides[1].side};
      for (std::size_t i = 0; i < 2; ++i) specs[i].keep = b.keep[i];
      b.blend.tangents = cross_tangents(*b.blend.correspondence, specs, job.tolerance.position);
      b.blend.surface = OdeBlend(b.blend.tangents->ends[0], b.blend.tangents->ends[1], entry.shape);
    } else {
      b.blend.surface = OdeBlend(b.blend.surface.end(0), b.blend.surface.end(1), entry.shape);
    }
    return std::make_shared<BuiltBlend>(std::move(b));
  }
  Outcome apply(std::size_t k, ChangedEntry change, bool sides, bool lines) try {
    Snapshot next = now;
    next.blends[k] = reshaped(k, change.entry, sides, lines);
    for (std::size_t other = 0; lines && other < next.blends.size(); ++other)
      if (other != k)
        refuse_crossing(next.entries[other], next.blends[other]->blend, change.entry, next.blends[k]->blend);
    next.entries[k] = std::move(change.entry);
    show(std::move(next));
    return {true, std::move(change.message)};
  } catch (const Error& e) {
    return {false, e.what()};
  }
  Outcome drag_line(const SessionHandle& handle, const Vec3& target);
  Outcome drag_magnitude(const SessionHandle& handle, const Vec3& target);
};

BlendSession::BlendSession(const std::string& text, JobSpec job, std::size_t nu, std::size_t nv)
    : state_(std::make_unique<State>()) {
  State& s = *state_;
  s.text = text;
  s.job = std::move(job);
  s.opened = s.job.blends;
  s.built_primaries = build_primaries(s.job);
  for (const BuiltPrimary& p : s.built_primaries) s.primaries.emplace_back(p.name, p.surface);
  Snapshot first{s.job.blends, {}};
  std::vector<std::string> warnings;
  for (const BlendEntry& entry : first.entries) {
    first.blends.push_back(
        std::make_shared<BuiltBlend>(build_blend(entry, s.job, s.built_primaries, warnings)));
    for (std::size_t other = 0; other + 1 < first.blends.size(); ++other)
      refuse_crossing(first.entries[other], first.blends[other]->blend, entry, first.blends.back()->blend);
  }
  s.grids.resize(first.blends.size());
  for (SessionGrid& g : s.grids) {
    g.nu = std::max<std::size_t>(nu, 2);
    g.nv = std::max<std::size_t>(nv, 2);
  }
  s.committed = s.saved = first;
  s.show(std::move(first));
}
BlendSession::~BlendSession() = default;
BlendSession::BlendSession(BlendSession&&) noexcept = default;
BlendSession& BlendSession::operator=(BlendSession&&) noexcept = default;

std::vector<SessionControl> BlendSession::controls() const {
  std::vector<SessionControl> all;
  for (std::size_t k = 0; k < blends(); ++k)
    for (SessionControl& c : controls_of(state_->now.entries[k], state_->opened[k], k))
      all.push_back(std::move(c));
  return all;
}

std::vector<SessionHandle> BlendSession::handles() const {
  std::vector<SessionHandle> all;
  for (std::size_t k = 0; k < blends(); ++k) {
    if (state_->now.entries[k].literal()) continue;
    const OdeBlend& surface = blend(k).surface;
    const SurfaceDomain domain = surface.domain();
    for (std::size_t side = 0; side < 2; ++side) {
      const Trimline& line = *state_->now.blends[k]->lines[side];
      const std::vector<double> places =
          line_handle_places(*state_->now.entries[k].sides[side].trimline, line.domain().closed);
      for (std::size_t i = 0; i < places.size(); ++i) {
        const double v = line.domain().v.at(places[i]);
        all.push_back({SessionHandle::Kind::trimline, k, side, i, v, line.jet(v).C()});
      }
      for (std::size_t i = 0; i < handles_per_line; ++i) {
        const double v = domain.v.at(handle_place(i, domain.v_closed));
        const SurfaceJet jet = surface.jet({static_cast<double>(side), v});
        const double out = side == 0 ? 1.0 : -1.0;
        all.push_back({SessionHandle::Kind::magnitude, k, side, i, v, jet.S + out / 3.0 * jet.Su});
      }
    }
  }
  return all;
}

std::size_t BlendSession::blends() const { return state_->now.blends.size(); }
const JobSpec& BlendSession::job() const { return state_->job; }
const SessionGrid& BlendSession::grid(std::size_t blend) const { return state_->grids.at(blend); }
const Blend& BlendSession::blend(std::size_t blend) const { return state_->now.blends.at(blend)->blend; }
const std::vector<std::pair<std::string, Surface>>& BlendSession::primaries() const {
  return state_->primaries;
}

BlendSession::Outcome BlendSession::set(std::size_t control, double value) {
  const std::vector<SessionControl> all = controls();
  const SessionControl& c = all.at(control);
  if (!std::isfinite(value)) return {false, c.name + ": is not a finite number"};
  value = std::clamp(value, c.low, c.high);
  if (c.kind == SessionControl::Kind::choice) value = std::round(value);
  if (value == c.value) return {};
  std::size_t index = 0;
  while (index < control && all[control - index - 1].blend == c.blend) ++index;
  try {
    ChangedEntry change =
        changed_entry(state_->now.entries[c.blend], index, value, state_->grids[c.blend].origin);
    return state_->apply(c.blend, std::move(change), index >= 2, false);
  } catch (const Error& e) {
    return {false, e.what()};
  }
}

BlendSession::Outcome BlendSession::State::drag_magnitude(const SessionHandle& handle, const Vec3& target) {
  const OdeBlend& surface = now.blends[handle.blend]->blend.surface;
  const SurfaceDomain domain = surface.domain();
  const SurfaceJet jet = surface.jet({static_cast<double>(handle.side), handle.v});
  const double out = handle.side == 0 ? 1.0 : -1.0;
  const double ratio = 3.0 * out * (target - jet.S).dot(jet.Su) / jet.Su.squaredNorm();
  if (!(ratio > 0.0)) return {false, "the magnitude must stay positive: drag away from the trimline"};
  ChangedEntry change{now.entries[handle.blend]};
  SideSpec& side = change.entry.sides[handle.side].side;
  const double t = (handle.v - domain.v.lo) / (domain.v.hi - domain.v.lo);
  side.factor = reshaped_law(side.factor, t, domain.v_closed, ratio);
  return apply(handle.blend, std::move(change), true, false);
}

BlendSession::Outcome BlendSession::State::drag_line(const SessionHandle& handle, const Vec3& target) {
  ChangedEntry change{now.entries[handle.blend]};
  TrimlineSpec& spec = *change.entry.sides[handle.side].trimline;
  const Trimline& line = *now.blends[handle.blend]->lines[handle.side];
  if (handle.index >= line_handle_places(spec, line.domain().closed).size())
    return {false, "there is no such handle"};
  TrimlineSpec moved = moved_line(spec, line, handle.index, handle.reach, target);
  if (moved.value == spec.value && moved.shift == spec.shift) return {};
  spec = std::move(moved);
  return apply(handle.blend, std::move(change), true, true);
}

BlendSession::Outcome BlendSession::drag(const SessionHandle& handle, const Vec3& target) {
  if (handle.blend >= blends() || handle.side > 1 || state_->now.entries[handle.blend].literal())
    return {false, "there is no such handle"};
  if (!target.allFinite()) return {false, "the place is not finite"};
  return handle.kind == SessionHandle::Kind::trimline ? state_->drag_line(handle, target)
                                                      : state_->drag_magnitude(handle, target);
}

void BlendSession::commit() {
  State& s = *state_;
  if (same(s.now, s.committed)) return;
  s.past.push_back(std::exchange(s.committed, s.now));
  s.future.clear();
}

bool BlendSession::undo() {
  State& s = *state_;
  commit();
  if (s.past.empty()) return false;
  s.future.push_back(std::exchange(s.committed, s.past.back()));
  s.past.pop_back();
  s.show(s.committed);
  return true;
}

bool BlendSession::redo() {
  State& s = *state_;
  commit();
  if (s.future.empty()) return false;
  s.past.push_back(std::exchange(s.committed, s.future.back()));
  s.future.pop_back();
  s.show(s.committed);
  return true;
}

bool BlendSession::changed() const { return !same(state_->now, state_->saved); }

BlendSession::Errors BlendSession::errors(std::size_t blend) const {
  const SessionGrid& g = grid(blend);
  const auto worst = [](const std::vector<float>& column) {
    float most = 0.0F;
    for (const float x : column) {
      if (std::isnan(x)) return static_cast<double>(x);
      most = std::max(most, x);
    }
    return static_cast<double>(most);
  };
  return {worst(g.gap), worst(g.angle_deg), worst(g.curvature_jump)};
}

PickedPoint BlendSession::picked(std::size_t blend, UV at) const {
  const SurfaceJet jet = this->blend(blend).surface.jet(at);
  const SurfaceCurvature c = curvature(jet);
  PickedPoint p;
  p.object = state_->now.entries[blend].name;
  p.point = jet.S;
  p.uv = at;
  p.normal = unit_normal(jet);
  // Convex towards the normal counts as positive, as in pictures.
  p.mean_curvature = -c.mean;
  p.gaussian_curvature = c.gaussian;
  p.least_radius = 1.0 / std::max(std::abs(c.k_min), std::abs(c.k_max));
  const SessionGrid& g = grid(blend);
  const Interval v = this->blend(blend).surface.domain().v;
  const auto nearest = [](double x, std::size_t count) {
    return static_cast<std::size_t>(std::lround(std::clamp(x, 0.0, 1.0) * static_cast<double>(count - 1)));
  };
  const std::size_t point = nearest(at.u, g.nu) * g.nv + nearest((at.v - v.lo) / (v.hi - v.lo), g.nv);
  p.gap = g.gap[point];
  p.angle_deg = g.angle_deg[point];
  p.curvature_jump = g.curvature_jump[point];
  return p;
}

std::string BlendSession::saved_text() const { return job_text(state_->text, state_->job); }
void BlendSession::mark_saved() { state_->saved = state_->now; }

JobResult BlendSession::result(const Progress& progress) const { return run_job(state_->job, progress); }

}  // namespace blendwright
