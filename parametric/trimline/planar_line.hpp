#pragma once
// A trimline in the plane of its primary's parameters, stretched to model units, and as a polygon close to
// it. Private to this module.
#include <vector>

#include "parametric/trimline/trimline.hpp"

namespace blendwright {

/// Whole numbers of periods along u and v.
struct Turns {
  int u = 0, v = 0;
  bool operator==(const Turns&) const = default;
};

class PlanarLine {
 public:
  /// A corner of the polygon.
  struct Sample {
    double v;
    Vec2 c, c1;     ///< the point and its derivative along v
    double turned;  ///< sum of the angles the tangent has turned by since the start of the line
  };

  /// `scale`: model units per parameter of u and v.
  PlanarLine(const Trimline& line, const Vec2& scale);

  [[nodiscard]] const std::vector<Sample>& samples() const { return samples_; }
  [[nodiscard]] std::size_t segments() const { return samples_.size() - 1; }
  /// How far the line may be from segment i.
  [[nodiscard]] double deviation(std::size_t i) const;
  [[nodiscard]] double total_turning() const { return samples_.back().turned; }
  /// Any v on a closed line: it goes on unrolled.
  [[nodiscard]] Sample at(double v) const;
  [[nodiscard]] const CurveDomain& domain() const { return domain_; }
  [[nodiscard]] const Vec2& period() const { return period_; }  ///< 0 along open directions
  [[nodiscard]] Vec2 shift(Turns t) const { return {t.u * period_[0], t.v * period_[1]}; }
  [[nodiscard]] Turns advance() const { return advance_; }  ///< of a closed line over its period

 private:
  void subdivide(const Sample& a, const Sample& b, double longest, int depth);

  Curve2 pcurve_;
  CurveDomain domain_;
  Vec2 scale_, period_;
  Turns advance_;
  std::vector<Sample> samples_;
};

/// Mean |Su| and |Sv| along the line; 1 where it is 0.
[[nodiscard]] Vec2 mean_scale(const Trimline& line);

}  // namespace blendwright
