// SPDX-License-Identifier: Apache-2.0
#include "validate/suite/method.h"

namespace floorproof {

std::string HowItEnded(const EpisodeRecord& record) {
  if (record.events.empty()) return std::string(Name(record.outcome));
  const Event& event = record.events.front();
  std::string how(Name(event.mode));
  if (!event.kind.empty()) how += "/" + event.kind;
  if (!event.hazard.empty()) how += " at " + event.hazard;
  return how;
}

MethodVerdict Method::Judge(const MethodRun&, const EpisodeRecord& record) const {
  if (record.outcome == Outcome::kSuccess) return {true};
  return {false, HowItEnded(record)};
}

}  // namespace floorproof
