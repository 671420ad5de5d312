#include "kernel/brep/parameter_curves.hpp"

namespace blendwright::detail {

BSplineCurve<2> joined(const std::vector<BSplineCurve<2>>& pieces, bool closed) {
  std::vector<double> breaks;
  std::vector<int> mults;
  std::vector<Vec2> control;
  const int degree = pieces.front().basis().degree();
  for (const BSplineCurve<2>& p : pieces) {
    const bool first = breaks.empty();
    if (!first) {
      breaks.pop_back();
      mults.pop_back();
      control.pop_back();
    }
    breaks.insert(breaks.end(), p.basis().breaks().begin(), p.basis().breaks().end());
    mults.insert(mults.end(), p.basis().multiplicities().begin(), p.basis().multiplicities().end());
    if (!first) mults[mults.size() - p.basis().multiplicities().size()] = degree;
    control.insert(control.end(), p.control().begin(), p.control().end());
  }
  if (closed) {
    mults.front() = mults.back() = degree;
    control.pop_back();
  }
  return {BSplineBasis(degree, std::move(breaks), std::move(mults), closed), std::move(control)};
}

}  // namespace blendwright::detail
