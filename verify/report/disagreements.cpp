// What the second path says against the first.
#include <numbers>

#include "kernel/base/number_text.hpp"
#include "verify/report/blend_report.hpp"

namespace blendwright {

std::vector<std::string> disagreements(const BlendReport& report, LengthUnit unit) {
  std::vector<std::string> texts;
  if (!report.second) return texts;
  constexpr double degree = 180.0 / std::numbers::pi;
  const std::string length = name(unit);
  const auto add = [&](const SecondFigure& f, std::string where, const char* what, const char* parameter,
                       double factor, const std::string& of) {
    if (f.agrees()) return;
    const auto figure = [&](double x) { return number_text(x * factor, 6) + " " + of; };
    where.append(", stage ").append(report.stage).append(": ").append(what).append(" at ");
    where.append(parameter).append(" = ").append(number_text(f.v, 4)).append(" ");
    where += place_text(f.point, report.size) + " is " + figure(f.first) + " by the first measurement, " +
             figure(f.second) + " by the second; they may differ by " + figure(f.bound);
    texts.push_back(std::move(where));
  };
  for (const SecondSeam& seam : report.second->seams) {
    add(seam.gap, seam.name, "gap", "v", 1.0, length);
    add(seam.surface_gap, seam.name, "distance from the primary", "v", 1.0, length);
    add(seam.angle, seam.name, "angle", "v", degree, "deg");
  }
  if (const auto& closing = report.second->closing) {
    add(closing->gap, report.name, "gap of the closing seam", "u", 1.0, length);
    add(closing->angle, report.name, "angle of the closing seam", "u", degree, "deg");
  }
  return texts;
}

}  // namespace blendwright
