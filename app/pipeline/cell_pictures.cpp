#include "app/pipeline/cell_pictures.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "app/pipeline/solid_section.hpp"
#include "kernel/base/number_text.hpp"
#include "kernel/exchange/picture.hpp"

namespace blendwright {
namespace {

using Verdict = SearchCell::Verdict;

constexpr std::array verdicts{Verdict::outside_first, Verdict::outside_second, Verdict::separated,
                              Verdict::witness, Verdict::undecided};
constexpr double layer = 4e-4;  // of the picture's size: faces in the cut lie over each other
constexpr double mark = 0.25;   // length of the normal, of what the picture is about
const std::array<Colour, 2> solid_colours{{{0.55, 0.66, 0.80}, {0.85, 0.70, 0.48}}};
const Colour mark_colour{0.75, 0.05, 0.10};

Colour colour_of(Verdict verdict) {
  switch (verdict) {
    case Verdict::outside_first:
      return {0.97, 0.91, 0.78};
    case Verdict::outside_second:
      return {0.84, 0.90, 0.97};
    case Verdict::separated:
      return {0.60, 0.83, 0.62};
    case Verdict::witness:
      return {0.86, 0.16, 0.20};
    case Verdict::undecided:
      return {0.98, 0.76, 0.10};
  }
  return {};
}

Colour darker(const Colour& c, double part) { return {part * c.r, part * c.g, part * c.b}; }

std::string key_text(Verdict verdict, std::span<const Body> bodies) {
  switch (verdict) {
    case Verdict::outside_first:
      return "outside " + bodies[0].name;
    case Verdict::outside_second:
      return "outside " + bodies[1].name;
    case Verdict::separated:
      return "separated";
    case Verdict::witness:
      return "holds a witness";
    case Verdict::undecided:
      return "undecided";
  }
  return "";
}

std::string answer_text(std::span<const Body> bodies, const Collision& c) {
  std::string text = bodies[0].name + " and " + bodies[1].name + ": " + std::string(name(c.contact));
  if (c.gap) {
    const std::string length = scientific_text(std::abs(*c.gap)) + " " + name(bodies[0].scene.spec.unit);
    text += *c.gap > 0.0 ? ", gap " + length : ", penetration " + length;
  }
  return text;
}

/// Through the place of contact, along the normal there.
Cut cut_of(const Collision& c, const Box& domain, std::optional<int> axis) {
  const Vec3 place = c.point ? *c.point : c.undecided ? c.undecided->centre() : domain.centre();
  Cut cut;
  if (axis)
    cut.k = *axis;
  else if (c.normal)
    for (const int k : {1, 0})
      if (std::abs((*c.normal)[k]) < std::abs((*c.normal)[cut.k])) cut.k = k;
  cut.at = place[cut.k];
  cut.sense = cut.k == 1 ? -1.0 : 1.0;  // as the default view, from the right, the front and above
  return cut;
}

Vec3 view_of(const Cut& cut) {
  Vec3 view(0.55, -0.75, 0.5);
  view[cut.k] = 1.5 * cut.sense;
  return view;
}

/// Rectangles across axis k at x_k = `at`, one per box.
PictureMesh tiles(std::span<const Box> boxes, int k, double at, const Colour& colour, double opacity) {
  PictureMesh shown{{}, colour, opacity};
  const int i = (k + 1) % 3, j = (k + 2) % 3;
  for (const Box& box : boxes) {
    const auto first = static_cast<std::uint32_t>(shown.mesh.points.size());
    for (const auto& [u, v] : {std::pair(box.lo[i], box.lo[j]),
                               {box.hi[i], box.lo[j]},
                               {box.hi[i], box.hi[j]},
                               {box.lo[i], box.hi[j]}}) {
      Vec3& p = shown.mesh.points.emplace_back();
      p[k] = at;
      p[i] = u;
      p[j] = v;
    }
    shown.mesh.triangles.push_back({first, first + 1, first + 2});
    shown.mesh.triangles.push_back({first, first + 2, first + 3});
    for (std::uint32_t n = 0; n < 4; ++n) shown.edges.push_back({first + n, first + (n + 1) % 4});
  }
  shown.edge_colour = darker(colour, 0.6);
  shown.edge_width = 0.5;
  return shown;
}

/// A ball of 10 x 20 faces.
TriMesh small_ball(const Vec3& centre, double radius) {
  TriMesh ball;
  constexpr std::uint32_t rows = 10, columns = 20;
  for (std::uint32_t i = 0; i <= rows; ++i)
    for (std::uint32_t j = 0; j < columns; ++j) {
      const double t = std::numbers::pi * i / rows, p = 2.0 * std::numbers::pi * j / columns;
      const Vec3 n(std::sin(t) * std::cos(p), std::sin(t) * std::sin(p), std::cos(t));
      ball.points.push_back(centre + radius * n);
      ball.normals.push_back(n);
      const std::uint32_t a = i * columns + j, b = i * columns + (j + 1) % columns;
      if (i < rows) {
        ball.triangles.push_back({a, a + columns, b + columns});
        ball.triangles.push_back({a, b + columns, b});
      }
    }
  return ball;
}

/// Builds a picture of two solids and the cells between them.
class CellPicture {
 public:
  CellPicture(std::span<const Body> bodies, const Collision& collision, std::optional<int> axis)
      : bodies_(bodies), collision_(collision), domain_(domain_of(bodies, collision)) {
    cut_ = cut_of(collision, domain_, axis);
    size_ = domain_.size().maxCoeff();
    for (const Body& body : bodies) size_ = std::max(size_, seen_of(body).size().maxCoeff());
    picture_.title = answer_text(bodies, collision);
    picture_.view = view_of(cut_);
  }

