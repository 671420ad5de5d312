#include "kernel/brep/step_guard.hpp"

#include <Interface_Check.hxx>
#include <OSD.hxx>
#include <OSD_Signal.hxx>
#include <Standard_ErrorHandler.hxx>
#include <TCollection_HAsciiString.hxx>
#include <algorithm>
#include <cctype>
#include <cstdint>
#include <cstring>
#include <fstream>
#include <iterator>
#include <limits>
#include <string>
#include <vector>

#include "kernel/base/error.hpp"
#include "kernel/brep/occt_geometry.hpp"

namespace blendwright::detail {
namespace {

// Those that OSD::SetSignal takes over.
constexpr std::array<int, 8> signals{SIGHUP, SIGFPE, SIGINT, SIGQUIT, SIGBUS, SIGILL, SIGSEGV, SIGSYS};
constexpr std::array<int, 3> left_alone{SIGHUP, SIGINT, SIGQUIT};  // a person's wish, not a crash

constexpr std::uint64_t largest_number = std::numeric_limits<int>::max();

/// Other entities (of products, approvals, kinematics, ...) do not reach shapes, names and colours.
bool matters(const std::string& type) {
  constexpr std::array<const char*, 5> packages{"StepGeom", "StepShape", "StepRepr", "StepBasic",
                                                "StepVisual"};
  return std::any_of(packages.begin(), packages.end(),
                     [&](const char* package) { return type.rfind(package, 0) == 0; });
}

/// An entity that the file defines: "#12 = ..." at the start of a statement.
struct Definition {
  std::uint64_t number = 0;
  std::size_t line = 0;
};

/// Reads past strings ('it''s') and comments.
class Statements {
 public:
  explicit Statements(const std::string& text) : text_(text) {}

  [[nodiscard]] std::vector<Definition> definitions() {
    std::vector<Definition> all;
    bool at_start = true;  // of a statement
    while (at_ < text_.size()) {
      const char c = text_[at_];
      if (c == '\'') {
        past("'");
      } else if (c == '/' && text_.compare(at_, 2, "/*") == 0) {
        past("*/");
      } else if (c == '#' && at_start) {
        all.push_back({number(), line_});
        at_start = false;
      } else {
        if (c == ';')
          at_start = true;
        else if (std::isspace(static_cast<unsigned char>(c)) == 0)
          at_start = false;
        step();
      }
    }
    return all;
  }

 private:
  void step() { line_ += text_[at_++] == '\n'; }
  void past(const char* end) {
    const std::size_t found = text_.find(end, at_ + 1);
    const std::size_t to = found == std::string::npos ? text_.size() : found + std::strlen(end);
    while (at_ < to) step();
  }
  /// Behind a '#'; too many digits give the largest.
  std::uint64_t number() {
    std::uint64_t n = 0;
    for (++at_; at_ < text_.size() && text_[at_] >= '0' && text_[at_] <= '9'; ++at_)
      n = n > largest_number ? n : 10 * n + static_cast<std::uint64_t>(text_[at_] - '0');
    return n;
  }

  const std::string& text_;
  std::size_t at_ = 0, line_ = 1;
};

/// The CAD kernel's reader never ends on an entity number that is defined twice, and follows one that does
/// not fit an int anywhere.
void require_numbers(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  const std::string text((std::istreambuf_iterator<char>(in)), std::istreambuf_iterator<char>());
  std::vector<Definition> all = Statements(text).definitions();
  std::stable_sort(all.begin(), all.end(),
                   [](const Definition& a, const Definition& b) { return a.number < b.number; });
  for (std::size_t i = 0; i < all.size(); ++i) {
    const std::string where = file.string() + ": is damaged in line " + std::to_string(all[i].line) + ": #";
    if (all[i].number > largest_number)
      throw IoError(where + "... has too many digits; export the part again");
    if (i > 0 && all[i].number == all[i - 1].number)
      throw IoError(where + std::to_string(all[i].number) + " is defined in line " +
                    std::to_string(all[i - 1].line) + " too; export the part again");
  }
}

}  // namespace

SignalGuard::SignalGuard() {
  for (std::size_t i = 0; i < signals.size(); ++i) ::sigaction(signals[i], nullptr, &before_[i]);
  OSD::SetSignal(false);
  for (std::size_t i = 0; i < signals.size(); ++i)
    if (std::find(left_alone.begin(), left_alone.end(), signals[i]) != left_alone.end())
      ::sigaction(signals[i], &before_[i], nullptr);
}

SignalGuard::~SignalGuard() {
  for (std::size_t i = 0; i < signals.size(); ++i) ::sigaction(signals[i], &before_[i], nullptr);
}

void require_whole_entities(const opencascade::handle<Interface_InterfaceModel>& model,
                            const std::filesystem::path& file) {
  std::string first;
  int count = 0;
  for (int i = 1; i <= model->NbEntities(); ++i) {
    const auto check = model->Check(i, true);
    if (!check->HasFailed() && !model->IsErrorEntity(i)) continue;
    const auto entity = model->Value(i);
    if (!matters(entity->DynamicType()->Name())) continue;
    if (++count > 1) continue;
    first = model->StringLabel(entity)->ToCString();
    if (check->NbFails() > 0) first += std::string(": ") + check->CFail(1);
  }
  if (count == 0) return;
  throw IoError(file.string() + ": is damaged: " + std::to_string(count) +
                (count == 1 ? " entity cannot be read, " : " entities cannot be read, the first is ") +
                first + "; export the part again");
}

void read_guarded(const std::filesystem::path& file, const std::function<void()>& read) {
  require_numbers(file);
  const SignalGuard guard;
  guarded<IoError>(file.string(), [&] {
    try {
      OCC_CATCH_SIGNALS
      read();
    } catch (const OSD_Signal&) {
      throw IoError(file.string() +
                    ": cannot be read, the CAD kernel's reader fails on it; it may be damaged, export the "
                    "part again");
    }
  });
}

}  // namespace blendwright::detail
