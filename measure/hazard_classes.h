// SPDX-License-Identifier: Apache-2.0
// The FMEA class of each type of hazard.
#pragma once

#include <map>
#include <string>

#include "env/core/hazard_map.h"

namespace floorproof {

// Of each type of hazard, its class; it does not hang on the hazard's place or size.
std::map<std::string, HazardClass> ClassOfType();

}  // namespace floorproof