  /// Both cut open through the place of contact, the cells there as a sheet on the cut.
  Picture section(const Progress& progress) {
    for (std::size_t i = 0; i < 2; ++i) {
      SolidSection made = cut_open(bodies_[i].scene.scene.field, seen_of(bodies_[i]), cut_, progress);
      const Colour& colour = solid_colours[i];
      if (made.surface.triangles.empty()) continue;
      picture_.meshes.push_back({std::move(made.surface), colour});
      picture_.keys.push_back({bodies_[i].name, colour});
      if (made.section.triangles.empty()) continue;
      raise(made.section, static_cast<double>(i));
      picture_.meshes.push_back({made.section, colour});
      picture_.meshes.back().edges = made.outline;
      picture_.meshes.back().edge_width = 0.0;
      PictureMesh outline{{bodies_[i].name, made.section.points, {}, {}, {}, {}}, colour};
      outline.edges = std::move(made.outline);
      outline.edge_colour = darker(colour, 0.3);
      outline.edge_width = 2.0;
      raise(outline.mesh, 3.0);
      picture_.meshes.push_back(std::move(outline));
    }
    const double place = cut_.at;
    add_sheet(place, cut_.at + 2.0 * layer * size_ * cut_.sense);
    add_mark(4.0 * layer * size_);
    return std::move(picture_);
  }

  /// Seen along the axis of the bars, which are a sheet before both solids.
  Picture bars(const Progress& progress) {
    picture_.view = cut_.sense * Vec3::Unit(cut_.k);
    double front = (cut_.sense > 0.0 ? domain_.hi : domain_.lo)[cut_.k];
    for (std::size_t i = 0; i < 2; ++i) {
      const Box seen = seen_of(bodies_[i]);
      const double end = (cut_.sense > 0.0 ? seen.hi : seen.lo)[cut_.k];
      if (cut_.sense * (end - front) > 0.0) front = end;
      SolidSection made = cut_open(bodies_[i].scene.scene.field, seen, std::nullopt, progress);
      if (made.surface.triangles.empty()) continue;
      picture_.meshes.push_back({std::move(made.surface), solid_colours[i]});
      picture_.keys.push_back({bodies_[i].name, solid_colours[i]});
    }
    add_sheet(domain_.centre()[cut_.k], front + layer * size_ * cut_.sense);
    if (collision_.point) add_mark(std::abs(front - (*collision_.point)[cut_.k]) + 0.05 * size_);
    return std::move(picture_);
  }

 private:
  static Box domain_of(std::span<const Body> bodies, const Collision& collision) {
    std::optional<Box> domain;
    for (const SearchCell& cell : collision.cells) domain = domain ? hull(*domain, cell.box) : cell.box;
    std::optional<Box> both;
    for (const Body& body : bodies) {
      const auto& bounds = body.scene.scene.field.bounds();
      if (!bounds || !bounds->finite()) continue;
      both = both ? common(*both, *bounds) : bounds;
      if (!both) break;
    }
    if (both) domain = domain ? hull(*domain, *both) : both;
    if (domain) return *domain;
    const Vec3 place = collision.point.value_or(Vec3::Zero());
    return {place, place};
  }

