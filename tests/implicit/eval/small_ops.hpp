#pragma once
// Four small operations that tapes of tests are made of, with plain functions that say what they compute.
#include "implicit/eval/op.hpp"

namespace blendwright::test {

/// |y| / radius.
struct Ball {
  double inverse_radius = 1.0;
};
/// (1 - x^2)^2 for x < 1, else 0; x >= 0.
struct Window {};
/// The sum of all arguments. Left out: arguments that are the constant 0.
struct Sum {};
/// The smaller of two arguments.
struct Least {};

}  // namespace blendwright::test

namespace blendwright {
template <>
const Op& op_for<test::Ball>();
template <>
const Op& op_for<test::Window>();
template <>
const Op& op_for<test::Sum>();
template <>
const Op& op_for<test::Least>();
}  // namespace blendwright
