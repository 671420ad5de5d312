// Choosing faces and edges of a part by geometry; nothing is chosen when the choice is not unique.
#include <BRepBuilderAPI_MakeVertex.hxx>
#include <BRepExtrema_DistShapeShape.hxx>
#include <algorithm>
#include <limits>

#include "kernel/base/number_text.hpp"
#include "kernel/brep/occt_geometry.hpp"
#include "kernel/brep/step_part_impl.hpp"

namespace blendwright {
namespace {

struct Candidate {
  std::size_t index = 0;
  double distance = 0.0;
};

double distance(const Vec3& p, const TopoDS_Shape& shape) {
  return detail::guarded<GeometryError>("distance to a face or edge", [&] {
    BRepExtrema_DistShapeShape d(BRepBuilderAPI_MakeVertex(detail::pnt(p)).Vertex(), shape);
    return d.IsDone() && d.NbSolution() > 0 ? d.Value() : std::numeric_limits<double>::infinity();
  });
}

std::string selector(const char* key, const std::string& kind, const Vec3& near, const std::string& size) {
  const auto round = [](double x) { return number_text(x, 9); };
  return std::string("{\"") + key + "\": \"" + kind + "\", \"near\": [" + round(near.x()) + ", " +
         round(near.y()) + ", " + round(near.z()) + "]}" + (size.empty() ? "" : "  " + size);
}

/// The one candidate that is nearest; else an InputError at `where` that lists `all` (nearest first) by
/// `text`.
template <class Text>
std::size_t the_one(std::vector<Candidate> found, std::vector<Candidate> all, const std::string& what,
                    bool near, double slack, const char* where, Text text) {
  const auto nearer = [](const Candidate& a, const Candidate& b) { return a.distance < b.distance; };
  std::stable_sort(found.begin(), found.end(), nearer);
  if (!found.empty() && !(found.front().distance < std::numeric_limits<double>::infinity())) found.clear();
  if (found.size() == 1) return found.front().index;
  if (found.size() > 1 && near && found[1].distance > found[0].distance + slack) return found.front().index;
  std::string message;
  if (found.empty()) {
    message = "matches no " + what + "; must match one of";
    found = std::move(all);
    std::stable_sort(found.begin(), found.end(), nearer);
  } else {
    message =
        near ? "two or more " + what + "s are equally near; \"near\" must be nearest to one of"
             : "matches " + std::to_string(found.size()) + " " + what + "s, must match one; add \"near\" of";
  }
  constexpr std::size_t most = 24;
  for (std::size_t i = 0; i < std::min(most, found.size()); ++i) message += "\n  " + text(found[i].index);
  if (found.size() > most) message += "\n  and " + std::to_string(found.size() - most) + " more";
  throw InputError(where, message);
}

}  // namespace

std::size_t StepPart::select(const FaceSelector& s) const {
  std::vector<Candidate> found, all;
  for (const FaceInfo& f : impl_->faces) {
    all.push_back({f.index, s.near ? distance(*s.near, impl_->face(f.index)) : 0.0});
    if (s.surface.empty() || f.surface == s.surface) found.push_back(all.back());
  }
  return the_one(std::move(found), std::move(all), s.surface.empty() ? "face" : s.surface + " face",
                 s.near.has_value(), 1e-6 * impl_->size, "select", [&](std::size_t i) {
                   const FaceInfo& f = impl_->faces[i];
                   return selector("surface", f.surface, f.anchor, f.size);
                 });
}

std::size_t StepPart::select(const EdgeSelector& s, std::optional<std::size_t> of_face) const {
  std::vector<Candidate> found, all;
  for (const EdgeInfo& e : impl_->edges) {
    if (of_face && std::find(e.faces.begin(), e.faces.end(), *of_face) == e.faces.end()) continue;
    all.push_back({e.index, s.near ? distance(*s.near, impl_->edge(e.index)) : 0.0});
    if (s.curve.empty() || e.curve == s.curve) found.push_back(all.back());
  }
  return the_one(std::move(found), std::move(all), s.curve.empty() ? "edge" : s.curve + " edge",
                 s.near.has_value(), 1e-6 * impl_->size, "near", [&](std::size_t i) {
                   const EdgeInfo& e = impl_->edges[i];
                   return selector("curve", e.curve, e.anchor, e.size);
                 });
}

}  // namespace blendwright
