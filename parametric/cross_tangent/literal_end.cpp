#include <memory>
#include <optional>

#include "kernel/base/error.hpp"
#include "kernel/math/formula.hpp"
#include "parametric/cross_tangent/cross_tangent.hpp"

namespace blendwright {
namespace {

/// Three formulas of v.
class Row {
 public:
  Row(const std::string& name, const std::vector<std::string>& texts,
      const std::map<std::string, double>& constants, std::vector<Problem>& problems) {
    if (texts.size() != 3) {
      problems.push_back({name, "has " + std::to_string(texts.size()) + " formulas, must have 3: x, y, z"});
      return;
    }
    for (std::size_t i = 0; i < 3; ++i) try {
        formulas_.emplace_back(texts[i], std::vector<std::string>{"v"}, constants);
      } catch (const InputError& e) {
        for (const Problem& p : e.problems()) problems.push_back({name + "/" + std::to_string(i), p.message});
      }
  }
  [[nodiscard]] Series3 operator()(double v) const {
    const std::vector<Series> argument{Series::variable(v)};
    return {formulas_[0](argument), formulas_[1](argument), formulas_[2](argument)};
  }

  [[nodiscard]] CurveEnclosure enclosed(const TaylorModel& v) const {
    const std::vector<ModelJet> argument{ModelJet::u_variable(v)};
    CurveEnclosure c;
    fill(c, std::array<ModelJet, 3>{formulas_[0](argument), formulas_[1](argument), formulas_[2](argument)});
    return c;
  }

 private:
  std::vector<Formula> formulas_;
};

}  // namespace

EndCondition literal_end(const LiteralEnd& data, CurveDomain domain,
                         const std::map<std::string, double>& constants) {
  std::vector<Problem> problems;
  if (!(domain.v.lo < domain.v.hi))
    problems.push_back({"v", "is an empty range, its start must be below its end"});
  Row C("C", data.C, constants, problems), T("T", data.T, constants, problems);
  std::optional<Row> D;
  if (!data.D.empty()) D.emplace("D", data.D, constants, problems);
  if (!problems.empty()) throw InputError(std::move(problems));
  EndCondition end{domain, D ? Continuity::G2 : Continuity::G1, {}};
  end.enclosure = [C, T, D](const TaylorModel& v) {
    const CurveEnclosure c = C.enclosed(v), t = T.enclosed(v);
    return EndEnclosure{c.D, {t.D[0], t.D[1]}, D ? D->enclosed(v).D[0] : ModelVector{}, {}};
  };
  end.series = [C = std::move(C), T = std::move(T), D = std::move(D)](double v) {
    return EndSeries{C(v), T(v), D ? (*D)(v) : constant(Vec3::Zero())};
  };
  return end;
}

}  // namespace blendwright
