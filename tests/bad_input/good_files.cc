// SPDX-License-Identifier: Apache-2.0
#include <array>
#include <cstdint>
#include <stdexcept>

#include "tests/bad_input/bad_input.h"

namespace floorproof {
namespace {

constexpr int kWidth = 8, kHeight = 6;

char Shade(int x, int y) {
  return x == 0 || y == 0 || x == kWidth - 1 || y == kHeight - 1 ? '\0' : '\xfe';
}

std::string Number(std::uint32_t value, int bytes, bool big_endian) {
  std::string out;
  for (int i = 0; i < bytes; ++i)
    out += static_cast<char>(value >> 8 * (big_endian ? bytes - 1 - i : i));
  return out;
}

std::uint32_t Crc(const std::string& bytes) {
  std::uint32_t crc = ~0U;
  for (const char c : bytes) {
    crc ^= static_cast<unsigned char>(c);
    for (int k = 0; k < 8; ++k) crc = (crc >> 1) ^ (crc & 1 ? 0xEDB88320U : 0);
  }
  return ~crc;
}

std::string Chunk(const std::string& type, const std::string& data) {
  return Number(static_cast<std::uint32_t>(data.size()), 4, true) + type + data +
         Number(Crc(type + data), 4, true);
}

// A zlib stream of one stored block.
std::string Stored(const std::string& bytes) {
  std::uint32_t a = 1, b = 0;
  for (const char c : bytes) {
    a = (a + static_cast<unsigned char>(c)) % 65521;
    b = (b + a) % 65521;
  }
  const auto size = static_cast<std::uint32_t>(bytes.size());
  return "\x78\x01\x01" + Number(size, 2, false) + Number(~size & 0xffff, 2, false) + bytes +
         Number(b << 16 | a, 4, true);
}

}  // namespace

std::string PngOfSize(int width, int height) {
  std::string rows;
  for (int y = 0; y < kHeight; ++y) {
    rows += '\0';  // the row's filter: none
    for (int x = 0; x < kWidth; ++x) rows += Shade(x, y);
  }
  const std::string header = Number(static_cast<std::uint32_t>(width), 4, true) +
                             Number(static_cast<std::uint32_t>(height), 4, true) +
                             std::string("\x08\0\0\0\0", 5);  // 8 bits, grey
  return "\x89PNG\r\n\x1a\n" + Chunk("IHDR", header) + Chunk("IDAT", Stored(rows)) +
         Chunk("IEND", "");
}

std::string GoodPng() { return PngOfSize(kWidth, kHeight); }

std::string GoodBmp() {
  std::string pixels;  // 24 bits; rows of 24 bytes need no padding
  for (int y = 0; y < kHeight; ++y)
    for (int x = 0; x < kWidth; ++x) pixels += std::string(3, Shade(x, y));
  const auto size = static_cast<std::uint32_t>(pixels.size());
  return "BM" + Number(54 + size, 4, false) + Number(0, 4, false) + Number(54, 4, false) +
         Number(40, 4, false) + Number(kWidth, 4, false) + Number(kHeight, 4, false) +
         Number(1, 2, false) + Number(24, 2, false) + Number(0, 4, false) + Number(size, 4, false) +
         std::string(16, '\0') + pixels;
}

std::string GoodPgm() {
  std::string out = "P5\n# drawn\n8 6\n255\n";
  for (int y = 0; y < kHeight; ++y)
    for (int x = 0; x < kWidth; ++x) out += Shade(x, y);
  return out;
}

const Files& GoodFiles() {
  static const Files files = {
      {"scenario.yaml", R"(scenario: 1
site: site.yaml
robot: beluga
start: {x_m: 1.0, y_m: 1.0, yaw_deg: 0}
plan: {file: plan.csv}
controller: {name: regulated_pursuit}
estimator: truth
failures: {stuck: {}}
success: {min_coverage: 0.1}
time_limit_s: 100
seed: 3
video: {camera: top}
)"},
      {"site.yaml", R"(site: 1
name: small room
map: map.yaml
unknown: wall
floor: {friction: 0.8}
hazards:
  - {type: glass, id: door, line_m: [[2.0, 1.0], [2.0, 2.0]], height_m: 2.0}
  - {type: step, id: sill, polygon_m: [[3.0, 0.5], [3.2, 0.5], [3.2, 2.5]], height_m: 0.01}
)"},
      {"map.yaml", R"(image: map.pgm
resolution: 0.5
origin: [0.0, 0.0, 0.0]
negate: 0
occupied_thresh: 0.65
free_thresh: 0.196
)"},
      {"map.pgm", GoodPgm()},
      {"map.png", GoodPng()},
      {"map.bmp", GoodBmp()},
      {"plan.csv", "x_m,y_m,speed_mps\n1.0,1.0,\n1.5,1.0,0.2\n"},
      {"drawn.yaml", R"(scenario: 1
site:
  site: 1
  grid:
    cell_m: 0.5
    rows: |
      ######
      #....#
      #....#
      ######
    sizes: {groove: {width_m: 0.02}}
  start: {x_m: 1.0, y_m: 1.0, yaw_deg: 0}
robot: {name: beluga}
plan: {planner: boustrophedon}
)"},
  };
  return files;
}

BadInput Trusted(BadInput c) {
  c.arguments.emplace_back("--trust");
  return c;
}

std::string Replaced(const std::string& text, const std::string& from, const std::string& to) {
  const std::size_t at = text.find(from);
  if (at == std::string::npos) throw std::logic_error("'" + from + "' is not in: " + text);
  return text.substr(0, at) + to + text.substr(at + from.size());
}

}  // namespace floorproof
