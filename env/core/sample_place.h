// SPDX-License-Identifier: Apache-2.0
// A place where an audit takes a sample of the floor: what planner, plan.json and pictures say of
// it.
#pragma once

#include <string_view>
#include <vector>

#include "env/geometry/geometry.h"

namespace floorproof {

// Why a place was chosen; it may be for several reasons ("audit-sampling", Eq. 1).
struct SampleKinds {
  bool boundary = false;  // near the walls of the room
  bool corner = false;    // near a sharp corner
  bool random = false;    // so that the rest of the floor is looked at, too
  bool given = false;     // the user's own
  bool near_walls() const { return boundary || corner; }
  bool operator==(const SampleKinds&) const = default;
};

// The reasons' names, the most telling one first: that by which it is coloured.
std::vector<std::string_view> Names(const SampleKinds& kinds);

struct SamplePlace {
  Vec2 p_W = Vec2::Zero();
  SampleKinds kinds;
  bool reachable = false;  // by the robot's clear shape, from the start
  int visit = 0;           // the how manieth stop of the plan, from 1 on; 0: none
};

// The room that is audited, by the parts whose places were chosen alike: shares of its floor where
// the robot's sensor gets to. What is left to 1 lies out of its reach.
struct SampledParts {
  double near_walls = 0;  // and corners
  double elsewhere = 0;
  // The places near walls may lie anywhere there; else they keep to the lattice, so that along a
  // straight wall all are at one or two distances from it.
  bool by_chance = false;
};

}  // namespace floorproof
