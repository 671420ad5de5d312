// The report's object "fairness".
#include "app/json/report_objects.hpp"

namespace blendwright {
namespace {

/// A draft angle in degrees.
JsonValue draft(const std::optional<std::array<Extreme, 2>>& draft, std::size_t end) {
  if (!draft) return {};
  Extreme angle = (*draft)[end];
  angle.value = Radians(angle.value).degrees();
  return extreme_json(angle);
}

constexpr Field<FairnessReport> fairness_fields[] = {
    {"area", "number", "of the surface, model units squared",
     [](const FairnessReport& f) { return JsonValue(f.area); }},
    {"bending_energy", "number", "integral of k1^2 + k2^2 over the surface",
     [](const FairnessReport& f) { return JsonValue(f.bending); }},
    {"thin_plate_energy", "number", "integral of |Suu|^2 + 2 |Suv|^2 + |Svv|^2, model units squared",
     [](const FairnessReport& f) { return JsonValue(f.thin_plate); }},
    {"curvature_variation", "number", "integral of (dk/ds)^2 across the blend, 1/model unit squared",
     [](const FairnessReport& f) { return JsonValue(f.variation); }},
    {"largest_curvature", "extreme", "largest principal curvature, signed by Su x Sv, 1/model unit",
     [](const FairnessReport& f) { return extreme_json(f.largest); }},
    {"smallest_curvature", "extreme", "smallest principal curvature",
     [](const FairnessReport& f) { return extreme_json(f.smallest); }},
    {"minimum_radius", "extreme", "smallest radius of curvature, model units",
     [](const FairnessReport& f) { return extreme_json(f.minimum_radius); }},
    {"most_turns", "integer", "local extremes of curvature inside a line across the blend, at most",
     [](const FairnessReport& f) { return JsonValue(f.turns.most); }},
    {"most_turns_v", "number", "the first line with that many",
     [](const FairnessReport& f) { return JsonValue(f.turns.v); }},
    {"average_turns", "number", "per line",
     [](const FairnessReport& f) { return JsonValue(f.turns.average); }},
    {"least_draft_deg", "extreme or null",
     "angle between the wall and the pull direction; null: none was given",
     [](const FairnessReport& f) { return draft(f.draft, 0); }},
    {"most_draft_deg", "extreme or null", "the same, largest",
     [](const FairnessReport& f) { return draft(f.draft, 1); }},
    {"unmeasured", "integer", "samples without a normal",
     [](const FairnessReport& f) { return JsonValue(f.unmeasured); }},
};

}  // namespace

JsonValue fairness_json(const FairnessReport& fairness) {
  return written<FairnessReport>(fairness, fairness_fields);
}

ObjectInfo fairness_object() {
  return object_info<FairnessReport>("fairness", "How fair the surface is", fairness_fields);
}

}  // namespace blendwright
