// SPDX-License-Identifier: Apache-2.0
// The progress line of what is drawn: maps, films.
#pragma once

#include <string_view>

#include "base/progress_line.h"

namespace floorproof {

class DrawingProgress {
 public:
  // `what` comes before the count: "drawing maps", "filming, frames".
  DrawingProgress(const Console& console, std::string_view what) : line_(console), what_(what) {}
  void Show(int done, int all);

 private:
  ProgressLine line_;
  std::string_view what_;
};

}  // namespace floorproof
