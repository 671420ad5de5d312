#include "verify/certify/piece_search.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>

#include "kernel/base/number_text.hpp"
#include "kernel/base/parallel_for.hpp"
#include "kernel/geometry/bspline.hpp"

namespace blendwright::detail {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double narrowest = 0x1p-32;  // piece, relative to the domain

struct Figure {
  Bounds SeamPiece::*bounds;
  ProvenFigure SeamCertificate::*result;
  double SeamSample::*sample;
  const char* name;
  double rounding;  ///< of a value of size 1, where that is the size of the figure; else of underflow
};
constexpr double underflow = 0x1p-480;  // the root of what products and sums of models lose at most
constexpr std::array<Figure, 3> figures{
    {{&SeamPiece::gap, &SeamCertificate::gap, &SeamSample::gap, "gap", underflow},
     {&SeamPiece::angle, &SeamCertificate::angle, &SeamSample::angle, "angle", 0x1p-52},
     {&SeamPiece::curvature, &SeamCertificate::curvature, &SeamSample::curvature, "curvature jump",
      underflow}}};

std::string place(double v) { return " at v = " + number_text(v, 6); }

void enclose_all(const PieceSource& source, std::vector<SeamPiece>& pieces, std::size_t from) {
  parallel_for(pieces.size() - from, 8, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = from + begin; i < from + end; ++i) pieces[i] = source.enclosed(pieces[i].v);
  });
}

/// Single places: ends of pieces, where splines have their knots and round most, and middles.
std::vector<SeamPiece> single_places(const std::vector<SeamPiece>& pieces) {
  const std::size_t places = std::min<std::size_t>(32, pieces.size());
  std::vector<SeamPiece> points;
  for (std::size_t i = 0; i < places; ++i) {
    const Interval& v = pieces[i * pieces.size() / places].v;
    for (const double at : {v.lo, v.middle()}) points.push_back({.v = {at, at}});
  }
  return points;
}

/// Widest bounds at a single place that are rounding and no pole; nullopt where nothing is bounded.
std::optional<double> usual_width(const std::vector<SeamPiece>& points, const Figure& f) {
  std::vector<double> widths;
  for (const SeamPiece& p : points) {
    const double width = (p.*f.bounds).hi - (p.*f.bounds).lo;
    if (std::isfinite(width)) widths.push_back(width);
  }
  if (widths.empty()) return std::nullopt;
  std::sort(widths.begin(), widths.end());
  const double usual = widths[widths.size() / 2];
  return *std::find_if(widths.rbegin(), widths.rend(), [&](double w) { return w <= 64.0 * usual; });
}

/// (4) of every figure; and (5), what is sampled at the same places lies within the bounds there.
void compare_at_places(const PieceSource& source, const std::vector<SeamPiece>& pieces,
                       SeamCertificate& certificate) {
  std::vector<SeamPiece> points = single_places(pieces);
  enclose_all(source, points, 0);
  for (const Figure& f : figures)
    if (const auto width = usual_width(points, f)) (certificate.*f.result).floor = 4.0 * *width + f.rounding;
  for (const SeamPiece& p : points) {
    if (p.stops) continue;  // samples look further inside
    const SeamSample sample = source.sample(p.v.lo);
    for (const Figure& f : figures) {
      ProvenFigure& figure = certificate.*f.result;
      const Bounds& b = p.*f.bounds;
      const double x = sample.*f.sample;
      if (!b.finite() || b.hi - b.lo > figure.floor || std::isnan(x)) continue;
      if (x >= b.lo - figure.floor && x <= b.hi + figure.floor) continue;
      figure.unproven = "a sample of " + scientific_text(x) + " lies outside of the bounds [" +
                        scientific_text(b.lo) + ", " + scientific_text(b.hi) + "]" + place(p.v.lo) +
                        ": the surface is not evaluated as it is defined";
    }
  }
}

/// Largest bound and its place; the largest value known to occur.
void measure(const std::vector<SeamPiece>& pieces, const Figure& f, ProvenFigure& figure) {
  figure.proven = 0.0;
  for (const SeamPiece& p : pieces) {
    const Bounds& b = p.*f.bounds;
    figure.found = std::max(figure.found, b.lo);
    if (!(b.hi > figure.proven)) continue;
    figure.proven = b.hi;
    figure.v = p.v.middle();
  }
}

double target(const ProvenFigure& figure, double ratio) {
  const double sampled = std::isfinite(figure.sampled) ? figure.sampled : 0.0;
  return ratio * std::max(sampled, figure.found) + figure.floor;
}

/// A figure that is unbounded everywhere has no enclosure; halving would not help.
bool nowhere_bounded(const std::vector<SeamPiece>& pieces, const Figure& f) {
  return std::none_of(pieces.begin(), pieces.end(),
                      [&](const SeamPiece& p) { return std::isfinite((p.*f.bounds).hi); });
}

struct Search {
  const PieceSource& source;
  const CertifyOptions& options;
  SeamCertificate& certificate;
  std::vector<SeamPiece> pieces{};
  std::array<bool, figures.size()> open{};          ///< figures that may still come to agree
  std::array<std::size_t, figures.size()> spent{};  ///< pieces made for each, of its share of the work

