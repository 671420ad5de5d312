#include "kernel/exchange/vtk_messages.hpp"

#include <vtkLogger.h>
#include <vtkObjectFactory.h>
#include <vtkOutputWindow.h>

#include <algorithm>

namespace blendwright {
namespace {

class Sink : public vtkOutputWindow {
 public:
  static Sink* New();
  vtkTypeMacro(Sink, vtkOutputWindow) void DisplayText(const char*) override {}
  void DisplayWarningText(const char*) override {}
  void DisplayGenericWarningText(const char*) override {}
  void DisplayDebugText(const char*) override {}
  void DisplayErrorText(const char* text) override {
    if (first_error.empty() && text) first_error = text;
  }
  std::string first_error;

 protected:
  Sink() = default;
};
vtkStandardNewMacro(Sink)

    std::mutex& one_at_a_time() {
  static std::mutex mutex;
  return mutex;
}

}  // namespace

VtkMessages::VtkMessages()
    : alone_(one_at_a_time()), verbosity_(static_cast<int>(vtkLogger::GetCurrentVerbosityCutoff())) {
  vtkLogger::SetStderrVerbosity(vtkLogger::VERBOSITY_OFF);
  Sink* sink = Sink::New();
  vtkOutputWindow::SetInstance(sink);
  sink->Delete();
}

VtkMessages::~VtkMessages() {
  vtkOutputWindow::SetInstance(nullptr);
  vtkLogger::SetStderrVerbosity(static_cast<vtkLogger::Verbosity>(verbosity_));
}

std::string VtkMessages::first_error() const {
  // "ERROR: In file.cxx, line 12\nvtkClass (0x55..): what happened\n\n": the class and its address say
  // nothing to a user.
  const Sink* sink = Sink::SafeDownCast(vtkOutputWindow::GetInstance());
  std::string text = sink ? sink->first_error : std::string();
  const std::size_t address = text.find("): ");
  if (address != std::string::npos) text.erase(0, address + 3);
  std::replace(text.begin(), text.end(), '\n', ' ');
  while (!text.empty() && text.back() == ' ') text.pop_back();
  return text;
}

}  // namespace blendwright
