// SPDX-License-Identifier: Apache-2.0
// A plug-in as scenarios write it: NAME, or a map with its name and its parameters.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "base/config.h"
#include "base/json_schema.h"

namespace floorproof {

struct NamedPlugin {
  std::string name;
  ConfigNode params;  // a map, its name among them
  SourceMark mark;    // of the name
};

// What is written under `key` of `root`; `name_key` is that of the name in the map, `path` stands
// before the key in messages. Nothing, or null, is the plug-in `default_name` without parameters.
// Throws InputError.
NamedPlugin ReadNamed(const ConfigNode& root, const std::string& key, const char* name_key,
                      std::string_view default_name, const std::string& path = "");
// `unnamed`: what a map without a name means.
ConfigNode NamedPluginSchema(const std::string& name_key, const std::string& help,
                             const std::vector<NamedSchema>& plugins, Unnamed unnamed);

}  // namespace floorproof
