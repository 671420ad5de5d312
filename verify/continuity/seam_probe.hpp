#pragma once
// Measures a joint at one parameter v; equations (1)-(5) of seam.hpp.
#include <optional>

#include "verify/continuity/seam.hpp"

namespace blendwright::detail {

struct SeamSample {
  double v = 0.0;
  Vec3 point;  ///< on the blend
  UV foot;     ///< on the primary
  double gap = 0.0, surface_gap = 0.0, angle = 0.0, curvature = 0.0, transverse = 0.0, fold = 0.0;
};

class SeamProbe {
 public:
  /// `seam` must outlive the probe and have a primary.
  explicit SeamProbe(const Seam& seam);
  /// `guess` starts the search for the foot where there is no pcurve; without it the search is global.
  [[nodiscard]] SeamSample measure(double v, std::optional<UV> guess) const;
  [[nodiscard]] Interval domain() const { return domain_; }
  [[nodiscard]] double length() const { return length_; }  ///< of the blend's edge, about
  /// |Su x Sv| of the blend at or below this is no normal: angles are taken a millionth of the domain further
  /// inside.
  [[nodiscard]] double least_normal() const;

 private:
  struct Place {
    SurfaceJet blend, primary;
    UV foot;
    Vec3 C1;  ///< derivative of the trimline
  };
  [[nodiscard]] Place place(double v, std::optional<UV> guess) const;
  [[nodiscard]] UV search(const Vec3& point, std::optional<UV> guess) const;
  [[nodiscard]] double distance_to_primary(const Place& at) const;
  [[nodiscard]] bool degenerate(const Place& at) const;
  void add_directions(const Place& at, SeamSample& sample) const;

  const Seam& seam_;
  const Surface& primary_;
  Interval domain_;
  double u_ = 0.0;
  double length_ = 0.0;  ///< mean |Sv| times the length of the domain
  double area_ = 0.0;    ///< mean |Su| times mean |Sv|
};

}  // namespace blendwright::detail
