#pragma once
// How the program talks: results to standard output, everything else to standard error, one exit code per
// outcome.
#include <chrono>
#include <functional>
#include <ostream>
#include <string>
#include <string_view>
#include <vector>

#include "kernel/base/progress.hpp"

namespace blendwright {

/// Exit codes of the program; --help lists them.
struct ExitCode {
  int code;
  std::string_view meaning;
};
inline constexpr int exit_done = 0, exit_not_verified = 1, exit_usage = 2, exit_bad_input = 3,
                     exit_no_result = 4, exit_input_output = 5, exit_defect = 6;
inline constexpr ExitCode exit_codes[] = {
    {exit_done, "done"},
    {exit_not_verified, "built, but not verified, or undecided"},
    {exit_usage, "usage"},
    {exit_bad_input, "bad input"},
    {exit_no_result, "no result"},
    {exit_input_output, "input or output failed"},
    {exit_defect, "two measurements disagree: a defect of the program"}};

class Console {
 public:
  /// `terminal`: standard error is one. `colour`: it may be coloured.
  Console(std::ostream& out, std::ostream& err, bool terminal, bool colour)
      : out_(out), err_(err), terminal_(terminal), colour_(colour) {}
  /// On the program's own streams; NO_COLOR and pipes switch colour off.
  [[nodiscard]] static Console of_process();

  [[nodiscard]] std::ostream& out() const { return out_; }
  [[nodiscard]] std::ostream& err() const { return err_; }
  [[nodiscard]] bool terminal() const { return terminal_; }
  void warn(std::string_view text) const;
  void fail(std::string_view text) const;

 private:
  std::ostream& out_;
  std::ostream& err_;
  bool terminal_ = false;
  bool colour_ = false;
};

/// Progress of one run: a line on a terminal for work over a second, and Ctrl-C as a stop request. One at a
/// time.
class Run {
 public:
  explicit Run(const Console& console, bool quiet);
  ~Run();
  Run(const Run&) = delete;
  Run& operator=(const Run&) = delete;
  [[nodiscard]] Progress progress();
  /// Removes the progress line.
  void clear();
  [[nodiscard]] double seconds() const;

 private:
  void show(double fraction, std::string_view stage);
  const Console& console_;
  bool quiet_ = false, shown_ = false;
  std::stop_source stop_;
  std::chrono::steady_clock::time_point start_;
};

/// Calls `verb`; every error becomes a message about `subject` (a file name) and an exit code.
[[nodiscard]] int guarded(const Console& console, const std::string& subject,
                          const std::function<int()>& verb);

/// The job's name in messages: "<stdin>" for "-".
[[nodiscard]] std::string shown_name(const std::string& file);

}  // namespace blendwright
