#include "app/cli/console.hpp"

#include <signal.h>
#include <unistd.h>

#include <cmath>
#include <cstdlib>
#include <iostream>
#include <new>

#include "app/cli/text_table.hpp"
#include "kernel/base/error.hpp"

namespace blendwright {
namespace {

// The only thing a signal handler may touch.
volatile sig_atomic_t interrupted = 0;
void remember_interrupt(int) { interrupted = 1; }

void listen(void (*handler)(int)) {
  struct sigaction action {};
  action.sa_handler = handler;
  action.sa_flags = SA_RESTART;
  sigaction(SIGINT, &action, nullptr);
  sigaction(SIGTERM, &action, nullptr);
}

void report_problems(const Console& console, const std::string& subject, const InputError& error) {
  std::string text = subject + ": " + counted(error.problems().size(), "problem");
  for (const Problem& p : error.problems()) {
    text += "\n  ";
    text += p.where.empty() ? p.message : p.where + ": " + p.message;
  }
  console.fail(text);
}

}  // namespace

Console Console::of_process() {
  const bool terminal = isatty(STDERR_FILENO) == 1;
  const char* no_colour = std::getenv("NO_COLOR");
  return Console(std::cout, std::cerr, terminal, terminal && !(no_colour && *no_colour));
}

void Console::warn(std::string_view text) const {
  err_ << (colour_ ? "\x1b[33mwarning:\x1b[0m " : "warning: ") << text << '\n';
}

void Console::fail(std::string_view text) const {
  err_ << (colour_ ? "\x1b[31m" : "") << text << (colour_ ? "\x1b[0m" : "") << '\n';
}

Run::Run(const Console& console, bool quiet)
    : console_(console), quiet_(quiet), start_(std::chrono::steady_clock::now()) {
  interrupted = 0;
  listen(remember_interrupt);
}

Run::~Run() {
  clear();
  listen(SIG_DFL);
}

double Run::seconds() const {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
}

Progress Run::progress() {
  return {[this](double fraction, std::string_view stage) { show(fraction, stage); }, stop_.get_token()};
}

void Run::show(double fraction, std::string_view stage) {
  if (interrupted) {
    stop_.request_stop();
    throw Cancelled("stopped while " + std::string(stage));
  }
  if (quiet_ || !console_.terminal() || seconds() < 1.0) return;
  console_.err() << "\r\x1b[K" << std::lround(100.0 * fraction) << " %  " << stage << std::flush;
  shown_ = true;
}

void Run::clear() {
  if (shown_) console_.err() << "\r\x1b[K" << std::flush;
  shown_ = false;
}

int guarded(const Console& console, const std::string& subject, const std::function<int()>& verb) {
  const auto fail = [&](const std::string& text, int code) {
    // A message about the file itself starts with its name already, perhaps with its folder.
    const std::size_t at = text.find(subject + ": ");
    const bool named = at == 0 || (at != std::string::npos && text[at - 1] == '/' && text.find(": ") > at);
    console.fail(named ? text : subject + ": " + text);
    return code;
  };
  try {
    const int code = verb();
    console.out().flush();
    if (console.out()) return code;
    console.fail("standard output cannot be written; is the disk full?");
    return exit_input_output;
  } catch (const InputError& e) {
    report_problems(console, subject, e);
    return exit_bad_input;
  } catch (const IoError& e) {
    return fail(e.what(), exit_input_output);
  } catch (const Cancelled& e) {
    return fail(e.what(), exit_no_result);
  } catch (const Error& e) {  // GeometryError, ConvergenceError
    return fail(std::string("no result\n  ") + e.what(), exit_no_result);
  } catch (const std::bad_alloc&) {
    return fail("not enough memory", exit_no_result);
  } catch (const std::exception& e) {
    return fail(std::string("unexpected error, please report it: ") + e.what(), exit_no_result);
  } catch (...) {
    return fail("unexpected error, please report it", exit_no_result);
  }
}

std::string shown_name(const std::string& file) {
  if (file == "-") return "<stdin>";
  const std::size_t slash = file.rfind('/');
  return slash == std::string::npos || slash + 1 == file.size() ? file : file.substr(slash + 1);
}

}  // namespace blendwright
