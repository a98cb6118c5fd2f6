// SPDX-License-Identifier: Apache-2.0
// A hazard's plug-in: its keys, footprint, FMEA class, neutral solids and material. A new hazard is
// one file in this folder and one line in list.inc.
#pragma once

#include <memory>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "base/params.h"
#include "base/registry.h"
#include "env/core/hazard_map.h"
#include "env/core/robot_spec.h"

namespace floorproof {

// Of a hazard's solids: below it the engine finds no volume.
inline constexpr double kLeastSize_m = 1e-4;

// Sizes that are the same but for rounding differ by less than this factor.
inline constexpr double kSame = 1 + 1e-9;

// Values of one key, its own or one that all types share, over which a robot's chance to fail goes
// from hardly any to nearly all.
struct KeyRange {
  std::string key;
  std::vector<std::pair<double, double>> spans;  // [low, high], ascending
  bool grows = false;                            // from 0, where the hazard is none, either way
};

class HazardType : public Configurable {
 public:
  // How its place is written in a site file.
  enum class Placement { kPolygon /* polygon_m */, kLine /* line_m */ };
  virtual Placement placement() const = 0;
  // Makes footprint, class, height, solids and material from the keys (already read by Visit) and
  // the place: a polygon's corners (counter-clockwise) or a polyline's points, world frame, metres.
  // Throws InputError (without mark; the caller adds it) when the place does not suit.
  virtual Hazard Make(const std::vector<Vec2>& place) const = 0;
  // Turns the directions among its keys counter-clockwise, as its place is turned. Whether there
  // are any: then it is not at its far edge as at its near one.
  virtual bool Turn(double /*by_rad*/) { return false; }
  // What of it to vary to measure how often this robot fails there. Any values from these ranges,
  // together, make a hazard, on a strip that is longer than three of the robot's wheels are high.
  // None: it is measured as it is by default.
  virtual std::vector<KeyRange> Ranges(const RobotSpec& /*robot*/) const { return {}; }
};

std::span<const PluginEntry<HazardType>> HazardTypes();

}  // namespace floorproof
