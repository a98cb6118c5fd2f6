// SPDX-License-Identifier: Apache-2.0
// PGM and PPM, which most ROS maps are: read here, so that they need no codec module.
#pragma once

#include <cstdint>
#include <string_view>

#include "media/image_header.h"
#include "media/media.h"

namespace floorproof {

bool IsNetpbm(std::string_view file);
// Reads the header alone (`start`: the file's first bytes) and checks it against the file's size.
// Throws FormatError.
ImageHeader ReadNetpbmHeader(std::string_view start, std::uint64_t file_size);
// Decodes the whole file; samples are scaled from 0..maxval to 0..255. Throws FormatError.
Image DecodeNetpbm(std::string_view file);

}  // namespace floorproof
