#include "app/view/window/view_window.hpp"

#include <vtkAutoInit.h>
#include <vtkCallbackCommand.h>
#include <vtkImageData.h>
#include <vtkInteractorStyle.h>
#include <vtkObjectFactory.h>
#include <vtkPNGWriter.h>
#include <vtkPointData.h>

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <utility>

#include "app/view/window/overlay.hpp"
#include "app/view/window/script.hpp"
#include "kernel/base/error.hpp"
#include "kernel/base/text_file.hpp"
#include "kernel/exchange/picture.hpp"
#include "kernel/exchange/vtk_messages.hpp"

VTK_MODULE_INIT(vtkRenderingOpenGL2)
VTK_MODULE_INIT(vtkRenderingFreeType)
VTK_MODULE_INIT(vtkRenderingUI)

namespace blendwright {
namespace {

constexpr double rounding = 1e-15;

}  // namespace

/// Hands the interactor's events to the controller; VTK's own keys and camera are not used.
class ViewWindow::Style : public vtkInteractorStyle {
 public:
  static Style* New();
  vtkTypeMacro(Style, vtkInteractorStyle)

      void OnMouseMove() override {
    give([&](Controller& c) { c.move(at()); });
  }
  void OnLeftButtonDown() override { down(Controller::Button::left); }
  void OnMiddleButtonDown() override { down(Controller::Button::middle); }
  void OnRightButtonDown() override { down(Controller::Button::right); }
  void OnLeftButtonUp() override { up(); }
  void OnMiddleButtonUp() override { up(); }
  void OnRightButtonUp() override { up(); }
  void OnMouseWheelForward() override {
    give([&](Controller& c) { c.wheel(1.0, at()); });
  }
  void OnMouseWheelBackward() override {
    give([&](Controller& c) { c.wheel(-1.0, at()); });
  }
  void OnChar() override {}
  void OnKeyPress() override {
    const char* symbol = Interactor->GetKeySym();
    give([&](Controller& c) { c.key(symbol ? symbol : "", Interactor->GetControlKey() != 0); });
    if (window_->controller_.ended()) Interactor->TerminateApp();
  }
  void OnConfigure() override {
    const int* size = Interactor->GetRenderWindow()->GetSize();
    give([&](Controller& c) { c.resize(size[0], size[1]); });
  }

  ViewWindow* window_ = nullptr;

 protected:
  Style() = default;

 private:
  [[nodiscard]] Vec2 at() const {
    const int* p = Interactor->GetEventPosition();
    return {p[0] + 0.5, p[1] + 0.5};
  }
  template <class Give>
  void give(Give handle) {
    if (!window_) return;
    handle(window_->controller_);
    window_->draw();
  }
  void down(Controller::Button button) {
    give([&](Controller& c) { c.press(button, at(), GetInteractor()->GetShiftKey() != 0); });
  }
  void up() {
    give([&](Controller& c) { c.release(at()); });
  }
};

vtkStandardNewMacro(ViewWindow::Style)

