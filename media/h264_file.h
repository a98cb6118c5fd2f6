// SPDX-License-Identifier: Apache-2.0
// One H.264 film in MP4, by FFmpeg's libraries and x264; part of the codec module.
#pragma once

#include <cstdint>
#include <memory>

namespace floorproof {

// Every function throws std::runtime_error with the library's reason.
class H264File {
 public:
  H264File(const char* path, int width, int height, double fps);
  ~H264File();
  H264File(const H264File&) = delete;
  H264File& operator=(const H264File&) = delete;
  void Add(const std::uint8_t* rgb);  // width x height x 3, rows from the top
  void Finish();                      // once, after the last frame

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

void SilenceVideoLibrary();

}  // namespace floorproof
