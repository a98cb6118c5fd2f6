// SPDX-License-Identifier: Apache-2.0
// What the ladder's rows say, taken together.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "validate/ladder.h"

namespace floorproof {

// What the hTetro paper saw (htetro-fmea-coverage, C4): a cable cover that is crossed forward and
// holds the robot when met sideways. Flanks steeper than from_deg and up to to_deg do so.
struct CoverGap {
  LadderCell cell;  // the forward one
  double from_deg = 0, to_deg = 0;
};
std::vector<CoverGap> CoverGaps(std::span<const LadderRow> rows);
std::string Sentence(const CoverGap& gap);

// A cell's limit with roller wheels that differs from that with ideal ones by more than `share` of
// the larger of the two.
struct WheelDisagreement {
  LadderRow ideal, rollers;
};
std::vector<WheelDisagreement> WheelDisagreements(std::span<const LadderRow> rows, double share);

// The highest level change (m) that `robot` crosses up and down, in every direction and at every
// speed, on friction 0.8, with either kind of wheels. Nothing where there is no such row. A robot's
// step_m should not exceed it.
std::optional<double> TrustedStep(std::span<const LadderRow> rows, std::string_view robot);

// Of each robot, hazard and direction: its limits by angle off square, and from farther away.
std::vector<std::string> ObliqueFindings(std::span<const LadderRow> rows);

// All but the last as sentences: gaps on friction 0.8, wheels that part by a fifth, and each
// robot's step_m beside what it crosses.
std::vector<std::string> Findings(std::span<const LadderRow> rows);

}  // namespace floorproof
