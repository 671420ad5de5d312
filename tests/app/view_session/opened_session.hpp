#pragma once
// A worked example opened for shaping.
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <stdexcept>
#include <string>

#include "app/json/job_reader.hpp"
#include "app/view/session/blend_session.hpp"

namespace blendwright::test {

inline std::filesystem::path example_file(const std::string& name) {
  return std::filesystem::path(BLENDWRIGHT_SOURCE_DIR) / "examples/specs" / (name + ".json");
}
inline std::string example_text(const std::string& name) {
  std::ifstream file(example_file(name));
  return {std::istreambuf_iterator<char>(file), {}};
}
inline BlendSession opened(const std::string& name, const std::string& text, std::size_t places = 24) {
  return {text, read_job(text, example_file(name)), places, places};
}
inline BlendSession opened(const std::string& name, std::size_t places = 24) {
  return opened(name, example_text(name), places);
}
inline std::size_t control(const BlendSession& session, const std::string& label) {
  const auto all = session.controls();
  for (std::size_t i = 0; i < all.size(); ++i)
    if (all[i].label == label) return i;
  throw std::out_of_range("no control " + label);
}
inline SessionHandle handle(const BlendSession& session, SessionHandle::Kind kind, std::size_t side,
                            std::size_t index) {
  for (const SessionHandle& h : session.handles())
    if (h.kind == kind && h.side == side && h.index == index) return h;
  throw std::out_of_range("no handle " + std::to_string(index));
}
inline bool same_grid(const SessionGrid& a, const SessionGrid& b) {
  return a.positions == b.positions && a.normals == b.normals && a.gap == b.gap &&
         a.angle_deg == b.angle_deg && a.curvature_jump == b.curvature_jump && a.origin == b.origin;
}
/// Half the length of the diagonal of the grid's box, about.
inline double size_of(const SessionGrid& g) {
  double most = 0.0;
  for (std::size_t k = 0; k < g.positions.size(); k += 3)
    most = std::max(most, std::sqrt(static_cast<double>(g.positions[k] * g.positions[k] +
                                                        g.positions[k + 1] * g.positions[k + 1] +
                                                        g.positions[k + 2] * g.positions[k + 2])));
  return most;
}

}  // namespace blendwright::test
