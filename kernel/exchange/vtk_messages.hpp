#pragma once
// Private: VTK reports by printing; here it is kept instead, for the message of an IoError.
#include <mutex>
#include <string>

namespace blendwright {

/// While it lives, VTK prints nothing and its errors are collected. VTK's output window is one per process,
/// so one of these lives at a time: others wait.
class VtkMessages {
 public:
  VtkMessages();
  ~VtkMessages();
  VtkMessages(const VtkMessages&) = delete;
  VtkMessages& operator=(const VtkMessages&) = delete;
  /// The first error so far in one line, "" when there was none.
  [[nodiscard]] std::string first_error() const;

 private:
  std::unique_lock<std::mutex> alone_;
  int verbosity_;  ///< of VTK's log on stderr before
};

}  // namespace blendwright
