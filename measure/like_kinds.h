// SPDX-License-Identifier: Apache-2.0
// What a robot fails at where it passes a hazard is that it touches it, whatever it is. So kinds
// that are alike, each of which hardly ever failed, fail together at what each of them fails at.
#pragma once

#include <map>
#include <memory>

#include "measure/rate_rows.h"

namespace floorproof {

struct LikeKinds {
  std::vector<RateAxis> axes;
  LinearPredictor any;  // of all of their meetings together
};

// Of hazards that are passed: what stands there (C1, C2) is alike, and what could be driven over
// (C3, C4). By kind, those that it is like; a kind that failed 100 times or more stands by itself,
// but counts for the others. None where there is no other, or all together failed fewer than 20
// times.
std::map<ByKind::key_type, std::shared_ptr<const LikeKinds>> FitLikeKinds(
    const ByKind& by_kind, const RateFitOptions& options);

// The odds of any failure of a kind with these rows, by the axes of `like`: those of `like`, raised
// or lowered as its own failures say. `name` is of the stream of its members.
void SetLike(const std::vector<RateRow>& rows, const LikeKinds& like, const std::string& name,
             LinearPredictor& any);

}  // namespace floorproof
