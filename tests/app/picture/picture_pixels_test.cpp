// Pictures as they are drawn: how the object lies in the frame, which colours there are, what the normals do.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <set>

#include "kernel/exchange/colour_scale.hpp"
#include "tests/app/picture/picture_models.hpp"
#include "tests/app/program.hpp"
#include "tests/exchange/read_png.hpp"

namespace blendwright {
namespace {

using test::ball;
using test::input_of;

constexpr std::array<unsigned char, 3> white{255, 255, 255};

/// A mode in a small picture.
PictureJob small(Show show) {
  PictureJob job = test::showing(show);
  job.width = 400;
  job.height = 300;
  return job;
}

class PicturePixels : public testing::Test {
 protected:
  void SetUp() override {
    if (!display().available()) GTEST_SKIP() << display().reason();
  }
  static const Display& display() {
    static const Display one;
    return one;
  }
  test::Pixels drawn(const Picture& picture) {
    const auto file = folder_ / "a.png";
    write_picture(file, picture, display());
    return test::read_png(file);
  }
  test::Pixels drawn(const TriMesh& mesh, PictureJob job) {
    return drawn(*plan_picture(input_of(mesh), job).picture);
  }
  test::Folder folder_;
};

/// Box of everything that is not background within the part of the picture.
struct Drawn {
  int left, right, top, bottom;
};
Drawn box_of(const test::Pixels& image, int x0, int x1, int y0, int y1,
             const std::array<unsigned char, 3>& background = white) {
  Drawn box{x1, x0, y1, y0};
  for (int y = y0; y < y1; ++y)
    for (int x = x0; x < x1; ++x)
      if (image.at(x, y) != background) {
        box.left = std::min(box.left, x);
        box.right = std::max(box.right, x);
        box.top = std::min(box.top, y);
        box.bottom = std::max(box.bottom, y);
      }
  return box;
}

TEST_F(PicturePixels, TheObjectFillsItsFrameAndIsNotCutOff) {
  for (const auto& [width, height] : {std::pair(1280, 960), {640, 480}}) {
    PictureJob job = small(Show::plain);
    job.width = width;
    job.height = height;
    const test::Pixels image = drawn(ball(1.0), job);
    ASSERT_EQ(image.width, width);
    ASSERT_EQ(image.height, height);
    const int title = height / 9;
    const Drawn box = box_of(image, 0, width, title, height);
    EXPECT_GT(box.bottom - box.top, 0.8 * (height - title));
    EXPECT_GT(box.left, 0);
    EXPECT_LT(box.right, width - 1);
    EXPECT_LT(box.bottom, height - 1);
    // A ball in a frame of 4:3: its square is more than half of it.
    EXPECT_GT((box.bottom - box.top) * (box.right - box.left), 0.5 * width * height);
  }
}

TEST_F(PicturePixels, SeveralViewsLieBesideEachOtherWithTheirNames) {
  PictureJob job = small(Show::plain);
  job.width = 800;
  job.height = 480;
  job.views = {"front", "top"};
  const test::Pixels image = drawn(ball(1.0), job);
  for (const int left : {0, 400}) {
    const Drawn box = box_of(image, left, left + 400, 60, 400);
    EXPECT_GT(box.left, left);
    EXPECT_LT(box.right, left + 399);
    EXPECT_GT(box.right - box.left, 300);
    const Drawn label = box_of(image, left, left + 400, 455, 480);
    EXPECT_GT(label.right, label.left);  // there is one
  }
}

/// Pixels whose colour is one of the map's, shading left out: hue and chroma as of a colour between the ends.
std::size_t pixels_of(const test::Pixels& image, const std::array<std::uint8_t, 3>& colour, int tolerance) {
  std::size_t count = 0;
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x) {
      const auto p = image.at(x, y);
      bool same = true;
      for (std::size_t k = 0; k < 3; ++k) same = same && std::abs(p[k] - colour[k]) <= tolerance;
      count += same ? 1 : 0;
    }
  return count;
}

TEST_F(PicturePixels, IsophotesHaveTheBarsColours) {
  const test::Pixels image = drawn(ball(1.0), small(Show::isophotes));
  std::size_t found = 0;
  for (int band = 0; band < isophote_bands; ++band) {
    const Colour c = viridis((band + 0.5) / isophote_bands);
    const auto byte = [](double x) { return static_cast<std::uint8_t>(std::lround(255.0 * x)); };
    if (pixels_of(image, {byte(c.r), byte(c.g), byte(c.b)}, 3) > 250) ++found;
  }
  EXPECT_EQ(found, static_cast<std::size_t>(isophote_bands));
  // Negative control: the plain picture has none of them.
  const Colour first = viridis(0.5 / isophote_bands);
  EXPECT_EQ(pixels_of(drawn(ball(1.0), small(Show::plain)),
                      {static_cast<std::uint8_t>(255 * first.r), static_cast<std::uint8_t>(255 * first.g),
                       static_cast<std::uint8_t>(255 * first.b)},
                      3),
            0u);
}

TEST_F(PicturePixels, DraftShowsBothEndsOfTheDivergingMap) {
  PictureJob job = small(Show::draft);
  job.from = Vec3(0.0, -1.0, 0.0);
  const test::Pixels image = drawn(ball(1.0), job);
  std::size_t red = 0, blue = 0;
  for (int y = 60; y < 280; ++y)
    for (int x = 0; x < 280; ++x) {
      const auto p = image.at(x, y);
      red += p[0] > p[2] + 60 ? 1 : 0;
      blue += p[2] > p[0] + 60 ? 1 : 0;
    }
  EXPECT_GT(red, 2000u);
  EXPECT_GT(blue, 2000u);
}

std::size_t different(const test::Pixels& a, const test::Pixels& b) {
  std::size_t count = 0;
  for (int y = 0; y < a.height; ++y)
    for (int x = 0; x < a.width; ++x) {
      const auto p = a.at(x, y), q = b.at(x, y);
      count += std::abs(p[0] - q[0]) > 60 ? 1 : 0;
    }
  return count;
}

/// The stripes know nothing of the facets: a plane with the normals of a ball has those of the ball, and a
/// ball with one bent normal has other ones there, though its points are where they were.
TEST_F(PicturePixels, ZebraFollowsTheNormalsAndNotTheFacets) {
  PictureJob job = small(Show::zebra);
  job.from = Vec3(0.0, -1.0, 0.0);
  const test::Pixels exact = drawn(ball(1.0), job);
  TriMesh bent = ball(1.0);
  std::size_t nearest = 0;
  for (std::size_t i = 0; i < bent.points.size(); ++i)
    if ((bent.points[i] - Vec3(0.0, -1.0, 0.0)).norm() < (bent.points[nearest] - Vec3(0.0, -1.0, 0.0)).norm())
      nearest = i;
  bent.normals[nearest] = (bent.normals[nearest] + Vec3(0.0, 0.0, 0.2)).normalized();
  EXPECT_GT(different(exact, drawn(bent, job)), 40u);
  EXPECT_EQ(different(exact, drawn(ball(1.0), job)), 0u);
  // Coarse facets with exact normals have nearly the stripes of fine ones: the silhouette differs, and the
  // interpolation over 7.5 degrees turns normals by at most 7.5^2/8 deg/rad = 0.06 deg, of stripes 2.8 deg
  // wide.
  const test::Pixels fine = drawn(ball(1.0, 96, 192), job);
  std::size_t inner = 0;
  for (int y = 100; y < 220; ++y)
    for (int x = 120; x < 280; ++x) inner += std::abs(exact.at(x, y)[0] - fine.at(x, y)[0]) > 60 ? 1 : 0;
  EXPECT_LT(inner, 160u * 120u / 50u);
}

/// The shader draws what zebra_value() says: compared at the middle of the ball, along the vertical.
TEST_F(PicturePixels, ZebraIsThatOfTheFormula) {
  PictureJob job = small(Show::zebra);
  job.from = Vec3(0.0, -1.0, 0.0);
  job.options.stripes = 6.0;
  job.width = 400;
  job.height = 400;
  Picture picture = *plan_picture(input_of(ball(1.0, 96, 192)), job).picture;
  picture.title.clear();
  picture.caption.clear();
  const test::Pixels image = drawn(picture);
  const Drawn box = box_of(image, 0, 400, 0, 400);
  const double middle = 0.5 * (box.top + box.bottom), radius = 0.5 * (box.bottom - box.top);
  ShowOptions options;
  options.stripes = 6.0;  // eye along z, up along y
  int compared = 0;
  for (int y = box.top + 10; y < box.bottom - 10; ++y) {
    const double up = (middle - y) / radius;
    const Vec3 n(0.0, up, std::sqrt(1.0 - up * up));
    const double phase = zebra_phase(n, options), fraction = phase - std::floor(phase);
    if (std::min({std::abs(fraction), std::abs(fraction - 0.5), std::abs(fraction - 1.0)}) < 0.06) continue;
    EXPECT_EQ(image.at(200, y)[0] > 100, zebra_value(n, options) == 1.0)
        << "row " << y << ", phase " << phase;
    ++compared;
  }
  EXPECT_GT(compared, 200);
}

TEST_F(PicturePixels, DarkBackgroundsHaveLightLetters) {
  PictureJob job = small(Show::radius);
  job.dark = true;
  const test::Pixels image = drawn(ball(1.0), job);
  const auto corner = image.at(0, 0);
  EXPECT_LT(corner[0], 40);
  int light = 0;
  for (int y = 0; y < 30; ++y)
    for (int x = 0; x < 400; ++x) light += image.at(x, y)[0] > 180 ? 1 : 0;
  EXPECT_GT(light, 100);
}

TEST_F(PicturePixels, BarsAndTitlesAreNotCutOff) {
  for (const auto& [width, height] : {std::pair(640, 480), {320, 240}, {200, 400}}) {
    PictureJob job = small(Show::curvature);
    job.width = width;
    job.height = height;
    const test::Pixels image = drawn(ball(0.00123), job);
    const Drawn all = box_of(image, 0, width, 0, height);
    EXPECT_GT(all.left, 0) << width;
    EXPECT_LT(all.right, width - 1) << width;
    EXPECT_GT(all.top, 0) << width;
    EXPECT_LT(all.bottom, height - 1) << width;
  }
}

}  // namespace
}  // namespace blendwright
