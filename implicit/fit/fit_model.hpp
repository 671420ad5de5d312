#pragma once
// Private: a scene as formulas of its numbers, for any number type, so that it can be differentiated by them.
#include <array>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "implicit/fit/scene_fit.hpp"

namespace blendwright::detail {

/// One number of the scene, and how the solver sees it.
struct FitSlot {
  std::string node, key;
  int index = -1;  ///< component of a list; -1: the value itself
  enum class Scale {
    linear,
    logarithmic,
    turn
  } scale = Scale::linear;      ///< turn: a component of a rotation vector
  double value = 0.0;           ///< in the scene; 0 for turns
  Interval widest{}, bounds{};  ///< of the value
  bool free = false;
};

/// A node as a formula; numbers are slots by index.
struct FitNode {
  enum class Kind {
    form_lp,
    form_superquadric,
    form_asymmetric,
    ray_scaling,
    place,
    soft_object,
    soft_blend
  } kind{};
  std::string name;
  std::vector<std::size_t> of;                         ///< indices of nodes
  std::size_t slot = 0;                                ///< the first of its own
  Eigen::Matrix3d turn = Eigen::Matrix3d::Identity();  ///< place: the rotation that turns are relative to
  enum class Potential { blanc, wyvill, gaussian, gaussian_windowed } potential{};
};

struct FitModel {
  std::vector<FitSlot> slots;
  std::vector<FitNode> nodes;  ///< children first; the last is the solid
  bool blend = false;          ///< a field of level 1/2; else a distance of level 1
  [[nodiscard]] std::vector<std::size_t> free() const;
};

/// Throws InputError as fit_scene does; all slots are free but those of kinds that never are (w2, softness,
/// scale).
[[nodiscard]] FitModel fit_model(const SceneSpec& scene);
/// Marks what `unknowns` name, and nothing else, as free; adds what is wrong to `problems`.
void choose_unknowns(FitModel& model, const std::vector<SceneUnknown>& unknowns,
                     std::vector<Problem>& problems);
/// The scene with the numbers `values`, one per slot.
[[nodiscard]] SceneSpec with_values(const SceneSpec& scene, const FitModel& model,
                                    std::span<const double> values);

/// Values of all slots to start from: the scene's own, and, when asked for, its single form laid into the
/// points in several turns. `model` gets the turns of each start. `outliers`: points
/// far from the others are not looked at.
struct FitStart {
  FitModel model;
  std::vector<double> values;
};
[[nodiscard]] std::vector<FitStart> starts_from_points(const FitModel& model, std::span<const Vec3> points,
                                                       bool outliers);

}  // namespace blendwright::detail
