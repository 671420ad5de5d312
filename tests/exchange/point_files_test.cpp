// Lines of numbers become points, and every broken line is named.
#include "kernel/exchange/point_files.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <sstream>

#include "kernel/base/error.hpp"
#include "kernel/base/number_text.hpp"
#include "kernel/exchange/mesh_files.hpp"
#include "tests/exchange/scratch_folder.hpp"
#include "tests/support/for_all.hpp"

namespace blendwright {
namespace {

using Points = std::vector<Vec3>;

Points read(const std::string& text) {
  std::istringstream in(text);
  return read_csv_points(in);
}
std::vector<Problem> problems(const std::string& text) {
  try {
    static_cast<void>(read(text));
  } catch (const InputError& e) {
    return e.problems();
  }
  return {};
}

const Points two{{1, -2.5, 3e-7}, {4, 5, 6}};

TEST(CsvPoints, MayBeSeparatedAndNamedInSeveralWays) {
  for (const char* text :
       {"1,-2.5,3e-7\n4,5,6\n", "1;-2.5;3e-7\r\n4;5;6", " 1 -2.5\t3e-7\n\n4 5 6\n\n",
        "x,y,z\n1,-2.5,3e-7\n4,5,6\n", "\xEF\xBB\xBF# points\nX, Y, Z\n1, -2.5, +3e-7\n4, 5, 6",
        "\"z\",name,\"y\",\"x\"\n3e-7,first,-2.5,1\n6,,5,4\n"})
    EXPECT_EQ(read(text), two) << text;
  EXPECT_EQ(read(""), Points{});
  EXPECT_EQ(read("x,y,z\n"), Points{});
}

TEST(CsvPoints, AreReadToTheLastBitFromAStreamOfManyBlocks) {
  test::for_all(
      [](test::Rng& rng) {
        Points points;
        std::string text;
        for (int i = 0; i < 4000; ++i) {  // over 64 kB each time
          points.push_back({test::uniform(rng, -1, 1), test::uniform(rng, -1, 1), test::uniform(rng, -1, 1)});
          const Vec3& p = points.back();
          text += number_text(p[0]) + "," + number_text(p[1]) + "," + number_text(p[2]) + "\n";
        }
        EXPECT_EQ(read(text), points);
      },
      5);
}

TEST(CsvPoints, NameEveryBrokenLine) {
  const auto found = problems("1,2,3\n1,2\nn/a,2,3\n# x\n1,2,nan\n1,2,1e999\n1,,3\n7,8,9,10\n1,2,3x\n");
  const std::vector<Problem> expected{
      {"line 2", "has 2 values, must have 3"},           {"line 3", "is \"n/a\" where a number must be"},
      {"line 5", "is \"nan\", must be a finite number"}, {"line 6", "is \"1e999\", must be a finite number"},
      {"line 7", "is \"\" where a number must be"},      {"line 8", "has 4 values, must have 3"},
      {"line 9", "is \"3x\" where a number must be"}};
  EXPECT_EQ(found, expected);
}

TEST(CsvPoints, NameTwentyBrokenLinesAndCountTheOthers) {
  std::string text = "0,0,0\n";
  for (int i = 0; i < 1000; ++i) text += "1,2\n";
  const auto found = problems(text);
  ASSERT_EQ(found.size(), 21u);
  EXPECT_EQ(found[19].where, "line 21");
  EXPECT_EQ(found[20].message, "980 more broken lines");
}

TEST(CsvPoints, SayWhichColumnIsMissing) {
  const auto found = problems("a,x,y\n1,2,3\n");
  ASSERT_EQ(found.size(), 1u);
  EXPECT_EQ(found[0].message, "names no column \"z\"; it has \"a\", \"x\", \"y\"");
}

TEST(CsvPoints, EndEarlyInWhatIsNoText) {
  const auto found = problems(std::string(5u << 20, '\0'));
  ASSERT_EQ(found.size(), 1u);
  EXPECT_THAT(found[0].message, testing::HasSubstr("longer than 1 MB"));
}

TEST(PointFile, MayBeAVtpOfAnyCells) {
  const test::ScratchFolder folder;
  const std::vector<PolyLine> lines{{"line", two, false, {}}};
  write_vtp(folder / "line.vtp", lines);
  EXPECT_EQ(read_points(folder / "line.vtp"), two);
  TriMesh cloud;
  cloud.points = two;
  cloud.columns = {{"member", "", 1, {0, 1}, {"bar", "plate"}}};
  write_vtp(folder / "cloud.vtp", cloud);
  EXPECT_EQ(read_points(folder / "cloud.vtp"), two);
  EXPECT_EQ(read_mesh(folder / "cloud.vtp").columns.at(0).labels, cloud.columns[0].labels);
  std::ofstream(folder / "points.txt") << "1 -2.5 3e-7\n4 5 6\n";
  EXPECT_EQ(read_points(folder / "points.txt"), two);
}

TEST(PointFile, ThatCannotBeReadIsNamed) {
  const test::ScratchFolder folder;
  for (const char* name : {"missing.csv", "missing.vtp", ""})
    EXPECT_THROW((void)read_points(folder / name), IoError);
}

}  // namespace
}  // namespace blendwright
