// SPDX-License-Identifier: Apache-2.0
#include "render/timeline.h"

#include <gtest/gtest.h>

#include "render/overlay.h"

namespace floorproof {
namespace {

constexpr Rgb kRed = {200, 10, 20}, kBlue = {10, 20, 200};

Timeline Made() {
  Timeline timeline;
  timeline.end_s = 100;
  timeline.rows = {{"machine", {{25, 50, kRed, "fault"}}, true},
                   {"alarms", {{30, 31, kBlue}}, false}};
  return timeline;
}

// Columns of the picture that hold a colour: the first and one past the last.
std::pair<int, int> Columns(const Image& image, const Rgb& colour) {
  std::pair<int, int> found = {image.width, 0};
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x) {
      const std::uint8_t* pixel = &image.data[3 * static_cast<std::size_t>(y * image.width + x)];
      if (pixel[0] != colour[0] || pixel[1] != colour[1] || pixel[2] != colour[2]) continue;
      found = {std::min(found.first, x), std::max(found.second, x + 1)};
    }
  return found;
}

TEST(Timeline, SpansLieAtTheirTimes) {
  Timeline timeline = Made();
  timeline.rows[1].spans[0] = {0, 100, kBlue};  // shows where the axis begins and ends
  const Image image = DrawTimeline(timeline);
  const auto axis = Columns(image, kBlue), span = Columns(image, kRed);
  const double second = (axis.second - axis.first) / 100.0;
  EXPECT_NEAR(span.first, axis.first + 25 * second, 2);
  EXPECT_NEAR(span.second, axis.first + 50 * second, 2);
}

TEST(Timeline, WhatIsShortIsSeenAllTheSame) {
  Timeline timeline = Made();
  timeline.rows[1].spans[0] = {30, 30.001, kBlue};
  const auto [first, end] = Columns(DrawTimeline(timeline), kBlue);
  EXPECT_GE(end - first, 2);
}

TEST(Timeline, HoldsAnyNumberOfRowsAndNone) {
  Timeline timeline;
  EXPECT_GT(DrawTimeline(timeline).height, 50);
  const int alone = DrawTimeline(Made()).height;
  timeline = Made();
  for (int i = 0; i < 30; ++i) timeline.rows.push_back(timeline.rows[0]);
  EXPECT_GT(DrawTimeline(timeline).height, alone + 30 * 20);
  timeline.curve = TimelineCurve{"R", {{0, 0}, {50, 100}}, 120, {{60, "fatal above"}}, kBlue};
  EXPECT_NE(Columns(DrawTimeline(timeline), kBlue).second, 0);
  constexpr Rgb kPink = {204, 121, 167};
  EXPECT_EQ(Columns(DrawTimeline(timeline), kPink).second, 0);
  timeline.curve->behind = {{0, 0}, {50, 110}};
  timeline.curve->behind_colour = kPink;
  EXPECT_NE(Columns(DrawTimeline(timeline), kPink).second, 0);
}

// The strip keeps to what lies above the status bar, and its line goes with the film's time.
TEST(TimelineStrip, MarksTheFramesTime) {
  const auto line = [](double t_s) {
    Image frame = GreyImage(640, 360, 128);
    const Image plain = frame;
    DrawTimelineStrip(Made(), t_s, frame);
    const int bottom = RowsOf(frame).bottom;
    for (int y = 0; y < frame.height; ++y)
      for (int x = 0; x < frame.width; ++x) {
        const auto at = 3 * static_cast<std::size_t>(y * frame.width + x);
        if (y >= bottom || y < bottom - 40) {
          EXPECT_EQ(frame.data[at], plain.data[at]) << x << ", " << y;
        }
      }
    EXPECT_EQ(Columns(frame, kBlue).second, 0) << "a row that is not for films";
    // Right of the names the line alone is white.
    int x = frame.width;
    while (x-- > 200)
      if (frame.data[3 * static_cast<std::size_t>((bottom - 2) * frame.width + x)] == 255) break;
    return x;
  };
  EXPECT_LT(line(50) + 100, line(100));
  EXPECT_NEAR(line(75) - line(50), line(100) - line(75), 2);
}

TEST(TimelineStrip, WithoutRowsForFilmsNothingIsDrawn) {
  Timeline timeline = Made();
  timeline.rows[0].in_film = false;
  Image frame = GreyImage(640, 360, 128);
  const Image plain = frame;
  DrawTimelineStrip(timeline, 10, frame);
  EXPECT_EQ(frame.data, plain.data);
}

}  // namespace
}  // namespace floorproof
