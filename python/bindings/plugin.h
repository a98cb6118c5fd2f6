// SPDX-License-Identifier: Apache-2.0
// What planners and trackers written in Python have in common. Each is a Python object that
// python/floorproof/_plugins.py wraps around what a user writes:
//
//   params()          -> [(name, value, help), ..], values of type float, int, bool or str
//   set(name, value)  takes one that was checked
//   promises()        -> dict, of planners
#pragma once

#include <deque>
#include <memory>
#include <span>
#include <string>
#include <tuple>
#include <utility>
#include <variant>
#include <vector>

#include "base/params.h"
#include "base/registry.h"
#include "python/bindings/host.h"

namespace floorproof {

// A Python object whose last reference may be dropped by a thread without the GIL.
class Held {
 public:
  explicit Held(nb::object object) : object_(new nb::object(std::move(object))) {}
  ~Held() {
    if (!Py_IsInitialized()) return;  // the interpreter has ended: there is nothing to give back
    const Gil held;
    delete object_;
  }
  Held(const Held&) = delete;
  Held& operator=(const Held&) = delete;
  nb::object& operator*() const { return *object_; }

 private:
  nb::object* object_;
};

// The parameters of a Python plug-in, as its class states them.
class PythonParams {
 public:
  PythonParams(std::string who, nb::object plugin)
      : who_(std::move(who)), plugin_(std::move(plugin)) {
    for (const nb::handle one : Ask(attr("params"))) {
      const auto row = nb::cast<nb::tuple>(one);
      Param& p = params_.emplace_back();
      p.name = nb::cast<std::string>(row[0]);
      p.value = ValueOf(row[1]);
      p.help = nb::cast<std::string>(row[2]);
    }
  }

  void Visit(ParamVisitor& v) {
    for (Param& p : params_) {
      const Value before = p.value;
      if (auto* flag = std::get_if<bool>(&p.value))
        v(p.name.c_str(), *flag, p.help.c_str());
      else if (auto* whole = std::get_if<int>(&p.value))
        v(p.name.c_str(), *whole, Any(), p.help.c_str());
      else if (auto* real = std::get_if<double>(&p.value))
        v(p.name.c_str(), *real, Any(), p.help.c_str());
      else
        v(p.name.c_str(), std::get<std::string>(p.value), {}, p.help.c_str());
      if (p.value != before) InPython(who_, [&] { Ask(attr("set"), p.name, p.value); });
    }
  }

  const std::string& who() const { return who_; }
  nb::object attr(const char* name) const { return (*plugin_).attr(name); }

 private:
  using Value = std::variant<bool, int, double, std::string>;
  static Value ValueOf(const nb::object& value) {
    if (nb::isinstance<nb::bool_>(value)) return nb::cast<bool>(value);
    if (nb::isinstance<nb::int_>(value)) return nb::cast<int>(value);
    if (nb::isinstance<nb::float_>(value)) return nb::cast<double>(value);
    return nb::cast<std::string>(value);
  }
  struct Param {
    std::string name, help;
    Value value;
  };
  std::string who_;
  Held plugin_;
  std::deque<Param> params_;
};

// `make`: makes the Python object.
template <class Interface, class Plugin>
void Register(std::span<const PluginEntry<Interface>> table, const std::string& name,
              nb::object make) {
  GuestPlugins<Interface>::Add(table, name, [name, held = std::make_shared<Held>(std::move(make))] {
    return InPython(name, [&] {
      return std::unique_ptr<Interface>(std::make_unique<Plugin>(name, Ask(**held)));
    });
  });
}

template <class Interface>
std::vector<std::tuple<std::string, std::string>> Listed(
    std::span<const PluginEntry<Interface>> table) {
  std::vector<std::tuple<std::string, std::string>> out;
  for (const auto& entry : table) out.emplace_back(entry.name, entry.help);
  return out;
}

}  // namespace floorproof
