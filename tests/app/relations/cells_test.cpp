// The subdivision of a search for contact, as a file of boxes and as a picture.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "kernel/exchange/box_cells.hpp"
#include "tests/app/relations/relation_scenes.hpp"

namespace blendwright::test {
namespace {

using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;

class Cells : public testing::Test {
 protected:
  Cells() {
    files_.add("ball.json", ball_scene(1.0));
    // No plane parts the ball from the ring around it.
    files_.add("ring.json", R"({ "solid": { "kind": "torus", "ring": 1, "tube": 0.3 } })");
    files_.add("pea.json", ball_scene(0.69));
    files_.add("deep.json", ball_scene(1.0, 1.2, 0.6, 1.2));
  }
  [[nodiscard]] BoxCells cells(const std::string& arguments, int code) const {
    const Outcome outcome = files_.run("collide " + arguments + " --force --cells cells.vtu");
    EXPECT_EQ(outcome.code, code) << outcome.err;
    return read_vtu(files_ / "cells.vtu");
  }
  SceneFolder files_;
};

/// Boxes of a bisection do not overlap; when they also fill what is around them, nothing was left out.
void expect_filled(const BoxCells& cells) {
  double volume = 0.0;
  Box all = cells.boxes.at(0);
  for (const Box& box : cells.boxes) {
    volume += box.size().prod();
    all = hull(all, box);
  }
  EXPECT_NEAR(volume, all.size().prod(), 1e-9);
}

TEST_F(Cells, FillTheDomainOfAProofAndHaveVerdicts) {
  const BoxCells found = cells("ring.json pea.json", 0);
  EXPECT_EQ(found.name, "ring and pea");
  EXPECT_THAT(found.note, HasSubstr("disjoint, scenes ring ("));
  EXPECT_GT(found.boxes.size(), 10u);
  expect_filled(found);
  ASSERT_EQ(found.columns.size(), 2u);
  EXPECT_EQ(found.columns[0].name, "verdict");
  EXPECT_EQ(found.columns[0].labels.size(), 5u);
  for (const double v : found.columns[0].values) EXPECT_LE(v, 2.0);  // outside of one of them, or separated
  for (std::size_t i = 0; i < found.boxes.size(); ++i)
    EXPECT_EQ(found.columns[1].values[i], found.boxes[i].size().maxCoeff());
}

TEST_F(Cells, ShowTheWitnessAndTheRegionThatIsLeft) {
  const BoxCells contact = cells("ball.json deep.json", 0);
  EXPECT_THAT(contact.columns[0].values, Contains(3.0));
  std::vector<std::string> facts;
  for (const Column& f : contact.facts) facts.push_back(f.name);
  EXPECT_THAT(facts, ElementsAre("point", "normal", "gap"));
  const BoxCells left = cells("ring.json pea.json --tolerance 0.2", 1);
  EXPECT_THAT(left.columns[0].values, Contains(4.0));
  EXPECT_EQ(left.facts.back().name, "undecided");
  const auto& u = left.facts.back().values;
  ASSERT_EQ(u.size(), 6u);
  const Box around{{u[0], u[1], u[2]}, {u[3], u[4], u[5]}};
  for (std::size_t i = 0; i < left.boxes.size(); ++i) {
    const bool undecided = left.columns[0].values[i] == 4.0;
    EXPECT_TRUE(!undecided || hull(around, left.boxes[i]) == around);
  }
}

TEST_F(Cells, OfBarsReachThroughTheDepth) {
  const BoxCells bars = cells("ring.json pea.json --projected y --tolerance 0.2", 1);
  for (const Box& box : bars.boxes) {
    EXPECT_EQ(box.lo.y(), bars.boxes[0].lo.y());
    EXPECT_EQ(box.hi.y(), bars.boxes[0].hi.y());
  }
  EXPECT_LE(bars.boxes[0].lo.y(), -0.69);  // through the ball
  EXPECT_GE(bars.boxes[0].hi.y(), 0.69);
  expect_filled(bars);
}

TEST_F(Cells, AreDrawnWhereThereIsADisplay) {
  for (const char* arguments :
       {"ring.json pea.json", "ball.json deep.json", "ring.json pea.json --projected z"}) {
    SCOPED_TRACE(arguments);
    const Outcome outcome =
        files_.run(std::string("collide --tolerance 0.05 --force --cells a.png --cells a.vtu ") + arguments);
    EXPECT_LE(outcome.code, 1) << outcome.err;
    EXPECT_THAT(files_.files(), Contains("a.vtu"));
    if (outcome.err.find("pictures skipped") != std::string::npos) GTEST_SKIP() << outcome.err;
    EXPECT_EQ(content(files_ / "a.png").substr(1, 3), "PNG");
  }
}

}  // namespace
}  // namespace blendwright::test
