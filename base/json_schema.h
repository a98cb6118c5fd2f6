// SPDX-License-Identifier: Apache-2.0
// What is read from YAML as a JSON Schema, from which editors complete keys and mark mistakes.
//
// The rules are the readers' own: keys of parameters come from their Visit, plug-ins from their
// tables. What a schema refuses, its reader refuses. The reverse does not hold: what two keys say
// together, or what hangs on a robot or a floor, readers alone know.
// Draft-07: all editors read it, and nothing that these schemas say needs a later one.
// A schema is a tree whose scalars are JSON's: quoted ones are texts.
#pragma once

#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "base/config.h"
#include "base/params.h"
#include "base/registry.h"

namespace floorproof {

ConfigNode NumberSchema(const Bounds& rule);
ConfigNode WholeSchema(const Bounds& rule);
ConfigNode BoolSchema();
// Any scalar: who reads a text takes 7 and true as they are written. `pattern`: a regular
// expression that texts match.
ConfigNode TextSchema(const std::string& pattern = "");
ConfigNode AnythingSchema();
// This one value, as JSON writes it.
ConfigNode ConstSchema(const std::string& value);
// `none`, or nothing at all.
ConfigNode NoneSchema();
// One of these values, each with a line of help where there are as many.
ConfigNode ChoiceSchema(const std::vector<std::string>& names,
                        const std::vector<std::string>& helps = {});
ConfigNode ListSchema(ConfigNode item, std::size_t least = 0, std::optional<std::size_t> most = {});
ConfigNode AnyOf(std::vector<ConfigNode> schemas);
// A map of any keys, all of one kind, but for `refused` and keys below these ("a", "a.b").
ConfigNode AnyKeysSchema(ConfigNode value, const std::vector<std::string>& refused = {});
// That, or nothing behind the key.
ConfigNode OrNull(ConfigNode schema);

// A map of known keys. All others are refused.
class MapSchema {
 public:
  enum class Defaults { kStated, kElsewhere };
  // `defaults`: whether what its Visit finds is meant where a key is missing.
  MapSchema& Params(const std::function<void(ParamVisitor&)>& visit,
                    Defaults defaults = Defaults::kStated);
  MapSchema& Params(Configurable& of);
  // Replaces a key of that name.
  MapSchema& Key(const std::string& name, ConfigNode schema, const std::string& help = "");
  MapSchema& Require(const std::string& name);
  ConfigNode Node() const;
  std::vector<std::string> Names() const;
  // The schema of a key that is there.
  ConfigNode& At(std::string_view name) { return *keys_.Find(name); }

 private:
  ConfigNode keys_ = ConfigNode::Map();
  ConfigNode required_ = ConfigNode::List();
};

// One of several maps.
struct NamedSchema {
  std::string name, help;
  MapSchema keys;  // but for that of the name
};
// What a map means that does not say its name: that it is refused; the first; one of them, and it
// may have the keys of any.
enum class Unnamed { kRefused, kFirst, kAny };
// A map in which `name_key` says which keys it may have.
ConfigNode NamedMapSchema(const std::string& name_key, const std::string& help,
                          const std::vector<NamedSchema>& named, Unnamed unnamed);
// Their names, each with its help.
ConfigNode NamesSchema(const std::vector<NamedSchema>& named);

template <class T>
std::vector<NamedSchema> PluginSchemas(std::span<const PluginEntry<T>> table) {
  std::vector<NamedSchema> named;
  for (const auto& entry : table) {
    named.push_back({std::string(entry.name), std::string(entry.help), {}});
    named.back().keys.Params(*entry.make());
  }
  return named;
}

// A map of plug-ins by name, each with its keys or nothing.
ConfigNode PluginMapSchema(const std::vector<NamedSchema>& named);

}  // namespace floorproof
