// SPDX-License-Identifier: Apache-2.0
#include "base/params.h"

#include <algorithm>
#include <charconv>
#include <cmath>

namespace floorproof {
namespace {

std::string Shown(const ConfigNode& node) {
  switch (node.kind) {
    case ConfigNode::Kind::kNull:
      return "(empty)";
    case ConfigNode::Kind::kScalar:
      return node.scalar.empty() ? "\"\"" : node.scalar;
    case ConfigNode::Kind::kList:
      return "[...]";
    case ConfigNode::Kind::kMap:
      return "{...}";
  }
  return "";
}

template <class T>
std::optional<T> Parse(const std::string& text) {
  T value{};
  const char* first = text.data();
  const char* last = first + text.size();
  if (first != last && *first == '+') ++first;
  const auto [end, error] = std::from_chars(first, last, value);
  if (error != std::errc() || end != last || first == last) return std::nullopt;
  return value;
}

std::string Joined(const std::vector<std::string>& words) {
  std::string out;
  for (const auto& word : words) out += (out.empty() ? "" : ", ") + word;
  return out;
}

// `also` ends the rule where other values are allowed too.
double ReadDouble(const ConfigNode& node, const std::string& key, const Bounds& rule,
                  const std::string& also) {
  const auto value = node.IsScalar() && !node.quoted ? Parse<double>(node.scalar) : std::nullopt;
  if (!value) throw InputError(node.mark, key, Shown(node), "must be a number" + also);
  if (!rule.Allows(*value))
    throw InputError(node.mark, key, Shown(node),
                     (std::isfinite(*value) ? rule.Text() : "must be a finite number") + also);
  return *value;
}

class Reader : public ParamVisitor {
 public:
  Reader(const ConfigNode& node, std::string path) : node_(node), path_(std::move(path)) {}

  void operator()(const char* name, double& value, const Bounds& rule, const char*) override {
    if (const auto* n = Take(name)) value = AsDouble(*n, path_ + name, rule);
  }
  void operator()(const char* name, int& value, const Bounds& rule, const char*) override {
    if (const auto* n = Take(name)) {
      const Bounds fits{std::max(rule.min, -2147483648.0), std::min(rule.max, 2147483647.0),
                        rule.min_open};
      value = static_cast<int>(AsInt(*n, path_ + name, fits));
    }
  }
  void operator()(const char* name, bool& value, const char*) override {
    if (const auto* n = Take(name)) value = AsBool(*n, path_ + name);
  }
  void operator()(const char* name, std::string& value, const std::vector<std::string>& choices,
                  const char*) override {
    const auto* n = Take(name);
    if (n == nullptr) return;
    value = AsString(*n, path_ + name);
    if (choices.empty() || std::ranges::find(choices, value) != choices.end()) return;
    throw InputError(n->mark, path_ + name, value,
                     "must be one of " + Joined(choices) + DidYouMean(value, choices));
  }
  void operator()(const char* name, std::optional<double>& value, const Bounds& rule,
                  const char*) override {
    const auto* n = Take(name);
    if (n == nullptr) return;
    if (n->IsScalar() && n->scalar == "none")
      value.reset();
    else
      value = ReadDouble(*n, path_ + name, rule, ", or none");
  }
  void Group(const char* name, const std::function<void(ParamVisitor&)>& visit,
             const char*) override {
    if (const auto* n = Take(name)) {
      ReadParams(*n, path_ + name + ".", visit);
    }
  }

  const std::vector<std::string>& known() const { return known_; }

 private:
  const ConfigNode* Take(const char* name) {
    known_.emplace_back(name);
    return node_.Find(name);
  }
  const ConfigNode& node_;
  std::string path_;
  std::vector<std::string> known_;
};

// Calls `each` with the full key and a reference to the value of each parameter, of whatever type.
template <class Each>
class EachParam : public ParamVisitor {
 public:
  EachParam(std::string path, Each& each) : path_(std::move(path)), each_(each) {}

