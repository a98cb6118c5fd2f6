// SPDX-License-Identifier: Apache-2.0
// A plug-in as scenarios write it: NAME, or a map with its name and its parameters.
#pragma once

#include <string>
#include <string_view>

#include "base/config.h"
#include "base/params.h"

namespace floorproof {

struct NamedPlugin {
  std::string name;
  ConfigNode params;  // a map, its name among them
  SourceMark mark;    // of the name
};

// What is written under `key` of `root`; `name_key` is that of the name in the map, `path` stands
// before the key in messages. Nothing, or null, is the plug-in `default_name` without parameters.
// Throws InputError.
inline NamedPlugin ReadNamed(const ConfigNode& root, const std::string& key, const char* name_key,
                             std::string_view default_name, const std::string& path = "") {
  const ConfigNode* node = root.Find(key);
  if (node == nullptr || node->IsNull() || node->IsScalar()) {
    NamedPlugin named{std::string(default_name), ConfigNode::Map(), node ? node->mark : root.mark};
    if (node != nullptr && node->IsScalar()) named.name = node->scalar;
    named.params.mark = named.mark;
    return named;
  }
  if (!node->IsMap()) throw InputError(node->mark, path + key, "", "must be a name or a map");
  const ConfigNode* name = node->Find(name_key);
  return {name ? AsString(*name, path + key + "." + name_key) : std::string(default_name), *node,
          name ? name->mark : node->mark};
}

}  // namespace floorproof
