// The report: deterministic bytes, every figure with its place, and the tolerances that the verdict follows
// from.
#include <cmath>

#include "app/json/choices.hpp"
#include "app/json/job_reader.hpp"
#include "app/json/report_objects.hpp"

#ifndef BLENDWRIGHT_VERSION
#error "the build defines BLENDWRIGHT_VERSION"
#endif

namespace blendwright {
namespace {

template <class T, class Write>
JsonValue list(const T& items, Write write) {
  JsonValue::Array array;
  for (const auto& item : items) array.push_back(write(item));
  return array;
}
JsonValue texts(const std::vector<std::string>& items) {
  return list(items, [](const std::string& t) { return JsonValue(t); });
}
JsonValue point(const Vec3& p) { return JsonValue::array({p[0], p[1], p[2]}); }

/// A deviation in the unit that it is reported in.
struct Scaled {
  const Deviation& deviation;
  double factor = 1.0;
};
constexpr double per_degree = Radians(1.0).degrees();

constexpr Field<Scaled> deviation_fields[] = {
    {"largest", "number", "largest value",
     [](const Scaled& d) { return JsonValue(d.deviation.worst * d.factor); }},
    {"rms", "number", "root mean square",
     [](const Scaled& d) { return JsonValue(d.deviation.rms * d.factor); }},
    {"v", "number", "where the largest is, along the trimline",
     [](const Scaled& d) { return JsonValue(d.deviation.v); }},
    {"point", "point", "where the largest is", [](const Scaled& d) { return point(d.deviation.point); }},
};
JsonValue deviation(const Deviation& d, double factor = 1.0) {
  return written<Scaled>({d, factor}, deviation_fields);
}

constexpr Field<Deviation> smallest_fields[] = {
    {"smallest", "number", "smallest value", [](const Deviation& d) { return JsonValue(d.worst); }},
    {"v", "number", "where it is, along the trimline", [](const Deviation& d) { return JsonValue(d.v); }},
    {"point", "point", "where it is", [](const Deviation& d) { return point(d.point); }},
};

constexpr Field<Extreme> extreme_fields[] = {
    {"value", "number", "the value", [](const Extreme& e) { return JsonValue(e.value); }},
    {"u", "number", "where it is, across the blend", [](const Extreme& e) { return JsonValue(e.at.u); }},
    {"v", "number", "where it is, along the blend", [](const Extreme& e) { return JsonValue(e.at.v); }},
    {"point", "point", "where it is", [](const Extreme& e) { return point(e.point); }},
};
JsonValue extreme(const Extreme& e) { return extreme_json(e); }

/// A pair (sampled, proven) in the unit that it is reported in.
struct ScaledProof {
  const ProvenFigure& figure;
  double factor = 1.0;
};
constexpr Field<ScaledProof> proof_fields[] = {
    {"sampled", "number", "largest sample",
     [](const ScaledProof& p) { return JsonValue(p.figure.sampled * p.factor); }},
    {"proven", "number or null", "no value anywhere on the trimline is larger; null: nothing is proven",
     [](const ScaledProof& p) {
       return std::isfinite(p.figure.proven) ? JsonValue(p.figure.proven * p.factor) : JsonValue();
     }},
    {"found", "number", "a value that is proven to occur",
     [](const ScaledProof& p) { return JsonValue(p.figure.found * p.factor); }},
    {"floor", "number", "what rounding alone may add to the bound",
     [](const ScaledProof& p) { return JsonValue(p.figure.floor * p.factor); }},
    {"v", "number", "where the bound is largest, along the trimline",
     [](const ScaledProof& p) { return JsonValue(p.figure.v); }},
    {"unproven", "text or null", "why the pair does not agree within 10 %; null: it agrees",
     [](const ScaledProof& p) { return p.figure.agreed() ? JsonValue() : JsonValue(p.figure.unproven); }},
};
JsonValue proof(const ProvenFigure& figure, double factor = 1.0) {
  return written<ScaledProof>({figure, factor}, proof_fields);
}
constexpr Field<SeamCertificate> certificate_fields[] = {
    {"gap", "proof", "distance to the trimline, model units",
     [](const SeamCertificate& c) { return proof(c.gap); }},
    {"angle_deg", "proof", "angle between the tangent planes, degrees",
     [](const SeamCertificate& c) { return proof(c.angle, per_degree); }},
    {"curvature", "proof", "jump of the normal curvature, 1/model unit",
     [](const SeamCertificate& c) { return proof(c.curvature); }},
    {"pieces", "integer", "pieces of the trimline that were enclosed",
     [](const SeamCertificate& c) { return JsonValue(c.pieces); }},
};

/// One side at one stage, and what it is held against.
struct SideStage {
  const SeamReport& seam;
  const SeamCertificate* proven;
  Continuity asked;
  const Tolerance& tolerance;
};
constexpr Field<SideStage> side_fields[] = {
    {"asked", "text", "continuity asked", [](const SideStage& s) { return JsonValue(name(s.asked)); }},
    {"reached", "text", "continuity reached within the tolerance",
     [](const SideStage& s) { return JsonValue(name(reached(s.seam, s.tolerance))); }},
    {"measured", "boolean", "false: the side has no primary, and no figure below counts",
     [](const SideStage& s) { return JsonValue(s.seam.measured); }},
    {"samples", "integer", "places measured along the trimline",
     [](const SideStage& s) { return JsonValue(s.seam.samples); }},
    {"gap", "deviation", "distance to the trimline, model units",
     [](const SideStage& s) { return deviation(s.seam.gap); }},
    {"surface_gap", "deviation", "distance to the primary surface, model units",
     [](const SideStage& s) { return deviation(s.seam.surface_gap); }},
    {"angle_deg", "deviation", "angle between the tangent planes, degrees",
     [](const SideStage& s) { return deviation(s.seam.angle, per_degree); }},
    {"curvature", "deviation", "jump of the normal curvature across the trimline, 1/model unit",
     [](const SideStage& s) { return deviation(s.seam.curvature); }},
    {"transversality", "smallest", "sine of the angle between the blend's u-lines and the trimline",
     [](const SideStage& s) { return written<Deviation>(s.seam.transverse, smallest_fields); }},
    {"folded", "integer", "places where the blend leaves on the kept side",
     [](const SideStage& s) { return JsonValue(s.seam.folded); }},
    {"proven", "certificate or null", "bounds between the samples; null: not asked for",
     [](const SideStage& s) {
       return s.proven ? written<SeamCertificate>(*s.proven, certificate_fields) : JsonValue();
     }},
};

constexpr Field<ClosingReport> closing_fields[] = {
    {"gap", "number", "mismatch of position, model units",
     [](const ClosingReport& c) { return JsonValue(c.gap); }},
    {"angle_deg", "number", "mismatch of the tangent planes",
     [](const ClosingReport& c) { return JsonValue(c.angle.degrees()); }},
    {"curvature", "number", "mismatch of the normal curvature along v, 1/model unit",
     [](const ClosingReport& c) { return JsonValue(c.curvature); }},
    {"u", "number", "where the worst is, across the blend",
     [](const ClosingReport& c) { return JsonValue(c.u); }},
};

constexpr Field<Finding> finding_fields[] = {
    {"check", "text", "name of the check", [](const Finding& f) { return JsonValue(f.check); }},
    {"text", "text", "what was found", [](const Finding& f) { return JsonValue(f.text); }},
    {"failed", "boolean", "false: a note", [](const Finding& f) { return JsonValue(f.failed); }},
};

/// One blend at one stage.
struct Stage {
  const BlendReport& report;
  const BlendEntry& entry;
  const Tolerance& tolerance;
  LengthUnit unit;
};
JsonValue side(const Stage& s, std::size_t i) {
  const SeamCertificate* const proven = s.report.proven ? &(*s.report.proven)[i] : nullptr;
  return written<SideStage>({s.report.seams[i], proven, s.entry.sides[i].side.continuity, s.tolerance},
                            side_fields);
}
JsonValue penetration(const Stage& s, std::size_t i) {
  const auto& p = s.report.penetration[i];
  return p && p->judged ? extreme(p->depth) : JsonValue();
}
constexpr Field<Stage> stage_fields[] = {
    {"stage", "text", "formula: the exact blend; fitted: the B-spline; step: the STEP file read back",
     [](const Stage& s) { return JsonValue(s.report.stage); }},
    {"from", "side", "the side u = 0", [](const Stage& s) { return side(s, 0); }},
    {"to", "side", "the side u = 1", [](const Stage& s) { return side(s, 1); }},
    {"closing", "closing or null", "closed blends: mismatch where v starts again",
     [](const Stage& s) {
       return s.report.closing ? written<ClosingReport>(*s.report.closing, closing_fields) : JsonValue();
     }},
    {"smallest_area", "extreme", "least |Su x Sv| relative to the mean lengths",
     [](const Stage& s) { return extreme(s.report.fold.smallest_area); }},
    {"folds", "integer", "neighbouring samples whose normals differ by more than 90 degrees",
     [](const Stage& s) { return JsonValue(s.report.fold.folded); }},
    {"minimum_radius", "extreme", "smallest radius of curvature, model units",
     [](const Stage& s) { return extreme(s.report.minimum_radius); }},
    {"penetration_from", "extreme or null", "depth beyond the primary of u = 0; null: not judged",
     [](const Stage& s) { return penetration(s, 0); }},
    {"penetration_to", "extreme or null", "depth beyond the primary of u = 1; null: not judged",
     [](const Stage& s) { return penetration(s, 1); }},
    {"self_intersections", "integer", "pairs of triangles that cross",
     [](const Stage& s) { return JsonValue(s.report.self_intersection.pairs); }},
    {"fairness", "fairness or null", "energies and extremes of curvature; null: not asked for",
     [](const Stage& s) { return s.report.fairness ? fairness_json(*s.report.fairness) : JsonValue(); }},
    {"second_path", "second_path or null", "gaps and angles measured again; null: they were not",
     [](const Stage& s) { return s.report.second ? second_json(*s.report.second) : JsonValue(); }},
    {"findings", "list of finding", "every check that failed or has a note",
     [](const Stage& s) {
       const std::array asked{s.entry.sides[0].side.continuity, s.entry.sides[1].side.continuity};
       return list(judge(s.report, asked, s.tolerance, s.unit),
                   [](const Finding& f) { return written<Finding>(f, finding_fields); });
     }},
};

bool fourth_order(const BlendResult& b) { return b.blend.surface.order() == 4; }
JsonValue coefficients(const BlendResult& b) {
  const BlendShape& shape = b.blend.surface.shape();
  if (!fourth_order(b) || shape.repeated_root) return {};
  return list(shape.ode, [](const SweepOde& o) { return JsonValue::array({o.b, o.c, o.d}); });
}
constexpr Field<BlendResult> shape_fields[] = {
    {"mode", "text", "what the sweep equation holds for",
     [](const BlendResult& b) { return JsonValue(word_for(mode_choices(), b.blend.surface.shape().mode)); }},
    {"anchor", "point or null", "point of mode anchor",
     [](const BlendResult& b) {
       const BlendShape& s = b.blend.surface.shape();
       return s.mode == BlendMode::anchor ? point(s.anchor) : JsonValue();
     }},
    {"order", "integer", "4, or 6 when a side asks for G2",
     [](const BlendResult& b) { return JsonValue(b.blend.surface.order()); }},
    {"bcd", "list of list of number or null", "fourth order: b, c, d of each component",
     [](const BlendResult& b) { return coefficients(b); }},
    {"q", "number or null", "fourth order: the repeated root given instead",
     [](const BlendResult& b) {
       const auto q = b.blend.surface.shape().repeated_root;
       return q && fourth_order(b) ? JsonValue(*q) : JsonValue();
     }},
    {"family", "text or null", "sixth order: the family",
     [](const BlendResult& b) {
       return fourth_order(b) ? JsonValue()
                              : JsonValue(word_for(family_choices(), b.blend.surface.shape().family));
     }},
    {"tension", "number or null", "sixth order: the root q of the family",
     [](const BlendResult& b) {
       return fourth_order(b) ? JsonValue() : JsonValue(b.blend.surface.shape().tension);
     }},
    {"frame", "text", "axes of b, c and d",
     [](const BlendResult& b) {
       return JsonValue(word_for(frame_choices(), b.blend.surface.shape().frame));
     }},
    {"kappa", "list of number", "condition number of each component's boundary problem",
     [](const BlendResult& b) {
       JsonValue::Array kappas;
       for (int i = 0; i < 3; ++i) kappas.emplace_back(b.blend.surface.basis(i).kappa());
       return JsonValue(std::move(kappas));
     }},
};

struct Fit {
  const BlendFitReport& report;
  BlendFitOptions asked;
};
constexpr Field<Fit> fit_fields[] = {
    {"position_asked", "number", "largest distance allowed, model units",
     [](const Fit& f) { return JsonValue(f.asked.position); }},
    {"position_bound", "number", "bound on the distance to the exact blend",
     [](const Fit& f) { return JsonValue(f.report.position_bound); }},
    {"angle_asked_deg", "number", "largest angle allowed at the trimlines",
     [](const Fit& f) { return JsonValue(f.asked.angle.degrees()); }},
    {"angle_estimate_deg", "number", "largest sampled angle at the trimlines",
     [](const Fit& f) { return JsonValue(f.report.angle_estimate.degrees()); }},
    {"curvature_asked", "number", "largest curvature jump allowed at G2 trimlines, 1/model unit",
     [](const Fit& f) { return JsonValue(f.asked.curvature); }},
    {"curvature_estimate", "number", "largest sampled curvature jump at G2 trimlines",
     [](const Fit& f) { return JsonValue(f.report.curvature_estimate); }},
    {"spans_u", "integer", "polynomial pieces across",
     [](const Fit& f) { return JsonValue(f.report.spans_u); }},
    {"spans_v", "integer", "polynomial pieces along",
     [](const Fit& f) { return JsonValue(f.report.spans_v); }},
    {"control_points", "integer", "of the B-spline surface",
     [](const Fit& f) { return JsonValue(f.report.control_points); }},
};

struct BlendContext {
  const BlendResult& blend;
  const JobSpec& job;
};
constexpr Field<BlendContext> blend_fields[] = {
    {"name", "text", "the blend's name", [](const BlendContext& c) { return JsonValue(c.blend.entry.name); }},
    {"from", "text", "primary of the side u = 0",
     [](const BlendContext& c) { return JsonValue(c.blend.entry.sides[0].primary); }},
    {"to", "text", "primary of the side u = 1",
     [](const BlendContext& c) { return JsonValue(c.blend.entry.sides[1].primary); }},
    {"shape", "shape", "shape parameters as used",
     [](const BlendContext& c) { return written<BlendResult>(c.blend, shape_fields); }},
    {"fit", "fit", "the exported B-spline",
     [](const BlendContext& c) {
       return written<Fit>({c.blend.fit.report, fit_options(c.job.tolerance)}, fit_fields);
     }},
    {"stages", "list of stage", "what was measured, stage by stage",
     [](const BlendContext& c) {
       return list(c.blend.stages, [&](const BlendReport& r) {
         return written<Stage>({r, c.blend.entry, c.job.tolerance, c.job.unit}, stage_fields);
       });
     }},
    {"warnings", "list of text", "warnings of the construction",
     [](const BlendContext& c) { return texts(c.blend.blend.warnings); }},
};

constexpr Field<Tolerance> tolerance_fields[] = {
    {"position", "number", "model units", [](const Tolerance& t) { return JsonValue(t.position); }},
    {"angle_deg", "number", "degrees", [](const Tolerance& t) { return JsonValue(t.angle.degrees()); }},
    {"curvature", "number", "1/model unit", [](const Tolerance& t) { return JsonValue(t.curvature); }},
};

constexpr Field<StepContent> step_fields[] = {
    {"schema", "text", "application protocol", [](const StepContent& s) { return JsonValue(s.schema); }},
    {"unit", "text", "unit of lengths in the file", [](const StepContent& s) { return JsonValue(s.unit); }},
    {"bytes", "integer", "size of the file", [](const StepContent& s) { return JsonValue(s.bytes); }},
    {"valid", "boolean", "the CAD kernel's check of every sub-shape",
     [](const StepContent& s) { return JsonValue(s.check.valid); }},
    {"largest_tolerance", "number", "over vertices, edges and faces",
     [](const StepContent& s) { return JsonValue(s.check.largest_tolerance); }},
    {"largest_edge_gap", "number", "measured distance between an edge and its faces",
     [](const StepContent& s) { return JsonValue(s.check.largest_edge_gap); }},
    {"faces", "integer", "faces", [](const StepContent& s) { return JsonValue(s.check.faces); }},
    {"shells", "integer", "shells", [](const StepContent& s) { return JsonValue(s.check.shells); }},
    {"solids", "integer", "solids", [](const StepContent& s) { return JsonValue(s.check.solids); }},
    {"free_edges", "integer", "edges of one face only",
     [](const StepContent& s) { return JsonValue(s.check.free_edges); }},
    {"unexpected_free_edges", "integer", "free edges on a blend's trimline",
     [](const StepContent& s) { return JsonValue(s.check.unexpected_free_edges); }},
    {"area", "number", "area of all faces", [](const StepContent& s) { return JsonValue(s.check.area); }},
    {"problems", "list of text", "what the CAD kernel objects to",
     [](const StepContent& s) { return texts(s.check.problems); }},
};

constexpr Field<WrittenFile> file_fields[] = {
    {"name", "text", "file name in the output folder",
     [](const WrittenFile& f) { return JsonValue(f.path.filename().string()); }},
    {"kind", "text", "its format", [](const WrittenFile& f) { return JsonValue(f.kind); }},
    {"bytes", "integer", "its size", [](const WrittenFile& f) { return JsonValue(f.bytes); }},
};

constexpr Field<StageTime> time_fields[] = {
    {"stage", "text", "what was done", [](const StageTime& t) { return JsonValue(t.stage); }},
    {"seconds", "number", "wall clock", [](const StageTime& t) { return JsonValue(t.seconds); }},
};

struct Report {
  const JobResult& result;
  const JobOutputs* outputs;
};
constexpr Field<Report> report_fields[] = {
    {"program", "text", "blendwright", [](const Report&) { return JsonValue("blendwright"); }},
    {"version", "text", "of the program", [](const Report&) { return JsonValue(BLENDWRIGHT_VERSION); }},
    {"job", "text", "name of the job", [](const Report& r) { return JsonValue(r.result.job.name); }},
    {"input_hash", "text", "64-bit FNV-1a of the job's text",
     [](const Report& r) { return JsonValue(r.result.job.source_hash); }},
    {"unit", "text", "unit of all lengths",
     [](const Report& r) { return JsonValue(word_for(unit_choices(), r.result.job.unit)); }},
    {"verified", "boolean", "every side reaches what was asked at its last stage, and the STEP file is sound",
     [](const Report& r) { return JsonValue(verified(r.result, r.outputs)); }},
    {"defects", "list of text", "figures that two measurements disagree about: the program is wrong there",
     [](const Report& r) { return texts(program_defects(r.result)); }},
    {"tolerance", "tolerance", "what counts as continuous",
     [](const Report& r) { return written<Tolerance>(r.result.job.tolerance, tolerance_fields); }},
    {"blends", "list of blend", "the blends in the order of the job",
     [](const Report& r) {
       return list(r.result.blends, [&](const BlendResult& b) {
         return written<BlendContext>({b, r.result.job}, blend_fields);
       });
     }},
    {"step", "step or null", "the STEP file as read back",
     [](const Report& r) {
       return r.outputs && r.outputs->step ? written<StepContent>(*r.outputs->step, step_fields)
                                           : JsonValue();
     }},
    {"files", "list of file", "what was written, besides the report itself",
     [](const Report& r) {
       JsonValue::Array files;
       if (r.outputs)
         for (const WrittenFile& f : r.outputs->files)
           if (f.kind != "report") files.push_back(written<WrittenFile>(f, file_fields));
       return JsonValue(std::move(files));
     }},
    {"warnings", "list of text", "warnings of the whole job",
     [](const Report& r) { return texts(r.result.warnings); }},
    {"notes", "list of text", "what was not written, and why",
     [](const Report& r) { return r.outputs ? texts(r.outputs->notes) : JsonValue(JsonValue::Array()); }},
};

}  // namespace

JsonValue extreme_json(const Extreme& e) { return written<Extreme>(e, extreme_fields); }

const std::vector<ObjectInfo>& report_objects() {
  static const std::vector<ObjectInfo> all = [] {
    ObjectInfo report = object_info<Report>("report", "What blendwright built and measured", report_fields);
    report.keys.push_back({"times", "list of time", "only when clock readings were asked for"});
    std::vector<ObjectInfo> objects{
        report,
        object_info<Tolerance>("tolerance", "What counts as continuous", tolerance_fields),
        object_info<BlendContext>("blend", "One blend", blend_fields),
        object_info<BlendResult>("shape", "Shape parameters as used", shape_fields),
        object_info<Fit>("fit", "The B-spline of the exact blend", fit_fields),
        object_info<Stage>("stage", "One blend as measured at one stage", stage_fields),
        object_info<SideStage>("side", "One trimline as measured", side_fields),
        object_info<Scaled>("deviation", "A deviation and its place", deviation_fields),
        object_info<SeamCertificate>("certificate", "Proven bounds of one trimline", certificate_fields),
        object_info<ScaledProof>("proof", "A figure as sampled and as proven", proof_fields),
        object_info<Deviation>("smallest", "A smallest value and its place", smallest_fields),
        object_info<Extreme>("extreme", "A value and its place on the blend", extreme_fields),
        fairness_object(),
        object_info<ClosingReport>("closing", "Where a closed blend meets itself", closing_fields),
        object_info<Finding>("finding", "A defect or a note", finding_fields),
        object_info<StepContent>("step", "The STEP file as read back", step_fields),
        object_info<WrittenFile>("file", "One file", file_fields),
        object_info<StageTime>("time", "A clock reading", time_fields)};
    for (ObjectInfo& object : second_objects()) objects.push_back(std::move(object));
    return objects;
  }();
  return all;
}

std::string report_json(const JobResult& result, const JobOutputs* outputs, bool times) {
  JsonValue report = written<Report>({result, outputs}, report_fields);
  if (times)
    report.add("times",
               list(result.times, [](const StageTime& t) { return written<StageTime>(t, time_fields); }));
  return json_text(report);
}

}  // namespace blendwright
