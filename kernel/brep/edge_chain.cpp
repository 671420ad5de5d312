#include "kernel/brep/edge_chain.hpp"

#include <BRep_Tool.hxx>
#include <TColStd_Array1OfReal.hxx>
#include <TopExp.hxx>
#include <TopExp_Explorer.hxx>
#include <TopoDS_Vertex.hxx>
#include <algorithm>
#include <map>
#include <optional>
#include <set>

#include "kernel/brep/occt_geometry.hpp"

namespace blendwright::detail {
namespace {

constexpr double largest_turn = 1.0 / 180.0 * std::numbers::pi;

Vec3 outward(const FaceGeometry& g, const Vec3& near) {
  const Vec2 uv = elementary_parameters(g.geometry, near).value_or(Vec2(g.box.u.middle(), g.box.v.middle()));
  gp_Pnt p;
  gp_Vec du, dv;
  g.geometry->D1(uv.x(), uv.y(), p, du, dv);
  const Vec3 n = vec(du).cross(vec(dv));
  return g.reversed ? Vec3(-n) : n;
}

/// Faces on the elementary surface of `face`, with the same outward side; `face` alone when it is not
/// elementary.
std::set<std::size_t> faces_on_same_surface(const StepPart::Impl& part, std::size_t face) {
  std::set<std::size_t> group{face};
  const FaceGeometry g = face_geometry(part.face(face));
  if (!elementary_parameters(g.geometry, Vec3::Zero())) return group;
  const double tolerance = std::max(1e-6 * part.size, 2.0 * part.tolerance);
  for (const FaceInfo& f : part.faces) {
    if (f.surface != part.faces[face].surface) continue;
    const FaceGeometry h = face_geometry(part.face(f.index));
    if (same_elementary(g.geometry, h.geometry, tolerance, part.size) &&
        outward(g, f.anchor).dot(outward(h, f.anchor)) > 0.0)
      group.insert(f.index);
  }
  return group;
}

TopoDS_Vertex vertex_at(const StepPart::Impl& part, const ChainLink& link, bool end) {
  TopoDS_Vertex first, last;
  const TopoDS_Edge edge = TopoDS::Edge(part.edge(link.edge).Oriented(TopAbs_FORWARD));
  TopExp::Vertices(edge, first, last);
  return end != link.backward ? last : first;
}

Vec3 tangent_at(const StepPart::Impl& part, const ChainLink& link, bool end) {
  return LinkCurve(part, link).at(end ? 1.0 : 0.0).C1.normalized();
}

/// The border edge that leaves the end of `link` in its direction (or enters its start, when `end` is false).
std::optional<ChainLink> neighbour(const StepPart::Impl& part,
                                   const std::map<std::size_t, std::size_t>& owner, const ChainLink& link,
                                   bool end) {
  const TopoDS_Vertex vertex = vertex_at(part, link, end);
  if (vertex.IsNull() || !part.edges_at_vertex.Contains(vertex)) return std::nullopt;
  const Vec3 direction = tangent_at(part, link, end);
  std::optional<ChainLink> best;
  double best_cosine = std::cos(largest_turn);
  for (const TopoDS_Shape& shape : part.edges_at_vertex.FindFromKey(vertex)) {
    const int k = part.edge_map.FindIndex(shape);
    if (k == 0) continue;
    const auto found = owner.find(static_cast<std::size_t>(k - 1));
    if (found == owner.end() || found->first == link.edge) continue;
    for (const bool backward : {false, true}) {
      const ChainLink next{found->first, found->second, backward};
      if (!vertex_at(part, next, !end).IsSame(vertex)) continue;
      const double cosine = tangent_at(part, next, !end).dot(direction);
      if (cosine < best_cosine) continue;
      best_cosine = cosine;
      best = next;
    }
  }
  return best;
}

bool holds(const EdgeChain& chain, std::size_t edge) {
  return std::any_of(chain.links.begin(), chain.links.end(),
                     [&](const ChainLink& l) { return l.edge == edge; });
}

void extend_both_ways(const StepPart::Impl& part, EdgeChain& chain,
                      const std::map<std::size_t, std::size_t>& owner) {
  while (!chain.closed) {
    const auto next = neighbour(part, owner, chain.links.back(), true);
    if (!next) break;
    if (next->edge == chain.links.front().edge)
      chain.closed = true;
    else if (holds(chain, next->edge))
      break;
    else
      chain.links.push_back(*next);
  }
  while (!chain.closed) {
    const auto previous = neighbour(part, owner, chain.links.front(), false);
    if (!previous || holds(chain, previous->edge)) break;
    chain.links.insert(chain.links.begin(), *previous);
  }
}

bool material_left(const StepPart::Impl& part, const ChainLink& link) {
  for (TopExp_Explorer e(part.face(link.face), TopAbs_EDGE); e.More(); e.Next())
    if (e.Current().IsSame(part.edge(link.edge)))
      return (e.Current().Orientation() == TopAbs_FORWARD) != link.backward;
  return true;
}

}  // namespace

std::map<std::size_t, std::size_t> border_edges(const StepPart::Impl& part,
                                                const std::set<std::size_t>& group) {
  std::map<std::size_t, std::size_t> uses, owner;
  for (const std::size_t f : group)
    for (TopExp_Explorer e(part.face(f), TopAbs_EDGE); e.More(); e.Next())
      if (const int k = part.edge_map.FindIndex(e.Current()); k > 0) {
        ++uses[static_cast<std::size_t>(k - 1)];
        owner[static_cast<std::size_t>(k - 1)] = f;
      }
  std::erase_if(owner, [&](const auto& item) { return uses[item.first] > 1; });
  return owner;
}

LinkCurve::LinkCurve(const StepPart::Impl& part, const ChainLink& link)
    : curve_(part.edge(link.edge)),
      backward_(link.backward),
      first_(curve_.FirstParameter()),
      last_(curve_.LastParameter()) {}

LinkPoint LinkCurve::at(double t) const {
  gp_Pnt p;
  gp_Vec d1, d2;
  curve_.D2(own(t), p, d1, d2);
  return {vec(p), rate() * vec(d1), rate() * rate() * vec(d2)};
}

std::vector<double> LinkCurve::breaks() const {
  const int count = curve_.NbIntervals(GeomAbs_C3);
  TColStd_Array1OfReal at(1, count + 1);
  curve_.Intervals(at, GeomAbs_C3);
  std::vector<double> t;
  for (const double x : at) t.push_back((x - own(0.0)) / rate());
  std::sort(t.begin(), t.end());
  t.front() = 0.0;
  t.back() = 1.0;
  return t;
}

EdgeChain edge_chain(const StepPart::Impl& part, std::size_t face, std::size_t edge, bool extend) {
  EdgeChain chain;
  chain.links.push_back({edge, face, false});
  chain.kept_left = material_left(part, chain.links.front());
  const ChainLink& only = chain.links.front();
  if (part.edges[edge].closed)
    chain.closed = tangent_at(part, only, true).dot(tangent_at(part, only, false)) > std::cos(largest_turn);
  else if (extend)
    extend_both_ways(part, chain, border_edges(part, faces_on_same_surface(part, face)));
  return chain;
}

}  // namespace blendwright::detail