    ViewWindow::ViewWindow(Controller& controller)
    : controller_(controller), style_(vtkSmartPointer<Style>::New()) {
  window_->SetMultiSamples(0);  // edges are smoothed afterwards
  window_->SetDPI(72);          // font sizes are pixels
  window_->SetSize(controller.state().width, controller.state().height);
  window_->SetNumberOfLayers(3);
  for (std::size_t i = 0; i < controller.documents().size(); ++i) {
    panes_.push_back(std::make_unique<PaneScene>());
    panes_.back()->renderer().SetLayer(0);
    window_->AddRenderer(&panes_.back()->renderer());
    panes_.back()->handle_renderer().SetLayer(1);
    window_->AddRenderer(&panes_.back()->handle_renderer());
  }
  painter_.renderer().SetLayer(2);
  window_->AddRenderer(&painter_.renderer());
  interactor_->SetRenderWindow(window_);
  style_->window_ = this;
  interactor_->SetInteractorStyle(style_);
  // A person closes the window as the key Q does: changes that are not saved are asked about once.
  vtkNew<vtkCallbackCommand> closing;
  closing->SetClientData(this);
  closing->SetCallback([](vtkObject*, unsigned long, void* self, void*) {
    auto* window = static_cast<ViewWindow*>(self);
    window->controller_.act(ViewAction::quit);
    window->draw();
    if (window->controller_.ended()) window->interactor_->TerminateApp();
  });
  interactor_->AddObserver(vtkCommand::ExitEvent, closing);
  controller_.set_picture_writer([this](const std::filesystem::path& file) { write_png(file); });
  interactor_->Initialize();
  draw();
}

ViewWindow::~ViewWindow() { style_->window_ = nullptr; }

void ViewWindow::run() { interactor_->Start(); }

void ViewWindow::update_colours() {
  const ViewState& state = controller_.state();
  std::vector<std::vector<std::vector<float>>> values;
  std::vector<double> all;
  for (std::size_t k = 0; k < controller_.documents().size(); ++k) {
    values.push_back(controller_.colour_values(k));
    for (const std::vector<float>& v : values.back()) all.insert(all.end(), v.begin(), v.end());
  }
  // Exact joints have no error at all: a bar needs some length, that of rounding.
  const bool error = state.show == Show::gap || state.show == Show::angle || state.show == Show::deviation;
  if (error && !all.empty() && *std::max_element(all.begin(), all.end()) <= 0.0) all.push_back(rounding);
  scale_.reset();
  if (!all.empty()) scale_ = colour_scale(state.show, state.options, all);
  for (std::size_t i = 0; i < panes_.size(); ++i) panes_[i]->update_colours(state, values[i], scale_);
}

void ViewWindow::set_drawing(bool on) {
  drawing_ = on;
  draw();
}

void ViewWindow::draw() {
  if (!drawing_) return;  // changes are kept until then
  const ViewChanges changes = controller_.take_changes();
  times_.reshapes += changes.reshapes;
  times_.reshape_seconds += changes.reshape_seconds;
  const auto start = std::chrono::steady_clock::now();
  const ViewState& state = controller_.state();
  const ViewLayout places = controller_.layout();
  for (std::size_t i = 0; i < panes_.size(); ++i) {
    if (changes.shapes)
      panes_[i]->update_shapes(*controller_.documents()[i], state,
                               i == state.active ? controller_.handles() : std::vector<SessionHandle>{});
    panes_[i]->aim(state.camera, places.panes[i], state.width, state.height);
  }
  if (changes.colours) update_colours();
  draw_overlay(painter_, controller_, scale_);
  window_->SetWindowName(controller_.window_title().c_str());
  window_->Render();
  times_.draw_seconds += std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  ++times_.draws;
}

void ViewWindow::write_png(const std::filesystem::path& file) {
  const bool drawing = std::exchange(drawing_, true);
  draw();
  drawing_ = drawing;
  const int* size = window_->GetSize();
  vtkNew<vtkUnsignedCharArray> pixels;
  window_->GetPixelData(0, 0, size[0] - 1, size[1] - 1, 0, pixels);
  vtkNew<vtkImageData> image;
  image->SetDimensions(size[0], size[1], 1);
  image->GetPointData()->SetScalars(pixels);
  vtkNew<vtkPNGWriter> writer;
  writer->SetInputData(image);
  writer->WriteToMemoryOn();
  writer->Write();
  vtkUnsignedCharArray* png = writer->GetResult();
  if (!png || writer->GetErrorCode() != 0)
    throw IoError(file.string() + ": cannot be written (no PNG was made)");
  write_text_file(file, {reinterpret_cast<const char*>(png->GetPointer(0)),
                         static_cast<std::size_t>(png->GetNumberOfValues())});
}

void ViewWindow::resize(int width, int height) {
  window_->SetSize(width, height);
  interactor_->UpdateSize(width, height);
  interactor_->InvokeEvent(vtkCommand::ConfigureEvent);
}

void ViewWindow::send(Event event, const Vec2& at, const TypedKey& key) {
  interactor_->SetEventInformation(static_cast<int>(at.x()), static_cast<int>(at.y()), key.control ? 1 : 0,
                                   key.shift ? 1 : 0, 0, 0, key.symbol.c_str());
  switch (event) {
    case Event::left_down:
      interactor_->InvokeEvent(vtkCommand::LeftButtonPressEvent);
      break;
    case Event::left_up:
      interactor_->InvokeEvent(vtkCommand::LeftButtonReleaseEvent);
      break;
    case Event::middle_down:
      interactor_->InvokeEvent(vtkCommand::MiddleButtonPressEvent);
      break;
    case Event::middle_up:
      interactor_->InvokeEvent(vtkCommand::MiddleButtonReleaseEvent);
      break;
    case Event::move:
      interactor_->InvokeEvent(vtkCommand::MouseMoveEvent);
      break;
    case Event::wheel_forward:
      interactor_->InvokeEvent(vtkCommand::MouseWheelForwardEvent);
      break;
    case Event::wheel_backward:
      interactor_->InvokeEvent(vtkCommand::MouseWheelBackwardEvent);
      break;
    case Event::key:
      interactor_->InvokeEvent(vtkCommand::KeyPressEvent);
      break;
  }
}

WindowTimes show_window(std::vector<std::unique_ptr<Document>> documents, const WindowOptions& options,
                        std::ostream& states) {
  std::vector<ScriptStep> steps;
  if (options.script) steps = read_script(*options.script);
  const VtkMessages messages;
  Controller controller(std::move(documents), {options.save, options.replace}, options.width, options.height);
  if (options.dark) controller.act(ViewAction::dark);
  ViewWindow window(controller);
  if (options.script)
    run_script(steps, window, controller, options.times, states);
  else
    window.run();
  return window.times();
}

std::string why_no_window() {
  const char* before = std::getenv("DISPLAY");
  const std::string named = before ? before : "";
  // A display of its own, which Display starts where there is none, would show the window to nobody.
  const Display display;
  const char* now = std::getenv("DISPLAY");
  if (display.available() && now && named == now) return "";
  return named.empty() ? "DISPLAY is not set" : "nothing can be drawn on DISPLAY " + named;
}

}  // namespace blendwright
