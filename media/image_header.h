// SPDX-License-Identifier: Apache-2.0
// What an image file claims about itself, checked against its size before anything is decoded. A
// file that lies must cost neither memory nor time, and a truncated file must not pass as grey
// rows.
#pragma once

#include <cstdint>
#include <stdexcept>
#include <string_view>

namespace floorproof {

// A file that is not what it claims; the text says why. The caller adds the file's name.
class FormatError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

struct ImageHeader {
  std::int64_t width = 0, height = 0;
};

// Throws FormatError unless both sides are at least 1 and the area is at most max_pixels.
void CheckSize(const ImageHeader& header, std::int64_t max_pixels);

struct PngHeader : ImageHeader {
  int bit_depth = 8;
  int color_type = 0;  // 0 grey, 2 RGB, 3 palette, 4 grey + alpha, 6 RGBA
};
bool IsPng(std::string_view file);
// The IHDR chunk alone; `start` holds the file's first bytes. Throws FormatError.
PngHeader ReadPngHeader(std::string_view start);
// The whole file: every chunk's length and CRC up to IEND, and whether the compressed data can hold
// the pixels claimed at all. Throws FormatError.
void CheckPng(std::string_view file);

bool IsBmp(std::string_view file);
// Checks an uncompressed BMP of any depth against the file's size. Throws FormatError.
ImageHeader ReadBmpHeader(std::string_view start, std::uint64_t file_size);

}  // namespace floorproof
