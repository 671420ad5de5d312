#include "parametric/shape_fit/surface_measures.hpp"

#include <ceres/jet.h>

namespace blendwright::detail {
namespace {

using Number = ceres::Jet<double, jet_size>;
struct V {
  Number x, y, z;
};
V operator+(const V& a, const V& b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
Number dot(const V& a, const V& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
V cross(const V& a, const V& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
V variable(const JetVector& jet, JetPlace place) {
  const auto i = static_cast<int>(place);
  return {Number(jet[place], i), Number(jet[place + 1], i + 1), Number(jet[place + 2], i + 2)};
}
Measure measure(const Number& n) { return {n.a, n.v}; }

}  // namespace

Measure line_curvature(const JetVector& jet) {
  const V Su = variable(jet, at_Su), Sv = variable(jet, at_Sv), Suu = variable(jet, at_Suu);
  const V N = cross(Su, Sv);
  return measure(dot(Suu, N) / (sqrt(dot(N, N)) * dot(Su, Su)));
}

Measure curvature_change(const JetVector& jet) {
  const V Su = variable(jet, at_Su), Sv = variable(jet, at_Sv), Suu = variable(jet, at_Suu),
          Suv = variable(jet, at_Suv), Suuu = variable(jet, at_Suuu);
  const V N = cross(Su, Sv), Nu = cross(Suu, Sv) + cross(Su, Suv);
  const Number NN = dot(N, N), E = dot(Su, Su), area = sqrt(NN), L = dot(Suu, N);
  const Number k = L / (area * E);
  const Number ku =
      (dot(Suuu, N) + dot(Suu, Nu)) / (area * E) - k * (dot(N, Nu) / NN + 2.0 * dot(Su, Suu) / E);
  return measure(ku * sqrt(area / E));
}

std::array<Measure, 2> principal_curvatures(const JetVector& jet) {
  const V Su = variable(jet, at_Su), Sv = variable(jet, at_Sv);
  const V N = cross(Su, Sv);
  const Number NN = dot(N, N), area = sqrt(NN), E = dot(Su, Su), F = dot(Su, Sv), G = dot(Sv, Sv);
  const Number L = dot(variable(jet, at_Suu), N) / area, M = dot(variable(jet, at_Suv), N) / area,
               P = dot(variable(jet, at_Svv), N) / area;
  const Number H = (E * P - 2.0 * F * M + G * L) / (2.0 * NN), K = (L * P - M * M) / NN;
  // At an umbilic the root has no derivative: there both curvatures are H, and their mean slope is taken.
  const Number square = H * H - K;
  if (!(square.a > 1e-14 * (H.a * H.a + std::abs(K.a)))) return {measure(H), measure(H)};
  const Number root = sqrt(square);
  return {measure(H + root), measure(H - root)};
}

Measure normal_along(const JetVector& jet, const Vec3& direction) {
  const V N = cross(variable(jet, at_Su), variable(jet, at_Sv));
  return measure((N.x * direction[0] + N.y * direction[1] + N.z * direction[2]) / sqrt(dot(N, N)));
}

}  // namespace blendwright::detail
