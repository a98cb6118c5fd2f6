// SPDX-License-Identifier: Apache-2.0
// Ints that number places and cells, as indices of vectors.
#pragma once

#include <cstddef>

namespace floorproof {

// Never negative.
inline std::size_t Z(int i) { return static_cast<std::size_t>(i); }

}  // namespace floorproof