  void measure_all() {
    for (const Figure& f : figures) measure(pieces, f, certificate.*f.result);
  }
  /// Whether figure k wants this piece halved.
  [[nodiscard]] bool too_wide(const SeamPiece& p, std::size_t k) const {
    return open[k] && (p.*figures[k].bounds).hi > target(certificate.*figures[k].result, options.ratio);
  }
  /// Unbounded where the trimline stops: the half that stops there will be too.
  [[nodiscard]] static bool hopeless(const SeamPiece& p, std::size_t k) {
    return p.stops && !std::isfinite((p.*figures[k].bounds).hi);
  }
  /// Halves every piece that is too wide; false when there is none. A figure that is too wide on the
  /// narrowest piece, or has spent its share, is given up.
  [[nodiscard]] bool halve() {
    const double least = narrowest * source.domain.length();
    for (std::size_t k = 0; k < figures.size(); ++k)
      open[k] = open[k] && 2 * spent[k] < options.max_pieces &&
                std::none_of(pieces.begin(), pieces.end(), [&](const SeamPiece& p) {
                  return (p.v.length() <= least && too_wide(p, k)) || hopeless(p, k);
                });
    std::vector<SeamPiece> kept, halves;
    for (SeamPiece& p : pieces) {
      bool split = false;
      for (std::size_t k = 0; k < figures.size(); ++k) {
        if (!too_wide(p, k)) continue;
        split = true;
        spent[k] += 2;
      }
      if (!split) {
        kept.push_back(std::move(p));
        continue;
      }
      const double middle = p.v.middle();
      halves.push_back({.v = {p.v.lo, middle}});
      halves.push_back({.v = {middle, p.v.hi}});
    }
    const std::size_t old = kept.size();
    certificate.pieces += halves.size();
    kept.insert(kept.end(), halves.begin(), halves.end());
    pieces = std::move(kept);
    enclose_all(source, pieces, old);
    return !halves.empty();
  }
};

void conclude(ProvenFigure& figure, const Figure& f, const CertifyOptions& options,
              const std::vector<SeamPiece>& pieces) {
  if (!figure.unproven.empty()) return;  // (5)
  const auto stop = std::find_if(pieces.begin(), pieces.end(), [&](const SeamPiece& p) {
    return p.stops && !std::isfinite((p.*f.bounds).hi);
  });
  if (std::isnan(figure.sampled))
    figure.unproven = "the samples are not numbers";
  else if (stop != pieces.end())
    figure.unproven = std::string("no bound of the ") + f.name + place(stop->v.middle()) +
                      ": the trimline stops there, which divides 0 by 0 twice";
  else if (!std::isfinite(figure.proven))
    figure.unproven = std::string("no bound of the ") + f.name + place(figure.v);
  else if (figure.sampled > figure.proven + figure.floor)
    figure.unproven = "a sample exceeds the bound: the surface is not evaluated as it is defined";
  else if (!(figure.proven <= target(figure, options.ratio)))
    figure.unproven =
        "the bound stays above " + number_text(options.ratio, 3) + " times what is known to occur" +
        place(figure.v) +
        (figure.proven > 1.5 && f.result == &SeamCertificate::angle ? ": no normal is certain there" : "");
  else if (figure.found > options.ratio * figure.sampled + figure.floor)
    figure.unproven = "between the samples, at least " + scientific_text(figure.found) + place(figure.v);
}

}  // namespace

void refuse(SeamCertificate& certificate, const std::string& why) {
  for (const Figure& f : figures) {
    (certificate.*f.result).proven = infinity;
    (certificate.*f.result).unproven = why;
  }
}

std::vector<Interval> first_pieces(const Surface& blend) {
  constexpr int steps = 64;
  const Interval domain = blend.domain().v;
  std::vector<double> at;
  if (const auto* spline = blend.target<BSplineSurface>()) {
    at = spline->basis_v().breaks();
  } else {
    for (int i = 0; i < steps; ++i) at.push_back(domain.at(static_cast<double>(i) / steps));
    at.push_back(domain.hi);
  }
  std::vector<Interval> pieces;
  for (std::size_t i = 0; i + 1 < at.size(); ++i) pieces.push_back({at[i], at[i + 1]});
  return pieces;
}

void prove(const PieceSource& source, const CertifyOptions& options, SeamCertificate& c) {
  Search search{source, options, c};
  for (const Interval& v : source.first) search.pieces.push_back({.v = v});
  c.pieces = search.pieces.size();
  enclose_all(source, search.pieces, 0);
  for (const SeamPiece& p : search.pieces)
    if (!p.unproven.empty()) {
      refuse(c, p.unproven);
      return;
    }
  std::array<bool, figures.size()> bounded{};
  for (std::size_t k = 0; k < figures.size(); ++k)
    bounded[k] = search.open[k] = !nowhere_bounded(search.pieces, figures[k]);
  compare_at_places(source, search.pieces, c);
  do search.measure_all();
  while (search.halve());
  for (std::size_t k = 0; k < figures.size(); ++k) {
    conclude(c.*figures[k].result, figures[k], options, search.pieces);
    if (!bounded[k])
      (c.*figures[k].result).unproven =
          source.unbounded.empty()
              ? std::string("the surfaces have no enclosure of what the ") + figures[k].name + " needs"
              : source.unbounded;
  }
}

}  // namespace blendwright::detail
