// SPDX-License-Identifier: Apache-2.0
// A configuration as a tree of scalars, lists and maps that remembers where each value was written.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "base/error.h"

namespace floorproof {

struct ConfigNode {
  enum class Kind { kNull, kScalar, kList, kMap };
  Kind kind = Kind::kNull;
  std::string scalar;             // the text as written
  bool quoted = false;            // a quoted or block scalar: always a string
  std::vector<ConfigNode> items;  // kList
  std::vector<std::pair<std::string, ConfigNode>> entries;  // kMap, in the order written
  SourceMark mark;

  static ConfigNode Scalar(std::string text, bool quoted = false);
  static ConfigNode List(std::vector<ConfigNode> items = {});
  static ConfigNode Map();

  bool IsNull() const { return kind == Kind::kNull; }
  bool IsScalar() const { return kind == Kind::kScalar; }
  bool IsList() const { return kind == Kind::kList; }
  bool IsMap() const { return kind == Kind::kMap; }
  const ConfigNode* Find(std::string_view key) const;  // nullptr: not there, or no map
  ConfigNode* Find(std::string_view key);
  ConfigNode& Add(std::string key, ConfigNode value);  // replaces an entry of that key
  void Remove(std::string_view key);
  // Sets key.path (dots between keys) making maps on the way, for `--set key.path=value`. In a list
  // a key is the `id` of an entry or its index; the entry must be there.
  void SetPath(std::string_view key_path, ConfigNode value);
};

// Reads YAML 1.2 text. Throws InputError naming file and line on bad syntax, duplicate keys, more
// than 400,000 nodes (aliases are expanded; what bad input may cost in time and memory), nesting
// beyond 100, or tags.
ConfigNode ParseYaml(const std::string& text, const std::string& file);
// As ParseYaml, from a file of at most 3 MiB; refuses what is missing, a folder, a pipe or device,
// or not UTF-8 text.
ConfigNode ReadYamlFile(const std::filesystem::path& path);
// Block style, short lists of scalars in one line; ParseYaml(WriteYaml(n)) gives n's values again.
std::string WriteYaml(const ConfigNode& node);
// The same in one line.
std::string WriteYamlLine(const ConfigNode& node);
// Any text as a quoted scalar in one line, to stand in YAML that is put together.
std::string QuotedYaml(const std::string& text);

// Where the key is written; the node's own mark where it is not.
inline const SourceMark& MarkOf(const ConfigNode& node, std::string_view key) {
  const ConfigNode* written = node.Find(key);
  return written != nullptr ? written->mark : node.mark;
}

}  // namespace floorproof
