#pragma once
// Private: STEP files that are damaged. The CAD kernel's reader follows references that lead nowhere, or to
// an entity of another type, into a null pointer; of randomly damaged files it crashed on a third.
#include <Interface_InterfaceModel.hxx>
#include <array>
#include <csignal>
#include <filesystem>
#include <functional>

namespace blendwright::detail {

/// While it lives, crashes of the CAD kernel are thrown as its OSD_Signal; the handlers before are put back.
class SignalGuard {
 public:
  SignalGuard();
  ~SignalGuard();
  SignalGuard(const SignalGuard&) = delete;
  SignalGuard& operator=(const SignalGuard&) = delete;

 private:
  std::array<struct sigaction, 8> before_;
};

/// After the file's text was read, before its shapes are made: throws IoError when an entity of geometry,
/// topology, units or styles could not be read as its type says; names the first and tells how many.
void require_whole_entities(const opencascade::handle<Interface_InterfaceModel>& model,
                            const std::filesystem::path& file);

/// Runs `read` under a SignalGuard. Throws IoError when the file defines a number twice, which the CAD kernel
/// would read for ever, when `read` crashes and where the CAD kernel throws.
void read_guarded(const std::filesystem::path& file, const std::function<void()>& read);

}  // namespace blendwright::detail
