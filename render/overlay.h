// SPDX-License-Identifier: Apache-2.0
// What is written over a film's frame: a status bar below and, once it is known, the outcome above.
#pragma once

#include <string>

#include "env/core/event.h"
#include "env/core/hazard_map.h"
#include "media/media.h"

namespace floorproof {

struct Banner {
  enum class Tone { kFailure, kWarning, kSuccess };
  Tone tone = Tone::kFailure;
  std::string headline;  // "FAILURE  roll over: fell"
  std::string detail;    // one line of evidence; may be empty
};

struct Overlay {
  std::string title;    // robot and site; cut short if the bar is too narrow
  double t_s = 0;       // simulated time
  double coverage = 0;  // 0 to 1; negative: not shown
  double speed_up = 1;  // seconds simulated a second of film; 0: time stands
  const Banner* banner = nullptr;
};

// Draws over an RGB picture of any size; all measures follow its height.
void DrawOverlay(const Overlay& overlay, Image& image);
// Rows of the picture that the two bars take: the banner [0, top), the status bar [bottom, height).
struct OverlayRows {
  int top = 0, bottom = 0;
};
OverlayRows RowsOf(const Image& image);

// What failed, in words (env/core/failure_text.h), with place and time. Of hazards that are not on
// the map only their ids are said.
Banner FailureBanner(const Event& event, const HazardMap& map);

}  // namespace floorproof
