// SPDX-License-Identifier: Apache-2.0
// What an estimate may be, at a stated confidence.
#pragma once

namespace floorproof {

// Of every interval that a campaign or a comparison states.
inline constexpr double kReportedConfidence = 0.95;

struct Interval {
  double lower = 0;
  double upper = 0;  // may be infinite where the data say nothing
  bool Contains(double value) const { return lower <= value && value <= upper; }
};

}  // namespace floorproof
