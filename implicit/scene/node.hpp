#pragma once
// A node of a scene after checking: what it computes, and what its users may rely on.
#include <array>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "implicit/eval/tape.hpp"
#include "kernel/base/error.hpp"
#include "kernel/base/table.hpp"

namespace blendwright {

struct Node;

/// The value is Q(frame.local(X)), A11 A22 A33 A12 A13 A23 A14 A24 A34 A44 the coefficients of Q. The frame
/// keeps a local origin near the object: in coordinates far from it digits are lost.
struct NodeQuadric {
  std::array<double, 10> coefficients{};
  Frame frame{};
};

/// weight max(q + free_term, 0)^power.
struct NodePerturbation {
  std::shared_ptr<const Node> q;
  int power;
  double free_term;
};

/// The smallest or largest of several nodes, or the complement of one.
struct NodeLattice {
  enum class Kind { smallest, largest, complement } kind;
  std::vector<std::shared_ptr<const Node>> of;
};

struct Node {
  Level level = Level::one;
  bool distance = false;       ///< level one and never negative: what potentials and distance operations take
  bool ray_linear = false;     ///< f(origin + a X) = a f(origin + X), a >= 0
  Vec3 origin = Vec3::Zero();  ///< of ray-linearity, in the node's own coordinates
  bool positive = false;       ///< value > 0 off the origin: the level set is bounded
  bool profile = false;        ///< a plane gauge g(u, v): only for sections
  bool exact_distance = false;  ///< level function: the distance to the surface, positive inside, everywhere
  bool any_value = false;       ///< level half, but values may leave [0, 1]: no argument of powers
  double weight = 0.0;          ///< of perturbations, also placed ones; 0: it is none
  std::shared_ptr<const NodeQuadric> quadric{};        ///< of quadrics, level function, also placed ones
  std::shared_ptr<const NodePerturbation> perturbs{};  ///< of perturbations that are not placed
  std::shared_ptr<const NodeLattice> lattice{};        ///< of min, max and complement
  /// Of exact distances: that of the solid which is larger by a length (smaller for < 0), all lengths in the
  /// node's own coordinates; null, or no function: it has no closed form.
  std::function<std::shared_ptr<const Node>(double length)> parallel{};
  std::shared_ptr<const Node> under{};  ///< of placements: what is placed; `detail` says where
  /// Adds the node's steps, seen from the coordinates that `frame` leads to.
  std::function<StepIndex(TapeBuilder&, const Frame&)> emit;
  /// Encloses every point, in the node's own coordinates, whose value lies on the solid's side of `value` (<=
  /// for levels zero and one, >= for the others); nullopt: not known. Ends may be
  /// infinite.
  std::function<std::optional<Box>(double value)> region = [](double) { return std::nullopt; };
  /// Of profiles and curves: whatever their users agree on. Of placements: the Frame from the coordinates of
  /// the node to those of the placed one.
  std::shared_ptr<const void> detail{};
};

/// Whether two ray-linear nodes are so about the same point: within 1e-9 of its distance from the origin of
/// their coordinates, which is what turned and scaled placements round to, or 1e-12.
[[nodiscard]] bool same_origin(const Node& a, const Node& b);

/// The named errors of soft objects; problems start with one of these words.
namespace scene_error {
inline constexpr std::string_view invalid_parameter = "InvalidParameter";
inline constexpr std::string_view not_ray_linear = "NotRayLinear";
inline constexpr std::string_view origin_mismatch = "OriginMismatch";
inline constexpr std::string_view erosion_overreach = "ErosionOverreach";
inline constexpr std::string_view contour_inside_object = "ContourInsideObject";
inline constexpr std::string_view unbounded_contour = "UnboundedContour";
inline constexpr std::string_view level_mismatch = "LevelMismatch";
}  // namespace scene_error

/// One key of a node kind.
struct NodeParam {
  enum class Type {
    number,             ///< `info` bounds it and gives its default
    integer,            ///< a number without fraction
    word,               ///< one of `words`; default the first
    point,              ///< [x, y, z]
    points,             ///< [[x, y, z], ...], at least one
    numbers,            ///< [a, b, ...] of `count` numbers; of any, but at least one, for count 0
    rows,               ///< `count` rows of three numbers (of two for count 3 when `columns` is 2)
    formulas,           ///< `count` formulas of t
    node,               ///< a node
    nodes,              ///< at least `count` nodes
    number_or_contour,  ///< a number, or {"contour": node}: a parameter that varies in space
  };
  Type type = Type::number;
  ParamInfo info;        ///< name and description of every type; the rest for numbers
  bool required = true;  ///< of all types but numbers, which are required when they have no default
  std::size_t count = 0, columns = 3;
  std::span<const std::string_view> words = {};
};

/// What make() of a kind reads: every value is there (or has its default) and is of its type, finite and in
/// its bounds; every node it refers to was made.
class NodeInputs {
 public:
  virtual ~NodeInputs() = default;
  [[nodiscard]] virtual bool has(std::string_view key) const = 0;
  [[nodiscard]] virtual double number(std::string_view key) const = 0;
  [[nodiscard]] virtual std::size_t word(std::string_view key) const = 0;  ///< index into the key's words
  [[nodiscard]] virtual const std::vector<double>& numbers(std::string_view key) const = 0;  ///< also a point
  [[nodiscard]] virtual const std::vector<std::vector<double>>& rows(std::string_view key) const = 0;
  [[nodiscard]] virtual const std::vector<std::string>& formulas(std::string_view key) const = 0;
  [[nodiscard]] virtual std::shared_ptr<const Node> node(std::string_view key) const = 0;
  [[nodiscard]] virtual std::vector<std::shared_ptr<const Node>> nodes(std::string_view key) const = 0;
  /// The contour of a number_or_contour key, or null when it is a number.
  [[nodiscard]] virtual std::shared_ptr<const Node> contour(std::string_view key) const = 0;
  [[nodiscard]] virtual bool strict() const = 0;
  [[nodiscard]] Vec3 point(std::string_view key) const {
    const std::vector<double>& p = numbers(key);
    return {p[0], p[1], p[2]};
  }

