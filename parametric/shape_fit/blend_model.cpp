#include "parametric/shape_fit/blend_model.hpp"

#include <utility>

namespace blendwright::detail {
namespace {

/// Derivatives by u and by t of the parts of a jet.
constexpr std::array<std::array<std::size_t, 2>, 7> orders{
    {{0, 0}, {1, 0}, {0, 1}, {2, 0}, {1, 1}, {0, 2}, {3, 0}}};

}  // namespace

BlendModel::BlendModel(std::shared_ptr<const BoundaryRows> rows, const BlendShape& start, int order,
                       Layout layout)
    : rows_(std::move(rows)),
      start_(start),
      order_(order),
      layout_(std::move(layout)),
      rotated_(order == 4 && start.frame == BlendFrame::fixed &&
               (!start.isotropic() || layout_.shape == ShapeUnknown::tension_per_component)) {}

BlendModel::At::At(const BlendModel& model, const double* x)
    : model_(model),
      x_(x),
      shape_(model.shape(x), model.order_,
             {model.rows_->continuity()[0] == Continuity::G2, model.rows_->continuity()[1] == Continuity::G2},
             model.layout_.shape) {}

Section BlendModel::At::section(double t, bool with_derivatives) const {
  Section s = model_.rows_->at(t, x_, with_derivatives);
  if (!model_.rotated_) return s;
  const Eigen::Matrix3d back = model_.start_.axes.transpose();
  for (auto& b : s.R)
    for (Vec3& row : b) row = back * row;
  for (Section::Change& c : s.by)
    for (std::size_t r = 0; r < c.count; ++r)
      for (Vec3& row : c.R[r]) row = back * row;
  return s;
}

JetAt BlendModel::At::jet(const Section& s, const WeightsAt& w, bool with_derivatives) const {
  JetAt jet;
  for (std::size_t k = 0; k < orders.size(); ++k) {
    const auto [a, b] = orders[k];
    Vec3 sum = Vec3::Zero();
    for (std::size_t r = 0; r < row_count; ++r) sum += w.value[a][r].cwiseProduct(s.R[b][r]);
    jet.value.segment<3>(3 * static_cast<Eigen::Index>(k)) = sum;
  }
  if (with_derivatives) {
    jet.by.setZero(jet_size, static_cast<Eigen::Index>(model_.unknowns()));
    for (std::size_t k = 0; k < orders.size(); ++k) {
      const auto [a, b] = orders[k];
      const auto place = 3 * static_cast<Eigen::Index>(k);
      for (std::size_t i = 0; i < w.by.size(); ++i)
        for (std::size_t r = 0; r < row_count; ++r)
          jet.by.block<3, 1>(place, static_cast<Eigen::Index>(i)) += w.by[i][a][r].cwiseProduct(s.R[b][r]);
      for (std::size_t p = 0; p < s.by.size(); ++p)
        for (std::size_t r = 0; r < s.by[p].count; ++r)
          jet.by.block<3, 1>(place, static_cast<Eigen::Index>(p)) +=
              w.value[a][s.by[p].rows[r]].cwiseProduct(s.by[p].R[r][b]);
    }
  }
  if (model_.rotated_)
    for (Eigen::Index k = 0; k < jet_size; k += 3) {
      jet.value.segment<3>(k) = (model_.start_.axes * jet.value.segment<3>(k)).eval();
      if (with_derivatives) jet.by.middleRows<3>(k) = (model_.start_.axes * jet.by.middleRows<3>(k)).eval();
    }
  return jet;
}

}  // namespace blendwright::detail
