// SPDX-License-Identifier: Apache-2.0
// Random streams: hashed from (campaign seed, episode id, stream name), never added, so that
// neighbouring seeds or episodes share nothing.
#pragma once

#include <cstdint>
#include <string_view>

namespace floorproof {

// A small counter-free generator (xoshiro256**), the same bits on every machine.
class Stream {
 public:
  Stream(std::uint64_t campaign_seed, std::uint64_t episode, std::string_view name);
  std::uint64_t Next();
  double Uniform();                         // [0, 1)
  double Uniform(double low, double high);  // [low, high)
  double Normal();                          // mean 0, standard deviation 1
  std::uint64_t Below(std::uint64_t n);     // 0 .. n - 1, unbiased

 private:
  std::uint64_t s_[4];
  double spare_ = 0;
  bool has_spare_ = false;
};

}  // namespace floorproof
