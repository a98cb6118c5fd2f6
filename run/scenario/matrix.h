// SPDX-License-Identifier: Apache-2.0
// `matrix`: the variants of a scenario that a campaign compares on the same draws.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "base/config.h"

namespace floorproof {

struct Variant {
  std::string name;  // key=value,key=value in the file's order; without a matrix `default`
  std::vector<std::pair<std::string, ConfigNode>> overrides;
};

// Reads the scenario's key `matrix`: a map of key path: list of values, or of a name: list of
// {label, key path: value, ..} that change together; `node` may be nullptr. All combinations, the
// last key fastest. Throws InputError.
std::vector<Variant> ReadMatrix(const ConfigNode* node);
ConfigNode MatrixSchema();

}  // namespace floorproof
