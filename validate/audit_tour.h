// SPDX-License-Identifier: Apache-2.0
// BELUGA's audits in Table 3 of "audit-sampling", driven; and the pace calibrated on them.
//
// The paper gives stops N, path length D, time T and energy E of each trial, not the paths. Assumed
// here: N legs of D / N, each ending in a stop, and a left turn of 90 deg on the spot after each;
// the bends of the paper's A* paths between stops are not driven. What a stop takes longer than
// that turn is part of the calibrated dwell.
#pragma once

#include <span>
#include <string_view>

#include "validate/rig.h"

namespace floorproof {

struct AuditTrial {
  std::string_view algorithm;
  int environment = 0;
  int stops = 0;        // N
  double path_m = 0;    // D
  double time_s = 0;    // T
  double energy_j = 0;  // E, of the whole robot
};

// Table 3, "The overall observations from trial-2": four algorithms in each of three environments.
std::span<const AuditTrial> AuditTrials();

struct AuditPace {
  double speed_mps = 0;  // from stop to stop
  double dwell_s = 0;    // at a stop
};

struct AuditRun {
  double time_s = 0;
  double energy_j = 0;  // of the whole robot, Eq. 5
};

// Drives a tour of this many stops and this length at the pace, tracked as an episode is. Throws
// InternalError when it does not end.
AuditRun DriveAudit(const AuditTrial& trial, const AuditPace& pace, const WrongModel& wrong = {});

struct AuditCalibration {
  AuditPace pace;
  double hotel_load_w = 0;
};

// Pace and hotel load by least squares over the four trials of environment 1, each driven: Gauss-
// Newton from `guess`, with N and D as the derivatives of T, until the pace stands still.
AuditCalibration CalibrateAudit(const AuditPace& guess);

}  // namespace floorproof
