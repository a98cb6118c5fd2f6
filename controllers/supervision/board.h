// SPDX-License-Identifier: Apache-2.0
// What a robot's primitives and its drive tell each other in a control period.
#pragma once

#include <cstddef>
#include <optional>
#include <span>

#include "controllers/monitors/monitor.h"
#include "controllers/navigator.h"
#include "controllers/supervision/wheel_redundancy.h"

namespace floorproof {

// What the primitives of motion ask for; the last one that asks in a period is heard.
struct MotionWish {
  enum class Kind { kStand, kPlan, kTurn, kLine };
  Kind kind = Kind::kStand;
  double yaw_rad = 0;  // kTurn: to this heading, where it stands
  AskedLine line;      // kLine
};

struct Board {
  // Told to the primitives.
  const MonitorReadings* now = nullptr;
  std::span<const NamedMonitor> monitors;
  const WheelRedundancy* wheels = nullptr;
  bool at_end = false;     // of the plan, or of the line
  bool busy = false;       // it stands on purpose: it dwells, folds, turns, or reacts to a touch
  double speed_share = 1;  // that its supervision lets it drive at; 0: it is held still
  // Told by them.
  MotionWish wish;
};

}  // namespace floorproof
