// SPDX-License-Identifier: Apache-2.0
// Many small grey images on one sheet, each with its caption and marks.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "env/geometry/geometry.h"
#include "env/geometry/grid.h"
#include "media/media.h"

namespace floorproof {

struct SheetImage {
  Grid<std::uint8_t> grey;   // 8 bit, rows from the lowest; not empty
  std::vector<Vec2> ringed;  // in its pixels, from its lower left corner
  std::string caption;
};

// In rows of six, each image shrunk or grown to a square.
Image DrawContactSheet(const std::string& title, const std::vector<SheetImage>& images);

}  // namespace floorproof
