// SPDX-License-Identifier: Apache-2.0
// Image and video files. What films and BMP need (FFmpeg and OpenCV's codecs, with some 200 shared
// libraries behind them) lives in a module of its own that is loaded at first use, as letters do
// (media/lettering.h), so that the program itself starts in milliseconds.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <vector>

#include "base/input_files.h"

namespace floorproof {

// Rows from the top, channels interleaved (1: grey, 2: grey + alpha, 3: RGB, 4: RGBA), 8 bits each.
struct Image {
  int width = 0, height = 0, channels = 0;
  std::vector<std::uint8_t> data;
  bool sixteen_bit = false;  // the file had 16 bits a channel, scaled down
};

// In RGB, one grey all over.
inline Image GreyImage(int width, int height, std::uint8_t grey) {
  const std::size_t pixels = static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
  return {width, height, 3, std::vector<std::uint8_t>(3 * pixels, grey), false};
}

inline constexpr std::uintmax_t kMaxImageBytes = 256u << 20;

// Decodes PNG (every colour type), PGM/PPM (P2, P3, P5, P6) or BMP as stored, with palettes
// expanded. Throws InputError naming the file when it is missing, not an image, truncated or larger
// than kMaxImageBytes, or when the image is larger than max_pixels. That is checked from the
// header, before anything is allocated.
Image ReadImage(const std::filesystem::path& path, std::int64_t max_pixels = 64'000'000,
                const InputFiles& files = {});
// Writes PNG; throws as WriteFileWhole does, and InternalError for what is no image.
void WritePng(const std::filesystem::path& path, const Image& image);

// H.264 in MP4 (High profile, yuv420p) that browsers play.
class VideoWriter {
 public:
  virtual ~VideoWriter() = default;
  virtual void Add(const Image& rgb) = 0;  // width x height x 3
  virtual void Close() = 0;                // throws InputError when the file is not whole
};
// Even width and height. Throws InputError when the file or the encoder cannot be opened.
std::unique_ptr<VideoWriter> OpenVideo(const std::filesystem::path& path, int width, int height,
                                       double fps);

}  // namespace floorproof