  /// Reports; `name` is one of scene_error, "" for none; index: the element of a list, -1 for the whole. The
  /// message says what it is and what it must be.
  virtual void problem(std::string_view key, std::string_view name, std::string message, int index = -1) = 0;
  virtual void warning(std::string_view key, std::string message) = 0;
};

/// A parameter of this name takes a profile; all other nodes are nodes in space.
inline constexpr std::string_view profile_key = "profile";

enum class NodeFamily {
  profile,
  distance,
  distance_operation,
  field,
  solid,
  offset,
  operation,
  conversion,
  placement
};
[[nodiscard]] std::string_view name(NodeFamily family);

/// A row of the table of node kinds: the scene reader, the schema, `list nodes`, the documentation and the
/// parametrised tests all read these rows.
struct NodeKind {
  std::string_view name;
  NodeFamily family;
  std::string_view equation;     ///< in the symbols of the keys
  std::string_view description;  ///< one phrase
  std::string_view source;       ///< author, year
  std::span<const NodeParam> params;
  /// After a problem its result is not used.
  Node (*make)(NodeInputs& in);
};

/// All kinds, family by family.
[[nodiscard]] std::span<const NodeKind* const> node_kinds();
[[nodiscard]] const NodeKind* find_node_kind(std::string_view name);  ///< null: there is none

// The families, each in its folder.
[[nodiscard]] std::span<const NodeKind> profile_kinds();             // implicit/primitives
[[nodiscard]] std::span<const NodeKind> distance_kinds();            // implicit/primitives
[[nodiscard]] std::span<const NodeKind> distance_operation_kinds();  // implicit/operators
[[nodiscard]] std::span<const NodeKind> operation_kinds();           // implicit/operators
[[nodiscard]] std::span<const NodeKind> solid_kinds();               // implicit/primitives: level function
[[nodiscard]] std::span<const NodeKind> offset_kinds();              // implicit/offset
[[nodiscard]] std::span<const NodeKind> field_kinds();       // implicit/scene: potentials of distances
[[nodiscard]] std::span<const NodeKind> conversion_kinds();  // implicit/scene: from level to level
[[nodiscard]] std::span<const NodeKind> placement_kinds();   // implicit/scene

}  // namespace blendwright