  void operator()(const char* name, double& value, const Bounds&, const char*) override {
    each_(path_ + name, value);
  }
  void operator()(const char* name, int& value, const Bounds&, const char*) override {
    each_(path_ + name, value);
  }
  void operator()(const char* name, bool& value, const char*) override {
    each_(path_ + name, value);
  }
  void operator()(const char* name, std::string& value, const std::vector<std::string>&,
                  const char*) override {
    each_(path_ + name, value);
  }
  void operator()(const char* name, std::optional<double>& value, const Bounds&,
                  const char*) override {
    each_(path_ + name, value);
  }
  void Group(const char* name, const std::function<void(ParamVisitor&)>& visit,
             const char*) override {
    ParamGroup group;
    each_(path_ + name, group);
    EachParam inner(path_ + name + ".", each_);
    visit(inner);
  }

 private:
  std::string path_;
  Each& each_;
};

ConfigNode Written(const ParamGroup&) { return ConfigNode::Map(); }
ConfigNode Written(double value) { return ConfigNode::Scalar(FormatDouble(value)); }
ConfigNode Written(int value) { return ConfigNode::Scalar(std::to_string(value)); }
ConfigNode Written(bool value) { return ConfigNode::Scalar(value ? "true" : "false"); }
ConfigNode Written(const std::string& value) { return ConfigNode::Scalar(value, true); }
ConfigNode Written(const std::optional<double>& value) {
  return ConfigNode::Scalar(value ? FormatDouble(*value) : "none");
}

class Documenter : public ParamVisitor {
 public:
  Documenter(std::vector<ParamDoc>& docs, std::string path) : docs_(docs), path_(std::move(path)) {}

  void operator()(const char* name, double& value, const Bounds& rule, const char* help) override {
    docs_.push_back({path_ + name, FormatDouble(value), rule.Text(), help});
  }
  void operator()(const char* name, int& value, const Bounds& rule, const char* help) override {
    docs_.push_back({path_ + name, std::to_string(value), rule.Text(), help});
  }
  void operator()(const char* name, bool& value, const char* help) override {
    docs_.push_back({path_ + name, value ? "true" : "false", "true or false", help});
  }
  void operator()(const char* name, std::string& value, const std::vector<std::string>& choices,
                  const char* help) override {
    docs_.push_back(
        {path_ + name, value, choices.empty() ? "text" : "one of " + Joined(choices), help});
  }
  void operator()(const char* name, std::optional<double>& value, const Bounds& rule,
                  const char* help) override {
    docs_.push_back(
        {path_ + name, value ? FormatDouble(*value) : "none", rule.Text() + ", or none", help});
  }
  void Group(const char* name, const std::function<void(ParamVisitor&)>& visit,
             const char*) override {
    Documenter inner(docs_, path_ + name + ".");
    visit(inner);
  }

