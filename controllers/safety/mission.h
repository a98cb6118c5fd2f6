// SPDX-License-Identifier: Apache-2.0
// A mission as a tree: tasks in order, each of skills, each of primitives ("safety-monitoring",
// section 3.1), with what is said of each primitive's failures.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "controllers/safety/decision.h"
#include "controllers/safety/safety_state.h"

namespace floorproof {

// A type of primitive that there is, and the keys that it knows beside what is said of its
// failures.
struct PrimitiveType {
  std::string name;
  std::vector<std::string> keys;
  bool ends = true;  // it is done some time: a skill runs it; else it goes on beside those
  // What only one primitive can use at a time, in words ("the wheels"); empty: nothing.
  std::string needs = {};
};

struct MissionPrimitive {
  std::string name, type;
  FailureRating rating;
  ConfigNode params;  // its own keys
};

struct MissionNode {
  enum class Kind { kMission, kTask, kSkill, kPrimitive };
  Kind kind = Kind::kMission;
  std::string name;
  std::vector<std::size_t> children;  // into Mission::nodes; they run one after the other
  bool parallel = false;              // it runs beside these, and ends with its parent
  std::size_t primitive = 0;          // a primitive: into Mission::primitives
  // A primitive: its keys, for whoever makes it; its own, and those of its skill that its type
  // knows.
  ConfigNode params;
};

struct Mission {
  std::string name;
  std::vector<MissionPrimitive> primitives;
  std::vector<MissionNode> nodes;  // the first is the mission; each stands before its children
  SafetyWeights weights;
  LevelLimits levels;
  DecisionParams decision;
};

// A file of a mission: docs/safety.md. Throws InputError with file, line and key: unknown keys,
// types and names, a task that is part of itself, parts that need the same thing at the same time,
// ratings that are not on the paper's scales, thresholds out of order, more than 10,000 nodes.
Mission ReadMission(const ConfigNode& root, std::span<const PrimitiveType> types);

}  // namespace floorproof
