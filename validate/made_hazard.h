// SPDX-License-Identifier: Apache-2.0
// A hazard as a site file would state it, made by its own plug-in.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "env/core/hazard_map.h"

namespace floorproof {

// `keys` as YAML: "height_m: 0.01, width_m: 0.1". It is not known: to
// detectors, which forgive going down what is known.
Hazard MakeHazard(std::string_view type, const std::string& keys, const std::vector<Vec2>& place);

}  // namespace floorproof
