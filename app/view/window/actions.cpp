// What the keys do: the rest of the controller.
#include <algorithm>

#include "app/view/window/controller.hpp"
#include "kernel/base/error.hpp"
#include "kernel/base/text_file.hpp"

namespace blendwright {
namespace {

namespace fs = std::filesystem;

constexpr std::pair<ViewAction, Show> modes[] = {
    {ViewAction::plain, Show::plain},         {ViewAction::gap, Show::gap},
    {ViewAction::angle, Show::angle},         {ViewAction::curvature, Show::curvature},
    {ViewAction::zebra, Show::zebra},         {ViewAction::isophotes, Show::isophotes},
    {ViewAction::draft, Show::draft},         {ViewAction::radius, Show::radius},
    {ViewAction::deviation, Show::deviation}, {ViewAction::field, Show::field}};

std::string first_problem(const Error& e) {
  const auto* input = dynamic_cast<const InputError*>(&e);
  return input && !input->problems().empty() ? input->problems().front().message : e.what();
}

}  // namespace

void Controller::act(ViewAction action) {
  if (action != ViewAction::save && action != ViewAction::picture && action != ViewAction::step)
    asked_.clear();
  if (action != ViewAction::quit) asked_to_quit_ = false;
  for (const auto& [key, mode] : modes)
    if (key == action) return show(mode);
  changes_.shapes = changes_.colours = changes_.camera = true;
  switch (action) {
    case ViewAction::help:
      state_.help = !state_.help;
      break;
    case ViewAction::next_mode: {
      const auto at = std::find_if(std::begin(modes), std::end(modes),
                                   [&](const auto& m) { return m.second == state_.show; });
      show((at + 1 == std::end(modes) ? std::begin(modes) : at + 1)->second);
      break;
    }
    case ViewAction::comb:
      state_.comb = !state_.comb;
      break;
    case ViewAction::handles:
      state_.handles = !state_.handles;
      break;
    case ViewAction::primaries:
      state_.primaries = !state_.primaries;
      break;
    case ViewAction::dark:
      state_.dark = !state_.dark;
      break;
    case ViewAction::fit:
      fit();
      break;
    case ViewAction::along_x:
      look(Vec3::UnitX());
      break;
    case ViewAction::along_y:
      look(-Vec3::UnitY());
      break;
    case ViewAction::along_z:
      look(Vec3::UnitZ());
      break;
    case ViewAction::next_blend:
      next_group();
      break;
    case ViewAction::next_page:
      state_.page = (state_.page + 1) % layout().pages;
      break;
    case ViewAction::undo:
      step_history(true);
      break;
    case ViewAction::redo:
      step_history(false);
      break;
    case ViewAction::save:
      save(files_.save.empty() ? beside("-edited", ".json") : files_.save, files_.replace);
      break;
    case ViewAction::picture: {
      const fs::path to = beside("", ".png");
      write_file(to, files_.replace, "picture", [&] { write_picture_(to); });
      break;
    }
    case ViewAction::step: {
      const fs::path to = beside("-edited", ".step");
      write_file(to, files_.replace, "STEP", [&] { document().export_step(to); });
      break;
    }
    case ViewAction::escape:
      state_.help = false;
      state_.picked.reset();
      break;
    case ViewAction::quit:
      quit();
      break;
    default:
      break;
  }
}

void Controller::show(Show mode) {
  state_.show = mode;
  for (const auto& d : documents_) d->choose(mode);
  changes_.colours = changes_.shapes = changes_.camera = true;
  if (fitted_) fit();  // a colour bar takes room
  bool any = mode == Show::plain || mode == Show::deviation;
  for (const auto& d : documents_)
    for (std::size_t i = 0; !any && i < d->surfaces().size(); ++i)
      any = !d->values(i, mode, state_.options).empty();
  const std::string name(row_of(mode).name);
  if (mode == Show::deviation) return measure_deviations();
  say(any ? "colours: " + name : "nothing here has the figure \"" + name + "\"", !any);
}

void Controller::step_history(bool back) {
  end_gesture();
  const bool done = back ? document().undo() : document().redo();
  say(done ? (back ? "taken back" : "made again") : (back ? "nothing to take back" : "nothing to make again"),
      !done);
  refresh();
  if (done && state_.show == Show::deviation) measure_deviations();
}

void Controller::next_group() {
  const std::size_t groups = std::max<std::size_t>(1, document().groups().size());
  state_.page = 0;
  if (++state_.group < groups) return;
  state_.group = 0;
  state_.active = (state_.active + 1) % documents_.size();
  refresh();
}

void Controller::quit() {
  const bool unsaved =
      std::any_of(documents_.begin(), documents_.end(), [](const auto& d) { return d->changed(); });
  if (unsaved && !asked_to_quit_) {
    asked_to_quit_ = true;
    return say("changes are not saved: Ctrl+S saves them, Q again leaves", true);
  }
  ended_ = true;
}

fs::path Controller::beside(const char* addition, const char* extension) const {
  const fs::path file = document().file();
  const std::string stem = file == "-" ? "view" : file.stem().string();
  return file.parent_path() / (stem + addition + extension);
}

void Controller::save(const fs::path& to, bool replace) {
  write_file(to, replace, "file", [&] {
    write_text_file(to, document().saved_text());
    document().mark_saved();
  });
}

void Controller::write_file(const fs::path& to, bool replace, const char* what,
                            const std::function<void()>& write) {
  const bool allowed = replace || asked_ == to || written_.count(to) > 0;
  asked_.clear();
  if (!allowed && fs::exists(to)) {
    asked_ = to;
    return say(to.filename().string() + " exists: the same key again replaces it", true);
  }
  try {
    write();
    written_.insert(to);
    say(std::string("wrote the ") + what + " " + to.string());
  } catch (const Error& e) {
    say(std::string("no ") + what + ": " + first_problem(e), true);
  }
}

}  // namespace blendwright
