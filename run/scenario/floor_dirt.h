// SPDX-License-Identifier: Apache-2.0
// The scenario's key `dirt`: what lies on the floor, who cleaned it before, and how samples of it
// are taken.
#pragma once

#include <string>

#include "base/config.h"
#include "env/audit/audit_sample.h"
#include "env/audit/brush.h"
#include "env/audit/dirt_field.h"
#include "env/audit/gathering.h"
#include "env/core/hazard_map.h"
#include "planners/planner.h"

namespace floorproof {

// What lies there, and how samples of it are taken.
struct DirtAuditParams {
  DirtParams laid;
  SamplingParams sampling;
  int dirty_above = kDirtyAbove;
  void Visit(ParamVisitor& v);
};

struct CleaningRounds {
  int rounds = 0;
  CleaningParams brush;
  void Visit(ParamVisitor& v);
};

struct FloorDirt {
  DirtAuditParams params;
  // Before the robot comes, one with the same base has cleaned the floor, by a plan of its own from
  // the same start.
  CleaningRounds cleaning;
  PluginSpec cleaner;       // a planner that covers floor
  SourceMark cleaner_mark;  // where it is named
};

// Throws InputError, also where more lies on this floor than the field holds.
FloorDirt ReadDirt(const ConfigNode& node, const HazardMap& map);
ConfigNode DirtSchema();
// The node that reads back as the same.
ConfigNode WriteDirt(const FloorDirt& dirt);

}  // namespace floorproof
