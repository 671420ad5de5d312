#pragma once
// Private to the command line: what the files that declare options share. They are the only ones that see
// CLI11, which is slow to compile.
#include <CLI/CLI.hpp>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include "app/cli/verbs.hpp"
#include "kernel/base/error.hpp"

namespace blendwright {

/// What the verbs are run with, and the exit code that they leave.
struct Program {
  Console console;
  std::string called;  ///< how the program was called
  int code = exit_done;
};

/// The subcommand of a row of verbs_table().
[[nodiscard]] CLI::App* verb(CLI::App& app, std::string_view name);

template <class T>
void optional_number(CLI::App* sub, const char* flag, std::optional<T>& value, const char* help,
                     const CLI::Validator& check) {
  sub->add_option(flag, value, help)->check(check);
}

/// Numbers above zero; the message says that, and no largest double.
[[nodiscard]] CLI::Validator positive();
/// Finite numbers.
[[nodiscard]] CLI::Validator finite();

/// A check that is passed when `read` returns; else the message is what its InputError says.
template <class Read>
CLI::Validator readable(Read read, const char* what) {
  return CLI::Validator(
      [read](std::string& text) -> std::string {
        try {
          static_cast<void>(read(text));
          return "";
        } catch (const InputError& e) {
          return e.problems().front().message;
        }
      },
      what);
}

void add_json(CLI::App* sub, bool& json, bool& times);
void add_threads(CLI::App* sub, std::optional<int>& threads);
void add_report(CLI::App* sub, std::string& report);

// One function per verb: declares its options and what it calls.
void add_blend(CLI::App& app, Program& program);
void add_verify(CLI::App& app, Program& program);
void add_fit(CLI::App& app, Program& program);
void add_mesh(CLI::App& app, Program& program);
void add_eval(CLI::App& app, Program& program);
void add_offset(CLI::App& app, Program& program);
void add_relate(CLI::App& app, Program& program);
void add_collide(CLI::App& app, Program& program);
void add_compare(CLI::App& app, Program& program);
void add_picture(CLI::App& app, Program& program);
void add_view(CLI::App& app, Program& program);

}  // namespace blendwright
