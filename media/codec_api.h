// SPDX-License-Identifier: Apache-2.0
// What crosses the border between the program and the codec module (media/module_call.h).
#pragma once

#include <cstddef>
#include <cstdint>

namespace floorproof {

struct CodecApi {
  static constexpr int kVersion = 3;
  int version;

  // Decodes a whole BMP file. Rows from the top, 8 bits each of grey | R G B | R G B A; `handle`
  // owns the pixels until release_bmp(handle).
  int (*decode_bmp)(const std::uint8_t* file, std::size_t size, int* width, int* height,
                    int* channels, const std::uint8_t** pixels, void** handle, char* error);
  void (*release_bmp)(void* handle);

  // `path` is absolute and ends in .mp4; width and height are even.
  int (*open_video)(const char* path, int width, int height, double fps, void** video, char* error);
  int (*add_frame)(void* video, const std::uint8_t* rgb, char* error);
  int (*finish_video)(void* video, char* error);  // writes what is left and the index
  void (*free_video)(void* video);
};

}  // namespace floorproof

// The module's one symbol.
extern "C" const floorproof::CodecApi* FloorproofCodecs();
inline constexpr const char* kCodecSymbol = "FloorproofCodecs";
inline constexpr const char* kCodecModule = "libfp_codecs.so";
