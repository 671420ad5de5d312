#pragma once
// An operation that a field is computed with: a body (a small struct of parameters) and, once per body type,
// what is known about it. The formula of a body is written once, as evaluate(body, inputs) in an -inl.hpp
// header; everything here is instantiated from that.
#include <cstddef>
#include <initializer_list>
#include <memory>
#include <span>
#include <string_view>

#include "kernel/field/scalar_field.hpp"

namespace blendwright {

/// Local coordinates y of a primitive from those of the scene, row vectors: y = x * matrix + offset.
struct Frame {
  Eigen::Matrix3d matrix = Eigen::Matrix3d::Identity();
  Vec3 offset = Vec3::Zero();
  bool identity = true;
  Frame() = default;
  /// Throws InputError ("matrix") when a number is not finite or |det| < 1e-12 * product of the row norms.
  Frame(const Eigen::Matrix3d& m, const Vec3& t);
  [[nodiscard]] Vec3 local(const Vec3& x) const { return matrix.transpose() * x + offset; }
  /// Encloses the local coordinates of the box.
  [[nodiscard]] Box local(const Box& x) const;
  /// Encloses the scene coordinates of a box in local ones.
  [[nodiscard]] Box scene(const Box& y) const;
  /// inner.after(outer): first outer, then inner, as one.
  [[nodiscard]] Frame after(const Frame& outer) const;
  /// The same with local coordinates multiplied by positive factors.
  [[nodiscard]] Frame scaled(const Vec3& factors) const;
  bool operator==(const Frame&) const = default;
};

/// Points that are evaluated together; every array below has this many places per component, in the order of
/// FieldValues: component c of point i at c * batch_size + i.
inline constexpr std::size_t batch_size = 256;

/// What a kernel reads. Arrays are readable up to batch_size whatever `count` is.
struct KernelInput {
  const double *x, *y, *z;    ///< scene coordinates
  const Frame* frame;         ///< null: local coordinates are the scene's
  const double* const* args;  ///< results of the arguments, of the same order as the output
  std::size_t arg_count;
  std::size_t count;  ///< points
};
/// Writes the results of `count` points (and may write up to batch_size of them) to out, which is none of the
/// arguments or exactly one of them.
using Kernel = void (*)(const void* body, const KernelInput& in, double* out);
/// One kernel per Order.
struct KernelSet {
  Kernel run[3];
};

/// What an operation is equal to on a whole box, bit for bit and with its derivatives, when that is less than
/// the operation itself.
struct Shortcut {
  enum class Kind { none, constant, argument } kind = Kind::none;
  double constant = 0.0;
  std::size_t argument = 0;
  [[nodiscard]] static Shortcut to_constant(double c) { return {Kind::constant, c, 0}; }
  [[nodiscard]] static Shortcut to_argument(std::size_t i) { return {Kind::argument, 0.0, i}; }
};

/// What a linear bound is made from, at local coordinates y = centre + axes t, t in [-1, 1]^3.
struct LinearInput {
  const Box& local;  ///< encloses them
  Vec3 centre;
  Eigen::Matrix3d axes;
  Vec3 slack;  ///< what rounding of a frame can change of y
  std::span<const LinearBound> args;
  std::span<const Range> ranges;  ///< of the arguments
  /// The slope in t of a function with this gradient in y.
  [[nodiscard]] Vec3 slope(const Vec3& gradient) const { return axes.transpose() * gradient; }
  /// The corner t = (+-1, +-1, +-1), bit i of k: the sign of t_i.
  [[nodiscard]] Vec3 corner(unsigned k) const {
    return centre + axes * Vec3(k & 1 ? 1.0 : -1.0, k & 2 ? 1.0 : -1.0, k & 4 ? 1.0 : -1.0);
  }
};

struct Op;
/// One operation in place of two.
struct Merged {
  const Op* op = nullptr;  ///< null: there is none
  std::shared_ptr<const void> body;
  Vec3 scale = Vec3::Ones();  ///< factors of the inner operation's local coordinates
};

struct Op {
  std::string_view name;
  KernelSet simd;    ///< for the best instruction set of this machine
  KernelSet scalar;  ///< one point at a time, with the C++ library's functions
  /// Contains evaluate() over the box (local coordinates) and all values of the arguments in their ranges.
  /// From monotonicity: end points, widened by range_slack.
  Range (*range)(const void* body, const Box& local, std::span<const Range> args);
  /// Null: never. A constant argument has lo == hi.
  Shortcut (*shortcut)(const void* body, const Box& local, std::span<const Range> args) = nullptr;
  /// Contains the same values as range(), to first order. Null: the range.
  LinearBound (*linear)(const void* body, const LinearInput& in) = nullptr;
  /// The operation that does both this one (which has no coordinates) and, for its argument `which`, `inner`,
  /// a primitive: of the primitive's coordinates and the remaining arguments. Null: never.
  Merged (*merge)(const void* body, std::size_t which, const Op& inner, const void* inner_body) = nullptr;
};

/// The operation of a body type; each body's .cpp specialises it.
template <class Body>
[[nodiscard]] const Op& op_for();

/// How far (relative) the vector, scalar and end-point evaluations of one formula may differ.
inline constexpr double range_slack = 1e-13;

/// The scalar value at one point.
[[nodiscard]] double scalar_value(const Op& op, const void* body, const Vec3& local,
                                  std::span<const double> args = {});
/// Range of an operation that rises with |x|, |y| and |z|: end points, exact but for rounding.
[[nodiscard]] Range range_by_magnitudes(const Op& op, const void* body, const Box& local);
/// Range of an operation without coordinates; rises[i]: it rises (or stays) with argument i, else it falls;
/// the last entry holds for all further arguments.
[[nodiscard]] Range range_by_arguments(const Op& op, const void* body, std::span<const Range> args,
                                       std::initializer_list<bool> rises);

}  // namespace blendwright
