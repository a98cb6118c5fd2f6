// SPDX-License-Identifier: Apache-2.0
// Parameters: structs with defaults in place and one Visit that reads, checks, documents and
// writes.
//
//   struct TrackParams {
//     double lookahead_m = 0.3;   // why 0.3
//     void Visit(ParamVisitor& v) { v("lookahead_m", lookahead_m, Positive(), "distance aimed at");
//     }
//   };
#pragma once

#include <cstdint>
#include <functional>
#include <limits>
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "base/config.h"

namespace floorproof {

// Bounds of a number; NaN and infinities are refused always.
struct Bounds {
  double min = -std::numeric_limits<double>::infinity();
  double max = std::numeric_limits<double>::infinity();
  bool min_open = false;     // min itself is refused
  std::string Text() const;  // "must be > 0", "must be in [0, 1]"
  bool Allows(double value) const;
};
inline Bounds Any() { return {}; }
inline Bounds Positive() { return {0, std::numeric_limits<double>::infinity(), true}; }
inline Bounds NonNegative() { return {0, std::numeric_limits<double>::infinity(), false}; }
inline Bounds Between(double low, double high) { return {low, high, false}; }
inline Bounds AtLeast(double low) { return {low, std::numeric_limits<double>::infinity(), false}; }

// Visits each parameter once: name, value, rule, one line of help (with unit or meaning).
class ParamVisitor {
 public:
  virtual ~ParamVisitor() = default;
  virtual void operator()(const char* name, double& value, const Bounds& rule,
                          const char* help) = 0;
  virtual void operator()(const char* name, int& value, const Bounds& rule, const char* help) = 0;
  virtual void operator()(const char* name, bool& value, const char* help) = 0;
  // `choices` empty: any text.
  virtual void operator()(const char* name, std::string& value,
                          const std::vector<std::string>& choices, const char* help) = 0;
  // None is written `none` in files that state every default, and means what `help` says.
  virtual void operator()(const char* name, std::optional<double>& value, const Bounds& rule,
                          const char* help) = 0;
  // A group of parameters under one key.
  virtual void Group(const char* name, const std::function<void(ParamVisitor&)>& visit,
                     const char* help) = 0;
};

// Anything with parameters; plug-ins derive from it.
class Configurable {
 public:
  virtual ~Configurable() = default;
  virtual void Visit(ParamVisitor&) {}
};

// Reads the map `node` into `target`. Keys in `also_allowed` belong to somebody else and are
// skipped. Throws InputError on a wrong type, a broken rule, or an unknown key, naming the nearest
// known one. `path` stands before the key in messages ("plan." gives "plan.overlap").
void ReadParams(const ConfigNode& node, const std::string& path, Configurable& target,
                const std::vector<std::string>& also_allowed = {});
void ReadParams(const ConfigNode& node, const std::string& path,
                const std::function<void(ParamVisitor&)>& visit,
                const std::vector<std::string>& also_allowed = {});
// Parameters as data, in the order in which they are visited: keys, those of groups as `group.key`,
// with their values. A group comes before its parameters, of which it may have none.
struct ParamGroup {
  bool operator==(const ParamGroup&) const = default;
};
using ParamValue = std::variant<double, int, bool, std::string, std::optional<double>, ParamGroup>;
using ParamValues = std::vector<std::pair<std::string, ParamValue>>;
ParamValues ValuesOf(Configurable& source);
ParamValues ValuesOf(const std::function<void(ParamVisitor&)>& visit);
// Sets each parameter of which there is a value of its type; others stay as they are.
void SetValues(const ParamValues& values, Configurable& target);
// Adds every one of them to the map `node`.
void WriteValues(const ParamValues& values, ConfigNode& node);
// Adds every parameter with its value to the map `node`.
void WriteParams(Configurable& source, ConfigNode& node);
void WriteParams(const std::function<void(ParamVisitor&)>& visit, ConfigNode& node);
// The node with them added.
ConfigNode WithValues(ConfigNode node, const ParamValues& values);
// The same. Takes a copy: who visits parameters may change them.
template <class Params>
ConfigNode WithParams(ConfigNode node, Params params) {
  WriteParams([&](ParamVisitor& v) { params.Visit(v); }, node);
  return node;
}

// The parameters that are numbers with a fraction, by name, in order; in groups: "group.name". One
// that is none is left out.
std::vector<std::pair<std::string, double>> NumericParams(Configurable& source);

struct ParamDoc {
  std::string name, default_text, rule, help;
};
std::vector<ParamDoc> DocumentParams(Configurable& source);

// Scalars of a node, with the rule checked; for readers of fixed structures (points, lists).
double AsDouble(const ConfigNode& node, const std::string& key, const Bounds& rule = {});
std::int64_t AsInt(const ConfigNode& node, const std::string& key, const Bounds& rule = {});
bool AsBool(const ConfigNode& node, const std::string& key);
std::string AsString(const ConfigNode& node, const std::string& key);
// Refuses keys of the map `node` that are not in `known`, naming the nearest.
void RefuseUnknownKeys(const ConfigNode& node, const std::string& path,
                       const std::vector<std::string>& known);

// Shortest text that reads back as the same double.
std::string FormatDouble(double value);

}  // namespace floorproof
