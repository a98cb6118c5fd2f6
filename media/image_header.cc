// SPDX-License-Identifier: Apache-2.0
// PNG: ISO/IEC 15948 (chunks, CRC-32 of annex D). BMP: the Windows headers of 12 and 40+ bytes.
#include "media/image_header.h"

#include <zlib.h>

#include <algorithm>
#include <string>

namespace floorproof {
namespace {

constexpr std::int64_t kMaxPngSide = 1'000'000;  // as libpng's
constexpr std::string_view kPngSignature = "\x89PNG\r\n\x1a\n";

std::uint32_t Byte(std::string_view s, std::size_t at) { return static_cast<unsigned char>(s[at]); }
std::uint32_t BigEndian32(std::string_view s, std::size_t at) {
  return Byte(s, at) << 24 | Byte(s, at + 1) << 16 | Byte(s, at + 2) << 8 | Byte(s, at + 3);
}
std::uint32_t LittleEndian16(std::string_view s, std::size_t at) {
  return Byte(s, at) | Byte(s, at + 1) << 8;
}
std::uint32_t LittleEndian32(std::string_view s, std::size_t at) {
  return LittleEndian16(s, at) | LittleEndian16(s, at + 2) << 16;
}

std::uint32_t Crc32(std::string_view bytes) {
  return static_cast<std::uint32_t>(
      crc32_z(0, reinterpret_cast<const Bytef*>(bytes.data()), bytes.size()));
}

int Channels(int png_color_type) {
  switch (png_color_type) {
    case 0:
    case 3:
      return 1;
    case 4:
      return 2;
    case 2:
      return 3;
    case 6:
      return 4;
    default:
      return 0;
  }
}

void CheckInflatedSize(const PngHeader& header, std::uint64_t compressed) {
  // Deflate packs at most 1032 bytes into one, so that this many pixels need this much data.
  const auto bits = static_cast<std::uint64_t>(header.width) *
                    static_cast<std::uint64_t>(header.bit_depth * Channels(header.color_type));
  const std::uint64_t needed = (bits + 7) / 8 * static_cast<std::uint64_t>(header.height);
  if (needed / 1032 > compressed)
    throw FormatError("claims " + std::to_string(header.width) + " x " +
                      std::to_string(header.height) + " pixels but holds only " +
                      std::to_string(compressed) + " bytes of compressed data");
}

}  // namespace

void CheckSize(const ImageHeader& header, std::int64_t max_pixels) {
  const std::string size =
      std::to_string(header.width) + " x " + std::to_string(header.height) + " pixels";
  if (header.width < 1 || header.height < 1)
    throw FormatError("claims " + size + ": must have at least 1 x 1");
  if (header.width > max_pixels / header.height)
    throw FormatError("claims " + size + ": at most " + std::to_string(max_pixels) +
                      " pixels are read");
}

bool IsPng(std::string_view file) { return file.starts_with(kPngSignature); }

PngHeader ReadPngHeader(std::string_view start) {
  // Signature, then the chunk IHDR: length 13, type, data, CRC.
  if (start.size() < 33) throw FormatError("PNG is truncated within its header");
  if (BigEndian32(start, 8) != 13 || start.substr(12, 4) != "IHDR")
    throw FormatError("PNG does not begin with an IHDR chunk");
  if (Crc32(start.substr(12, 17)) != BigEndian32(start, 29))
    throw FormatError("PNG is damaged: wrong checksum of chunk IHDR");
  PngHeader header;
  header.width = BigEndian32(start, 16);
  header.height = BigEndian32(start, 20);
  header.bit_depth = static_cast<int>(Byte(start, 24));
  header.color_type = static_cast<int>(Byte(start, 25));
  const int d = header.bit_depth, c = header.color_type;
  const bool known = Channels(c) != 0;
  const bool depth_ok =
      d == 8 || (d == 16 && c != 3) || ((d == 1 || d == 2 || d == 4) && (c == 0 || c == 3));
  if (!known || !depth_ok)
    throw FormatError("PNG of colour type " + std::to_string(c) + " with " + std::to_string(d) +
                      " bits a channel does not exist");
  return header;
}

void CheckPng(std::string_view file) {
  const PngHeader header = ReadPngHeader(file);
  if (std::max(header.width, header.height) > kMaxPngSide)
    throw FormatError("claims " + std::to_string(header.width) + " x " +
                      std::to_string(header.height) + " pixels: of a PNG at most " +
                      std::to_string(kMaxPngSide) + " a side are read");
  std::uint64_t compressed = 0;
  for (std::size_t at = kPngSignature.size();;) {
    if (file.size() - at < 12) throw FormatError("PNG is truncated: it ends before its IEND chunk");
    const std::uint64_t length = BigEndian32(file, at);
    const std::string_view type = file.substr(at + 4, 4);
    if (file.size() - at - 12 < length)
      throw FormatError("PNG is truncated within a chunk of " + std::to_string(length) + " bytes");
    const std::string_view body = file.substr(at + 4, length + 4);
    if (Crc32(body) != BigEndian32(file, at + 8 + length))
      throw FormatError("PNG is damaged: wrong checksum of a chunk at byte " + std::to_string(at));
    if (type == "IDAT") compressed += length;
    if (type == "IEND") break;
    at += length + 12;
  }
  CheckInflatedSize(header, compressed);
}

bool IsBmp(std::string_view file) { return file.starts_with("BM"); }

ImageHeader ReadBmpHeader(std::string_view start, std::uint64_t file_size) {
  if (start.size() < 26) throw FormatError("BMP is truncated within its header");
  const std::uint64_t data_offset = LittleEndian32(start, 10);
  const std::uint32_t header_size = LittleEndian32(start, 14);
  ImageHeader header;
  std::uint32_t bits = 0, compression = 0;
  if (header_size == 12) {
    header.width = LittleEndian16(start, 18);
    header.height = LittleEndian16(start, 20);
    bits = LittleEndian16(start, 24);
  } else {
    if (header_size < 40) throw FormatError("BMP has an unknown kind of header");
    if (start.size() < 54) throw FormatError("BMP is truncated within its header");
    header.width = static_cast<std::int32_t>(LittleEndian32(start, 18));
    header.height = static_cast<std::int32_t>(LittleEndian32(start, 22));
    if (header.height < 0) header.height = -header.height;  // rows from the top
    bits = LittleEndian16(start, 28);
    compression = LittleEndian32(start, 30);
  }
  if (bits != 1 && bits != 4 && bits != 8 && bits != 16 && bits != 24 && bits != 32)
    throw FormatError("BMP of " + std::to_string(bits) + " bits a pixel does not exist");
  if (compression != 0 && compression != 3)
    throw FormatError("compressed BMP is not read; save it uncompressed, or as PNG");
  if (header.width < 1 || header.height < 1) return header;  // CheckSize says it
  const std::uint64_t stride = (static_cast<std::uint64_t>(header.width) * bits + 31) / 32 * 4;
  if (data_offset > file_size ||
      (file_size - data_offset) / stride < static_cast<std::uint64_t>(header.height))
    throw FormatError("BMP is truncated: it claims " + std::to_string(header.width) + " x " +
                      std::to_string(header.height) + " pixels, more than its " +
                      std::to_string(file_size) + " bytes can hold");
  return header;
}

}  // namespace floorproof
