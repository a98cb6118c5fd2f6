// SPDX-License-Identifier: Apache-2.0
// What the detectors share: which hazard was met last, and the making of an event.
#pragma once

#include <limits>
#include <string>
#include <string_view>

#include "env/core/event.h"
#include "env/core/hazard_map.h"
#include "env/core/motion.h"

namespace floorproof {

// The hazard that the robot met last. A failure is often established seconds after what caused it.
class HazardMemory {
 public:
  void Clear() { *this = {}; }

  void Update(const Sample& sample) {
    if (sample.num_contacts > 0) {
      index_ = sample.contacts[0].hazard;
      for (int i = 1; i < sample.num_contacts; ++i)  // a hazard says more than the wall beside it
        if (index_ < 0) index_ = sample.contacts[static_cast<std::size_t>(i)].hazard;
      if (index_ < 0) index_ = sample.near_hazard;
      contact_ = true;
      t_s_ = sample.t_s;
    } else if (sample.near_hazard >= 0) {
      index_ = sample.near_hazard;
      contact_ = false;
      t_s_ = sample.t_s;
    }
  }

  // Its id when it was met at since_s or later, else "".
  std::string Recall(const HazardMap& map, double since_s) const;

 private:
  int index_ = -1;
  bool contact_ = false;
  double t_s_ = -std::numeric_limits<double>::infinity();
};

// An event at this sample's time and pose, with the mode's effect.
Event MakeEvent(FailureMode mode, std::string_view kind, const Sample& sample, std::string hazard,
                double value, double threshold);

}  // namespace floorproof
