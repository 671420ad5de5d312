#pragma once
// How long the stages of a run take.
#include <chrono>
#include <string>

namespace blendwright {

struct StageTime {
  std::string stage;
  double seconds = 0.0;
};

/// Seconds since the last lap, or since it was made.
class StopWatch {
 public:
  double lap() {
    const auto now = std::chrono::steady_clock::now();
    const double seconds = std::chrono::duration<double>(now - last_).count();
    last_ = now;
    return seconds;
  }

 private:
  std::chrono::steady_clock::time_point last_ = std::chrono::steady_clock::now();
};

}  // namespace blendwright
