// SPDX-License-Identifier: Apache-2.0
#include "render/overlay.h"

#include <gmock/gmock.h>

#include "env/geometry/geometry.h"
#include "render/text.h"
#include "tests/render/room.h"

namespace floorproof {
namespace {

struct Size {
  int width, height;
};
class OverlaySizes : public ::testing::TestWithParam<Size> {};

TEST_P(OverlaySizes, DrawsWithinItsRowsOnly) {
  const Image plain = GreyImage(GetParam().width, GetParam().height, 128);
  Image image = plain;
  Event event;
  event.mode = FailureMode::kRollOver;
  const Banner banner = FailureBanner(event, {});
  DrawOverlay({"robot on site", 12.3, 0.5, 20, &banner}, image);
  const OverlayRows rows = RowsOf(image);
  EXPECT_LT(rows.top + plain.height - rows.bottom, plain.height / 4);
  for (int y = 0; y < plain.height; ++y) {
    const bool bars = y < rows.top || y >= rows.bottom;
    for (int x = 0; x < plain.width; ++x) {
      EXPECT_EQ(Difference(image, plain, x, y) > 0, bars) << x << ", " << y;
    }
  }
}

// Letters stand out from their bar, in the picture's own resolution.
TEST_P(OverlaySizes, TextIsReadable) {
  Image image = GreyImage(GetParam().width, GetParam().height, 128);
  DrawOverlay({"", 83.4, -1, 1, nullptr}, image);
  int light = 0;
  for (int y = RowsOf(image).bottom; y < image.height; ++y)
    for (int x = 0; x < image.width / 4; ++x) light += Luma(image, x, y) > 180;
  const double letter = (image.height - RowsOf(image).bottom) / 3.0;
  EXPECT_GT(light, 5 * letter);
}

TEST_P(OverlaySizes, LongTitleLeavesTheGaugeAlone) {
  const auto draw = [&](std::string title) {
    Image image = GreyImage(GetParam().width, GetParam().height, 128);
    DrawOverlay({std::move(title), 1, 0.5, 1, nullptr}, image);
    return image;
  };
  const Image none = draw(""), endless = draw(std::string(500, 'W'));
  int changed = 0;
  for (int y = 0; y < none.height; ++y) {
    for (int x = 0; x < none.width; ++x) {
      if (Difference(none, endless, x, y) == 0) continue;
      ++changed;
      EXPECT_LT(x, none.width * 6 / 10);
    }
  }
  EXPECT_GT(changed, 0);
}

INSTANTIATE_TEST_SUITE_P(Sizes, OverlaySizes,
                         ::testing::Values(Size{1280, 720}, Size{640, 360}, Size{960, 540}),
                         [](const auto& i) { return std::to_string(i.param.height); });

TEST(OverlayTest, GaugeGrowsWithCoverage) {
  const auto green = [](double coverage) {
    Image image = GreyImage(960, 540, 128);
    DrawOverlay({"", 1, coverage, 1, nullptr}, image);
    int n = 0;
    for (int y = RowsOf(image).bottom; y < image.height; ++y)
      for (int x = 0; x < image.width; ++x) n += Pixel(image, x, y)[1] > Pixel(image, x, y)[0] + 80;
    return n;
  };
  EXPECT_EQ(green(0), 0);
  EXPECT_GT(green(0.5), 100);
  EXPECT_NEAR(green(1.0), 2.0 * green(0.5), 0.05 * green(1.0));
  EXPECT_EQ(green(1.7), green(1.0));
}

TEST(OverlayTest, AFailureSaysWhatWhereAndWhen) {
  Event event;
  event.mode = FailureMode::kRollOver;
  event.kind = "fell";
  event.hazard = "drop-1";
  event.t_s = 12.34;
  event.x_m = 1;
  event.value = 0.148;
  event.threshold = 0.030;
  const Banner fell = FailureBanner(event, {});
  EXPECT_EQ(fell.headline, "FAILURE   roll over (fell)   at drop-1");
  EXPECT_THAT(fell.detail, ::testing::HasSubstr("a wheel dropped by 148 mm"));
  EXPECT_THAT(fell.detail, ::testing::HasSubstr("at x 1.00, y 0.00 m"));
  EXPECT_THAT(fell.detail, ::testing::EndsWith("t 12.3 s"));
}

TEST(TextTest, IsCutAtThePicturesBordersAndTakesAnyBytes) {
  Image image = GreyImage(40, 20, 128);
  for (const double x : {-30.0, 10.0, 39.0, 500.0}) {
    for (const double y : {-5.0, 0.0, 10.0, 25.0}) DrawText(image, x, y, "M\xC3\xBC\xFF\n", {});
  }
  EXPECT_EQ(image.data.size(), 40u * 20 * 3);
  EXPECT_DOUBLE_EQ(TextWidth("\xFF\n", {}), TextWidth("??", {}));
}

// Other letters make other pictures: neither boxes nor question marks stand for them.
TEST(TextTest, NamesOfAnyScriptAreDrawn) {
  const auto draw = [](const char* text) {
    Image image = GreyImage(300, 60, 128);
    DrawText(image, 10, 40, text, {.cap_px = 16});
    return image.data;
  };
  const char* const names[] = {"größe", "groesse", "порог", "ступень", "门槛",
                               "楼梯",  "عتبة",    "باب",   "αβγ",     "δεζ"};
  for (const char* one : names)
    for (const char* other : names) {
      EXPECT_EQ(draw(one) == draw(other), one == other) << one << " " << other;
    }
  EXPECT_NE(draw("step 门槛"), draw("step 楼梯"));
  // Scripts that no one font has together.
  EXPECT_NE(draw("门槛 порог عتبة"), draw("\\u95e8\\u69db порог عتبة"));
  EXPECT_NE(draw("门槛 порог عتبة"), draw("楼梯 порог عتبة"));
}

// Letters of Arabic are joined: together they are narrower than one by one.
TEST(TextTest, LettersAreShapedAsTheirScriptWants) {
  const TextStyle style{.cap_px = 40};
  const double apart = TextWidth("ع", style) + TextWidth("ت", style) + TextWidth("ب", style);
  EXPECT_LT(TextWidth("عتب", style), 0.9 * apart);
}

TEST(TextTest, ALetterThatNoFontHasIsEscaped) {
  const auto draw = [](const char* text) {
    Image image = GreyImage(300, 60, 128);
    DrawText(image, 10, 40, text, {});
    return image.data;
  };
  EXPECT_EQ(draw("\xF3\xBF\xBF\xBD"), draw("\\U000ffffd"));  // for private use
}

TEST(TextTest, IsCutByWholeLetters) {
  EXPECT_EQ(WithoutLastLetter("aé"), "a");
  EXPECT_EQ(WithoutLastLetter("门槛"), "门");
  EXPECT_EQ(WithoutLastLetter("ab"), "a");
  EXPECT_EQ(WithoutLastLetter(""), "");
}

TEST(TextTest, AnchorsAgree) {
  const TextStyle style{.cap_px = 14};
  const double width = TextWidth("covered", style);
  const auto draw = [&](double x, Anchor anchor) {
    Image image = GreyImage(200, 40, 128);
    TextStyle s = style;
    s.anchor = anchor;
    DrawText(image, x, 30, "covered", s);
    return image.data;
  };
  EXPECT_EQ(draw(60, Anchor::kLeft), draw(60 + width, Anchor::kRight));
  EXPECT_EQ(draw(60, Anchor::kLeft), draw(60 + width / 2, Anchor::kCentre));
}

}  // namespace
}  // namespace floorproof
