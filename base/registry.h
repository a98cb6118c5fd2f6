// SPDX-License-Identifier: Apache-2.0
// Plug-ins: each folder's list.inc names them; this turns a list into a table. A program that holds
// this one as a library brings more of them at run time (python/): guests, found by name as well.
#pragma once

#include <algorithm>
#include <functional>
#include <memory>
#include <mutex>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "base/params.h"

namespace floorproof {

template <class T>
struct PluginEntry {
  std::string_view name;
  std::string_view help;
  std::unique_ptr<T> (*make)();
};

// Plug-ins of the program that holds this one as a library, in the order in which they came.
// Several threads may ask and add at a time.
template <class T>
class GuestPlugins {
 public:
  using Make = std::function<std::unique_ptr<T>()>;

  // Adds one, in place of one that has its name. Throws InputError where `table` has that name.
  static void Add(std::span<const PluginEntry<T>> table, const std::string& name, Make make) {
    for (const auto& entry : table)
      if (entry.name == name)
        throw InputError({}, "name", name, "is built in; a plug-in needs a name of its own");
    auto added = std::make_shared<const Make>(std::move(make));
    Kept& kept = Get();
    const std::lock_guard alone(kept.mutex);
    const auto there = std::ranges::find(kept.guests, name, &Guest::first);
    if (there == kept.guests.end())
      kept.guests.emplace_back(name, std::move(added));
    else
      std::swap(there->second, added);  // the former goes behind the lock, if nobody makes one now
  }
  // nullptr: there is none. It may be replaced while it is called.
  static std::shared_ptr<const Make> Find(std::string_view name) {
    Kept& kept = Get();
    const std::lock_guard alone(kept.mutex);
    const auto there = std::ranges::find(kept.guests, name, &Guest::first);
    return there == kept.guests.end() ? nullptr : there->second;
  }
  static std::vector<std::string> Names() {
    Kept& kept = Get();
    const std::lock_guard alone(kept.mutex);
    std::vector<std::string> names;
    for (const Guest& guest : kept.guests) names.push_back(guest.first);
    return names;
  }

 private:
  using Guest = std::pair<std::string, std::shared_ptr<const Make>>;
  struct Kept {
    std::mutex mutex;
    std::vector<Guest> guests;
  };
  static Kept& Get() {
    static auto& kept = *new Kept;  // what they hold may be gone at the end
    return kept;
  }
};

template <class T>
std::vector<std::string> PluginNames(std::span<const PluginEntry<T>> table) {
  std::vector<std::string> names;
  for (const auto& entry : table) names.emplace_back(entry.name);
  for (std::string& guest : GuestPlugins<T>::Names()) names.push_back(std::move(guest));
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
  if (const auto guest = GuestPlugins<T>::Find(name)) return (*guest)();
  auto names = PluginNames(table);
  names.insert(names.end(), others.begin(), others.end());
  throw InputError(mark, key, name, "unknown" + DidYouMeanOneOf(name, names));
}

// A plug-in as data: unlike the plug-in, which has a state, it can be copied, kept and compared.
struct PluginSpec {
  std::string name;
  ParamValues params;
  bool operator==(const PluginSpec&) const = default;
};

// Makes the plug-in. Throws InputError where the table has none of that name.
template <class T>
std::unique_ptr<T> MakePlugin(std::span<const PluginEntry<T>> table, const PluginSpec& spec,
                              std::string_view key) {
  auto plugin = MakePlugin(table, spec.name, key);
  SetValues(spec.params, *plugin);
  return plugin;
}

// Makes each of them as a Named {name, plug-in}, in their order. Throws as MakePlugin does.
template <class Named, class T>
std::vector<Named> MakePlugins(std::span<const PluginEntry<T>> table,
                               std::span<const PluginSpec> specs, std::string_view key) {
  std::vector<Named> plugins;
  for (const PluginSpec& spec : specs) plugins.push_back({spec.name, MakePlugin(table, spec, key)});
  return plugins;
}

}  // namespace floorproof

// In a plug-in's file, behind its class (which may live in an anonymous namespace): defines the
// factory that the folder's list.inc declares.
#define FP_DEFINE_PLUGIN(Interface, Class) \
  std::unique_ptr<Interface> Make##Class() { return std::make_unique<Class>(); }
