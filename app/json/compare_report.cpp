// The report of a comparison.
#include <cmath>

#include "app/json/compare_report.hpp"
#include "app/json/json_value.hpp"

namespace blendwright {
namespace {

using Value = JsonValue;

Value point(const Vec3& p) { return Value::array({p[0], p[1], p[2]}); }

Value way_json(const BodyDeviation& d) {
  Value way = Value::object({{"largest", d.largest},
                             {"proven", d.proven ? Value(*d.proven) : Value()},
                             {"point", point(d.at)},
                             {"foot", point(d.foot)},
                             {"piece", d.piece},
                             {"other_piece", d.other_piece},
                             {"mean", d.mean},
                             {"rms", d.rms},
                             {"percentile_95", d.percentile95},
                             {"signed", d.signs}});
  way.add("signed_mean", d.signs ? Value(d.signed_mean) : Value());
  way.add("least", d.signs ? Value(d.least) : Value());
  way.add("most", d.signs ? Value(d.most) : Value());
  way.add("samples", d.samples);
  return way;
}

Value result_json(const ComparedResult& r) {
  Value::Array pieces;
  for (const std::string& p : r.pieces) pieces.emplace_back(p);
  return Value::object({{"name", r.name},
                        {"pieces", std::move(pieces)},
                        {"surfaces", r.surfaces},
                        {"border_slack", 4.0 * r.sag},
                        {"triangles", r.triangles}});
}

}  // namespace

std::string compare_report_json(const CompareResult& result) {
  const auto within = result.within();
  Value report = Value::object({{"program", "blendwright " BLENDWRIGHT_VERSION},
                                {"unit", name(result.unit)},
                                {"first", result_json(result.results[0])},
                                {"second", result_json(result.results[1])},
                                {"hausdorff", result.largest()},
                                {"proven", result.proven() ? Value(*result.proven()) : Value()},
                                {"limit", result.limit ? Value(*result.limit) : Value()},
                                {"within_limit", !result.limit || !within ? Value() : Value(*within)},
                                {"first_to_second", way_json(result.ways[0])},
                                {"second_to_first", way_json(result.ways[1])}});
  Value::Array files, notes;
  for (const WrittenFile& f : result.files)
    files.push_back(Value::object({{"path", f.path.string()}, {"kind", f.kind}, {"bytes", f.bytes}}));
  for (const std::string& n : result.notes) notes.emplace_back(n);
  report.add("files", std::move(files));
  report.add("notes", std::move(notes));
  return json_text(report);
}

}  // namespace blendwright
