// SPDX-License-Identifier: Apache-2.0
// What crosses the border between the program and the thinning module: plain C types, no
// exceptions.
#pragma once

#include <cstdint>

namespace floorproof {

// Thins width x height pixels in place, 0 or 255 each; nullptr when done, else why not.
using ThinFunction = const char*(std::uint8_t* pixels, int width, int height);
inline constexpr const char* kThinningSymbol = "FloorproofThin";
inline constexpr const char* kThinningModule = "libfp_thinning.so";

}  // namespace floorproof
