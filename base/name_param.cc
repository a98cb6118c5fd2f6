// SPDX-License-Identifier: Apache-2.0
#include "base/name_param.h"

#include "base/json_schema.h"
#include "base/params.h"

namespace floorproof {

std::string AsName(const ConfigNode& node, const std::string& key) {
  const std::string name = AsString(node, key);
  if (name.size() > kMaxNameBytes)
    throw InputError(node.mark, key, name,
                     "must be at most " + std::to_string(kMaxNameBytes) + " bytes");
  return name;
}

ConfigNode NameSchema() {
  ConfigNode schema = TextSchema();
  schema.Add("maxLength", ConfigNode::Scalar(std::to_string(kMaxNameBytes)));
  return schema;
}

}  // namespace floorproof
