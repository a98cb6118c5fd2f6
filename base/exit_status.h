// SPDX-License-Identifier: Apache-2.0
// How every command ends; of an interruption kInterruptedExit (base/interrupt.h).
#pragma once

namespace floorproof {

inline constexpr int kExitDone = 0, kExitNotSuccess = 1, kExitBadInput = 2, kExitBroken = 3,
                     kExitUndecided = 4;

}  // namespace floorproof
