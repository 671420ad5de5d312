#pragma once
// The program as a process of its own, to be signalled while it runs.
#include <fcntl.h>
#include <signal.h>

#include <array>
#include <chrono>
#include <thread>

#include "tests/app/program.hpp"

namespace blendwright::test {

/// The program with a pipe to its standard input, which stays open until finish(); both of its outputs go to
/// a file.
class Running {
 public:
  Running(const std::vector<std::string>& arguments, const std::string& input, const fs::path& output) {
    std::array<int, 2> pipe{};
    if (::pipe(pipe.data()) != 0) throw std::runtime_error("no pipe");
    input_ = pipe[1];
    process_ = ::fork();
    if (process_ == 0) {
      ::dup2(pipe[0], 0);
      ::close(pipe[0]);
      ::close(pipe[1]);
      const int out = ::open(output.c_str(), O_WRONLY | O_CREAT, 0600);
      ::dup2(out, 1);
      ::dup2(out, 2);
      std::vector<std::string> words = arguments;
      words.insert(words.begin(), "blendwright");
      std::vector<char*> pointers;
      for (std::string& word : words) pointers.push_back(word.data());
      pointers.push_back(nullptr);
      ::execv(BLENDWRIGHT_PROGRAM, pointers.data());
      ::_exit(127);
    }
    ::close(pipe[0]);
    if (::write(input_, input.data(), input.size()) < 0) throw std::runtime_error("cannot write to the pipe");
  }
  /// Waits until the program handles this signal, as the kernel tells.
  [[nodiscard]] bool handles(int signal) const {
    for (int i = 0; i < 1000; ++i) {
      const std::string status = content("/proc/" + std::to_string(process_) + "/status");
      const std::size_t at = status.find("SigCgt:");
      if (at != std::string::npos &&
          (std::strtoull(status.c_str() + at + 7, nullptr, 16) >> (signal - 1) & 1) != 0)
        return true;
      std::this_thread::sleep_for(std::chrono::milliseconds(10));
    }
    return false;
  }
  void send(int signal) const { ::kill(process_, signal); }
  [[nodiscard]] int finish() {
    ::close(input_);
    int status = 0;
    ::waitpid(process_, &status, 0);
    return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
  }

 private:
  pid_t process_ = -1;
  int input_ = -1;
};

}  // namespace blendwright::test
