// The shared camera and the rays through its pixels.
#include "app/view/window/camera.hpp"

#include <gtest/gtest.h>

#include "app/view/window/layout.hpp"
#include "app/view/window/picking.hpp"

namespace blendwright {
namespace {

const PixelBox pane{300.0, 44.0, 1184.0, 960.0};

ViewCamera oblique() {
  ViewCamera camera;
  camera.focus = {3.0, -2.0, 5.0};
  camera.half_height = 7.5;
  return camera.looking({1.0, -1.2, 0.8});
}

// Numbers of order 10 and pixels of order 1000: some ten roundings of 1e3 * 2^-53 = 1.1e-13.
constexpr double pixel_tolerance = 1e-11;

TEST(ViewCamera, ARayGoesThroughWhatItsPixelShows) {
  const ViewCamera camera = oblique();
  const Vec3 p(4.0, -1.0, 8.0);
  const Vec2 pixel = camera.pixel(p, pane);
  const Ray ray = camera.ray(pixel, pane);
  EXPECT_LE((p - ray.origin).cross(ray.direction).norm(), pixel_tolerance);
  EXPECT_LE((camera.at_depth_of(p, pixel, pane) - p).norm(), pixel_tolerance);
  EXPECT_GT((p - camera.ray(pixel + Vec2(1.0, 0.0), pane).origin).cross(ray.direction).norm(), 1e-3);
}

TEST(ViewCamera, ZoomingKeepsWhatIsUnderTheMouse) {
  const ViewCamera camera = oblique();
  const Vec3 p(4.0, -1.0, 8.0);
  const Vec2 pixel = camera.pixel(p, pane);
  const ViewCamera nearer = camera.zoomed(1.5, pixel, pane);
  EXPECT_LE((nearer.pixel(p, pane) - pixel).norm(), pixel_tolerance);
  EXPECT_NEAR(nearer.half_height, 5.0, 1e-14);
}

TEST(ViewCamera, PanningMovesTheObjectWithTheMouse) {
  const ViewCamera camera = oblique();
  const Vec3 p(4.0, -1.0, 8.0);
  const Vec2 by(31.0, -17.0);
  EXPECT_LE((camera.panned(by, pane).pixel(p, pane) - camera.pixel(p, pane) - by).norm(), pixel_tolerance);
}

TEST(ViewCamera, OrbitingKeepsTheFocusAndAnOrthonormalFrame) {
  ViewCamera camera = oblique();
  for (int i = 0; i < 1000; ++i) camera = camera.orbited({7.0, -3.0 + 0.01 * i}, pane);
  EXPECT_LE((camera.focus - oblique().focus).norm(), 0.0);
  // Each turn normalises: what is left is rounding of unit vectors.
  EXPECT_NEAR(camera.right.dot(camera.up), 0.0, 1e-15 * 10);
  EXPECT_NEAR(camera.right.cross(camera.up).dot(camera.back), 1.0, 1e-15 * 10);
  EXPECT_GT((camera.back - oblique().back).norm(), 1e-3);
}

TEST(ViewCamera, AFittedObjectTakesMostOfThePaneAndIsNotCutOff) {
  std::vector<Vec3> corners;
  for (int i = 0; i < 8; ++i) corners.emplace_back(i & 1 ? 9.0 : -1.0, i & 2 ? 5.0 : 0.0, i & 4 ? 2.0 : -2.0);
  const ViewCamera camera = oblique().fitted(corners, pane);
  Vec2 lo(1e9, 1e9), hi = -lo;
  for (const Vec3& p : corners) {
    lo = lo.cwiseMin(camera.pixel(p, pane));
    hi = hi.cwiseMax(camera.pixel(p, pane));
  }
  EXPECT_TRUE(contains({pane.left, pane.bottom, pane.right, pane.top}, lo));
  EXPECT_TRUE(contains({pane.left, pane.bottom, pane.right, pane.top}, hi));
  EXPECT_GE(std::max((hi - lo).x() / pane.width(), (hi - lo).y() / pane.height()), 0.85);
}

/// Two parallel squares, z = 0 and z = 1, over [0, 1]^2.
struct Squares {
  std::vector<float> low{0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0}, high{0, 0, 1, 1, 0, 1, 1, 1, 1, 0, 1, 1};
  std::vector<std::array<std::uint32_t, 3>> triangles{{0, 1, 2}, {0, 2, 3}};
  [[nodiscard]] std::vector<DrawnSurface> drawn() const {
    return {{DrawnSurface::Role::primary, "low", Vec3::Zero(), low, {}, triangles},
            {DrawnSurface::Role::blend, "high", Vec3::Zero(), high, {}, triangles}};
  }
};

TEST(Picking, HitsAreInOrderFromTheEye) {
  const Squares squares;
  const Ray ray{{0.3, 0.4, 10.0}, -Vec3::UnitZ()};
  const auto hits = hits_of(ray, squares.drawn(), [](const DrawnSurface&) { return true; });
  ASSERT_EQ(hits.size(), 2u);
  EXPECT_EQ(hits[0].surface, 1u);
  EXPECT_LE((hits[0].point - Vec3(0.3, 0.4, 1.0)).norm(), 1e-14);
  EXPECT_LE((hits[1].point - Vec3(0.3, 0.4, 0.0)).norm(), 1e-14);
  EXPECT_NEAR(hits[0].weights[0] + hits[0].weights[1] + hits[0].weights[2], 1.0, 1e-15);
  const Ray beside{{1.3, 0.4, 10.0}, -Vec3::UnitZ()};
  EXPECT_TRUE(hits_of(beside, squares.drawn(), [](const DrawnSurface&) { return true; }).empty());
}

TEST(Picking, AHandleIsTakenWithinReachOnly) {
  const ViewCamera camera = oblique();
  std::vector<SessionHandle> handles(2);
  handles[0].position = {3.0, -2.0, 5.0};
  handles[1].position = {6.0, -2.0, 5.0};
  const Vec2 at = camera.pixel(handles[1].position, pane);
  EXPECT_EQ(handle_at(at + Vec2(4.0, 4.0), handles, camera, pane, 9.0), 1u);
  EXPECT_EQ(handle_at(at + Vec2(10.0, 0.0), handles, camera, pane, 9.0), std::nullopt);
}

TEST(Picking, ATrimlineHandleIsDraggedOnItsPrimaryAndAMagnitudeHandleInThePlaneOfView) {
  const Squares squares;
  ViewCamera camera = ViewCamera{}.looking({0.3, -0.4, 1.0});
  SessionHandle handle;
  handle.position = {0.5, 0.5, 0.0};
  const Vec2 pixel = camera.pixel({0.25, 0.75, 0.0}, pane);
  // The square's corners are floats: exact here.
  EXPECT_LE((drag_target(handle, pixel, squares.drawn(), camera, pane) - Vec3(0.25, 0.75, 0.0)).norm(),
            1e-12);
  handle.kind = SessionHandle::Kind::magnitude;
  const Vec3 target = drag_target(handle, pixel, squares.drawn(), camera, pane);
  EXPECT_NEAR(camera.back.dot(target - handle.position), 0.0, 1e-14);
  EXPECT_GT(std::abs(target.z()), 1e-2);
}

}  // namespace
}  // namespace blendwright
