// SPDX-License-Identifier: Apache-2.0
// What a drive went through, as bands over its time: a picture of its own, and a strip below the
// frames of its film, in which a line marks the frame's time.
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "media/media.h"
#include "render/text.h"

namespace floorproof {

struct TimelineSpan {
  double from_s = 0, to_s = 0;
  Rgb colour = {0, 0, 0};
  std::string text = {};  // in it, where it fits
};

struct TimelineRow {
  std::string name;
  std::vector<TimelineSpan> spans;
  bool in_film = false;  // in the strip, too
};

// A value that changes in steps, and the levels that it is held against.
struct TimelineCurve {
  std::string name;
  std::vector<std::pair<double, double>> steps;  // from this time on, s: this value
  double most = 1;                               // the axis ends there
  std::vector<std::pair<double, std::string>> levels;
  Rgb colour = {0, 0, 0};
  std::vector<std::pair<double, double>> behind = {};  // a second value of the same unit
  Rgb behind_colour = {0, 0, 0};
};

struct Timeline {
  std::string title;
  std::vector<std::string> notes;  // lines below the title
  double end_s = 0;
  std::vector<TimelineRow> rows;
  std::optional<TimelineCurve> curve = {};
  std::vector<std::pair<std::string, Rgb>> legend;
};

Image DrawTimeline(const Timeline& timeline);
// Over an RGB frame, above its status bar; nothing where no row is meant for films.
void DrawTimelineStrip(const Timeline& timeline, double t_s, Image& frame);

}  // namespace floorproof
