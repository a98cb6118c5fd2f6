// SPDX-License-Identifier: Apache-2.0
// A key that the command line or a caller sets in a scenario.
#pragma once

#include <string>

namespace floorproof {

struct Override {
  std::string key_path, value;  // --set key.path=value; the value is YAML
};

}  // namespace floorproof
