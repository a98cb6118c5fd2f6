// SPDX-License-Identifier: Apache-2.0
// The effect E1..E5 that a failure has on the mission.
#pragma once

#include <string_view>

#include "env/core/event.h"

namespace floorproof {

std::string_view EffectOf(FailureMode mode, std::string_view kind);

}  // namespace floorproof
