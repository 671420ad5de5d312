// Enclosures of a blend along its ends; equation (1) of ode_blend.hpp in Taylor models.
#include "parametric/ode/ode_blend.hpp"

namespace blendwright {
namespace {

ModelVector normalized(const ModelVector& x) { return pow(dot(x, x), -0.5) * x; }

ModelVector in_frame(const std::array<ModelVector, 3>& axes, const ModelVector& x) {
  return {dot(axes[0], x), dot(axes[1], x), dot(axes[2], x)};
}

ModelVector out_of_frame(const std::array<ModelVector, 3>& axes, const ModelVector& x) {
  return x[0] * axes[0] + x[1] * axes[1] + x[2] * axes[2];
}

}  // namespace

std::array<ModelVector, 3> OdeBlend::frame(const EndEnclosure& e0, const EndEnclosure& e1) const {
  if (shape_.frame != BlendFrame::moving) {
    const Eigen::Matrix3d axes =
        shape_.frame == BlendFrame::fixed ? shape_.axes : Eigen::Matrix3d::Identity();
    return {constant_model(axes.col(0)), constant_model(axes.col(1)), constant_model(axes.col(2))};
  }
  const ModelVector x = normalized(e1.C[0] - e0.C[0]);
  const ModelVector sum = normalized(cross(e0.T[0], e0.C[1])) + normalized(cross(e1.T[0], e1.C[1]));
  const ModelVector z = normalized(sum - dot(sum, x) * x);
  return {x, cross(z, x), z};
}

ModelVector OdeBlend::bend(std::size_t side, const EndEnclosure& e0, const EndEnclosure& e1) const {
  std::array<ModelVector, 4> B{e0.C[0], e0.T[0], e1.C[0], e1.T[0]};
  if (shape_.mode == BlendMode::chord) {
    const ModelVector De = e1.C[0] - e0.C[0];
    B = {ModelVector{}, e0.T[0] - De, ModelVector{}, e1.T[0] - De};
  } else if (shape_.mode == BlendMode::anchor) {
    B[0] = B[0] - constant_model(shape_.anchor);
    B[2] = B[2] - constant_model(shape_.anchor);
  }
  // With one equation for all components the frame of (1) goes in and out again.
  const bool turns =
      shape_.frame == BlendFrame::fixed || (shape_.frame == BlendFrame::moving && !shape_.isotropic());
  const std::array<ModelVector, 3> axes = turns ? frame(e0, e1) : std::array<ModelVector, 3>{};
  ModelVector sum{};
  for (std::size_t k = 0; k < 4; ++k) {
    const ModelVector local = turns ? in_frame(axes, B[k]) : B[k];
    for (std::size_t x = 0; x < 3; ++x) sum[x] = sum[x] + TaylorModel(bends_[x].value[side][k]) * local[x];
  }
  return turns ? out_of_frame(axes, sum) : sum;
}

void OdeBlend::enclose(const TaylorModel& u, const TaylorModel& v, SurfaceEnclosure& out) const {
  const bool at_end = u.exact() && (u.centre() == 0.0 || u.centre() == 1.0);
  if (!at_end) out.unproven = "a blend is enclosed along its ends only";
  if (!ends_[0].enclosure || !ends_[1].enclosure) out.unproven = "the blend's data have no enclosure";
  if (!out.unproven.empty()) return;
  const std::size_t side = u.centre() == 0.0 ? 0 : 1;
  const EndEnclosure end = ends_[side].enclosure(v);
  out.unproven = end.unproven;
  out.S = end.C[0];
  out.Sv = end.C[1];
  out.Svv = end.C[2];
  out.Su = end.T[0];
  out.Suv = end.T[1];
  out.Suu = end.D;
  const bool second = order_ == 6 && ends_[side].continuity == Continuity::G2;
  if (second && shape_.frame != BlendFrame::fixed) return;
  const EndEnclosure other = ends_[1 - side].enclosure(v);
  if (!other.unproven.empty()) out.unproven = other.unproven;
  const EndEnclosure &e0 = side == 0 ? end : other, &e1 = side == 0 ? other : end;
  if (order_ == 4) {
    out.Suu = bend(side, e0, e1);
  } else if (!second) {
    const std::array<const ModelVector*, 4> data{&e0.C[0], &e0.T[0], &e1.C[0], &e1.T[0]};
    out.Suu = ModelVector{};
    for (std::size_t k = 0; k < 4; ++k) out.Suu = out.Suu + TaylorModel(completion_[side][k]) * *data[k];
  }
  if (shape_.frame == BlendFrame::fixed) turn(e0, e1, out);
}

void OdeBlend::turn(const EndEnclosure& e0, const EndEnclosure& e1, SurfaceEnclosure& out) const {
  const auto through = [&](const ModelVector& x) {
    return turned(shape_.axes, turned(shape_.axes.transpose(), x));
  };
  if (order_ == 6) out.Suu = through(out.Suu);
  if (shape_.mode == BlendMode::chord) {
    const ModelVector De = e1.C[0] - e0.C[0], De1 = e1.C[1] - e0.C[1];
    out.Su = through(out.Su - De) + De;
    out.Suv = through(out.Suv - De1) + De1;
    return;
  }
  const ModelVector a = shape_.mode == BlendMode::anchor ? constant_model(shape_.anchor) : ModelVector{};
  out.S = through(out.S - a) + a;
  for (ModelVector* x : {&out.Sv, &out.Svv, &out.Su, &out.Suv}) *x = through(*x);
}

}  // namespace blendwright
