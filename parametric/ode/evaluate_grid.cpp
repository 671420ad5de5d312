// Grid evaluation: the rows B_k(v) are computed once, then every row of points is a linear combination of
// them.
#include <algorithm>
#include <cstdint>

#include "kernel/base/number_text.hpp"
#include "kernel/base/parallel_for.hpp"
#include "parametric/ode/grid_kernel.hpp"
#include "parametric/ode/ode_blend.hpp"

namespace blendwright {
namespace {

constexpr std::size_t streaming_bytes = std::size_t{4} << 20;  // larger results do not stay in the caches

/// What a row of the product is: one of the blend's rows, or a line taken off before the equation was solved.
struct Term {
  enum class Kind { row, row_along_axis, line0, line1 } kind;
  std::size_t k = 0, axis = 0;
};

Eigen::Map<Vec3> point_at(double* x) { return Eigen::Map<Vec3>(x); }

/// The three components share their cardinal functions.
bool has_common_functions(const OdeBlend& blend) { return blend.order() == 6 || blend.shape().isotropic(); }

std::vector<Term> terms_of(const OdeBlend& blend) {
  std::vector<Term> terms;
  const BlendShape& shape = blend.shape();
  const std::size_t order = static_cast<std::size_t>(blend.order()), half = order / 2;
  if (shape.mode != BlendMode::origin) terms = {{Term::Kind::line0}, {Term::Kind::line1}};
  for (std::size_t k = 0; k < order; ++k) {
    if (shape.mode == BlendMode::chord && k % half == 0) continue;  // positions are in the chord
    if (shape.frame == BlendFrame::global || has_common_functions(blend))
      terms.push_back({Term::Kind::row, k});
    else
      for (std::size_t axis = 0; axis < 3; ++axis) terms.push_back({Term::Kind::row_along_axis, k, axis});
  }
  return terms;
}

Vec3 row_value(const Term& term, const BlendSection& s, bool global) {
  const auto axis = static_cast<Eigen::Index>(term.axis);
  switch (term.kind) {
    case Term::Kind::line0:
      return s.line0;
    case Term::Kind::line1:
      return s.line1;
    case Term::Kind::row:
      return global ? s.B[term.k] : Vec3(s.axes * s.B[term.k]);
    case Term::Kind::row_along_axis:
      return s.B[term.k][axis] * s.axes.col(axis);
  }
  return Vec3::Zero();
}

Vec3 coefficient(const Term& term, double u, const std::array<CardinalValues, 3>& phi) {
  switch (term.kind) {
    case Term::Kind::line0:
      return Vec3::Constant(1.0 - u);
    case Term::Kind::line1:
      return Vec3::Constant(u);
    case Term::Kind::row:
      return {phi[0].value[0][term.k], phi[1].value[0][term.k], phi[2].value[0][term.k]};
    case Term::Kind::row_along_axis:
      return Vec3::Constant(phi[term.axis].value[0][term.k]);
  }
  return Vec3::Zero();
}

/// The rows of the product, placed within a cache line as `out` is: then vectors of both are aligned
/// together.
class Rows {
 public:
  Rows(std::size_t count, std::size_t length, const double* out)
      : stride_((length + line - 1) / line * line + line), memory_(count * stride_ + 2 * line) {
    const auto place = [](const double* p) {
      return reinterpret_cast<std::uintptr_t>(p) / sizeof(double) % line;
    };
    first_ = memory_.data() + (place(out) + line - place(memory_.data())) % line;
  }
  [[nodiscard]] double* row(std::size_t k) { return first_ + k * stride_; }
  [[nodiscard]] std::size_t stride() const { return stride_; }

 private:
  static constexpr std::size_t line = 64 / sizeof(double);
  std::size_t stride_;
  std::vector<double> memory_;
  double* first_;
};

void evaluate_separable(const OdeBlend& blend, std::span<const double> u, std::span<const double> v,
                        std::span<double> out) {
  const std::vector<Term> terms = terms_of(blend);
  const std::size_t count = terms.size(), length = 3 * v.size();
  const bool global = blend.shape().frame == BlendFrame::global;
  Rows rows(count, length, out.data());
  parallel_for(v.size(), 64, [&](std::size_t begin, std::size_t end) {
    for (std::size_t j = begin; j < end; ++j) {
      const BlendSection s = blend.section(v[j]);
      for (std::size_t k = 0; k < count; ++k) point_at(rows.row(k) + 3 * j) = row_value(terms[k], s, global);
    }
  });
  std::vector<double> coefficients(u.size() * count * 3);
  parallel_for(u.size(), 64, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const std::array<CardinalValues, 3> phi = blend.cardinals(u[i]);
      for (std::size_t k = 0; k < count; ++k)
        point_at(&coefficients[(i * count + k) * 3]) = coefficient(terms[k], u[i], phi);
    }
  });
  const detail::RowCombination task{.rows = rows.row(0),
                                    .stride = rows.stride(),
                                    .coefficients = coefficients.data(),
                                    .count = count,
                                    .length = length,
                                    .out = out.data(),
                                    .uniform = !global || has_common_functions(blend),
                                    .stream = out.size_bytes() >= streaming_bytes};
  // Tiles of the grid: small enough for many tasks, long enough that whole pages are written in one go.
  constexpr std::size_t tile_rows = 32, tile_columns = 3 * 4096;
  const std::size_t across = (length + tile_columns - 1) / tile_columns;
  const std::size_t down = (u.size() + tile_rows - 1) / tile_rows;
  parallel_for(across * down, 1, [&](std::size_t begin, std::size_t end) {
    for (std::size_t tile = begin; tile < end; ++tile) {
      const std::size_t i0 = tile / across * tile_rows, j0 = tile % across * tile_columns;
      detail::combine_rows(task, i0, std::min(i0 + tile_rows, u.size()), j0,
                           std::min(j0 + tile_columns, length));
    }
  });
}

void evaluate_point_by_point(const OdeBlend& blend, std::span<const double> u, std::span<const double> v,
                             std::span<double> out) {
  std::vector<BlendSection> sections(v.size());
  parallel_for(v.size(), 64, [&](std::size_t begin, std::size_t end) {
    for (std::size_t j = begin; j < end; ++j) sections[j] = blend.section(v[j]);
  });
  parallel_for(u.size(), 1, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const std::array<CardinalValues, 3> phi = blend.cardinals(u[i]);
      for (std::size_t j = 0; j < v.size(); ++j) {
        const BlendSection& s = sections[j];
        Vec3 local = Vec3::Zero();
        for (std::size_t k = 0; k < static_cast<std::size_t>(blend.order()); ++k)
          local += Vec3(phi[0].value[0][k], phi[1].value[0][k], phi[2].value[0][k]).cwiseProduct(s.B[k]);
        point_at(&out[(i * v.size() + j) * 3]) = (1.0 - u[i]) * s.line0 + u[i] * s.line1 + s.axes * local;
      }
    }
  });
}

}  // namespace

void evaluate_grid(const OdeBlend& blend, std::span<const double> u, std::span<const double> v,
                   std::span<double> out) {
  const std::size_t needed = u.size() * v.size() * 3;
  if (out.size() != needed)
    throw InputError("out",
                     "has " + std::to_string(out.size()) + " values, must have " + std::to_string(needed));
  if (needed == 0) return;
  if (blend.separable())
    evaluate_separable(blend, u, v, out);
  else
    evaluate_point_by_point(blend, u, v, out);
}

}  // namespace blendwright
