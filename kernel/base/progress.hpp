#pragma once
// How long calls report and stop: one thread calls `report` with a monotone fraction; a stop request surfaces
// as Cancelled at the next poll, and no half-built value escapes.
#include <functional>
#include <stop_token>
#include <string_view>

#include "kernel/base/error.hpp"

namespace blendwright {

struct Progress {
  std::function<void(double fraction, std::string_view stage)> report = [](double, std::string_view) {};
  std::stop_token stop;
  /// Polls: throws Cancelled when a stop was asked for, else reports. Call between rows, never per sample.
  void at(double fraction, std::string_view stage) const {
    if (stop.stop_requested()) throw Cancelled("stopped while " + std::string(stage));
    report(fraction, stage);
  }
};

}  // namespace blendwright
