// SPDX-License-Identifier: Apache-2.0
// Writes PNG files of any colour type and depth, right or wrong on purpose, without a codec: stored
// (uncompressed) deflate blocks, filter 0.
#pragma once

#include <algorithm>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace floorproof {

struct PngSpec {
  unsigned width = 1, height = 1;
  int bit_depth = 8;
  int color_type = 0;  // 0 grey, 2 RGB, 3 palette, 4 grey + alpha, 6 RGBA
  std::vector<unsigned> samples =
      {};                         // channels interleaved, row by row from the top; empty: no pixels
  std::string palette = {};       // PLTE
  std::string transparency = {};  // tRNS
  unsigned drop_rows = 0;         // so many rows are left out of the compressed data
  bool adam7 = false;             // interlaced, in seven passes
  std::string other = {};         // chunks between the header and the palette
};

inline std::string PngBigEndian(std::uint32_t v) {
  return {static_cast<char>(v >> 24), static_cast<char>(v >> 16), static_cast<char>(v >> 8),
          static_cast<char>(v)};
}

inline std::string PngChecksum(const std::string& type_and_data) {
  std::uint32_t crc = 0xffffffffU;
  for (const char c : type_and_data) {
    crc ^= static_cast<unsigned char>(c);
    for (int k = 0; k < 8; ++k) crc = crc & 1 ? 0xedb88320U ^ (crc >> 1) : crc >> 1;
  }
  return PngBigEndian(crc ^ 0xffffffffU);
}

inline std::string PngChunk(const std::string& type, const std::string& data) {
  return PngBigEndian(static_cast<std::uint32_t>(data.size())) + type + data +
         PngChecksum(type + data);
}

// A PNG that was changed: each chunk's checksum is that of what it holds now. Other files stay.
inline std::string WithRightChecksums(std::string png) {
  if (!png.starts_with("\x89PNG\r\n\x1a\n")) return png;
  for (std::size_t at = 8; at + 12 <= png.size();) {
    std::size_t length = 0;
    for (int k = 0; k < 4; ++k) length = length << 8 | static_cast<unsigned char>(png[at + k]);
    if (length > png.size() - at - 12) break;
    png.replace(at + 8 + length, 4, PngChecksum(png.substr(at + 4, length + 4)));
    at += length + 12;
  }
  return png;
}

inline std::string PngStored(const std::string& raw) {
  std::string zlib = "\x78\x01";
  for (std::size_t at = 0; at < raw.size() || at == 0;) {
    const std::size_t n = std::min<std::size_t>(raw.size() - at, 65535);
    const bool last = at + n == raw.size();
    zlib += static_cast<char>(last ? 1 : 0);
    for (const std::size_t v : {n, ~n}) {
      zlib += static_cast<char>(v & 0xff);
      zlib += static_cast<char>(v >> 8 & 0xff);
    }
    zlib += raw.substr(at, n);
    at += n;
    if (last) break;
  }
  std::uint32_t a = 1, b = 0;  // Adler-32
  for (const char c : raw) {
    a = (a + static_cast<unsigned char>(c)) % 65521;
    b = (b + a) % 65521;
  }
  return zlib + PngBigEndian(b << 16 | a);
}

inline std::string MakePng(const PngSpec& spec) {
  const unsigned channels[] = {1, 0, 3, 1, 2, 0, 4};
  const std::size_t per_pixel = channels[spec.color_type];
  const std::size_t per_row = static_cast<std::size_t>(spec.width) * per_pixel;
  struct Pass {
    unsigned x, y, dx, dy;  // first pixel, and how far it is to the next
  };
  const std::vector<Pass> passes =
      spec.adam7 ? std::vector<Pass>{{0, 0, 8, 8}, {4, 0, 8, 8}, {0, 4, 4, 8}, {2, 0, 4, 4},
                                     {0, 2, 2, 4}, {1, 0, 2, 2}, {0, 1, 1, 2}}
                 : std::vector<Pass>{{0, 0, 1, 1}};
  std::string raw;
  for (const Pass& pass : passes) {
    if (spec.samples.empty() || pass.x >= spec.width) continue;
    for (unsigned y = pass.y; y + spec.drop_rows < spec.height; y += pass.dy) {
      raw += '\0';
      unsigned bits = 0, held = 0;
      for (unsigned x = pass.x; x < spec.width; x += pass.dx)
        for (std::size_t k = 0; k < per_pixel; ++k) {
          held = held << spec.bit_depth | spec.samples[y * per_row + x * per_pixel + k];
          for (bits += static_cast<unsigned>(spec.bit_depth); bits >= 8; bits -= 8)
            raw += static_cast<char>(held >> (bits - 8) & 0xff);
        }
      if (bits > 0) raw += static_cast<char>(held << (8 - bits) & 0xff);
    }
  }
  std::string header = PngBigEndian(spec.width) + PngBigEndian(spec.height);
  header += static_cast<char>(spec.bit_depth);
  header += static_cast<char>(spec.color_type);
  header += std::string(2, '\0');
  header += static_cast<char>(spec.adam7 ? 1 : 0);
  std::string png = "\x89PNG\r\n\x1a\n" + PngChunk("IHDR", header) + spec.other;
  if (!spec.palette.empty()) png += PngChunk("PLTE", spec.palette);
  if (!spec.transparency.empty()) png += PngChunk("tRNS", spec.transparency);
  return png + PngChunk("IDAT", PngStored(raw)) + PngChunk("IEND", "");
}

}  // namespace floorproof
