// SPDX-License-Identifier: Apache-2.0
// What a robot fails at where it passes a hazard is that it touches it. So kinds that are alike,
// each of which hardly ever failed, learn together at what they fail.
#pragma once

#include <map>
#include <memory>

#include "measure/rate_rows.h"

namespace floorproof {

struct LikeKinds {
  std::vector<RateAxis> axes;
  LinearPredictor any;  // of all of their meetings together
};

// Of hazards that are passed: what stands there (C1, C2) is alike; so is what could be driven over
// (C3, C4) and is no ramp, by how far it rises or falls (kRise). By kind, those that it is like; a
// kind that failed 100 times or more stands by itself, but counts for the others. None where there
// is no other, or all together failed fewer than 20 times.
std::map<ByKind::key_type, std::shared_ptr<const LikeKinds>> FitLikeKinds(
    const ByKind& by_kind, const RateFitOptions& options);

// The odds of any failure of a kind with these rows, by the axes of `like`, which failed
// `any.events` times: those of `like`, shifted as its own failures say. `name` is of the stream of
// its members.
void SetLike(const std::vector<RateRow>& rows, const LikeKinds& like, const std::string& name,
             LinearPredictor& any);

}  // namespace floorproof
