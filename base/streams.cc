// SPDX-License-Identifier: Apache-2.0
// Seeds by SplitMix64 over an FNV-1a hash; draws by xoshiro256** (Blackman & Vigna 2018). Our own
// few lines because the standard library's distributions differ between implementations.
#include "base/streams.h"

#include <cmath>

namespace floorproof {
namespace {

std::uint64_t Mix(std::uint64_t z) {
  z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9ULL;
  z = (z ^ (z >> 27)) * 0x94d049bb133111ebULL;
  return z ^ (z >> 31);
}

std::uint64_t RotateLeft(std::uint64_t x, int k) { return (x << k) | (x >> (64 - k)); }

}  // namespace

Stream::Stream(std::uint64_t campaign_seed, std::uint64_t episode, std::string_view name) {
  std::uint64_t hash = 0xcbf29ce484222325ULL;
  const auto add_byte = [&hash](unsigned char byte) { hash = (hash ^ byte) * 0x100000001b3ULL; };
  for (int i = 0; i < 8; ++i) add_byte(static_cast<unsigned char>(campaign_seed >> (8 * i)));
  for (int i = 0; i < 8; ++i) add_byte(static_cast<unsigned char>(episode >> (8 * i)));
  for (const char c : name) add_byte(static_cast<unsigned char>(c));
  for (auto& s : s_) s = Mix(hash += 0x9e3779b97f4a7c15ULL);
}

std::uint64_t Stream::Next() {
  const std::uint64_t result = RotateLeft(s_[1] * 5, 7) * 9;
  const std::uint64_t t = s_[1] << 17;
  s_[2] ^= s_[0];
  s_[3] ^= s_[1];
  s_[1] ^= s_[2];
  s_[0] ^= s_[3];
  s_[2] ^= t;
  s_[3] = RotateLeft(s_[3], 45);
  return result;
}

double Stream::Uniform() { return static_cast<double>(Next() >> 11) * 0x1.0p-53; }

double Stream::Uniform(double low, double high) { return low + (high - low) * Uniform(); }

double Stream::Normal() {
  if (has_spare_) {
    has_spare_ = false;
    return spare_;
  }
  // Marsaglia's polar method: no trigonometry, two draws at a time.
  double u, v, s;
  do {
    u = Uniform(-1, 1);
    v = Uniform(-1, 1);
    s = u * u + v * v;
  } while (s >= 1 || s == 0);
  const double factor = std::sqrt(-2 * std::log(s) / s);
  spare_ = v * factor;
  has_spare_ = true;
  return u * factor;
}

std::uint64_t Stream::Below(std::uint64_t n) {
  const std::uint64_t reject_below = (0 - n) % n;  // 2^64 mod n
  for (;;)
    if (const std::uint64_t x = Next(); x >= reject_below) return x % n;
}

}  // namespace floorproof
