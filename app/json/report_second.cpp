// The report's object "second_path".
#include "app/json/report_objects.hpp"

namespace blendwright {
namespace {

struct ScaledFigure {
  const SecondFigure& figure;
  double factor = 1.0;
};
constexpr Field<ScaledFigure> figure_fields[] = {
    {"places", "integer", "places compared; 0: none, and the rest does not count",
     [](const ScaledFigure& f) { return JsonValue(f.figure.places); }},
    {"first", "number", "as the seam check has it, where the two come nearest to disagreeing",
     [](const ScaledFigure& f) { return JsonValue(f.figure.first * f.factor); }},
    {"second", "number", "as the second path has it there",
     [](const ScaledFigure& f) { return JsonValue(f.figure.second * f.factor); }},
    {"difference", "number", "of the two, or what the second is above the first where only that is wrong",
     [](const ScaledFigure& f) { return JsonValue(f.figure.difference * f.factor); }},
    {"bound", "number", "by how much they may differ there",
     [](const ScaledFigure& f) { return JsonValue(f.figure.bound * f.factor); }},
    {"at", "number", "where: v along the trimline, u for a closing seam",
     [](const ScaledFigure& f) { return JsonValue(f.figure.v); }},
    {"agrees", "boolean", "false: the program has a defect",
     [](const ScaledFigure& f) { return JsonValue(f.figure.agrees()); }},
};
JsonValue figure(const SecondFigure& f, double factor = 1.0) {
  return written<ScaledFigure>({f, factor}, figure_fields);
}
constexpr double per_degree = Radians(1.0).degrees();

constexpr Field<SecondSeam> seam_fields[] = {
    {"gap", "second_figure", "distance to the trimline, model units",
     [](const SecondSeam& s) { return figure(s.gap); }},
    {"surface_gap", "second_figure", "distance to the primary surface, model units",
     [](const SecondSeam& s) { return figure(s.surface_gap); }},
    {"angle_deg", "second_figure", "angle between the tangent planes, degrees",
     [](const SecondSeam& s) { return figure(s.angle, per_degree); }},
};
JsonValue seam(const SecondSeam& s) { return written<SecondSeam>(s, seam_fields); }

constexpr Field<SecondClosing> closing_fields[] = {
    {"gap", "second_figure", "mismatch of position, model units",
     [](const SecondClosing& c) { return figure(c.gap); }},
    {"angle_deg", "second_figure", "mismatch of the tangent planes, degrees",
     [](const SecondClosing& c) { return figure(c.angle, per_degree); }},
};

constexpr Field<BlendReport::Second> second_fields[] = {
    {"from", "second_side", "the side u = 0", [](const BlendReport::Second& s) { return seam(s.seams[0]); }},
    {"to", "second_side", "the side u = 1", [](const BlendReport::Second& s) { return seam(s.seams[1]); }},
    {"closing", "second_closing or null", "closed blends: where v starts again",
     [](const BlendReport::Second& s) {
       return s.closing ? written<SecondClosing>(*s.closing, closing_fields) : JsonValue();
     }},
};

}  // namespace

JsonValue second_json(const BlendReport::Second& second) {
  return written<BlendReport::Second>(second, second_fields);
}

std::vector<ObjectInfo> second_objects() {
  return {object_info<BlendReport::Second>(
              "second_path", "Gaps and angles measured again by independent code", second_fields),
          object_info<SecondSeam>("second_side", "One trimline as measured twice", seam_fields),
          object_info<SecondClosing>("second_closing", "The closing seam as measured twice", closing_fields),
          object_info<ScaledFigure>("second_figure", "One figure as measured twice", figure_fields)};
}

}  // namespace blendwright