 private:
  std::vector<ParamDoc>& docs_;
  std::string path_;
};

}  // namespace

std::string Bounds::Text() const {
  const bool has_min = std::isfinite(min), has_max = std::isfinite(max);
  if (has_min && has_max)
    return std::string("must be in ") + (min_open ? "(" : "[") + FormatDouble(min) + ", " +
           FormatDouble(max) + "]";
  if (has_min) return std::string("must be ") + (min_open ? "> " : ">= ") + FormatDouble(min);
  if (has_max) return "must be <= " + FormatDouble(max);
  return "must be a number";
}

bool Bounds::Allows(double value) const {
  return std::isfinite(value) && value <= max && (min_open ? value > min : value >= min);
}

void ReadParams(const ConfigNode& node, const std::string& path,
                const std::function<void(ParamVisitor&)>& visit,
                const std::vector<std::string>& also_allowed) {
  if (!node.IsMap() && !node.IsNull()) {
    std::string key = path;
    if (!key.empty() && key.back() == '.') key.pop_back();
    throw InputError(node.mark, key, Shown(node), "must be a map of keys");
  }
  Reader reader(node, path);
  visit(reader);
  std::vector<std::string> known = reader.known();
  known.insert(known.end(), also_allowed.begin(), also_allowed.end());
  RefuseUnknownKeys(node, path, known);
}

void ReadParams(const ConfigNode& node, const std::string& path, Configurable& target,
                const std::vector<std::string>& also_allowed) {
  ReadParams(
      node, path, [&](ParamVisitor& v) { target.Visit(v); }, also_allowed);
}

ParamValues ValuesOf(const std::function<void(ParamVisitor&)>& visit) {
  ParamValues values;
  auto keep = [&values](std::string key, const auto& value) {
    values.emplace_back(std::move(key), value);
  };
  EachParam visitor("", keep);
  visit(visitor);
  return values;
}

ParamValues ValuesOf(Configurable& source) {
  return ValuesOf([&](ParamVisitor& v) { source.Visit(v); });
}

void SetValues(const ParamValues& values, Configurable& target) {
  auto set = [&values]<class T>(const std::string& key, T& value) {
    const auto found = std::ranges::find(values, key, &ParamValues::value_type::first);
    if (found == values.end()) return;
    if (const T* given = std::get_if<T>(&found->second)) value = *given;
  };
  EachParam visitor("", set);
  target.Visit(visitor);
}

void WriteValues(const ParamValues& values, ConfigNode& node) {
  node.kind = ConfigNode::Kind::kMap;
  for (const auto& [key, value] : values)
    node.SetPath(key, std::visit([](const auto& v) { return Written(v); }, value));
}

ConfigNode WithValues(ConfigNode node, const ParamValues& values) {
  WriteValues(values, node);
  return node;
}

void WriteParams(const std::function<void(ParamVisitor&)>& visit, ConfigNode& node) {
  WriteValues(ValuesOf(visit), node);
}

void WriteParams(Configurable& source, ConfigNode& node) { WriteValues(ValuesOf(source), node); }

std::vector<std::pair<std::string, double>> NumericParams(Configurable& source) {
  std::vector<std::pair<std::string, double>> numbers;
  for (const auto& [key, value] : ValuesOf(source)) {
    if (const double* number = std::get_if<double>(&value)) numbers.emplace_back(key, *number);
    if (const auto* number = std::get_if<std::optional<double>>(&value); number && *number)
      numbers.emplace_back(key, **number);
  }
  return numbers;
}

std::vector<ParamDoc> DocumentParams(Configurable& source) {
  std::vector<ParamDoc> docs;
  Documenter documenter(docs, "");
  source.Visit(documenter);
  return docs;
}

double AsDouble(const ConfigNode& node, const std::string& key, const Bounds& rule) {
  return ReadDouble(node, key, rule, "");
}

std::int64_t AsInt(const ConfigNode& node, const std::string& key, const Bounds& rule) {
  const auto value =
      node.IsScalar() && !node.quoted ? Parse<std::int64_t>(node.scalar) : std::nullopt;
  if (!value) throw InputError(node.mark, key, Shown(node), "must be a whole number");
  if (!rule.Allows(static_cast<double>(*value)))
    throw InputError(node.mark, key, Shown(node), rule.Text());
  return *value;
}

bool AsBool(const ConfigNode& node, const std::string& key) {
  if (node.IsScalar() && !node.quoted) {
    if (node.scalar == "true" || node.scalar == "True") return true;
    if (node.scalar == "false" || node.scalar == "False") return false;
  }
  throw InputError(node.mark, key, Shown(node), "must be true or false");
}

std::string AsString(const ConfigNode& node, const std::string& key) {
  if (!node.IsScalar()) throw InputError(node.mark, key, Shown(node), "must be text");
  return node.scalar;
}

void RefuseUnknownKeys(const ConfigNode& node, const std::string& path,
                       const std::vector<std::string>& known) {
  for (const auto& [key, value] : node.entries) {
    if (std::ranges::find(known, key) != known.end()) continue;
    throw InputError(value.mark, path + key, "", "unknown key" + DidYouMean(key, known));
  }
}

std::string FormatDouble(double value) {
  char text[32];
  const auto [end, error] = std::to_chars(text, text + sizeof text, value);
  return error == std::errc() ? std::string(text, end) : "nan";
}

}  // namespace floorproof
