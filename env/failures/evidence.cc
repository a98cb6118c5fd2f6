// SPDX-License-Identifier: Apache-2.0
#include "env/failures/evidence.h"

#include <utility>

#include "env/failures/detector.h"
#include "env/failures/effects.h"

namespace floorproof {

std::string HazardMemory::Recall(const HazardMap& map, double since_s) const {
  return t_s_ >= since_s ? HazardId(map, index_, contact_) : "";
}

Event MakeEvent(FailureMode mode, std::string_view kind, const Sample& sample, std::string hazard,
                double value, double threshold) {
  Event event;
  event.mode = mode;
  event.kind = kind;
  event.t_s = sample.t_s;
  event.x_m = sample.p_WB.x();
  event.y_m = sample.p_WB.y();
  event.yaw_rad = sample.yaw_rad;
  event.hazard = std::move(hazard);
  event.value = value;
  event.threshold = threshold;
  event.effect = EffectOf(mode, kind);
  return event;
}

}  // namespace floorproof
