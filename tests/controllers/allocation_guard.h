// SPDX-License-Identifier: Apache-2.0
// Counts heap allocations, for tests of loops that must not allocate.
#pragma once

#include <cstdint>

namespace floorproof {

// Calls of operator new in this program so far.
std::int64_t AllocationCount();

}  // namespace floorproof
