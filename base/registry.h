// SPDX-License-Identifier: Apache-2.0
// Plug-ins: each folder's list.inc names them; this turns a list into a table. A program that holds
// this one as a library brings more of them at run time (python/): guests, found by name as well.
#pragma once

#include <algorithm>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "base/error.h"

namespace floorproof {

template <class T>
struct PluginEntry {
  std::string_view name;
  std::string_view help;
  std::unique_ptr<T> (*make)();
};

// A plug-in of the program that holds this one as a library.
template <class T>
struct GuestPlugin {
  std::string name;
  std::function<std::unique_ptr<T>()> make;
};

// In the order in which they came. Not for several threads at a time.
template <class T>
std::vector<GuestPlugin<T>>& GuestPlugins() {
  static auto& guests = *new std::vector<GuestPlugin<T>>;  // what they hold may be gone at the end
  return guests;
}

// Adds a guest, in place of one that has its name. Throws InputError where `table` has that name.
template <class T>
void AddGuestPlugin(std::span<const PluginEntry<T>> table, GuestPlugin<T> guest) {
  for (const auto& entry : table)
    if (entry.name == guest.name)
      throw InputError({}, "name", guest.name, "is built in; a plug-in needs a name of its own");
  auto& guests = GuestPlugins<T>();
  const auto there = std::ranges::find(guests, guest.name, &GuestPlugin<T>::name);
  if (there == guests.end())
    guests.push_back(std::move(guest));
  else
    *there = std::move(guest);
}

template <class T>
std::vector<std::string> PluginNames(std::span<const PluginEntry<T>> table) {
  std::vector<std::string> names;
  for (const auto& entry : table) names.emplace_back(entry.name);
  for (const auto& guest : GuestPlugins<T>()) names.push_back(guest.name);
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
  for (const auto& guest : GuestPlugins<T>())
    if (guest.name == name) return guest.make();
  auto names = PluginNames(table);
  names.insert(names.end(), others.begin(), others.end());
  throw InputError(mark, key, name, "unknown" + DidYouMeanOneOf(name, names));
}

}  // namespace floorproof

// In a plug-in's file, behind its class (which may live in an anonymous namespace): defines the
// factory that the folder's list.inc declares.
#define FP_DEFINE_PLUGIN(Interface, Class) \
  std::unique_ptr<Interface> Make##Class() { return std::make_unique<Class>(); }
