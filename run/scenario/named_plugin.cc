// SPDX-License-Identifier: Apache-2.0
#include "run/scenario/named_plugin.h"

#include "base/error.h"
#include "base/params.h"

namespace floorproof {

NamedPlugin ReadNamed(const ConfigNode& root, const std::string& key, const char* name_key,
                      std::string_view default_name, const std::string& path) {
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

ConfigNode NamedPluginSchema(const std::string& name_key, const std::string& help,
                             const std::vector<NamedSchema>& plugins, Unnamed unnamed) {
  return OrNull(AnyOf({NamesSchema(plugins), NamedMapSchema(name_key, help, plugins, unnamed)}));
}

}  // namespace floorproof
