#include "kernel/base/error.hpp"

namespace blendwright {
namespace {

std::string sentence(const std::vector<Problem>& problems) {
  std::string text;
  for (const Problem& p : problems) {
    if (!text.empty()) text += "\n";
    text += p.where.empty() ? p.message : p.where + ": " + p.message;
  }
  return text.empty() ? "invalid input" : text;
}

}  // namespace

InputError::InputError(std::vector<Problem> problems)
    : Error(sentence(problems)), problems_(std::move(problems)) {}

InputError InputError::under(const std::string& prefix) const {
  std::vector<Problem> moved = problems_;
  for (Problem& p : moved) {
    const bool pointer = p.where.empty() || p.where.front() == '/';
    p.where = prefix + (pointer ? "" : "/") + p.where;
  }
  return InputError(std::move(moved));
}

}  // namespace blendwright
