#include "kernel/brep/occt_session.hpp"

#include <Interface_Static.hxx>
#include <Message.hxx>
#include <Message_Messenger.hxx>
#include <STEPControl_Controller.hxx>

namespace blendwright::detail {
namespace {

std::mutex& exchange_mutex() {
  static std::mutex mutex;
  return mutex;
}

}  // namespace

const char* occt_unit_name(LengthUnit unit) {
  switch (unit) {
    case LengthUnit::centimetre:
      return "CM";
    case LengthUnit::metre:
      return "M";
    case LengthUnit::inch:
      return "INCH";
    default:
      return "MM";
  }
}

double millimetres(LengthUnit unit) {
  switch (unit) {
    case LengthUnit::centimetre:
      return 10.0;
    case LengthUnit::metre:
      return 1000.0;
    case LengthUnit::inch:
      return 25.4;
    default:
      return 1.0;
  }
}

ExchangeSession::ExchangeSession(LengthUnit unit) : lock_(exchange_mutex()) {
  const auto& messenger = Message::DefaultMessenger();
  printers_ = messenger->Printers();
  messenger->ChangePrinters().Clear();
  STEPControl_Controller::Init();  // settings do not exist, and setting them does nothing, before this
  Interface_Static::SetCVal("xstep.cascade.unit", occt_unit_name(unit));
}

ExchangeSession::~ExchangeSession() { Message::DefaultMessenger()->ChangePrinters() = printers_; }

}  // namespace blendwright::detail
