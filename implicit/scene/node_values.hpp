#pragma once
// The values of one node against the parameters of its kind.
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "implicit/scene/node.hpp"
#include "implicit/scene/node_spec.hpp"

namespace blendwright::detail {

/// A value of a node that names another one.
struct NodeLink {
  std::string_view key;  ///< of the parameter
  std::string path;      ///< below the node: "of/2", "w1/contour"
  std::string name;      ///< of the other node
};

struct ValueCheck {
  std::vector<Problem> problems;  ///< `where` is relative to the node
  std::vector<NodeLink> links;    ///< in the order of the parameters
};

/// Unknown and missing keys, wrong types, bounds, counts, words; the links of what is right.
[[nodiscard]] ValueCheck check_values(const NodeSpec& spec, const NodeKind& kind);

/// The parameter of a kind, null when it has none of that name.
[[nodiscard]] const NodeParam* find_param(const NodeKind& kind, std::string_view key);

/// "; did you mean "x"?" or nothing.
[[nodiscard]] std::string suggestion(std::string_view word, const std::vector<std::string>& known);

/// The JSON pointer of a node, and the reference token of a name (RFC 6901).
[[nodiscard]] std::string pointer_of(const NodeSpec& spec);
[[nodiscard]] std::string pointer_token(std::string_view name);

/// What a kind's make() reads: checked values, and nodes made before.
class CheckedInputs final : public NodeInputs {
 public:
  struct Link {
    std::string_view key;
    std::shared_ptr<const Node> node;
  };
  CheckedInputs(const NodeSpec& spec, const NodeKind& kind, std::vector<Link> links, bool strict)
      : spec_(spec), kind_(kind), links_(std::move(links)), strict_(strict) {}

  [[nodiscard]] bool has(std::string_view key) const override;
  [[nodiscard]] double number(std::string_view key) const override;
  [[nodiscard]] std::size_t word(std::string_view key) const override;
  [[nodiscard]] const std::vector<double>& numbers(std::string_view key) const override;
  [[nodiscard]] const std::vector<std::vector<double>>& rows(std::string_view key) const override;
  [[nodiscard]] const std::vector<std::string>& formulas(std::string_view key) const override;
  [[nodiscard]] std::shared_ptr<const Node> node(std::string_view key) const override;
  [[nodiscard]] std::vector<std::shared_ptr<const Node>> nodes(std::string_view key) const override;
  [[nodiscard]] std::shared_ptr<const Node> contour(std::string_view key) const override;
  [[nodiscard]] bool strict() const override { return strict_; }
  void problem(std::string_view key, std::string_view name, std::string message, int index) override;
  void warning(std::string_view key, std::string message) override;

  /// What make() reported; `where` is relative to the node.
  [[nodiscard]] std::vector<Problem>& problems() { return problems_; }
  [[nodiscard]] std::vector<Problem>& warnings() { return warnings_; }

 private:
  template <class V>
  [[nodiscard]] const V* find(std::string_view key) const;

  const NodeSpec& spec_;
  const NodeKind& kind_;
  std::vector<Link> links_;
  bool strict_;
  std::vector<Problem> problems_, warnings_;
};

}  // namespace blendwright::detail
