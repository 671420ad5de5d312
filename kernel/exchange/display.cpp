#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <charconv>
#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <sstream>
#include <thread>

#include "kernel/exchange/picture.hpp"
#include "kernel/exchange/render_target.hpp"

namespace blendwright {
namespace {

using namespace std::chrono_literals;

constexpr unsigned trial_seconds =
    10;                            // a display on another machine may be slow; a hung one must not hold us
constexpr auto start_limit = 10s;  // Xvfb is ready after some 0.1 s
constexpr auto stop_limit = 2s;    // then SIGKILL
constexpr int ready_fd = 3;        // where Xvfb writes the number of its display

std::string environment(const char* name) {
  const char* value = std::getenv(name);
  return value ? value : "";
}

/// In a child between fork and exec: signals as in a fresh program, and gone with its parent.
void become_ordinary_child(pid_t parent, int signal_at_parents_death) {
  for (const int s : {SIGABRT, SIGALRM, SIGTERM, SIGINT, SIGUSR1, SIGSEGV, SIGPIPE}) ::signal(s, SIG_DFL);
  sigset_t none;
  ::sigemptyset(&none);
  ::sigprocmask(SIG_SETMASK, &none, nullptr);
  ::prctl(PR_SET_PDEATHSIG, signal_at_parents_death);
  if (::getppid() != parent) ::_exit(127);
  const int nothing = ::open("/dev/null", O_RDWR);
  for (const int fd : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO}) ::dup2(nothing, fd);
}

/// VTK aborts the process when it meets no display, or one without OpenGL 3.2 (ssh -X). So a child draws
/// first.
bool child_can_draw() {
  const pid_t parent = ::getpid();
  const pid_t child = ::fork();
  if (child < 0) return false;
  if (child == 0) {
    become_ordinary_child(parent, SIGKILL);
    const rlimit no_core{0, 0};
    ::setrlimit(RLIMIT_CORE, &no_core);
    ::alarm(trial_seconds);
    ::_exit(RenderTarget::works() ? 0 : 1);
  }
  int status = -1;
  while (::waitpid(child, &status, 0) < 0 && errno == EINTR) continue;
  return WIFEXITED(status) && WEXITSTATUS(status) == 0;
}

bool display_works(const std::string& name) {
  static std::string proven;  // a trial costs some 0.2 s
  if (name.empty()) return false;
  if (name != proven && child_can_draw()) proven = name;
  return name == proven;
}

std::filesystem::path find_program(const char* name) {
  std::istringstream folders(environment("PATH"));
  for (std::string folder; std::getline(folders, folder, ':');) {
    const std::filesystem::path file = std::filesystem::path(folder.empty() ? "." : folder) / name;
    if (::access(file.c_str(), X_OK) == 0 && !std::filesystem::is_directory(file)) return file;
  }
  return {};
}

/// Only calls that are safe after fork in a program with threads.
[[noreturn]] void become_xvfb(const char* program, int ready, pid_t parent) {
  become_ordinary_child(parent, SIGTERM);
  ::setpgid(0, 0);  // Ctrl-C is the program's to handle: without its display VTK would end the process
  ::dup2(ready, ready_fd);
  ::close_range(ready_fd + 1, ~0u, 0);
  // -noreset: else the server starts over when its last client leaves, and refuses a client that comes just
  // then.
  const std::array<const char*, 10> arguments{program, "-screen",    "0", "1600x1200x24", "-nolisten",
                                              "tcp",   "-displayfd", "3", "-noreset",     nullptr};
  ::execv(program, const_cast<char* const*>(arguments.data()));
  ::_exit(127);
}

/// The number that Xvfb writes when it accepts connections; "" when it ends or takes too long.
std::string read_display_number(int fd) {
  std::string number;
  const auto deadline = std::chrono::steady_clock::now() + start_limit;
  for (;;) {
    const auto left =
        std::chrono::duration_cast<std::chrono::milliseconds>(deadline - std::chrono::steady_clock::now());
    pollfd wait{fd, POLLIN, 0};
    const int ready = left > 0ms ? ::poll(&wait, 1, static_cast<int>(left.count())) : 0;
    if (ready < 0 && errno == EINTR) continue;
    char c = 0;
    if (ready <= 0 || ::read(fd, &c, 1) != 1) return {};
    if (c == '\n') return number;
    number += c;
  }
}

void stop(pid_t child) {
  ::kill(child, SIGTERM);  // Xvfb then removes its lock and its socket
  const auto deadline = std::chrono::steady_clock::now() + stop_limit;
  while (::waitpid(child, nullptr, WNOHANG) == 0) {
    if (std::chrono::steady_clock::now() > deadline) {
      ::kill(child, SIGKILL);
      ::waitpid(child, nullptr, 0);
      return;
    }
    std::this_thread::sleep_for(2ms);
  }
}

}  // namespace

Display::Display() : previous_(environment("DISPLAY")) {
  if (display_works(previous_)) {
    available_ = true;
    return;
  }
  const std::string without =
      previous_.empty() ? "DISPLAY is not set" : "nothing can be drawn on DISPLAY " + previous_;
  const std::filesystem::path program = find_program("Xvfb");
  if (program.empty()) {
    reason_ = without + " and Xvfb is not installed; install the package xvfb";
    return;
  }
  std::array<int, 2> ready{};
  if (::pipe2(ready.data(), O_CLOEXEC) != 0) {
    reason_ = without + " and Xvfb cannot be started (no pipe)";
    return;
  }
  const pid_t parent = ::getpid();
  xvfb_ = ::fork();
  if (xvfb_ == 0) become_xvfb(program.c_str(), ready[1], parent);
  ::close(ready[1]);
  const std::string number = xvfb_ > 0 ? read_display_number(ready[0]) : std::string();
  ::close(ready[0]);
  if (number.empty()) {
    if (xvfb_ > 0) stop(xvfb_);
    xvfb_ = -1;
    reason_ = without + " and " + program.string() + " did not start";
    return;
  }
  ::setenv("DISPLAY", (":" + number).c_str(), 1);
  available_ = true;
}

Display::~Display() {
  if (xvfb_ <= 0) return;
  if (previous_.empty()) {
    ::unsetenv("DISPLAY");
  } else {
    ::setenv("DISPLAY", previous_.c_str(), 1);
  }
  stop(xvfb_);
}

}  // namespace blendwright
