#include "app/cli/options.hpp"

#include <charconv>
#include <cmath>

namespace blendwright {

CLI::App* verb(CLI::App& app, std::string_view name) {
  for (const VerbInfo& v : verbs_table())
    if (v.name == name) {
      CLI::App* sub = app.add_subcommand(std::string(name), std::string(v.summary));
      sub->footer("\nExample:\n  " + std::string(v.example));
      return sub;
    }
  throw std::logic_error("verb without a row in the table");
}

CLI::Validator positive() {
  const auto check = [](std::string& text) -> std::string {
    double x = 0.0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), x);
    if (error != std::errc() || end != text.data() + text.size()) return "is " + text + ", must be a number";
    return x > 0.0 && std::isfinite(x) ? "" : "is " + text + ", must be > 0";
  };
  return CLI::Validator(check, "NUMBER");
}

CLI::Validator finite() {
  const auto check = [](std::string& text) -> std::string {
    double x = 0.0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), x);
    const bool number = error == std::errc() && end == text.data() + text.size() && std::isfinite(x);
    return number ? "" : "is " + text + ", must be a finite number";
  };
  return CLI::Validator(check, "NUMBER");
}

void add_json(CLI::App* sub, bool& json, bool& times) {
  CLI::Option* flag = sub->add_flag("--json", json, "print the report instead of the table");
  CLI::Option* clock = sub->add_flag("--times", times, "time of each stage in the report");
  if (sub->get_name() == "verify") clock->needs(flag);  // it writes no report
}

void add_threads(CLI::App* sub, std::optional<int>& threads) {
  optional_number(sub, "--threads", threads, "number of threads; the result is the same",
                  CLI::Range(1, 1024));
}

void add_report(CLI::App* sub, std::string& report) {
  sub->add_option("--report", report,
                  "also write a page for people, .html: verdict, pictures, plots, tables");
}

}  // namespace blendwright
