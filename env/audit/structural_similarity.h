// SPDX-License-Identifier: Apache-2.0
// How alike two images look.
#pragma once

#include "env/audit/tape_image.h"

namespace floorproof {

// The mean structural similarity of two images of one size, at least 11 x 11 pixels, which the
// caller has checked: 1 of an image and itself, less the less they are alike, never above 1. It is
// symmetric. O(pixels).
double StructuralSimilarity(const TapeImage& a, const TapeImage& b);

}  // namespace floorproof
