// SPDX-License-Identifier: Apache-2.0
// Lines for people.
#pragma once

#include <functional>
#include <string>

namespace floorproof {

struct Console {
  bool json = false;   // stdout is the result's: lines go to stderr
  bool quiet = false;  // nothing is said
  // Takes each line in place of stdout and stderr, where there is one, quiet or not.
  std::function<void(const std::string&)> listener = {};

  void Say(const std::string& line) const;
};

}  // namespace floorproof
