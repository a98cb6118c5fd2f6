// SPDX-License-Identifier: Apache-2.0
// How a robot is supervised: the mission that it executes, the monitors that watch it, and what it
// does about what they say.
#pragma once

#include <vector>

#include "base/registry.h"
#include "controllers/safety/mission.h"
#include "controllers/supervision/robot_primitive.h"

namespace floorproof {

// The supervision primitives' own numbers (docs/safety.md).
struct ReactionParams {
  bool react = true;
  double adapt_share = 0.5;
  double wait_s = 5;
  double patience_s = 60;
  double cautious_s = 5;
  int most_waits = 3;
  void Visit(ParamVisitor& v);
};

struct SafetyPlan {
  Mission mission;
  std::vector<PluginSpec> monitors;  // those that the mission names and the robot can have
  ReactionParams reaction;
  bool helped = false;  // somebody comes when it hands over
};

// Makes the primitive of this node. Throws InputError, with line and key, for a value that is out
// of bounds and a monitor that there is not. Monitors that the robot does without are passed over.
std::unique_ptr<RobotPrimitive> MakePrimitive(const Mission& mission, const MissionNode& node);
// Its lines, in order; empty: it drives the scenario's plan. Throws InputError where
// it does both, or neither.
struct MissionLine {
  AskedLine line;
  SourceMark mark;    // where its place is written
  std::string skill;  // of which it is part
};
std::vector<MissionLine> LinesOf(const Mission& mission, const ConfigNode& root);
// The monitors that the mission's primitives name, each once.
std::vector<std::string> MonitorsOf(const Mission& mission);
// Those of one node.
std::vector<std::string> MonitorsOf(const MissionNode& node);

}  // namespace floorproof
