// SPDX-License-Identifier: Apache-2.0
// PNG by libpng, in memory.
#pragma once

#include <string>
#include <string_view>

#include "media/media.h"

namespace floorproof {

// A whole file of any colour type and depth: palettes and see-through levels expanded, 16 bits
// rounded to 8, no colour management. At most 1,000,000 pixels a side, which is libpng's limit.
// Allocates what its header asks for, so that is to be checked before (media/image_header.h).
// Throws FormatError.
Image DecodePng(std::string_view file);

// 8-bit grey, RGB or RGBA of at least one pixel, packed for speed rather than size. Throws
// InternalError.
std::string EncodePng(const Image& image);

}  // namespace floorproof
