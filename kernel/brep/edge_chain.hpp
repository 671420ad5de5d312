#pragma once
// Private: edges of a part that continue each other along faces on one surface.
#include <BRepAdaptor_Curve.hxx>
#include <map>
#include <set>
#include <vector>

#include "kernel/brep/occt_surface.hpp"
#include "kernel/brep/step_part_impl.hpp"

namespace blendwright::detail {

/// One edge of a chain, run through along its curve's parameter, or against it.
struct ChainLink {
  std::size_t edge = 0, face = 0;
  bool backward = false;
};

struct EdgeChain {
  std::vector<ChainLink> links;
  bool closed = false;    ///< ends where it starts, with the same tangent
  bool kept_left = true;  ///< material of the face to the left of the running direction
};

/// The edges around a group of faces: edge -> the one face of the group that uses it.
[[nodiscard]] std::map<std::size_t, std::size_t> border_edges(const StepPart::Impl& part,
                                                              const std::set<std::size_t>& group);

/// The edge alone, or with those that continue it tangentially along faces on the same elementary surface.
[[nodiscard]] EdgeChain edge_chain(const StepPart::Impl& part, std::size_t face, std::size_t edge,
                                   bool extend);

/// Position and first two derivatives of the edge of a link at t in [0, 1], in running direction.
struct LinkPoint {
  Vec3 C, C1, C2;
};
class LinkCurve {
 public:
  LinkCurve(const StepPart::Impl& part, const ChainLink& link);
  [[nodiscard]] LinkPoint at(double t) const;
  /// Parameter of the edge's own curve at t.
  [[nodiscard]] double own(double t) const {
    return backward_ ? last_ - t * (last_ - first_) : first_ + t * (last_ - first_);
  }
  /// t where the polynomial pieces of the edge's curve meet, 0 and 1 included.
  [[nodiscard]] std::vector<double> breaks() const;
  /// d own / dt
  [[nodiscard]] double rate() const { return backward_ ? first_ - last_ : last_ - first_; }

 private:
  BRepAdaptor_Curve curve_;
  bool backward_;
  double first_, last_;
};

}  // namespace blendwright::detail
