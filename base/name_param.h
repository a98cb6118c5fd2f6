// SPDX-License-Identifier: Apache-2.0
// Names of sites and scenarios. They are printed, and become parts of files' names and of messages.
#pragma once

#include <cstddef>
#include <string>

#include "base/config.h"

namespace floorproof {

inline constexpr std::size_t kMaxNameBytes = 200;

// Throws InputError unless the text has at most kMaxNameBytes bytes.
std::string AsName(const ConfigNode& node, const std::string& key);
ConfigNode NameSchema();

}  // namespace floorproof
