#include <array>

#include "implicit/primitives/primitive_inputs.hpp"
#include "implicit/primitives/profile.hpp"

namespace blendwright {
namespace {

using detail::Profile;

constexpr NodeParam lobes_param(std::string_view description) {
  return {.type = NodeParam::Type::integer,
          .info = {.name = "k",
                   .description = description,
                   .min = 2.0,
                   .max = detail::most_lobes,
                   .min_allowed = true}};
}
constexpr std::array lp_params{detail::length_param("a", "half-axis a along u, of g = 1"),
                               detail::length_param("b", "half-axis b along v, of g = 1"),
                               detail::exponent_param("n", "exponent n; convex for n >= 1")};
constexpr std::array rose_params{
    lobes_param("number k of lobes"), detail::length_param("a", "largest radius a"),
    NodeParam{
        .type = NodeParam::Type::number,
        .info = {.name = "eps",
                 .description = "depth eps of the hollows: the smallest radius is a (1 - eps)/(1 + eps)",
                 .min = 0.0,
                 .max = 0.999999,
                 .min_allowed = true}}};
constexpr std::array star_params{
    lobes_param("number k of tips"), detail::length_param("a", "radius a of the tips"),
    NodeParam{.type = NodeParam::Type::number,
              .info = {.name = "sigma",
                       .description = "depth sigma of the hollows: the smallest radius is a/(1 + sigma)",
                       .min = 0.0,
                       .max = 1e6}},
    NodeParam{.type = NodeParam::Type::number,
              .info = {.name = "m",
                       .description = "exponent m of the tips, sharp for m = 1, smooth above",
                       .min = 1.0,
                       .max = 64.0,
                       .min_allowed = true,
                       .fallback = 1.0}}};

Node profile_node(const Profile& profile) {
  Node node;
  node.ray_linear = true;
  node.positive = true;
  node.profile = true;
  node.detail = std::make_shared<const Profile>(profile);
  return node;
}
int lobes(const NodeInputs& in) { return static_cast<int>(in.number("k")); }

Node make_lp(NodeInputs& in) {
  const double a = detail::read_length(in, "a"), b = detail::read_length(in, "b");
  return profile_node(Profile::lp(a, b, in.number("n")));
}
Node make_rose(NodeInputs& in) {
  return profile_node(Profile::rose(lobes(in), detail::read_length(in, "a"), in.number("eps")));
}
Node make_star(NodeInputs& in) {
  return profile_node(
      Profile::star(lobes(in), detail::read_length(in, "a"), in.number("sigma"), in.number("m")));
}

constexpr std::array rows{
    NodeKind{"lp_profile", NodeFamily::profile, "g = (|u/a|^n + |v/b|^n)^(1/n)",
             "super-ellipse, from diamond to box", "Blanc and Schlick 1995", lp_params, make_lp},
    NodeKind{"rose", NodeFamily::profile, "g = r/rho, rho = a (1 + eps cos k theta)/(1 + eps)",
             "rounded lobes around a centre", "after Hsu 2012", rose_params, make_rose},
    NodeKind{"star", NodeFamily::profile, "g = r/rho, rho = a/(1 + sigma |sin(k theta/2)|^m)",
             "tips around a centre, the first along +u", "after Hsu 2012", star_params, make_star}};

}  // namespace

std::span<const NodeKind> profile_kinds() { return rows; }

}  // namespace blendwright
