#include "app/view/window/controller.hpp"

#include <algorithm>
#include <cmath>

#include "kernel/base/error.hpp"

namespace blendwright {
namespace {

constexpr double click_slack = 3.0;   // pixels that a click may move
constexpr double handle_reach = 9.0;  // pixels
constexpr double wheel_factor = 1.15;
const Vec3 first_view(1.0, -1.2, 0.8);  // that of pictures

/// Track without the half thumb at its ends.
constexpr double thumb = 6.0;

double fraction_of(const SessionControl& c) {
  if (!(c.high > c.low)) return 0.0;
  if (c.logarithmic) return std::log(c.value / c.low) / std::log(c.high / c.low);
  return (c.value - c.low) / (c.high - c.low);
}

}  // namespace

Controller::Controller(std::vector<std::unique_ptr<Document>> documents, Files files, int width, int height)
    : documents_(std::move(documents)), files_(std::move(files)) {
  state_.width = width;
  state_.height = height;
  refresh();
  state_.camera = state_.camera.looking(first_view);
  fit();
  say("H shows the keys");
}

void Controller::refresh() {
  controls_ = document().controls();
  handles_ = document().handles();
  changes_.shapes = changes_.colours = true;
}

void Controller::say(std::string text, bool warning) {
  state_.message = std::move(text);
  state_.warning = warning;
}

void Controller::tell(const Document::Outcome& outcome) {
  if (!outcome.done || !outcome.message.empty()) say(outcome.message, !outcome.done);
}

ViewChanges Controller::take_changes() { return std::exchange(changes_, {}); }

ViewLayout Controller::layout() const {
  return layout_of({.width = state_.width,
                    .height = state_.height,
                    .panes = documents_.size(),
                    .controls = shown_controls().size(),
                    .page = state_.page,
                    .bar = !bar_title(state_.show, state_.options).empty(),
                    .picked = state_.picked.has_value()});
}

std::vector<std::size_t> Controller::shown_controls() const {
  std::vector<std::size_t> shown;
  for (std::size_t i = 0; i < controls_.size(); ++i)
    if (controls_[i].blend == state_.group) shown.push_back(i);
  return shown;
}

std::string Controller::window_title() const {
  std::string title;
  for (const auto& d : documents_) {
    if (!title.empty()) title += " | ";
    title += d->file().filename().string();
    if (d->changed()) title += '*';
  }
  return title + " - blendwright";
}

std::optional<std::size_t> Controller::pane_at(const Vec2& at) const {
  const ViewLayout places = layout();
  for (std::size_t i = 0; i < places.panes.size(); ++i)
    if (contains(places.panes[i], at)) return i;
  return std::nullopt;
}

std::vector<Vec3> Controller::shown_points() const {
  std::vector<Vec3> points;
  for (const auto& d : documents_)
    for (const DrawnSurface& s : d->surfaces()) {
      if (s.role == DrawnSurface::Role::primary) continue;
      const std::size_t step = std::max<std::size_t>(1, s.positions.size() / 3 / 4096);
      for (std::size_t i = 0; 3 * i + 2 < s.positions.size(); i += step)
        points.push_back(s.origin + Vec3(s.positions[3 * i], s.positions[3 * i + 1], s.positions[3 * i + 2]));
    }
  if (points.empty())
    for (const auto& d : documents_)
      for (const PolyLine& line : d->lines())
        points.insert(points.end(), line.points.begin(), line.points.end());
  return points;
}

void Controller::fit() {
  state_.camera = state_.camera.fitted(shown_points(), layout().panes.front());
  changes_.camera = fitted_ = true;
}

void Controller::look(const Vec3& to_eye) {
  state_.camera = state_.camera.looking(to_eye);
  fit();
}

template <class Reshape>
void Controller::timed(Reshape reshape) {
  const auto start = std::chrono::steady_clock::now();
  const Document::Outcome outcome = reshape();
  changes_.reshape_seconds += std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  ++changes_.reshapes;
  tell(outcome);
  refresh();
}

double Controller::pixel_of(const SessionControl& c, const PixelBox& track) {
  if (c.kind == SessionControl::Kind::choice)
    return track.left + track.width() * (c.value + 0.5) / static_cast<double>(c.choices.size());
  return track.left + thumb + (track.width() - 2.0 * thumb) * std::clamp(fraction_of(c), 0.0, 1.0);
}

double Controller::value_at(const SessionControl& c, const PixelBox& track, double x) {
  if (c.kind == SessionControl::Kind::choice) {
    const auto count = static_cast<double>(c.choices.size());
    return std::clamp(std::floor((x - track.left) / track.width() * count), 0.0, count - 1.0);
  }
  const double t = std::clamp((x - track.left - thumb) / (track.width() - 2.0 * thumb), 0.0, 1.0);
  if (t == 1.0) return c.high;
  return c.logarithmic ? c.low * std::pow(c.high / c.low, t) : c.low + t * (c.high - c.low);
}

PixelBox Controller::reveal(const std::string& control) {
  for (std::size_t i = 0; i < controls_.size(); ++i) {
    if (controls_[i].name != control && controls_[i].label != control) continue;
    state_.group = controls_[i].blend;
    const std::vector<std::size_t> shown = shown_controls();
    const auto place = static_cast<std::size_t>(std::find(shown.begin(), shown.end(), i) - shown.begin());
    for (state_.page = 0;; ++state_.page) {
      const ViewLayout places = layout();
      if (place < places.first_control + places.tracks.size())
        return places.tracks[place - places.first_control];
    }
  }
  std::string known;
  for (const SessionControl& c : controls_) known += (known.empty() ? "\"" : ", \"") + c.name + "\"";
  throw InputError(
      "", "there is no slider \"" + control + "\", must be one of " + (known.empty() ? "none" : known));
}

void Controller::press(Button button, const Vec2& at, bool shift) {
  end_gesture();
  pressed_ = last_ = at;
  moved_ = false;
  const ViewLayout places = layout();
  const std::vector<std::size_t> shown = shown_controls();
  for (std::size_t i = 0; button == Button::left && i < places.tracks.size(); ++i)
    if (contains(places.tracks[i], at)) {
      gesture_ = Gesture::slider;
      dragged_ = shown[places.first_control + i];
      drag_slider(at);
      return;
    }
  const std::optional<std::size_t> pane = pane_at(at);
  if (!pane) return;
  dragged_ = *pane;
  gesture_ = button == Button::left ? Gesture::orbit : Gesture::pan;
  if (button != Button::left || !state_.handles || *pane != state_.active) return;
  if (const auto handle = handle_at(at, handles_, state_.camera, places.panes[*pane], handle_reach)) {
    gesture_ = Gesture::handle;
    state_.held = handles_[*handle];
    state_.held->reach = shift ? SessionHandle::Reach::here : SessionHandle::Reach::whole;
    changes_.shapes = true;
  }
}

void Controller::drag_slider(const Vec2& at) {
  const ViewLayout places = layout();
  const std::vector<std::size_t> shown = shown_controls();
  const auto row = static_cast<std::size_t>(std::find(shown.begin(), shown.end(), dragged_) - shown.begin()) -
                   places.first_control;
  const double value = value_at(controls_[dragged_], places.tracks.at(row), at.x());
  if (value == controls_[dragged_].value) return;
  timed([&] { return document().set(dragged_, value); });
}

void Controller::drag_handle(const Vec2& at) {
  const PixelBox pane = layout().panes[state_.active];
  const SessionHandle handle = *state_.held;
  const Vec3 target = drag_target(handle, at, document().surfaces(), state_.camera, pane);
  timed([&] { return document().drag(handle, target); });
  for (const SessionHandle& h : handles_)
    if (h.kind == handle.kind && h.blend == handle.blend && h.side == handle.side &&
        h.index == handle.index) {
      state_.held = h;
      state_.held->reach = handle.reach;
    }
}

void Controller::move(const Vec2& at) {
  if (gesture_ == Gesture::none) return;
  const bool first = !moved_;
  if (first && (at - pressed_).norm() <= click_slack && gesture_ != Gesture::slider) return;
  moved_ = true;
  const Vec2 by = at - last_;
  last_ = at;
  const PixelBox pane = layout().panes.front();
  if (gesture_ == Gesture::slider) drag_slider(at);
  if (gesture_ == Gesture::handle) drag_handle(at);
  if (gesture_ == Gesture::orbit || gesture_ == Gesture::pan) fitted_ = false;
  if (gesture_ == Gesture::orbit) state_.camera = state_.camera.orbited(by, pane);
  if (gesture_ == Gesture::pan) state_.camera = state_.camera.panned(by, pane);
  changes_.camera = true;
}

void Controller::end_gesture() {
  if (gesture_ == Gesture::slider || (gesture_ == Gesture::handle && moved_)) {
    timed([&] { return document().commit(); });
    --changes_.reshapes;  // the end of one is not another
    // It takes a few tenths of a second: when the hand lets go.
    if (state_.show == Show::deviation) measure_deviations();
  }
  gesture_ = Gesture::none;
  state_.held.reset();
  changes_.shapes = changes_.colours = true;
}

void Controller::release(const Vec2& at) {
  const bool clicked = gesture_ == Gesture::orbit && !moved_;
  const bool handle_clicked = gesture_ == Gesture::handle && !moved_;
  end_gesture();
  if (clicked || handle_clicked) click(at);
}

void Controller::click(const Vec2& at) {
  const std::optional<std::size_t> pane = pane_at(at);
  if (!pane) return;
  if (*pane != state_.active) {
    state_.active = *pane;
    state_.group = state_.page = 0;
    refresh();
  }
  const auto hits = hits_of(
      state_.camera.ray(at, layout().panes[*pane]), document().surfaces(),
      [&](const DrawnSurface& s) { return state_.primaries || s.role != DrawnSurface::Role::primary; });
  if (hits.empty()) {
    state_.picked.reset();
    say("nothing is there to be picked");
    return;
  }
  // Primaries are drawn as glass: what lies behind them is meant.
  const auto solid = std::find_if(hits.begin(), hits.end(), [&](const SurfaceHit& h) {
    return document().surfaces()[h.surface].role != DrawnSurface::Role::primary;
  });
  state_.picked = document().picked(solid != hits.end() ? *solid : hits.front());
  say("picked " + state_.picked->object);
  changes_.shapes = true;
}

void Controller::wheel(double steps, const Vec2& at) {
  const std::optional<std::size_t> pane = pane_at(at);
  if (!pane) return;
  state_.camera = state_.camera.zoomed(std::pow(wheel_factor, steps), at, layout().panes[*pane]);
  fitted_ = false;
  changes_.camera = true;
}

void Controller::resize(int width, int height) {
  if (width == state_.width && height == state_.height) return;
  state_.width = width;
  state_.height = height;
  changes_.camera = changes_.shapes = true;
  if (fitted_) fit();
}

void Controller::key(const std::string& symbol, bool control) {
  if (const auto action = action_of(symbol, control)) act(*action);
}

}  // namespace blendwright
