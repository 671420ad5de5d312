#include "tests/bench/fcl_pairs.hpp"

#ifdef BLENDWRIGHT_WITH_FCL
#include <fcl/geometry/shape/box.h>
#include <fcl/geometry/shape/ellipsoid.h>
#include <fcl/geometry/shape/sphere.h>
#include <fcl/narrowphase/collision.h>

namespace blendwright::bench {
namespace {

std::shared_ptr<fcl::CollisionGeometryd> geometry(const Convex& body) {
  const Vec3& s = body.size;
  if (body.shape == Shape::sphere) return std::make_shared<fcl::Sphered>(s.x());
  if (body.shape == Shape::ellipsoid) return std::make_shared<fcl::Ellipsoidd>(s.x(), s.y(), s.z());
  return std::make_shared<fcl::Boxd>(2.0 * s.x(), 2.0 * s.y(), 2.0 * s.z());
}
fcl::Transform3d transform(const RigidMotion& m) {
  fcl::Transform3d t = fcl::Transform3d::Identity();
  t.linear() = m.R;
  t.translation() = m.t;
  return t;
}

}  // namespace

struct FclPair::Objects {
  fcl::CollisionObjectd first, second;
};

bool fcl_is_here() { return true; }

FclPair::FclPair(const Pair& pair)
    : objects_(new Objects{fcl::CollisionObjectd(geometry(pair.first), transform(pair.first.at)),
                           fcl::CollisionObjectd(geometry(pair.second), transform(pair.second.at))}) {}

bool FclPair::in_contact(FclSolver solver) const {
  fcl::CollisionRequestd request;
  request.gjk_solver_type = solver == FclSolver::libccd ? fcl::GST_LIBCCD : fcl::GST_INDEP;
  fcl::CollisionResultd result;
  return fcl::collide(&objects_->first, &objects_->second, request, result) > 0;
}

#else
namespace blendwright::bench {

struct FclPair::Objects {};
bool fcl_is_here() { return false; }
FclPair::FclPair(const Pair&) {}
bool FclPair::in_contact(FclSolver) const { return false; }

#endif

FclPair::~FclPair() = default;
FclPair::FclPair(FclPair&&) noexcept = default;
FclPair& FclPair::operator=(FclPair&&) noexcept = default;

}  // namespace blendwright::bench
