#include "kernel/exchange/picture.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <numbers>
#include <optional>
#include <set>
#include <sstream>
#include <thread>

#include "kernel/base/error.hpp"
#include "tests/exchange/read_png.hpp"
#include "tests/exchange/scratch_folder.hpp"

namespace blendwright {
namespace {

using test::read_png;
using test::ScratchFolder;

/// Sets a variable while it lives; nullopt: unset.
class Environment {
 public:
  Environment(const char* name, std::optional<std::string> value) : name_(name) {
    if (const char* before = std::getenv(name)) before_ = before;
    set(value);
  }
  ~Environment() { set(before_); }
  Environment(const Environment&) = delete;
  Environment& operator=(const Environment&) = delete;

 private:
  void set(const std::optional<std::string>& value) const {
    if (value) {
      ::setenv(name_, value->c_str(), 1);
    } else {
      ::unsetenv(name_);
    }
  }
  const char* name_;
  std::optional<std::string> before_;
};

/// Strip z = 0.2 x y over [-1, 1]^2 with a column that grows with x from 1e-12 to 1e-4, and zeros.
TriMesh saddle() {
  TriMesh mesh;
  mesh.name = "saddle";
  Column gap{"gap", "mm", 1, {}};
  constexpr std::uint32_t n = 20;
  for (std::uint32_t i = 0; i <= n; ++i)
    for (std::uint32_t j = 0; j <= n; ++j) {
      const double x = 2.0 * i / n - 1.0, y = 2.0 * j / n - 1.0;
      mesh.points.emplace_back(x, y, 0.2 * x * y);
      mesh.normals.push_back(Vec3(-0.2 * y, -0.2 * x, 1.0).normalized());
      gap.values.push_back(i == 0 ? 0.0 : std::pow(10.0, -8.0 + 4.0 * x));
      if (i == n || j == n) continue;
      const std::uint32_t a = i * (n + 1) + j, b = a + n + 1;
      mesh.triangles.push_back({a, b, b + 1});
      mesh.triangles.push_back({a, b + 1, a + 1});
    }
  mesh.columns = {gap};
  return mesh;
}

Picture saddle_picture() {
  Picture picture;
  picture.title = "saddle: worst gap 1.0e-04 mm";
  picture.meshes = {{saddle(), {0.9, 0.55, 0.15}, 1.0, true}};
  picture.lines = {{"rim", {{-1, -1, 0.2}, {1, -1, -0.2}, {1, -1, -0.2}, {1, 1, 0.2}}, false, {}}};
  picture.column = "gap";
  picture.bar_title = "gap (mm)";
  picture.logarithmic = true;
  picture.width = 320;
  picture.height = 240;
  return picture;
}

std::size_t colours_in(const test::Pixels& image) {
  std::set<std::array<unsigned char, 3>> colours;
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x) colours.insert(image.at(x, y));
  return colours.size();
}

double share_of_white(const test::Pixels& image, int x0, int x1, int y0, int y1) {
  int white = 0;
  for (int y = y0; y < y1; ++y)
    for (int x = x0; x < x1; ++x)
      white += image.at(x, y) == std::array<unsigned char, 3>{255, 255, 255} ? 1 : 0;
  return static_cast<double>(white) / ((x1 - x0) * (y1 - y0));
}

/// The object's area of a picture of 320 x 240: below the title, left of the bar. Its middle is near (134,
/// 130).
double share_of_white_in_the_middle(const test::Pixels& image) {
  return share_of_white(image, 114, 154, 115, 145);
}

class Drawing : public testing::Test {
 protected:
  void SetUp() override {
    if (!display().available()) GTEST_SKIP() << display().reason();
  }
  static const Display& display() {
    static const Display one;
    return one;
  }
  ScratchFolder folder_;
};

TEST_F(Drawing, ShowsTheObjectOnWhiteInTheSizeAskedFor) {
  write_picture(folder_ / "a.png", saddle_picture(), display());
  const test::Pixels image = read_png(folder_ / "a.png");
  EXPECT_EQ(image.width, 320);
  EXPECT_EQ(image.height, 240);
  EXPECT_GT(colours_in(image), 300u);  // shading times the colour map
  EXPECT_EQ(image.at(0, 0), (std::array<unsigned char, 3>{255, 255, 255}));
  EXPECT_EQ(share_of_white_in_the_middle(image), 0.0);
  EXPECT_EQ(folder_.entries(), std::vector<std::string>{"a.png"});
}

TEST_F(Drawing, IsBlankWithoutObjects) {
  Picture nothing;
  nothing.width = 320;
  nothing.height = 240;
  write_picture(folder_ / "blank.png", nothing, display());
  const test::Pixels image = read_png(folder_ / "blank.png");
  EXPECT_EQ(colours_in(image), 1u);
  EXPECT_EQ(share_of_white(image, 0, 320, 0, 240), 1.0);
}

TEST_F(Drawing, IsTheSameBytesTwice) {
  for (const char* name : {"a.png", "b.png"}) write_picture(folder_ / name, saddle_picture(), display());
  EXPECT_EQ(read_png(folder_ / "a.png").rgb, read_png(folder_ / "b.png").rgb);
}

TEST_F(Drawing, ShowsWhatIsBehindATranslucentMesh) {
  // A grey lid above an orange saddle, seen from above.
  Picture picture = saddle_picture();
  picture.column.clear();
  picture.title.clear();
  picture.lines.clear();
  picture.view = Vec3::UnitZ();
  picture.meshes[0].coloured = false;
  PictureMesh lid = picture.meshes[0];
  for (Vec3& p : lid.mesh.points) p.z() = 1.0;
  lid.colour = {0.7, 0.7, 0.7};
  picture.meshes.push_back(lid);
  const auto red_minus_blue = [&](double opacity) {
    picture.meshes[1].opacity = opacity;
    write_picture(folder_ / "a.png", picture, display());
    const auto pixel = read_png(folder_ / "a.png").at(150, 110);
    return pixel[0] - pixel[2];
  };
  EXPECT_GT(red_minus_blue(0.3), 40);
  EXPECT_LT(red_minus_blue(1.0), 10);  // negative control: an opaque lid is grey
}

TEST_F(Drawing, ColoursFollowTheScaleOfTheBar) {
  // From above, x runs to the right: dark violet (low) on the left, yellow (high) on the right, and on a
  // linear scale all but the right end is low.
  Picture picture = saddle_picture();
  picture.view = Vec3::UnitZ();
  picture.lines.clear();
  const auto green_at = [&](int x, bool logarithmic) {
    picture.logarithmic = logarithmic;
    write_picture(folder_ / "a.png", picture, display());
    return static_cast<int>(read_png(folder_ / "a.png").at(x, 110)[1]);
  };
  EXPECT_GT(green_at(130, true), green_at(65, true) + 40);
  EXPECT_GT(green_at(200, true), green_at(130, true) + 40);
  EXPECT_LT(std::abs(green_at(130, false) - green_at(65, false)), 40);
}

TEST_F(Drawing, ShowsALegendAndTheEdgesThatAreGiven) {
  Picture picture = saddle_picture();
  picture.column.clear();
  picture.title.clear();
  picture.lines.clear();
  picture.view = Vec3::UnitZ();
  picture.meshes[0].coloured = false;
  picture.keys = {{"inside", {0.0, 1.0, 0.0}}, {"left", {0.0, 0.0, 1.0}}};
  const auto count = [&](const std::array<unsigned char, 3>& colour) {
    write_picture(folder_ / "a.png", picture, display());
    const test::Pixels image = read_png(folder_ / "a.png");
    int pixels = 0;
    for (int y = 0; y < image.height; ++y)
      for (int x = 0; x < image.width; ++x) pixels += image.at(x, y) == colour ? 1 : 0;
    return pixels;
  };
  // Swatches are 18 pixels wide with a frame of one.
  EXPECT_GT(count({0, 255, 0}), 200);
  EXPECT_GT(count({0, 0, 255}), 200);
  const std::array<unsigned char, 3> red{255, 0, 0};
  EXPECT_EQ(count(red), 0);
  picture.meshes[0].edge_colour = {1.0, 0.0, 0.0};
  picture.meshes[0].edge_width = 3.0;
  picture.meshes[0].edges = {{0, 440}};  // from corner to corner of 21 x 21 points
  EXPECT_GT(count(red), 100);
  picture.meshes[0].edges = {{0, 441}};
  EXPECT_THROW(write_picture(folder_ / "b.png", picture, display()), InputError);
}

TEST_F(Drawing, RefusesAColumnThatIsMissingAndAViewWithoutDirection) {
  Picture picture = saddle_picture();
  picture.column = "angle";
  EXPECT_THROW(write_picture(folder_ / "a.png", picture, display()), InputError);
  picture = saddle_picture();
  picture.view = Vec3::Zero();
  EXPECT_THROW(write_picture(folder_ / "a.png", picture, display()), InputError);
  picture = saddle_picture();
  picture.width = 0;
  EXPECT_THROW(write_picture(folder_ / "a.png", picture, display()), InputError);
  EXPECT_TRUE(folder_.entries().empty());
}

TEST_F(Drawing, DrawsColumnsOfZerosAndOfNaN) {
  for (const double value : {0.0, std::nan("")})
    for (const bool logarithmic : {false, true}) {
      Picture picture = saddle_picture();
      picture.logarithmic = logarithmic;
      std::fill(picture.meshes[0].mesh.columns[0].values.begin(),
                picture.meshes[0].mesh.columns[0].values.end(), value);
      write_picture(folder_ / "a.png", picture, display());
      EXPECT_EQ(share_of_white_in_the_middle(read_png(folder_ / "a.png")), 0.0);
    }
}

TEST_F(Drawing, NamesTheFileThatCannotBeWritten) {
  const std::filesystem::path file = folder_ / "missing" / "a.png";
  for (const bool plots : {false, true}) {
    try {
      if (plots) write_plots(file, {Plot{}}, display());
      if (!plots) write_picture(file, saddle_picture(), display());
      ADD_FAILURE() << "wrote " << file;
    } catch (const IoError& e) {
      EXPECT_THAT(e.what(), testing::StartsWith(file.string() + ": "));
    }
  }
  EXPECT_TRUE(folder_.entries().empty());
}

Plot sine_plot(bool logarithmic) {
  Plot plot{"gap", "v", "gap (mm)", {{"from", {}, {}}, {"to", {}, {}}}, logarithmic, 1e-6};
  for (int i = 0; i <= 100; ++i) {
    const double v = 0.0628 * i;
    for (PlotCurve& curve : plot.curves) {
      curve.x.push_back(v);
      curve.y.push_back(1e-7 * std::abs(std::sin(3.0 * v)));
    }
    plot.curves[1].y.back() *= 0.01;
  }
  return plot;
}

TEST_F(Drawing, PlotsCurvesInTheirColours) {
  write_plots(folder_ / "p.png", {sine_plot(true), sine_plot(false)}, display(), 800, 300);
  const test::Pixels image = read_png(folder_ / "p.png");
  EXPECT_EQ(image.width, 800);
  EXPECT_EQ(image.height, 300);
  const auto has = [&](const std::array<unsigned char, 3>& colour, int x0, int x1) {
    int pixels = 0;
    for (int y = 0; y < 300; ++y)
      for (int x = x0; x < x1; ++x) pixels += image.at(x, y) == colour ? 1 : 0;
    return pixels;
  };
  constexpr std::array<unsigned char, 3> blue{0x00, 0x72, 0xb2}, vermilion{0xd5, 0x5e, 0x00},
      green{0x00, 0x9e, 0x73};
  for (const int left : {0, 400}) {
    EXPECT_GT(has(blue, left, left + 400), 50);
    EXPECT_GT(has(vermilion, left, left + 400), 50);
    EXPECT_EQ(has(green, left, left + 400), 0);  // negative control: there is no third curve
  }
}

TEST_F(Drawing, RefusesACurveWithoutAsManyXAsY) {
  Plot plot = sine_plot(true);
  plot.curves[0].y.pop_back();
  EXPECT_THROW(write_plots(folder_ / "p.png", {plot}, display()), InputError);
}

TEST_F(Drawing, SaysNothing) {
  testing::internal::CaptureStderr();
  testing::internal::CaptureStdout();
  write_picture(folder_ / "a.png", saddle_picture(), display());
  EXPECT_EQ(testing::internal::GetCapturedStdout() + testing::internal::GetCapturedStderr(), "");
}

TEST(Display, NamesThePackageWhenThereIsNeitherDisplayNorXvfb) {
  const ScratchFolder empty;
  const Environment no_display("DISPLAY", std::nullopt), no_programs("PATH", (empty / "").string());
  const Display display;
  EXPECT_FALSE(display.available());
  EXPECT_EQ(display.reason(), "DISPLAY is not set and Xvfb is not installed; install the package xvfb");
  try {
    write_picture(empty / "a.png", saddle_picture(), display);
    ADD_FAILURE() << "drew without a display";
  } catch (const IoError& e) {
    EXPECT_THAT(e.what(), testing::HasSubstr("install the package xvfb"));
  }
  EXPECT_THROW(write_plots(empty / "p.png", {sine_plot(true)}, display), IoError);
  EXPECT_TRUE(empty.entries().empty());
}

TEST(Display, SeesThatADisplayDoesNotAnswer) {
  const ScratchFolder empty;
  const Environment dead("DISPLAY", ":64000"), no_programs("PATH", (empty / "").string());
  const Display display;
  EXPECT_FALSE(display.available());
  EXPECT_THAT(display.reason(), testing::HasSubstr("DISPLAY :64000"));
}

TEST(Display, SaysThatXvfbDoesNotStart) {
  const ScratchFolder folder;
  std::ofstream(folder / "Xvfb") << "#!/bin/sh\nexit 3\n";
  std::filesystem::permissions(folder / "Xvfb", std::filesystem::perms::owner_all);
  const Environment no_display("DISPLAY", std::nullopt), broken("PATH", (folder / "").string());
  const Display display;
  EXPECT_FALSE(display.available());
  EXPECT_THAT(display.reason(), testing::HasSubstr("did not start"));
}

/// Children of this process that are still there, by their number.
std::set<pid_t> children() {
  std::set<pid_t> pids;
  const std::string own = std::to_string(::getpid());
  for (const auto& task : std::filesystem::directory_iterator("/proc/self/task")) {
    std::ifstream in(task.path() / "children");
    for (pid_t pid = 0; in >> pid;) pids.insert(pid);
  }
  return pids;
}

TEST(Display, StartsXvfbAndTakesItAwayAgain) {
  const Environment no_display("DISPLAY", std::nullopt);
  const std::set<pid_t> before = children();
  {
    const Display display;
    if (!display.available()) GTEST_SKIP() << display.reason();
    ASSERT_NE(std::getenv("DISPLAY"), nullptr);
    EXPECT_EQ(children().size(), before.size() + 1);
    const Display second;  // uses the first one's
    EXPECT_TRUE(second.available());
    EXPECT_EQ(children().size(), before.size() + 1);
  }
  EXPECT_EQ(std::getenv("DISPLAY"), nullptr);
  EXPECT_EQ(children(), before);
}

TEST(Display, EndsXvfbWhenTheProgramIsKilled) {
  const Environment no_display("DISPLAY", std::nullopt);
  std::array<int, 2> pipe{};
  ASSERT_EQ(::pipe(pipe.data()), 0);
  const pid_t program = ::fork();
  if (program == 0) {
    const Display display;
    const std::set<pid_t> started = children();
    const pid_t xvfb = started.empty() ? -1 : *started.begin();
    if (::write(pipe[1], &xvfb, sizeof xvfb) != sizeof xvfb) ::_exit(1);
    for (;;) ::pause();
  }
  pid_t xvfb = -1;
  ASSERT_EQ(::read(pipe[0], &xvfb, sizeof xvfb), static_cast<ssize_t>(sizeof xvfb));
  const bool was_running = xvfb > 0 && ::kill(xvfb, 0) == 0;
  ::kill(program, SIGKILL);
  ::waitpid(program, nullptr, 0);
  ::close(pipe[0]);
  ::close(pipe[1]);
  if (!was_running) GTEST_SKIP() << "Xvfb cannot be started";
  const auto alive = [&] {  // an orphan that nobody reaps stays as a zombie, "Z"
    std::ifstream stat("/proc/" + std::to_string(xvfb) + "/stat");
    std::string number, name, state;
    return static_cast<bool>(stat >> number >> name >> state) && state != "Z";
  };
  for (int i = 0; i < 500 && alive(); ++i) std::this_thread::sleep_for(std::chrono::milliseconds(10));
  EXPECT_FALSE(alive());
}

}  // namespace
}  // namespace blendwright
