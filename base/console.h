// SPDX-License-Identifier: Apache-2.0
// Lines for people.
#pragma once

#include <string>

namespace floorproof {

struct Console {
  bool json = false;   // stdout is the result's: lines go to stderr
  bool quiet = false;  // nothing is said

  void Say(const std::string& line) const;
};

}  // namespace floorproof
