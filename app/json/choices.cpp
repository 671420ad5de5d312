#include "app/json/choices.hpp"

#include <stdexcept>
#include <string>

namespace blendwright {
namespace {

constexpr Choice<LengthUnit> units[] = {{"mm", LengthUnit::millimetre, "millimetre"},
                                        {"cm", LengthUnit::centimetre, "centimetre"},
                                        {"m", LengthUnit::metre, "metre"},
                                        {"in", LengthUnit::inch, "inch"}};

constexpr Choice<Continuity> continuities[] = {
    {"G0", Continuity::G0, "position only"},
    {"G1", Continuity::G1, "position and tangent plane"},
    {"G2", Continuity::G2, "position, tangent plane and normal curvature"}};

using Kind = TrimlineSpec::Kind;
constexpr Choice<Kind> trimlines[] = {
    {"isoline", Kind::isoline, "where one parameter of the primary has a fixed value"},
    {"parameters", Kind::parameters, "a curve in the primary's two parameters (angles in radians)"},
    {"projected", Kind::projected, "a space curve projected on the primary"},
    {"edge", Kind::edge, "one edge of a STEP face"},
    {"edge_chain", Kind::edge_chain, "an edge of a STEP face and the edges that continue it smoothly"}};

constexpr Choice<MagnitudeRule> magnitudes[] = {
    {"circle_like", MagnitudeRule::circle_like,
     "|T| = factor 2 / (1 + cos(theta/2)) |C1 - C0|, theta = angle(T0, T1) < 170 deg (default)"},
    {"chord", MagnitudeRule::chord, "|T| = factor |C1 - C0|"},
    {"arc_length", MagnitudeRule::arc_length, "|T| = factor times the length of the blend's u-line"},
    {"minimum_bending", MagnitudeRule::minimum_bending,
     "|T0| and |T1| with the least integral of |Suu|^2, times factor"},
    {"constant", MagnitudeRule::constant, "|T| = factor, in model units"}};

constexpr Choice<SideSpec::Keep> keeps[] = {
    {"auto", SideSpec::Keep::automatic, "the side that faces away from the other trimline (default)"},
    {"left", SideSpec::Keep::left, "left of the trimline seen from outside, along increasing v"},
    {"right", SideSpec::Keep::right, "right of the trimline seen from outside, along increasing v"}};

constexpr Choice<CorrespondenceRule> correspondences[] = {
    {"arc_length", CorrespondenceRule::arc_length, "equal fractions of arc length (default)"},
    {"as_given", CorrespondenceRule::as_given, "equal fractions of each trimline's own parameter"},
    {"minimal_twist", CorrespondenceRule::minimal_twist, "the map that turns the connecting lines least"},
    {"mapped", CorrespondenceRule::mapped, "the map of fractions of arc length that \"map\" gives"}};

constexpr Choice<BlendMode> modes[] = {
    {"chord", BlendMode::chord,
     "the sweep equation holds for S minus the chord: moves and scales with the part (default)"},
    {"origin", BlendMode::origin,
     "the sweep equation holds for S itself: pulled towards the coordinate origin"},
    {"anchor", BlendMode::anchor, "the sweep equation holds for S minus the point \"anchor\""}};

constexpr Choice<BlendFrame> frames[] = {
    {"global", BlendFrame::global, "b, c, d along the coordinate axes (default)"},
    {"moving", BlendFrame::moving, "b, c, d along the chord, across it, and along the blended normal"},
    {"fixed", BlendFrame::fixed, "b, c, d along the three perpendicular unit vectors given"}};

constexpr Choice<SixthOrderFamily> families[] = {
    {"tension1", SixthOrderFamily::tension1, "characteristic L^2 (L - q^2), q = tension (default)"},
    {"tension2", SixthOrderFamily::tension2, "characteristic L (L - q^2)^2, q = tension"},
    {"triple", SixthOrderFamily::triple, "characteristic (L - q^2)^3, q = tension"},
    {"quintic", SixthOrderFamily::quintic, "characteristic L^3: no tension"}};

constexpr Choice<ObjectiveKind> objectives[] = {
    {"thin_plate", ObjectiveKind::thin_plate, "the least bending energy: the fairest surface"},
    {"curvature_variation", ObjectiveKind::curvature_variation,
     "the least change of normal curvature along the u-lines"},
    {"rolling_ball", ObjectiveKind::rolling_ball,
     "the middle of the blend is curved like a ball of this radius"},
    {"pass_through", ObjectiveKind::pass_through, "the blend goes through these points"},
    {"largest_curvature", ObjectiveKind::largest_curvature,
     "no principal radius of curvature is less than this one"},
    {"clearance", ObjectiveKind::clearance, "the blend keeps this far from a mesh or from a soft object"},
    {"no_fold", ObjectiveKind::no_fold, "the blend does not turn over"},
    {"scanned_points", ObjectiveKind::scanned_points, "the blend is close to measured points"}};

constexpr Choice<OutputFormat> formats[] = {
    {"step", OutputFormat::step, "STEP: the blends and the trimmed primaries, sharing edges"},
    {"vtp", OutputFormat::vtp, "VTK PolyData: meshes and trimlines with the measured errors as point data"},
    {"png", OutputFormat::png, "pictures: the blend coloured by error, and plots along the trimlines"},
    {"stl", OutputFormat::stl, "STL, binary: all faces"},
    {"obj", OutputFormat::obj, "Wavefront OBJ: all faces, one group each, with normals"}};

constexpr Choice<StepSchema> schemas[] = {
    {"AP214", StepSchema::AP214, "automotive design"},
    {"AP242", StepSchema::AP242, "managed model-based engineering (default)"}};

template <class E>
WordFamily family(std::string_view name, std::string_view description, std::span<const Choice<E>> choices) {
  WordFamily f{name, description, {}};
  for (const Choice<E>& c : choices) f.words.push_back({c.name, c.description});
  return f;
}

}  // namespace

std::span<const Choice<LengthUnit>> unit_choices() { return units; }
std::span<const Choice<Continuity>> continuity_choices() { return continuities; }
std::span<const Choice<TrimlineSpec::Kind>> trimline_choices() { return trimlines; }
std::span<const Choice<MagnitudeRule>> magnitude_choices() { return magnitudes; }
std::span<const Choice<SideSpec::Keep>> keep_choices() { return keeps; }
std::span<const Choice<CorrespondenceRule>> correspondence_choices() { return correspondences; }
std::span<const Choice<BlendMode>> mode_choices() { return modes; }
std::span<const Choice<BlendFrame>> frame_choices() { return frames; }
std::span<const Choice<SixthOrderFamily>> family_choices() { return families; }
std::span<const Choice<ObjectiveKind>> objective_choices() { return objectives; }
std::span<const Choice<OutputFormat>> format_choices() { return formats; }
std::span<const Choice<StepSchema>> step_schema_choices() { return schemas; }

const std::vector<WordFamily>& word_families() {
  static const std::vector<WordFamily> all = {
      family("unit", "Unit of all lengths", unit_choices()),
      family("continuity", "What a side is asked to reach", continuity_choices()),
      family("trimline", "Kinds of trimline", trimline_choices()),
      family("magnitude_rule", "Length of the cross tangent", magnitude_choices()),
      family("keep", "Which part of the primary stays", keep_choices()),
      family("correspondence_rule", "Which points of the trimlines are joined", correspondence_choices()),
      family("mode", "What the sweep equation holds for", mode_choices()),
      family("frame", "Axes of b, c and d", frame_choices()),
      family("family", "Sixth-order families, used when a side asks for G2", family_choices()),
      family("objective", "What a fit may ask of a blend", objective_choices()),
      family("format", "Output files", format_choices()),
      family("step_schema", "STEP application protocol", step_schema_choices()),
      {"face_kind",
       "Surface of a STEP face",
       {{"plane", ""},
        {"cylinder", ""},
        {"cone", ""},
        {"sphere", ""},
        {"torus", ""},
        {"bspline", ""},
        {"revolution", ""},
        {"extrusion", ""},
        {"other", ""}}},
      {"edge_kind",
       "Curve of a STEP edge",
       {{"line", ""}, {"circle", ""}, {"ellipse", ""}, {"bspline", ""}, {"other", ""}}}};
  return all;
}

const WordFamily& word_family(std::string_view name) {
  for (const WordFamily& f : word_families())
    if (f.name == name) return f;
  throw std::out_of_range("no family of words is named " + std::string(name));
}

}  // namespace blendwright
