// SPDX-License-Identifier: Apache-2.0
// Letters of any script; part of the module of letters.
#pragma once

#include <memory>
#include <opencv2/core.hpp>
#include <string>

namespace floorproof {

// Text that is shaped and drawn: how much of each pixel it covers.
struct DrawnLetters {
  cv::Mat coverage;  // 8 bits, one channel, continuous
  int base = 0;      // row of the base line
  double advance_px = 0;
};

// One line of UTF-8 in one direction of writing, at this height of a capital letter, in an
// installed font that has all of its letters; nullptr: there is none. Throws cv::Exception,
// std::runtime_error.
std::unique_ptr<DrawnLetters> DrawLetters(const std::string& utf8, double cap_px, bool bold);

}  // namespace floorproof
