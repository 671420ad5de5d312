#pragma once
// Private: the window itself, its interactor, and what it draws.
#include <vtkNew.h>
#include <vtkRenderWindow.h>
#include <vtkRenderWindowInteractor.h>

#include <filesystem>
#include <memory>
#include <vector>

#include "app/view/window/controller.hpp"
#include "app/view/window/painter.hpp"
#include "app/view/window/pane_scene.hpp"
#include "app/view/window/window.hpp"

namespace blendwright {

class ViewWindow {
 public:
  explicit ViewWindow(Controller& controller);
  ~ViewWindow();
  ViewWindow(const ViewWindow&) = delete;
  ViewWindow& operator=(const ViewWindow&) = delete;
  /// Waits for events until the controller has ended or the window is closed.
  void run();
  /// Draws what changed since the last time.
  void draw();
  /// Off: draw() does nothing and what changed is drawn when it is on again.
  void set_drawing(bool on);
  void write_png(const std::filesystem::path& file);
  void resize(int width, int height);
  [[nodiscard]] const WindowTimes& times() const { return times_; }

  // Events as the interactor gets them from X; positions from the lower left corner.
  enum class Event { left_down, left_up, middle_down, middle_up, move, wheel_forward, wheel_backward, key };
  void send(Event event, const Vec2& at, const TypedKey& key = {});

 private:
  class Style;
  void update_colours();

  Controller& controller_;
  vtkNew<vtkRenderWindow> window_;
  vtkNew<vtkRenderWindowInteractor> interactor_;
  vtkSmartPointer<Style> style_;
  std::vector<std::unique_ptr<PaneScene>> panes_;
  Painter painter_;
  std::optional<ColourScale> scale_;
  WindowTimes times_;
  bool drawing_ = true;
};

}  // namespace blendwright
