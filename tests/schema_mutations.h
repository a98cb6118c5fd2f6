// SPDX-License-Identifier: Apache-2.0
// What a person may mistype in a file: a tree with one thing in it changed.
#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "base/config.h"

namespace floorproof {

// Calls `look` with the root once for each node below `node` that a change was made to, and undoes
// the change. `where` names it.
using Look = std::function<void(const std::string& where)>;

// A key that nobody knows, in every map.
inline void AddUnknownKeys(ConfigNode& node, const Look& look, const std::string& where = "") {
  if (node.IsMap()) {
    node.Add("no_such_key", ConfigNode::Scalar("1"));
    look(where + ".no_such_key");
    node.Remove("no_such_key");
  }
  for (auto& [key, value] : node.entries) AddUnknownKeys(value, look, where + "." + key);
  for (std::size_t i = 0; i < node.items.size(); ++i)
    AddUnknownKeys(node.items[i], look, where + "[" + std::to_string(i) + "]");
}

// Of every type, in bounds and out of them.
inline std::vector<ConfigNode> OddValues() {
  return {ConfigNode(),
          ConfigNode::Map(),
          ConfigNode::List(),
          ConfigNode::Scalar("odd", true),
          ConfigNode::Scalar("none"),
          ConfigNode::Scalar("true"),
          ConfigNode::Scalar("-1e7"),
          ConfigNode::Scalar("0"),
          ConfigNode::Scalar("0.03"),
          ConfigNode::Scalar("2"),
          ConfigNode::Scalar("10000000000")};
}

// Three odd values in place of each node but the root: the next three at the next node.
class OddInPlace {
 public:
  void Put(ConfigNode& node, const Look& look, const std::string& where = "") {
    for (auto& [key, value] : node.entries) PutFor(value, look, where + "." + key);
    for (std::size_t i = 0; i < node.items.size(); ++i)
      PutFor(node.items[i], look, where + "[" + std::to_string(i) + "]");
  }
  // In place of this one, too.
  void PutFor(ConfigNode& child, const Look& look, const std::string& where) {
    for (int i = 0; i < 3; ++i) {
      const ConfigNode& value = values_[next_++ % values_.size()];
      const ConfigNode kept = std::exchange(child, value);
      look(where + " = " + WriteYamlLine(value));
      child = kept;
    }
    Put(child, look, where);
  }

 private:
  const std::vector<ConfigNode> values_ = OddValues();
  std::size_t next_ = 0;
};

// Every key is left out once.
inline void LeaveOut(ConfigNode& node, const Look& look, const std::string& where = "") {
  for (std::size_t i = 0; i < node.entries.size(); ++i) {
    const auto kept = node.entries[i];
    node.entries.erase(node.entries.begin() + static_cast<std::ptrdiff_t>(i));
    look("without " + where + "." + kept.first);
    node.entries.insert(node.entries.begin() + static_cast<std::ptrdiff_t>(i), kept);
    LeaveOut(node.entries[i].second, look, where + "." + kept.first);
  }
  for (std::size_t i = 0; i < node.items.size(); ++i)
    LeaveOut(node.items[i], look, where + "[" + std::to_string(i) + "]");
}

}  // namespace floorproof
