#include "kernel/exchange/box_cells.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>

#include "kernel/base/error.hpp"
#include "kernel/base/text_file.hpp"
#include "tests/exchange/scratch_folder.hpp"

namespace blendwright {
namespace {

using test::ScratchFolder;

BoxCells two_cells() {
  BoxCells cells{"a and b", {}, {}, {}, "how it was made"};
  cells.boxes = {{Vec3(0, 0, 0), Vec3(1, 2, 3)}, {Vec3(1, 0, 1.0 / 3.0), Vec3(2, 1e-9, 4)}};
  cells.columns = {{"verdict", "", 1, {3, 4}, {"out", "in", "apart", "witness", "undecided"}},
                   {"size", "mm", 1, {3, 4 - 1.0 / 3.0}, {}}};
  cells.facts = {{"point", "mm", 3, {1, 2, 0.1}, {}}, {"gap", "mm", 1, {-1e-12}, {}}};
  return cells;
}

TEST(BoxCells, ComeBackAsTheyWereWritten) {
  const ScratchFolder folder;
  const BoxCells cells = two_cells();
  write_vtu(folder / "cells.vtu", cells);
  const BoxCells read = read_vtu(folder / "cells.vtu");
  EXPECT_EQ(read.name, cells.name);
  EXPECT_EQ(read.note, cells.note);
  EXPECT_EQ(read.boxes, cells.boxes);
  const auto expect_equal = [](const std::vector<Column>& a, const std::vector<Column>& b) {
    ASSERT_EQ(a.size(), b.size());
    for (std::size_t i = 0; i < a.size(); ++i) {
      EXPECT_EQ(a[i].name, b[i].name);
      EXPECT_EQ(a[i].unit, b[i].unit);
      EXPECT_EQ(a[i].components, b[i].components);
      EXPECT_EQ(a[i].values, b[i].values);
      EXPECT_EQ(a[i].labels, b[i].labels);
    }
  };
  expect_equal(read.columns, cells.columns);
  expect_equal(read.facts, cells.facts);
  write_vtu(folder / "again.vtu", cells);
  EXPECT_EQ(read_text_file(folder / "again.vtu", 100'000), read_text_file(folder / "cells.vtu", 100'000));
}

TEST(BoxCells, MayBeNone) {
  const ScratchFolder folder;
  write_vtu(folder / "none.vtu", {"none", {}, {}, {}, {}});
  EXPECT_TRUE(read_vtu(folder / "none.vtu").boxes.empty());
}

TEST(BoxCells, RefuseWhatContradictsItself) {
  const ScratchFolder folder;
  BoxCells short_column = two_cells(), endless = two_cells(), half_fact = two_cells();
  short_column.columns[0].values.pop_back();
  endless.boxes[1].hi.x() = std::numeric_limits<double>::infinity();
  half_fact.facts[0].values.pop_back();
  for (const BoxCells* bad : {&short_column, &endless, &half_fact})
    EXPECT_THROW(write_vtu(folder / "bad.vtu", *bad), InputError);
  EXPECT_FALSE(std::filesystem::exists(folder / "bad.vtu"));
  EXPECT_THROW(write_vtu(folder / "no" / "such" / "folder.vtu", two_cells()), IoError);
}

TEST(BoxCells, SayWhatIsNoFileOfBoxes) {
  const ScratchFolder folder;
  EXPECT_THROW((void)read_vtu(folder / "missing.vtu"), IoError);
  write_text_file(folder / "text.vtu", "no grid");
  EXPECT_THROW((void)read_vtu(folder / "text.vtu"), IoError);
}

}  // namespace
}  // namespace blendwright
