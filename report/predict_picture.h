// SPDX-License-Identifier: Apache-2.0
// Which meeting of a plan costs how much, over the map.
#pragma once

#include <filesystem>

#include "run/plan_check/prediction.h"

namespace floorproof {

struct World;

// The likeliest places to fail are numbered and listed; the floor around each meeting is coloured
// by the probability that the drive ends there.
void WritePredictPicture(const World& world, const Prediction& prediction,
                         const std::filesystem::path& png);

}  // namespace floorproof
