// SPDX-License-Identifier: Apache-2.0
// Episodes that came out the same to the last bit are one episode, driven again: a thousand of them
// say no more of how often a robot fails than one does.
#pragma once

#include <cstdint>
#include <string>

#include "run/campaign/episode_row.h"

namespace floorproof {

// Told the results (EpisodeRow::ResultHash) of a variant's episodes, errors left out.
class Repetition {
 public:
  void Add(const std::string& result) {
    if (n_++ == 0) first_ = result;
    differ_ |= result != first_;
  }
  std::uint64_t n() const { return n_; }
  // Two or more, and no two differ.
  bool repeated() const { return n_ > 1 && !differ_; }

 private:
  std::uint64_t n_ = 0;
  std::string first_;
  bool differ_ = false;
};

}  // namespace floorproof
