#pragma once
// The errors this library throws: five leaves, no more. A report (fit, continuity, shape check) is not an
// error: bad geometry is a verifier's result.
#include <stdexcept>
#include <string>
#include <vector>

namespace blendwright {

/// what() is one sentence (or a short list) that a user can act on: where, what it is, what it must be, the
/// nearest fix.
class Error : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// One thing wrong with an input. `where` is a JSON pointer ("/primaries/main/radius") or a parameter path
/// relative to the object that was checked ("radius"); `message` says what it is and what it must be.
struct Problem {
  std::string where;
  std::string message;
  bool operator==(const Problem&) const = default;
};

/// The input cannot be used. Carries every problem found, in the order of the input.
class InputError : public Error {
 public:
  explicit InputError(std::vector<Problem> problems);
  InputError(std::string where, std::string message)
      : InputError({Problem{std::move(where), std::move(message)}}) {}
  [[nodiscard]] const std::vector<Problem>& problems() const { return problems_; }
  /// The same problems with `prefix` put before each `where`.
  [[nodiscard]] InputError under(const std::string& prefix) const;

 private:
  std::vector<Problem> problems_;
};

/// No result exists: |Su x Sv| = 0 on the trimline, a resonance of the sweep equation, ...
class GeometryError : public Error {
 public:
  using Error::Error;
};
/// No result was found within the budget of an iteration.
class ConvergenceError : public Error {
 public:
  using Error::Error;
};
/// File system, STEP or VTK reader and writer.
class IoError : public Error {
 public:
  using Error::Error;
};
/// The caller asked to stop.
class Cancelled : public Error {
 public:
  using Error::Error;
};

}  // namespace blendwright
