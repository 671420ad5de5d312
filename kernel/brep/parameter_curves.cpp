#include "kernel/brep/parameter_curves.hpp"

namespace blendwright::detail {

template <int Dim>
BSplineCurve<Dim> joined(const std::vector<BSplineCurve<Dim>>& pieces, bool closed) {
  std::vector<double> breaks;
  std::vector<int> mults;
  std::vector<typename BSplineCurve<Dim>::Point> control;
  const int degree = pieces.front().basis().degree();
  for (const BSplineCurve<Dim>& p : pieces) {
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

template BSplineCurve<2> joined(const std::vector<BSplineCurve<2>>&, bool);
template BSplineCurve<3> joined(const std::vector<BSplineCurve<3>>&, bool);

}  // namespace blendwright::detail
