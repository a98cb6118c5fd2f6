// SPDX-License-Identifier: Apache-2.0
// What a key of a scenario or a site is called among people, and the unit of its values.
#pragma once

#include <string>
#include <string_view>

namespace floorproof {

struct KeyName {
  std::string name{};  // "step height"
  std::string unit{};  // "m", "m/s", "°"; empty: none
};

// By the last parts of its path, and the suffix of the unit: site.generate.sizes.step.height_m is
// the "step height" in m, faults.0.onset_s the "fault 0 onset" in s.
KeyName NameOfKey(std::string_view path);

// Numbers of such a key. Metres below one are in mm: a length of 0.0159 is 15.9 mm.
struct KeyScale {
  double per = 1;      // the value times this is shown ...
  std::string unit{};  // ... in this unit; empty: none

  // "15.9 mm", of a number that is shown.
  std::string Of(const std::string& shown) const {
    return unit.empty() ? shown : shown + (unit == "°" ? "" : " ") + unit;
  }
};
// For values up to `most`, of whatever sign.
KeyScale ScaleOf(const KeyName& key, double most);

}  // namespace floorproof
