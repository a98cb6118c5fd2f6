// SPDX-License-Identifier: Apache-2.0
// What crosses the border between the program and the codec module: plain C types, no exceptions.
// Every function that returns int gives 0 when done; else it fills `error` (of kCodecErrorSize
// bytes) with a line.
#pragma once

#include <cstddef>
#include <cstdint>

namespace floorproof {

inline constexpr std::size_t kCodecErrorSize = 256;
inline constexpr int kCodecApiVersion = 2;

// Rows from the top, channels interleaved in the order grey | R G B | R G B A.
struct CodecImage {
  int width, height, channels;
  int depth_bits;  // 8, or 16 (machine byte order)
  const void* data;
};

// Letters as the share of each pixel that they cover: 8 bits, one channel.
struct CodecText {
  CodecImage coverage;
  int base;  // row of the base line
  double advance_px;
};

struct CodecApi {
  int version;
  // Decodes a whole PNG or BMP file; `handle` owns the pixels until release(handle).
  int (*decode)(const std::uint8_t* file, std::size_t size, CodecImage* image, void** handle,
                char* error);
  // Encodes 8-bit grey, RGB or RGBA as PNG; `handle` owns the bytes.
  int (*encode_png)(const CodecImage* image, const std::uint8_t** file, std::size_t* size,
                    void** handle, char* error);
  void (*release)(void* handle);

  // Draws one line of UTF-8; `handle` owns the pixels until release_text(handle), and is nullptr
  // where no installed font has all letters.
  int (*draw_text)(const char* utf8, double cap_px, int bold, CodecText* text, void** handle,
                   char* error);
  void (*release_text)(void* handle);

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
