// SPDX-License-Identifier: Apache-2.0
// What a drawing in characters becomes: cells, and hazards with whole-cell footprints and solids
// that are drawn back.
#include "env/map/char_grid.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace floorproof {
namespace {

using ::testing::ElementsAre;
using ::testing::SizeIs;

CharGrid Draw(const std::string& rows, const std::string& more = "") {
  std::string text = "grid:\n  cell_m: 1\n  inset_m: 0.1\n  rows: |\n";
  for (std::size_t at = 0; at < rows.size();) {
    const std::size_t end = std::min(rows.find('\n', at), rows.size());
    text += "    " + rows.substr(at, end - at) + "\n";
    at = end + 1;
  }
  return ReadCharGrid(*ParseYaml(text + more, "site.yaml").Find("grid"));
}

// The lower left and upper right of all the hazard's footprint, or of its solids.
using Span = std::array<double, 4>;
Span SpanOf(const std::vector<Polygon>& polygons) {
  Span s = {1e9, 1e9, -1e9, -1e9};
  for (const Polygon& polygon : polygons)
    for (const Vec2& p : polygon) {
      s = {std::min(s[0], p.x()), std::min(s[1], p.y()), std::max(s[2], p.x()),
           std::max(s[3], p.y())};
    }
  return s;
}
Span FootprintOf(const Hazard& hazard) { return SpanOf(hazard.footprint); }
Span SolidsOf(const Hazard& hazard) {
  std::vector<Polygon> bases;
  for (const Solid& solid : hazard.solids) bases.push_back(solid.base);
  return SpanOf(bases);
}
void ExpectSpan(const Span& actual, const Span& expected) {
  for (std::size_t i = 0; i < 4; ++i) EXPECT_NEAR(actual[i], expected[i], 1e-9) << "side " << i;
}

TEST(CharGridTest, TopRowIsTheFarSideAndTheOriginTheLowerLeftCorner) {
  const CharGrid dut = Draw("#.?\n...");
  EXPECT_EQ(dut.occupancy(0, 1), CellState::kOccupied);
  EXPECT_EQ(dut.occupancy(1, 1), CellState::kFree);
  EXPECT_EQ(dut.occupancy(2, 1), CellState::kUnknown);
  EXPECT_EQ(dut.occupancy(0, 0), CellState::kFree);
  EXPECT_EQ(dut.frame.ToCell({0.01, 0.01}), (Cell{0, 0}));
  EXPECT_EQ(dut.frame.width, 3);
  EXPECT_EQ(dut.frame.height, 2);
  EXPECT_THAT(dut.hazards, SizeIs(0));
}

TEST(CharGridTest, HazardCharactersStandOnFreeCellsInReadingOrder) {
  const CharGrid dut = Draw("G.v.^\n.....\n=.g.r");
  std::vector<std::string> types;
  for (const Hazard& h : dut.hazards) types.push_back(h.type);
  EXPECT_THAT(types, ElementsAre("glass", "step", "step", "cable_cover", "groove", "rough"));
  for (const CellState c : dut.occupancy.cells) EXPECT_EQ(c, CellState::kFree);
  EXPECT_EQ(dut.hazards[0].hazard_class, HazardClass::kGlass);
  EXPECT_LT(dut.hazards[1].height_m, 0);
  EXPECT_GT(dut.hazards[2].height_m, 0);
  EXPECT_EQ(dut.hazards[2].hazard_class, HazardClass::kLevelChange);
  EXPECT_EQ(dut.hazards[3].hazard_class, HazardClass::kTerrain);
}

//   # # # # #
//   # G G . #     glass spans its two cells; drawn back to the right and below,
//   # . . . #     and reaching into the drawn-back walls to the left and above
TEST(CharGridTest, SolidsAreDrawnBackTowardsFreeFloorOnly) {
  const CharGrid dut = Draw("#####\n#GG.#\n#...#\n#####");
  ASSERT_THAT(dut.hazards, SizeIs(1));
  ExpectSpan(FootprintOf(dut.hazards[0]), {1, 2, 3, 3});
  ExpectSpan(SolidsOf(dut.hazards[0]), {1 - 0.1, 2 + 0.1, 3 - 0.1, 3 + 0.1});
}

TEST(CharGridTest, RaisedFloorAndDropsAreDrawnBackToo) {
  for (const char c : {'^', 'v'}) {
    const CharGrid dut = Draw(std::string("...\n.") + c + ".\n...");
    ASSERT_THAT(dut.hazards, SizeIs(1));
    ExpectSpan(FootprintOf(dut.hazards[0]), {1, 1, 2, 2});
    ExpectSpan(SolidsOf(dut.hazards[0]), {1.1, 1.1, 1.9, 1.9});
  }
}

//   v v v        one hazard of two rectangles; cells that touch by a corner only are another's
//   v . .
//   . v .
TEST(CharGridTest, JoinedCellsAreOneHazardOfFewRectangles) {
  const CharGrid dut = Draw("vvv\nv..\n.v.");
  ASSERT_THAT(dut.hazards, SizeIs(2));
  EXPECT_THAT(dut.hazards[0].footprint, SizeIs(2));
  double area = 0;
  for (const Polygon& p : dut.hazards[0].footprint) area += SignedArea(p);
  EXPECT_DOUBLE_EQ(area, 4);
  ExpectSpan(FootprintOf(dut.hazards[1]), {1, 0, 2, 1});
}

TEST(CharGridTest, AFullBlockIsOneRectangle) {
  const CharGrid dut = Draw("....\n.^^.\n.^^.\n.^^.");
  ASSERT_THAT(dut.hazards, SizeIs(1));
  EXPECT_THAT(dut.hazards[0].solids, SizeIs(1));
}

// Strips lie in the middle of their cells, from wall to wall: their ground is that of their cells,
// their solids go on into the walls' drawn-back faces.
TEST(CharGridTest, ARunIsOneStripAlongItself) {
  const CharGrid across = Draw("#===#", "  sizes: {cable_cover: {width_m: 0.2}}\n");
  ASSERT_THAT(across.hazards, SizeIs(1));
  ExpectSpan(FootprintOf(across.hazards[0]), {1, 0.4, 4, 0.6});
  ExpectSpan(SolidsOf(across.hazards[0]), {0.9, 0.4, 4.1, 0.6});
  const CharGrid up = Draw(".=.\n.=.\n...", "  sizes: {cable_cover: {width_m: 0.2}}\n");
  ASSERT_THAT(up.hazards, SizeIs(1));
  ExpectSpan(FootprintOf(up.hazards[0]), {1.4, 1, 1.6, 3});
  ExpectSpan(SolidsOf(up.hazards[0]), {1.4, 1, 1.6, 3.1});  // beyond the map is wall
}

TEST(CharGridTest, ALoneCellIsAStripAlongY) {
  const CharGrid dut = Draw("...\n.g.\n...", "  sizes: {groove: {width_m: 0.2}}\n");
  ASSERT_THAT(dut.hazards, SizeIs(1));
  ExpectSpan(FootprintOf(dut.hazards[0]), {1.4, 1, 1.6, 2});
  EXPECT_LT(dut.hazards[0].height_m, 0);
}

//   . . . .
//   = = = .      the longer run keeps the corner; the other reaches to its middle
//   = . . .
TEST(CharGridTest, ACornerIsJoined) {
  const CharGrid dut = Draw("....\n===.\n=...", "  sizes: {cable_cover: {width_m: 0.2}}\n");
  ASSERT_THAT(dut.hazards, SizeIs(2));
  ExpectSpan(FootprintOf(dut.hazards[0]), {0, 1.4, 3, 1.6});
  ExpectSpan(SolidsOf(dut.hazards[0]), {-0.1, 1.4, 3, 1.6});
  ExpectSpan(FootprintOf(dut.hazards[1]), {0.4, 0, 0.6, 1.5});
  ExpectSpan(SolidsOf(dut.hazards[1]), {0.4, -0.1, 0.6, 1.5});
}

TEST(CharGridTest, SizesSetWhatACharacterMeasures) {
  const CharGrid dut = Draw("v^G\n",
                            "  sizes:\n"
                            "    drop: {height_m: -0.3, known: false}\n"
                            "    raised: {height_m: 0.02, friction: 0.4}\n"
                            "    glass: {thickness_m: 0.01, restitution: 0.9}\n");
  ASSERT_THAT(dut.hazards, SizeIs(3));
  EXPECT_DOUBLE_EQ(dut.hazards[0].height_m, -0.3);
  EXPECT_FALSE(dut.hazards[0].known);
  EXPECT_DOUBLE_EQ(dut.hazards[1].height_m, 0.02);
  EXPECT_EQ(dut.hazards[1].material.friction, 0.4);
  EXPECT_DOUBLE_EQ(dut.hazards[2].material.restitution, 0.9);
  // A thin pane stands in the middle of its cell, and only its own ground is not free.
  ExpectSpan(FootprintOf(dut.hazards[2]), {2.495, 0, 2.505, 1});
}

// Mirroring the drawing mirrors the floor.
TEST(CharGridTest, MirroredDrawingMirroredHazards) {
  const CharGrid one = Draw("..v\n.vv\nG=="), other = Draw("v..\nvv.\n==G");
  ASSERT_EQ(one.hazards.size(), other.hazards.size());
  for (const Hazard& h : one.hazards) {
    const auto same = std::ranges::find(other.hazards, h.type, &Hazard::type);
    ASSERT_NE(same, other.hazards.end());
    const Span a = FootprintOf(h), b = FootprintOf(*same);
    ExpectSpan(b, {3 - a[2], a[1], 3 - a[0], a[3]});
  }
}

}  // namespace
}  // namespace floorproof
