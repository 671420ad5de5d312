#pragma once
// Private: from events of mouse and keyboard to calls of the documents. It knows pixels but no window, so
// that it can be tested without one.
#include <array>
#include <chrono>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "app/view/window/document.hpp"
#include "app/view/window/keys.hpp"
#include "app/view/window/layout.hpp"
#include "app/view/window/picking.hpp"

namespace blendwright {

/// What is seen besides the documents themselves.
struct ViewState {
  int width = 1280, height = 960;
  Show show = Show::plain;
  ShowOptions options{};
  bool comb = false, handles = true, primaries = true, help = false, dark = false;
  std::size_t active = 0;  ///< the document whose controls are shown
  std::size_t group = 0;   ///< its blend
  std::size_t page = 0;    ///< of its controls
  std::string message{};
  bool warning = false;  ///< the message tells of something that was not done
  std::optional<PickedPoint> picked{};
  ViewCamera camera{};
  std::optional<SessionHandle> held{};
};

/// What the window has to draw anew.
struct ViewChanges {
  bool camera = false, shapes = false, colours = false;
  std::size_t reshapes = 0;
  double reshape_seconds = 0.0;  ///< of these
};

class Controller {
 public:
  struct Files {
    std::filesystem::path save{};  ///< empty: beside the job, "-edited" added to its name
    bool replace = false;          ///< files that exist
  };
  /// One document, or two side by side.
  Controller(std::vector<std::unique_ptr<Document>> documents, Files files, int width, int height);

  [[nodiscard]] const ViewState& state() const { return state_; }
  [[nodiscard]] const std::vector<std::unique_ptr<Document>>& documents() const { return documents_; }
  [[nodiscard]] Document& document() const { return *documents_[state_.active]; }
  [[nodiscard]] ViewLayout layout() const;
  /// Controls of the active document's blend; indices into its controls().
  [[nodiscard]] std::vector<std::size_t> shown_controls() const;
  [[nodiscard]] const std::vector<SessionControl>& controls() const { return controls_; }
  [[nodiscard]] const std::vector<SessionHandle>& handles() const { return handles_; }
  /// What document `index` is coloured by, for each of its surfaces; empty ones have no such figure. The
  /// deviation is that from the other document, of a single one from its shape when it was opened.
  [[nodiscard]] std::vector<std::vector<float>> colour_values(std::size_t index) const;
  [[nodiscard]] std::string window_title() const;
  [[nodiscard]] bool ended() const { return ended_; }
  /// Since the last call.
  [[nodiscard]] ViewChanges take_changes();
  /// What draws a picture of the window into a file.
  void set_picture_writer(std::function<void(const std::filesystem::path&)> writer) {
    write_picture_ = std::move(writer);
  }

  enum class Button { left, middle, right };
  void press(Button button, const Vec2& at, bool shift = false);
  void move(const Vec2& at);
  void release(const Vec2& at);
  void wheel(double steps, const Vec2& at);
  void key(const std::string& symbol, bool control);
  void resize(int width, int height);
  void act(ViewAction action);
  /// Turns to the page and blend of a control; where its slider then lies. Throws InputError: no such
  /// control.
  PixelBox reveal(const std::string& control);

  /// The pixel of a slider's value, and the value of a pixel.
  [[nodiscard]] static double pixel_of(const SessionControl& control, const PixelBox& track);
  [[nodiscard]] static double value_at(const SessionControl& control, const PixelBox& track, double x);

  void save(const std::filesystem::path& to, bool replace);

 private:
  enum class Gesture { none, slider, handle, orbit, pan };
  void say(std::string text, bool warning = false);
  void tell(const Document::Outcome& outcome);
  void refresh();
  void drag_slider(const Vec2& at);
  void drag_handle(const Vec2& at);
  void end_gesture();
  void click(const Vec2& at);
  void show(Show mode);
  /// What document `index` deviates from.
  [[nodiscard]] std::optional<PictureInput> deviation_target(std::size_t index) const;
  /// Of all documents; tells that of the active one.
  void measure_deviations();
  void fit();
  void look(const Vec3& to_eye);
  void step_history(bool back);
  void next_group();
  void quit();
  /// Calls `write` unless the file exists and nobody said that it may go; the second time in a row it may.
  void write_file(const std::filesystem::path& to, bool replace, const char* what,
                  const std::function<void()>& write);
  [[nodiscard]] std::filesystem::path beside(const char* addition, const char* extension) const;
  [[nodiscard]] std::optional<std::size_t> pane_at(const Vec2& at) const;
  [[nodiscard]] std::vector<Vec3> shown_points() const;
  template <class Reshape>
  void timed(Reshape reshape);

  std::vector<std::unique_ptr<Document>> documents_;
  Files files_;
  ViewState state_;
  std::vector<SessionControl> controls_;
  std::vector<SessionHandle> handles_;
  std::vector<std::vector<std::vector<float>>> deviations_;  ///< for each document and part, last measured
  Gesture gesture_ = Gesture::none;
  std::size_t dragged_ = 0;  ///< control, or pane of an orbit
  Vec2 pressed_ = Vec2::Zero(), last_ = Vec2::Zero();
  bool moved_ = false, ended_ = false;
  bool fitted_ = true;             ///< nobody has moved the camera: the object follows the window's size
  std::filesystem::path asked_{};  ///< file about to be replaced when asked again
  bool asked_to_quit_ = false;
  std::set<std::filesystem::path> written_{};  ///< own files may be replaced
  ViewChanges changes_{true, true, true, 0, 0.0};
  std::function<void(const std::filesystem::path&)> write_picture_;
};

}  // namespace blendwright
