// SPDX-License-Identifier: Apache-2.0
// One line that says how far a long command is. On a terminal it is rewritten in place; elsewhere a
// plain line is written every ten seconds.
#pragma once

#include <chrono>
#include <string>

#include "base/console.h"

namespace floorproof {

class ProgressLine {
 public:
  explicit ProgressLine(const Console& console);
  ~ProgressLine() { Clear(); }
  ProgressLine(const ProgressLine&) = delete;
  ProgressLine& operator=(const ProgressLine&) = delete;

  // Whether it is time for a new line; never when nothing is to be said.
  bool IsDue();
  void Show(const std::string& line);
  // Makes room on a terminal for what is said next.
  void Clear();
  // From the start to the last time that a line was due.
  double wall_s() const { return std::chrono::duration<double>(last_ - start_).count(); }

 private:
  bool quiet_, terminal_, shown_ = false;
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now(), last_ = start_;
};

}  // namespace floorproof
