// SPDX-License-Identifier: Apache-2.0
// Navigators: along which path a robot goes on. A plan that is driven to its end, one that is taken
// up again after something was met, a planner of an unknown floor: the robot's side asks no
// further.
#pragma once

#include <cstddef>

#include "env/core/motion.h"
#include "env/core/path.h"
#include "env/known/known_map.h"

namespace floorproof {

// What a navigator may know in a control period.
struct NavigatorInput {
  const Estimate& estimate;
  const KnownMap* known = nullptr;  // what the robot has drawn; nullptr: it draws no map
  std::size_t segment = 0;          // of path() that is tracked
  bool recovered = false;           // it has just gone back from what it met on the way
};

class Navigator {
 public:
  virtual ~Navigator() = default;
  // What the tracker follows; it changes in the calls below alone.
  virtual const Path& path() const = 0;
  // One control period. True: path() is a new one, from where the robot thinks it is. Allocates
  // only then.
  virtual bool Update(const NavigatorInput& input) = 0;
  // A person has set the robot down at this waypoint: path() begins there now.
  virtual void GoOnFrom(std::size_t waypoint) = 0;
};

}  // namespace floorproof
