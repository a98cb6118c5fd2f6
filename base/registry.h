// SPDX-License-Identifier: Apache-2.0
// Plug-ins: each folder's list.inc names them; this turns a list into a table.
#pragma once

#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "base/error.h"

namespace floorproof {

template <class T>
struct PluginEntry {
  std::string_view name;
  std::string_view help;
  std::unique_ptr<T> (*make)();
};

template <class T>
std::vector<std::string> PluginNames(std::span<const PluginEntry<T>> table) {
  std::vector<std::string> names;
  for (const auto& entry : table) names.emplace_back(entry.name);
  return names;
}

// Makes the plug-in of that name; throws InputError at `mark`, naming the nearest and all names.
// `others`: of another table, which would have done as well.
template <class T>
std::unique_ptr<T> MakePlugin(std::span<const PluginEntry<T>> table, std::string_view name,
                              std::string_view key, const SourceMark& mark = {},
                              const std::vector<std::string>& others = {}) {
  for (const auto& entry : table)
    if (entry.name == name) return entry.make();
  auto names = PluginNames(table);
  names.insert(names.end(), others.begin(), others.end());
  throw InputError(mark, key, name, "unknown" + DidYouMeanOneOf(name, names));
}

}  // namespace floorproof

// In a plug-in's file, behind its class (which may live in an anonymous namespace): defines the
// factory that the folder's list.inc declares.
#define FP_DEFINE_PLUGIN(Interface, Class) \
  std::unique_ptr<Interface> Make##Class() { return std::make_unique<Class>(); }