  /// All of a solid, or what lies around the cells when it has no end.
  [[nodiscard]] Box seen_of(const Body& body) const {
    const auto& bounds = body.scene.scene.field.bounds();
    const bool whole = bounds && bounds->finite();
    const Box& box = whole ? *bounds : domain_;
    const Vec3 margin = Vec3::Constant(std::max(1e-12, (whole ? 0.02 : 0.75) * box.size().maxCoeff()));
    return {box.lo - margin, box.hi + margin};
  }

  void raise(TriMesh& mesh, double layers) const {
    for (Vec3& p : mesh.points) p[cut_.k] += layers * layer * size_ * cut_.sense;
  }

  /// The cells that the plane x_k = place meets, as a sheet at x_k = at.
  void add_sheet(double place, double at) {
    for (const Verdict verdict : verdicts) {
      std::vector<Box> boxes;
      for (const SearchCell& cell : collision_.cells)
        if (cell.verdict == verdict && cell.box.axis(cut_.k).contains(place)) boxes.push_back(cell.box);
      if (boxes.empty()) continue;
      const bool outside = verdict == Verdict::outside_first || verdict == Verdict::outside_second;
      picture_.meshes.push_back(tiles(boxes, cut_.k, at, colour_of(verdict), outside ? 0.45 : 0.7));
      picture_.keys.push_back({key_text(verdict, bodies_), colour_of(verdict)});
    }
  }

  /// The place of contact and its normal.
  void add_mark(double raised) {
    if (!collision_.point) return;
    const double size = std::max(domain_.size().maxCoeff(), 0.3 * size_);
    Vec3 place = *collision_.point;
    place[cut_.k] += cut_.sense * raised;
    picture_.meshes.push_back({small_ball(place, 0.06 * mark * size), mark_colour});
    picture_.keys.push_back(
        {collision_.contact == Contact::contact ? "witness, normal" : "nearest place, normal", mark_colour});
    if (!collision_.normal) return;
    Vec3 along = *collision_.normal;
    along[cut_.k] = 0.0;  // what the cut shows of it
    if (along.norm() > 0.1)
      picture_.lines.push_back({"normal", {place, place + mark * size * along}, false, {}});
  }

  std::span<const Body> bodies_;
  const Collision& collision_;
  Box domain_;
  Cut cut_;
  double size_ = 0.0;
  Picture picture_;
};

}  // namespace

BoxCells cells_of(std::span<const Body> bodies, const Collision& collision) {
  const std::string length = name(bodies[0].scene.spec.unit);
  BoxCells cells{bodies[0].name + " and " + bodies[1].name, {}, {}, {}, {}};
  cells.note = std::string(name(collision.contact)) + ", scenes " + bodies[0].scene.name + " (" +
               bodies[0].scene.source_hash + ") and " + bodies[1].scene.name + " (" +
               bodies[1].scene.source_hash + ")";
  Column verdict{"verdict", "", 1, {}, {}}, size{"size", length, 1, {}, {}};
  for (const Verdict v : verdicts) verdict.labels.emplace_back(name(v));
  for (const SearchCell& cell : collision.cells) {
    cells.boxes.push_back(cell.box);
    verdict.values.push_back(static_cast<double>(cell.verdict));
    size.values.push_back(cell.box.size().maxCoeff());
  }
  cells.columns = {std::move(verdict), std::move(size)};
  const auto fact = [&](const char* what, const std::string& unit, int components,
                        std::vector<double> values) {
    cells.facts.push_back({what, unit, components, std::move(values), {}});
  };
  if (const auto& p = collision.point) fact("point", length, 3, {p->x(), p->y(), p->z()});
  if (const auto& n = collision.normal) fact("normal", "", 3, {n->x(), n->y(), n->z()});
  if (collision.gap) fact("gap", length, 1, {*collision.gap});
  if (const auto& b = collision.undecided)
    fact("undecided", length, 3, {b->lo.x(), b->lo.y(), b->lo.z(), b->hi.x(), b->hi.y(), b->hi.z()});
  return cells;
}

void write_cells_picture(const std::filesystem::path& png, std::span<const Body> bodies,
                         const Collision& collision, std::optional<int> axis, std::vector<std::string>& notes,
                         const Progress& progress) {
  const Display display;
  if (!display.available()) {
    notes.push_back("pictures skipped: " + display.reason());
    return;
  }
  CellPicture made(bodies, collision, axis);
  write_picture(png, axis ? made.bars(progress) : made.section(progress), display);
}

}  // namespace blendwright
