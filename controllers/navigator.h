// SPDX-License-Identifier: Apache-2.0
// Navigators: along which path a robot goes on. A plan that is driven to its end, one that is taken
// up again after something was met, a planner of an unknown floor: the robot's side asks no
// further.
#pragma once

#include <cstddef>
#include <optional>
#include <string_view>

#include "env/core/motion.h"
#include "env/core/path.h"
#include "env/known/known_map.h"

namespace floorproof {

// A straight way that a mission asks for.
struct AskedLine {
  int number = 0;  // another one: another line
  Vec2 to_W = Vec2::Zero();
  std::optional<double> speed_mps;  // none: the robot's own
};

// What a navigator may know in a control period.
struct NavigatorInput {
  double t_s = 0;
  const Estimate& estimate;
  const KnownMap* known = nullptr;  // what the robot has drawn; nullptr: it draws no map
  std::size_t segment = 0;          // of path() that is tracked
  bool at_end = false;              // of path()
  // It has just gone back from what it met on the way; and that was a drop, not a touch.
  bool recovered = false, met_drop = false;
  const AskedLine* line = nullptr;  // nullptr: no mission asks for one
};

enum class PathChange {
  kNone,
  kAnew,    // path() leads on from where the robot thinks it is
  kLonger,  // path() begins on the segment that was tracked; from there it leads farther, or
            // elsewhere
};

class Navigator {
 public:
  // Where the end of path() is: the path will be continued; the drive's end; there is nowhere to
  // go.
  enum class Leads { kOn, kToEnd, kNowhere };

  virtual ~Navigator() = default;
  // What the tracker follows; it changes in the calls below alone.
  virtual const Path& path() const = 0;
  // One control period. Allocates only where the path changes.
  virtual PathChange Update(const NavigatorInput& input) = 0;
  virtual Leads leads() const = 0;
  // Whether nobody is led at all: path() is no way to be on, or to get on along.
  virtual bool free() const { return false; }
  // In words, where the drive ended for another reason than that a plan was driven.
  virtual std::string_view why() const { return {}; }
  // The plan; or what was gone along so far, where there was none beforehand.
  virtual const Path& plan() const = 0;
  // A person has set the robot down at this waypoint: path() begins there now.
  virtual void GoOnFrom(std::size_t waypoint) = 0;
};

}  // namespace floorproof
