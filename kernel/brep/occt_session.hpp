#pragma once
// Private: data exchange of the CAD kernel is process-wide state; one call at a time, and silent.
#include <Message_SequenceOfPrinters.hxx>
#include <mutex>

#include "kernel/base/units.hpp"

namespace blendwright::detail {

/// While it lives, this thread alone uses the STEP translators, and the CAD kernel prints nothing.
class ExchangeSession {
 public:
  /// @param unit  that shapes in memory are in
  explicit ExchangeSession(LengthUnit unit);
  ~ExchangeSession();
  ExchangeSession(const ExchangeSession&) = delete;
  ExchangeSession& operator=(const ExchangeSession&) = delete;

 private:
  std::scoped_lock<std::mutex> lock_;
  Message_SequenceOfPrinters printers_;
};

/// The unit's name in the CAD kernel's settings.
[[nodiscard]] const char* occt_unit_name(LengthUnit unit);
[[nodiscard]] double millimetres(LengthUnit unit);

}  // namespace blendwright::detail
