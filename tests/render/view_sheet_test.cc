// SPDX-License-Identifier: Apache-2.0
#include "render/view_sheet.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace floorproof {
namespace {

constexpr Rgb kTop = {250, 20, 20}, kSide = {20, 250, 20}, kFront = {20, 20, 250};

struct Box {
  int left = 1 << 20, top = 1 << 20, right = -1, bottom = -1;
  int width() const { return right - left + 1; }
  int height() const { return bottom - top + 1; }
};

// Of all pixels of this colour.
Box Find(const Image& image, const Rgb& colour) {
  Box box;
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x) {
      const std::uint8_t* p = image.data.data() + 3 * (y * image.width + x);
      if (!std::equal(colour.begin(), colour.end(), p)) continue;
      box.left = std::min(box.left, x);
      box.right = std::max(box.right, x);
      box.top = std::min(box.top, y);
      box.bottom = std::max(box.bottom, y);
    }
  return box;
}

// A box of 2 x 1 x 0.5 m.
ViewSheet BoxSheet() {
  ViewSheet sheet;
  sheet.title = "box";
  sheet.top.shapes = {{Rectangle({-1, -0.5}, {1, 0.5}), kTop}};
  sheet.side.shapes = {{Rectangle({-1, 0}, {1, 0.5}), kSide}};
  sheet.front.shapes = {{Rectangle({-0.5, 0}, {0.5, 0.5}), kFront}};
  sheet.side.floor = sheet.front.floor = true;
  sheet.figures = {{"length", "2 m"}};
  return sheet;
}

TEST(ViewSheet, AllViewsHaveOneScale) {
  const Image dut = DrawViewSheet(BoxSheet());
  const Box top = Find(dut, kTop), side = Find(dut, kSide), front = Find(dut, kFront);
  constexpr int kBorder_px = 4;  // each shape's own, darker
  ASSERT_GT(top.width(), 100);
  EXPECT_NEAR(top.width(), 2 * top.height(), kBorder_px);
  EXPECT_NEAR(side.width(), top.width(), kBorder_px);
  EXPECT_NEAR(front.width(), top.height(), kBorder_px);
  EXPECT_NEAR(4 * side.height(), side.width(), 4 * kBorder_px);
}

TEST(ViewSheet, TheSideLiesBelowTheTopAndTheFrontBesideIt) {
  const Image dut = DrawViewSheet(BoxSheet());
  const Box top = Find(dut, kTop), side = Find(dut, kSide), front = Find(dut, kFront);
  EXPECT_NEAR(side.left, top.left, 1);
  EXPECT_NEAR(side.right, top.right, 1);
  EXPECT_GT(side.top, top.bottom);
  EXPECT_EQ(front.bottom, side.bottom);
  EXPECT_GT(front.left, side.right);
  EXPECT_LT(front.right, dut.width);
}

TEST(ViewSheet, LaterShapesCoverEarlierOnes) {
  ViewSheet sheet = BoxSheet();
  sheet.top.shapes.push_back({Rectangle({-1, -0.5}, {1, 0.5}), kSide});
  sheet.side.shapes.clear();
  sheet.side.shapes = {{Rectangle({-1, 0}, {1, 0.5}), {9, 9, 9}}};
  const Image dut = DrawViewSheet(sheet);
  EXPECT_EQ(Find(dut, kTop).right, -1);
  EXPECT_GT(Find(dut, kSide).right, 0);
}

// What is written below the figures has room however much it is.
TEST(ViewSheet, RemarksMakeRoom) {
  ViewSheet sheet = BoxSheet();
  const int before = Find(DrawViewSheet(sheet), kSide).top;
  sheet.remarks.assign(40, "wrong: something: mend it");
  EXPECT_GT(Find(DrawViewSheet(sheet), kSide).top, before + 100);
}

TEST(ViewSheet, TheSameSheetGivesTheSameBytes) {
  EXPECT_EQ(DrawViewSheet(BoxSheet()).data, DrawViewSheet(BoxSheet()).data);
}

}  // namespace
}  // namespace floorproof
