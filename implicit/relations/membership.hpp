#pragma once
// Whether points belong to a solid.
#include <span>

#include "kernel/field/scalar_field.hpp"

namespace blendwright {

enum class Place { outside = 0, boundary = 1, inside = 2 };
[[nodiscard]] std::string_view name(Place place);

struct MembershipOptions {
  enum class Mode {
    value,      ///< boundary: |phi| <= tolerance, a field value
    length,     ///< boundary: |phi| <= tolerance |grad phi|, tolerance a length, with what rounding adds
    guaranteed  ///< boundary: 0 is in the range of phi over the point's box of half size tolerance (a length)
  } mode = Mode::length;
  double tolerance = 1e-9;
  /// Report the boundary only where the solid's outside is met within the tolerance: unions have zeros
  /// inside.
  bool confirm = false;
};

struct Membership {
  bool belongs = false;          ///< S2: phi >= 0, the solid is closed
  Place place = Place::outside;  ///< S3
  double phi = 0.0;
  double distance = 0.0;  ///< |phi| / |grad phi|: first order, no bound; infinite without a gradient
};

/// Point membership, 2- and 3-valued (Vyatkin 2014, (16), (17)). Throws InputError ("tolerance", "points").
[[nodiscard]] std::vector<Membership> membership(const ScalarField& solid, std::span<const Vec3> points,
                                                 const MembershipOptions& options);

}  // namespace blendwright
