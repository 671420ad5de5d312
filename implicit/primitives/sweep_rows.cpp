#include <array>
#include <numbers>

#include "implicit/primitives/polar_bar.hpp"
#include "implicit/primitives/primitive_inputs.hpp"
#include "implicit/primitives/primitive_tables.hpp"
#include "implicit/primitives/sweep_arc.hpp"
#include "implicit/primitives/sweep_curve.hpp"
#include "implicit/primitives/sweep_line.hpp"
#include "kernel/base/number_text.hpp"

namespace blendwright::detail {
namespace {

constexpr double radians(double degrees) { return degrees * (std::numbers::pi / 180.0); }

// ---- What sweeps share ------------------------------------------------------------------------------

constexpr NodeParam profile_param{
    .type = NodeParam::Type::node,
    .info = {.name = "profile", .description = "gauge g(u, v): lp_profile, rose or star"}};
constexpr NodeParam scale_param{
    .type = NodeParam::Type::numbers,
    .info = {.name = "scale", .description = "[s0, s1], factors of the profile at both ends; default [1, 1]"},
    .required = false,
    .count = 2};
constexpr NodeParam twist_param{.type = NodeParam::Type::number,
                                .info = {.name = "twist_deg",
                                         .description = "turn of the profile from end to end, phi = twist k",
                                         .min = -36000.0,
                                         .max = 36000.0,
                                         .min_allowed = true,
                                         .fallback = 0.0}};
constexpr NodeParam cap_param = length_param("cap", "length e of the rounded ends of d = 1");
constexpr NodeParam m_param{.type = NodeParam::Type::number,
                            .info = {.name = "m",
                                     .description = "exponent m of the ends, larger is flatter",
                                     .min = 1.0,
                                     .max = largest_exponent,
                                     .fallback = 2.0}};

Profile read_profile(const NodeInputs& in) {
  return *std::static_pointer_cast<const Profile>(in.node("profile")->detail);
}

Section read_section(NodeInputs& in) {
  Section s;
  s.profile = read_profile(in);
  if (in.has("scale")) {
    constexpr double least = 1e-6, most = 1e6;
    for (int i = 0; i < 2; ++i) {
      const double x = in.numbers("scale")[static_cast<std::size_t>(i)];
      if (!(x >= least && x <= most))
        in.problem("scale", scene_error::invalid_parameter,
                   "is " + number_text(x) + ", must be a number >= 1e-6 and <= 1e6", i);
    }
    s.s0 = in.numbers("scale")[0];
    s.ds = in.numbers("scale")[1] - s.s0;
  }
  s.twist = radians(in.number("twist_deg"));
  s.inverse_cap = 1.0 / read_length(in, "cap");
  s.m = Power(in.number("m"));
  s.inverse_m = Power(1.0 / in.number("m"));
  return s;
}

void warn_unless_closing(NodeInputs& in, const Section& s) {
  if (s.ds != 0.0)
    in.warning("scale", "differs at both ends of a closed trajectory: the field jumps where they meet");
  else if (!s.closes())
    in.warning("twist_deg", "is " + number_text(in.number("twist_deg")) +
                                ", which does not map the profile onto itself: on a closed trajectory the "
                                "field jumps where the ends meet");
}

/// A distance whose d <= value lies in region(body, value).
template <class Body>
Node sweep_node(Body body, Box (*region)(const Body&, double)) {
  Node node;
  node.distance = true;
  const auto shared = std::make_shared<const Body>(std::move(body));
  node.emit = [shared](TapeBuilder& tape, const Frame& frame) { return tape.add<Body>(shared, frame, {}); };
  node.region = [shared, region](double value) -> std::optional<Box> { return region(*shared, value); };
  return node;
}

// ---- polar_bar --------------------------------------------------------------------------------------

constexpr std::array bar_params{profile_param, length_param("c", "half-length c along z, of d = 1"),
                                exponent_param("n", "exponent n of the outline along z", 1.0)};

Node make_polar_bar(NodeInputs& in) {
  const Profile profile = read_profile(in);
  const double c = read_length(in, "c"), n = in.number("n");
  const auto [u, v] = profile.extent();
  const Vec3 half(u, v, c);
  Node node;
  node.distance = true;
  node.ray_linear = true;
  node.positive = true;
  node.emit = emit_body(PolarBar{profile, 1.0 / c, Power(n), Power(1.0 / n)});
  node.region = [half](double value) { return scaled_box({-half, half}, value); };
  return node;
}

// ---- sweep_line -------------------------------------------------------------------------------------

constexpr std::array line_params{
    NodeParam{.type = NodeParam::Type::point, .info = {.name = "p0", .description = "start of the axis"}},
    NodeParam{.type = NodeParam::Type::point, .info = {.name = "p1", .description = "end of the axis"}},
    NodeParam{.type = NodeParam::Type::point,
              .info = {.name = "u", .description = "direction of the profile's u axis"}},
    profile_param,
    scale_param,
    twist_param,
    cap_param,
    m_param};

Node make_sweep_line(NodeInputs& in) {
  SweepLine b;
  b.section = read_section(in);
  b.start = read_point(in, "p0");
  const Vec3 end = read_point(in, "p1"), axis = end - b.start, u = in.point("u");
  b.length = axis.norm();
  if (!(b.length >= 1e-12 * (b.start.norm() + end.norm())) || b.length < smallest_length) {
    in.problem("p1", scene_error::invalid_parameter, "is the same point as p0, must be another one");
    return {};
  }
  b.W = axis / b.length;
  const Vec3 across = u - u.dot(b.W) * b.W;
  if (!(across.norm() > 1e-6 * u.norm())) {
    in.problem("u", scene_error::invalid_parameter,
               "is parallel to the axis p0 p1, must have a part across it");
    return {};
  }
  b.U = across.normalized();
  b.V = b.W.cross(b.U);
  return sweep_node(b, sweep_line_region);
}

// ---- sweep_arc --------------------------------------------------------------------------------------

constexpr std::array arc_params{
    length_param("arc_radius", "radius R of the arc about the z axis"),
    NodeParam{.type = NodeParam::Type::numbers,
              .info = {.name = "angles_deg",
                       .description = "[t0, t1] from the x axis; 360 apart: a whole turn without ends",
                       .min = -36000.0,
                       .max = 36000.0,
                       .min_allowed = true},
              .count = 2},
    profile_param,
    scale_param,
    twist_param,
    cap_param,
    m_param};

Node make_sweep_arc(NodeInputs& in) {
  const Section section = read_section(in);
  const double R = read_length(in, "arc_radius");
  const double t0 = in.numbers("angles_deg")[0], t1 = in.numbers("angles_deg")[1];
  if (!(std::abs(t0) <= 36000.0 && t1 - t0 > 0.0 && t1 - t0 <= 360.0 + 1e-9)) {
    in.problem("angles_deg", scene_error::invalid_parameter,
               "goes from " + number_text(t0) + " to " + number_text(t1) + ", must go up by at most 360");
    return {};
  }
  const bool whole = t1 - t0 >= 360.0 - 1e-9;
  if (whole) warn_unless_closing(in, section);
  return sweep_node(SweepArc(section, R, radians(t0), radians(t1), whole), sweep_arc_region);
}

// ---- sweep_curve ------------------------------------------------------------------------------------

constexpr std::array curve_params{
    NodeParam{.type = NodeParam::Type::formulas,
              .info = {.name = "curve", .description = "x, y and z of C(t) as formulas of t (radians)"},
              .count = 3},
    NodeParam{.type = NodeParam::Type::numbers,
              .info = {.name = "t", .description = "[t0, t1], the range of t"},
              .count = 2},
    NodeParam{.type = NodeParam::Type::point,
              .info = {.name = "u",
                       .description = "direction of the profile's u axis at t0; default: the coordinate axis "
                                      "most nearly across the curve"},
              .required = false},
    profile_param,
    scale_param,
    twist_param,
    cap_param,
    m_param};

Node make_sweep_curve(NodeInputs& in) {
  const Section section = read_section(in);
  const std::vector<double>& t = in.numbers("t");
  std::shared_ptr<const Path> path;
  try {
    const std::optional<Vec3> u = in.has("u") ? std::optional(in.point("u")) : std::nullopt;
    path = std::make_shared<const Path>(in.formulas("curve"), t[0], t[1], u);
  } catch (const InputError& e) {
    for (const Problem& p : e.problems()) {
      const std::size_t slash = p.where.find('/');
      const int index = slash == std::string::npos ? -1 : std::stoi(p.where.substr(slash + 1));
      in.problem(p.where.substr(0, slash), scene_error::invalid_parameter, p.message, index);
    }
    return {};
  }
  if (path->closed()) warn_unless_closing(in, section);
  return sweep_node(SweepCurve(section, path), sweep_curve_region);
}

constexpr std::string_view section_equation = "d = g((u0, v0) turned by -phi)/s, at ends N_m(d, |alpha|/cap)";
constexpr std::array rows{NodeKind{"polar_bar", NodeFamily::distance, "d = (g(x, y)^n + |z/c|^n)^(1/n)",
                                   "bar with any profile", "after Hsu 2012", bar_params, make_polar_bar},
                          NodeKind{"sweep_line", NodeFamily::distance, section_equation,
                                   "profile swept along a segment, scaled and twisted",
                                   "Crespin, Blanc and Schlick 1996", line_params, make_sweep_line},
                          NodeKind{"sweep_arc", NodeFamily::distance, section_equation,
                                   "profile swept along an arc about the z axis, up to a ring",
                                   "Crespin, Blanc and Schlick 1996", arc_params, make_sweep_arc},
                          NodeKind{"sweep_curve", NodeFamily::distance, section_equation,
                                   "profile swept along a curve given by formulas",
                                   "Crespin, Blanc and Schlick 1996", curve_params, make_sweep_curve}};

}  // namespace

std::span<const NodeKind> sweep_kinds() { return rows; }

}  // namespace blendwright::detail
