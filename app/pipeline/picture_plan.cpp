#include "app/pipeline/picture_plan.hpp"

#include <algorithm>
#include <cmath>

#include "app/json/json_value.hpp"
#include "app/json/object_reader.hpp"
#include "app/pipeline/picture_comb.hpp"
#include "app/pipeline/picture_deviation.hpp"
#include "app/pipeline/picture_views.hpp"
#include "kernel/base/number_text.hpp"

namespace blendwright {
namespace {

using Role = PicturePart::Role;

constexpr double outlier_part = 0.02;  // of the values at each end that may lie beyond the bar
constexpr double outlier_ratio = 1.0;  // how far the extremes must be beyond the others to be left out
const Colour blend_colour{0.90, 0.55, 0.15}, primary_colour{0.72, 0.75, 0.80}, other_colour{0.80, 0.72, 0.58};

Colour colour_of(Role role) {
  return role == Role::blend ? blend_colour : role == Role::primary ? primary_colour : other_colour;
}

/// Figures of joints belong to blends; everything else to all surfaces.
bool of_joints(const PictureJob& job) {
  return job.show == Show::gap || job.show == Show::angle ||
         (job.show == Show::curvature && job.options.curvature == CurvatureFigure::jump);
}

std::string length_unit(const PictureInput& input) { return input.unit ? name(*input.unit) : ""; }

std::string with_unit(const std::string& figure, const std::string& unit) {
  return unit.empty() ? figure : figure + " " + unit;
}

/// Three digits, or an exponent where that is shorter.
std::string figure_text(double x) {
  const double size = std::abs(x);
  if (size == 0.0) return "0";
  return size >= 1e-3 && size < 1e5 ? number_text(x, 3) : scientific_text(x);
}

/// Errors below the rounding of any length are told as 0.
std::string error_text(double x) {
  if (x < 1e-18) return "0";
  return x >= 0.01 && x < 1e5 ? number_text(x, 2) : scientific_text(x);
}

std::string point_text(const Vec3& p, double size) {
  const auto text = [&](int k) { return place_text(p[k], 1e-3 * size); };
  return "(" + text(0) + ", " + text(1) + ", " + text(2) + ")";
}

double size_of(const PictureInput& input) {
  Vec3 lo = Vec3::Constant(std::numeric_limits<double>::max()), hi = -lo;
  const auto add = [&](const std::vector<Vec3>& points) {
    for (const Vec3& p : points) {
      lo = lo.cwiseMin(p);
      hi = hi.cwiseMax(p);
    }
  };
  for (const PicturePart& part : input.parts) add(part.mesh.points);
  for (const PolyLine& line : input.lines) add(line.points);
  return lo.x() <= hi.x() ? (hi - lo).norm() : 0.0;
}

/// What this input can show, for the message when it cannot show what was asked for.
std::vector<std::string> possible(const PictureInput& input) {
  std::vector<std::string> names;
  for (const ShowRow& row : show_table()) {
    bool can = row.show != Show::deviation && row.show != Show::field;
    if (row.show == Show::field) can = input.kind == PictureInput::Kind::scene;
    for (const PicturePart& part : input.parts) {
      if (!can || row.show == Show::plain) break;
      const bool joints = row.show == Show::gap || row.show == Show::angle;
      if (joints && part.role != Role::blend) {
        can = std::any_of(input.parts.begin(), input.parts.end(),
                          [](const PicturePart& p) { return p.role == Role::blend; });
        continue;
      }
      TriMesh mesh = part.mesh;
      if (row.show == Show::comb)
        can = !mesh.normals.empty();
      else
        can = add_column(mesh, row.show, {});
    }
    if (can) names.emplace_back(row.name);
  }
  return names;
}

[[noreturn]] void refuse(const PictureInput& input, const PictureJob& job) {
  std::string text = "is " + in_quotes(row_of(job.show).name);
  const bool normals = row_of(job.show).from_normals || job.show == Show::draft || job.show == Show::comb;
  if (normals)
    text += ", which needs exact normals that " + input.name + " does not have; a .vtp or a .ply keeps them";
  else
    text += ", which " + input.name + " does not know";
  text += "; it can show " + listed(possible(input));
  throw InputError("--show", text);
}

/// Adds the column to every part that is to be coloured; true for these.
std::vector<bool> coloured_parts(PictureInput& input, const PictureJob& job) {
  std::vector<bool> coloured;
  bool any = false;
  const bool pattern = row_of(job.show).from_normals;
  for (PicturePart& part : input.parts) {
    bool shown = !of_joints(job) || part.role == Role::blend || input.kind == PictureInput::Kind::mesh;
    if (shown && pattern)
      shown = !part.mesh.normals.empty();
    else if (shown)
      shown = add_column(part.mesh, job.show, job.options);
    coloured.push_back(shown);
    any = any || shown;
  }
  if (!any) refuse(input, job);
  return coloured;
}

/// Finite values of the mode's column in all coloured meshes.
std::vector<double> shown_values(const Picture& picture, bool magnitudes) {
  std::vector<double> values;
  for (const PictureMesh& m : picture.meshes) {
    if (!m.coloured) continue;
    for (const double x : find_column(m.mesh, picture.column)->values)
      if (!std::isnan(x)) values.push_back(magnitudes ? std::abs(x) : x);
  }
  return values;
}

std::string range_text(const PictureFigure& f) {
  const std::string least = figure_text(f.least), most = figure_text(f.most);
  return with_unit(least == most ? most : least + " to " + most, f.unit);
}

PictureFigure figure_of(const PictureJob& job, const std::vector<double>& values) {
  const std::string title = bar_title(job.show, job.options);
  PictureFigure f{title.substr(0, title.find(" (")), unit_of(job.show, job.options), 0.0, 0.0};
  const ValueRange range = range_of(values);
  f.least = range.least;
  f.most = range.most;
  return f;
}

/// The worst joint figures where they are known, for pictures of how surfaces meet.
std::string title_of(const PictureInput& input, const PictureJob& job, const PicturePlan& plan) {
  const WorstFigures worst = worst_of(input);
  const std::string shown = std::string(row_of(job.show).name);
  switch (job.show) {
    case Show::plain:
    case Show::zebra:
    case Show::isophotes: {
      const std::string what = job.show == Show::plain   ? ""
                               : job.show == Show::zebra ? "zebra stripes"
                                                         : shown;
      if (worst.known) return (what.empty() ? "" : what + ", ") + worst.text(input);
      return what;
    }
    case Show::radius:
      return "least radius " + with_unit(figure_text(plan.figure->least), plan.figure->unit);
    case Show::draft:
      return "draft angle " + range_text(*plan.figure);
    case Show::gap:
    case Show::angle:
      if (worst.known) return worst.text(input);
      return "largest " + plan.figure->name + " " +
             with_unit(scientific_text(plan.figure->most), plan.figure->unit);
    default:
      return plan.figure->name + " " + range_text(*plan.figure);
  }
}

std::string caption_of(const PictureInput& input, const PictureJob& job) {
  const bool signed_figure = job.show == Show::curvature && job.options.curvature != CurvatureFigure::jump;
  switch (job.show) {
    case Show::curvature:
      if (!signed_figure) return "jumps are measured along the trimlines and run linearly between them";
      if (job.options.curvature == CurvatureFigure::gaussian) return "negative where the surface is a saddle";
      return input.kind == PictureInput::Kind::mesh ? "signs belong to the normals of the file"
                                                    : "positive where convex, seen from outside";
    case Show::gap:
    case Show::angle:
      return input.job ? "measured along the trimlines, runs linearly between them" : "";
    case Show::draft: {
      const Vec3& pull = job.options.pull;
      return "pull (" + number_text(pull.x(), 3) + ", " + number_text(pull.y(), 3) + ", " +
             number_text(pull.z(), 3) + "); 0: the wall stands along it, negative: undercut or lower half";
    }
    case Show::zebra:
      return "reflections of " + number_text(job.options.stripes, 3) +
             " pairs of strips; a kink shows a curvature jump";
    default:
      return "";
  }
}

std::vector<CombLine> comb_lines(const PictureInput& input, const PictureJob& job) {
  std::vector<CombLine> lines;
  std::vector<const TriMesh*> others;
  for (const PicturePart& part : input.parts) {
    if (part.role != Role::blend || !part.surface) {
      others.push_back(&part.mesh);
      continue;
    }
    const auto us = find_column(part.mesh, "u")->values, vs = find_column(part.mesh, "v")->values;
    const std::size_t middle = part.mesh.points.size() / 2;
    const SurfaceJet jet = part.surface->jet({us[middle], vs[middle]});
    const double side = jet.Su.cross(jet.Sv).dot(part.mesh.normals[middle]) < 0.0 ? -1.0 : 1.0;
    for (CombLine& line : comb_across(*part.surface, job.comb_lines, 40, side))
      lines.push_back(std::move(line));
  }
  if (!lines.empty()) return lines;
  const ScalarField* field = input.scene ? &input.scene->scene.field : nullptr;
  return comb_of_sections(others, std::max<std::size_t>(job.comb_lines / 2, 1), 180, field);
}

void add_comb(PicturePlan& plan, const PictureInput& input, const PictureJob& job) {
  Picture& picture = *plan.picture;
  Comb comb = comb_of(comb_lines(input, job), size_of(input));
  if (comb.hairs.edges.empty()) {
    const bool normals = std::any_of(input.parts.begin(), input.parts.end(),
                                     [](const PicturePart& p) { return !p.mesh.normals.empty(); });
    if (!normals) refuse(input, job);
    plan.notes.push_back("the surface is flat: the comb has no hairs");
  }
  const std::string unit = input.unit ? "1/" + length_unit(input) : "";
  const std::string per_length = input.unit ? length_unit(input) + "^-1" : "";
  plan.figure = PictureFigure{"curvature", unit, comb.least, comb.most};
  picture.keys = {{"hair: curvature", comb.hairs.edge_colour}, {"envelope", comb.envelope.edge_colour}};
  if (comb.scale > 0.0)
    picture.length_bar =
        LengthBar{comb.scale * comb.shown, "hair of " + with_unit(figure_text(comb.shown), per_length)};
  picture.caption = comb.inward ? "hairs stand out where hollow" : "hairs stand out where convex";
  if (job.dark) comb.hairs.edge_colour = picture.keys[0].colour = {0.45, 0.68, 0.95};
  picture.meshes.push_back(std::move(comb.hairs));
  picture.meshes.push_back(std::move(comb.envelope));
}

void add_light_scale(PicturePlan& plan) {
  Axis axis{0.0, 90.0, false, {}};
  for (int i = 0; i <= isophote_bands; ++i) {
    const int degrees = 90 * i / isophote_bands;
    axis.ticks.push_back({static_cast<double>(degrees), std::to_string(degrees)});
  }
  plan.picture->scale = ColourScale(ColourMap::sequential, std::move(axis));
}

/// Trimlines stay visible, but for stripes, which they would cut.
bool shows_lines(const PictureJob& job) { return !row_of(job.show).from_normals; }

}  // namespace

std::string WorstFigures::text(const PictureInput& input) const {
  const std::string unit = length_unit(input);
  return "largest gap " + with_unit(error_text(gap), unit) + ", angle " + error_text(angle_deg) +
         " deg, curvature jump " + with_unit(error_text(jump), unit.empty() ? "" : "1/" + unit);
}

WorstFigures worst_of(const PictureInput& input) {
  WorstFigures worst;
  const auto add = [&](double gap, double angle, double jump) {
    worst.known = true;
    worst.gap = std::max(worst.gap, gap);
    worst.angle_deg = std::max(worst.angle_deg, angle);
    worst.jump = std::max(worst.jump, jump);
  };
  if (input.job)
    for (const BlendResult& b : input.job->blends)
      for (const SeamReport& s : b.stages.back().seams)
        add(s.gap.worst, Radians(s.angle.worst).degrees(), s.curvature.worst);
  if (!input.job)
    for (const PolyLine& line : input.lines) {
      const auto most = [&](const char* name) -> std::optional<double> {
        for (const Column& c : line.columns)
          if (c.name == name) return range_of(c.values).most;
        return std::nullopt;
      };
      const auto gap = most("gap"), angle = most("angle_deg"), jump = most("curvature_jump");
      if (gap && angle && jump) add(*gap, *angle, *jump);
    }
  return worst;
}

void set_up(Picture& picture, const PictureInput& input, const PictureJob& job) {
  picture.title = input.name;
  picture.width = job.width;
  picture.height = job.height;
  picture.dark = job.dark;
  picture.to_light = job.to_light;
  if (job.from && !job.views.empty())
    throw InputError("--from", "is given beside --views, must be alone: it is a view of its own");
  if (job.from) picture.view = job.from;
  std::vector<PictureView> views = views_named(job.views);
  if (views.empty() && !job.from) {
    std::vector<const TriMesh*> blends, primaries;
    for (const PicturePart& part : input.parts)
      (part.role == Role::blend ? blends : primaries).push_back(&part.mesh);
    if (!blends.empty()) picture.view = view_of_blends(blends, primaries);
  }
  if (views.size() == 1)
    picture.view = views.front().direction;
  else
    picture.views = std::move(views);
}

ColourScale scale_of(const PictureJob& job, std::vector<double> values) {
  const ScaleRule rule = scale_rule(job.show, job.options);
  if (job.range) {
    const ValueRange range{job.range->lo, job.range->hi, std::max(job.range->lo, 1e-16)};
    if (rule == ScaleRule::logarithmic) return {ColourMap::sequential, log_axis(range, 16, 9)};
    const bool diverging = rule == ScaleRule::diverging && job.range->lo < 0.0 && job.range->hi > 0.0;
    if (diverging && job.range->lo == -job.range->hi)
      return {ColourMap::diverging, linear_axis(range, 8, true)};
    return {ColourMap::sequential, linear_axis(range, 8, true)};
  }
  std::erase_if(values, [](double x) { return !std::isfinite(x); });
  if (rule == ScaleRule::logarithmic || values.size() < 100 || of_joints(job) || job.show == Show::deviation)
    return ColourScale::over(values, rule);
  const ValueRange all = range_of(values);
  const auto at = [&](double part) {
    const auto i = static_cast<std::ptrdiff_t>(part * static_cast<double>(values.size() - 1));
    std::nth_element(values.begin(), values.begin() + i, values.end());
    return values[static_cast<std::size_t>(i)];
  };
  const double lo = at(outlier_part), hi = at(1.0 - outlier_part),
               width = std::max(hi - lo, 1e-12 * (1.0 + std::abs(hi)));
  const bool cut_high = all.most > hi + outlier_ratio * width,
             cut_low = all.least < lo - outlier_ratio * width;
  for (double& x : values) x = std::clamp(x, cut_low ? lo : x, cut_high ? hi : x);
  const ColourScale scale = ColourScale::over(values, rule);
  Axis axis = scale.axis();
  const bool rises = axis.ticks.front().value < axis.ticks.back().value;
  Tick &low = rises ? axis.ticks.front() : axis.ticks.back(),
       &high = rises ? axis.ticks.back() : axis.ticks.front();
  const auto value = [&](double end) { return axis.logarithmic ? std::pow(10.0, end) : end; };
  const double rounding = 1e-9 * std::max(std::abs(all.least), std::abs(all.most));
  if (all.most > value(axis.hi) + rounding) high.label.insert(0, "> ");
  if (!axis.logarithmic && all.least < axis.lo - rounding) low.label.insert(0, "< ");
  return {scale.map(), std::move(axis)};
}

PicturePlan plan_of_surface(PictureInput input, const PictureJob& given, const Progress& progress) {
  PictureJob job = given;
  if (input.unit) job.options.unit = *input.unit;
  PicturePlan plan;
  plan.notes = input.notes;
  plan.picture.emplace();
  Picture& picture = *plan.picture;
  set_up(picture, input, job);
  std::string caption = caption_of(input, job), other_text;
  if (job.show == Show::deviation) {
    const PictureInput other = job.other ? *job.other : read_picture_input(job.to, job.reading, progress);
    const DeviationFacts facts = add_deviation(input, other, progress);
    const std::string unit = length_unit(input);
    other_text = "largest deviation " + with_unit(figure_text(facts.worst), unit) + " from " + other.name;
    caption =
        "at " + point_text(facts.at, size_of(input)) + ", rms " + with_unit(figure_text(facts.rms), unit);
    if (facts.facets > 0.0)
      caption += ", right to " + with_unit(scientific_text(facts.facets, 1), unit) + " (triangles)";
  }
  const bool plain = job.show == Show::plain || job.show == Show::comb;
  const bool pattern = row_of(job.show).from_normals;
  const std::vector<bool> coloured =
      plain ? std::vector<bool>(input.parts.size(), false) : coloured_parts(input, job);
  if (!plain && !pattern) picture.column = column_of(job.show, job.options);
  for (std::size_t i = 0; i < input.parts.size(); ++i)
    picture.meshes.push_back({input.parts[i].mesh, colour_of(input.parts[i].role), 1.0, coloured[i]});
  if (shows_lines(job)) picture.lines = input.lines;
  picture.caption = std::move(caption);
  picture.bar_title = bar_title(job.show, job.options);
  if (job.show == Show::zebra) picture.pattern = SurfacePattern::zebra;
  if (job.show == Show::isophotes) picture.pattern = SurfacePattern::isophotes;
  picture.stripes = job.options.stripes;
  if (job.show == Show::isophotes) add_light_scale(plan);
  if (job.show == Show::comb) add_comb(plan, input, job);
  if (!plain && !pattern) {
    const bool magnitudes = job.options.logarithmic;
    plan.figure = figure_of(job, shown_values(picture, false));
    if (magnitudes)
      for (PictureMesh& m : picture.meshes)
        for (Column& c : m.mesh.columns)
          if (c.name == picture.column)
            for (double& x : c.values) x = std::abs(x);
    picture.scale = scale_of(job, shown_values(picture, magnitudes));
    if (magnitudes && scale_rule(job.show, given.options) == ScaleRule::logarithmic &&
        plan.figure->least < 0.0)
      picture.bar_title.insert(0, "magnitude of ");
  }
  const std::string title = other_text.empty() ? title_of(input, job, plan) : other_text;
  if (!title.empty()) picture.title += ": " + title;
  return plan;
}

}  // namespace blendwright
