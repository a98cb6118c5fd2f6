// SPDX-License-Identifier: Apache-2.0
#include "base/json_schema.h"

#include <cmath>
#include <map>

namespace floorproof {
namespace {

ConfigNode Text(const std::string& text) { return ConfigNode::Scalar(text, true); }
ConfigNode Number(double value) { return ConfigNode::Scalar(FormatDouble(value)); }

ConfigNode Texts(const std::vector<std::string>& texts) {
  ConfigNode list = ConfigNode::List();
  for (const std::string& text : texts) list.items.push_back(Text(text));
  return list;
}

ConfigNode With(const char* key, ConfigNode value) {
  ConfigNode node = ConfigNode::Map();
  node.Add(key, std::move(value));
  return node;
}

ConfigNode OfType(const char* type) { return With("type", Text(type)); }

ConfigNode Bounded(const char* type, const Bounds& rule) {
  ConfigNode node = OfType(type);
  if (std::isfinite(rule.min))
    node.Add(rule.min_open ? "exclusiveMinimum" : "minimum", Number(rule.min));
  if (std::isfinite(rule.max)) node.Add("maximum", Number(rule.max));
  return node;
}

// A map that has the key, and there this value.
ConfigNode Says(const std::string& key, const std::string& value) {
  return With("properties", With(key.c_str(), With("const", Text(value))));
}

ConfigNode Has(const std::string& key) { return With("required", Texts({key})); }

ConfigNode Described(ConfigNode schema, const std::string& help) {
  if (!help.empty()) schema.Add("description", Text(help));
  return schema;
}

class SchemaVisitor : public ParamVisitor {
 public:
  SchemaVisitor(MapSchema& into, MapSchema::Defaults defaults) : into_(into), defaults_(defaults) {}

  void operator()(const char* name, double& value, const Bounds& rule, const char* help) override {
    Add(name, NumberSchema(rule), Number(value), help, rule.Text());
  }
  void operator()(const char* name, int& value, const Bounds& rule, const char* help) override {
    Add(name, WholeSchema(rule), ConfigNode::Scalar(std::to_string(value)), help, rule.Text());
  }
  void operator()(const char* name, bool& value, const char* help) override {
    Add(name, BoolSchema(), ConfigNode::Scalar(value ? "true" : "false"), help, "true or false");
  }
  void operator()(const char* name, std::string& value, const std::vector<std::string>& choices,
                  const char* help) override {
    Add(name, choices.empty() ? TextSchema() : ChoiceSchema(choices), Text(value), help,
        choices.empty() ? "text" : "");
  }
  void operator()(const char* name, std::optional<double>& value, const Bounds& rule,
                  const char* help) override {
    Add(name, AnyOf({NumberSchema(rule), With("const", Text("none"))}),
        value ? Number(*value) : Text("none"), help, rule.Text() + ", or none");
  }
  void Group(const char* name, const std::function<void(ParamVisitor&)>& visit,
             const char* help) override {
    into_.Key(name, OrNull(MapSchema().Params(visit, defaults_).Node()), help);
  }

 private:
  // Editors show of a schema its description alone: it states default and rule, too.
  void Add(const char* name, ConfigNode schema, ConfigNode value, const std::string& help,
           const std::string& rule) {
    std::string also = rule;
    if (defaults_ == MapSchema::Defaults::kStated) {
      if (!value.scalar.empty())
        also = "default " + value.scalar + (rule.empty() ? "" : "; " + rule);
      schema.Add("default", std::move(value));
    }
    into_.Key(name, std::move(schema), also.empty() ? help : help + " (" + also + ")");
  }

  MapSchema& into_;
  MapSchema::Defaults defaults_;
};

// Of a key or of what is below it: no match.
std::string NeitherBelow(const std::vector<std::string>& keys) {
  std::string any;
  for (std::string key : keys) {
    for (std::size_t at = 0; (at = key.find('.', at)) != std::string::npos; at += 2)
      key.insert(at, "\\");
    any += (any.empty() ? "" : "|") + key;
  }
  return "^(?!(" + any + ")(\\.|$))";
}

// The keys of all of them, each as any of them has it.
MapSchema United(const std::vector<NamedSchema>& named) {
  MapSchema all;
  std::map<std::string, std::vector<ConfigNode>> forms;
  for (const NamedSchema& one : named) {
    MapSchema keys = one.keys;
    for (const std::string& name : keys.Names()) {
      forms[name].push_back(keys.At(name));
      all.Key(name, forms[name].size() == 1 ? forms[name].front() : AnyOf(forms[name]));
    }
  }
  return all;
}

}  // namespace

ConfigNode NumberSchema(const Bounds& rule) { return Bounded("number", rule); }
ConfigNode WholeSchema(const Bounds& rule) { return Bounded("integer", rule); }
ConfigNode BoolSchema() { return OfType("boolean"); }

ConfigNode TextSchema(const std::string& pattern) {
  ConfigNode node = With("type", Texts({"string", "number", "boolean"}));
  if (!pattern.empty()) node.Add("pattern", Text(pattern));
  return node;
}

ConfigNode AnythingSchema() { return ConfigNode::Scalar("true"); }

ConfigNode ConstSchema(const std::string& value) {
  return With("const", ConfigNode::Scalar(value));
}

ConfigNode NoneSchema() { return With("enum", ConfigNode::List({Text("none"), ConfigNode()})); }

ConfigNode ChoiceSchema(const std::vector<std::string>& names,
                        const std::vector<std::string>& helps) {
  ConfigNode node = With("enum", Texts(names));
  if (helps.size() == names.size()) node.Add("enumDescriptions", Texts(helps));
  return node;
}

ConfigNode ListSchema(ConfigNode item, std::size_t least, std::optional<std::size_t> most) {
  ConfigNode node = OfType("array");
  node.Add("items", std::move(item));
  if (least > 0) node.Add("minItems", ConfigNode::Scalar(std::to_string(least)));
  if (most) node.Add("maxItems", ConfigNode::Scalar(std::to_string(*most)));
  return node;
}

ConfigNode AnyOf(std::vector<ConfigNode> schemas) {
  return With("anyOf", ConfigNode::List(std::move(schemas)));
}

ConfigNode AnyKeysSchema(ConfigNode value, const std::vector<std::string>& refused) {
  ConfigNode node = OfType("object");
  if (!refused.empty()) {
    ConfigNode& names = node.Add("propertyNames", With("pattern", Text(NeitherBelow(refused))));
    names.Add("patternErrorMessage", Text("this key cannot differ"));
  }
  node.Add("additionalProperties", std::move(value));
  return node;
}

ConfigNode OrNull(ConfigNode schema) { return AnyOf({std::move(schema), OfType("null")}); }

MapSchema& MapSchema::Params(const std::function<void(ParamVisitor&)>& visit, Defaults defaults) {
  SchemaVisitor visitor(*this, defaults);
  visit(visitor);
  return *this;
}

MapSchema& MapSchema::Params(Configurable& of) {
  return Params([&](ParamVisitor& v) { of.Visit(v); });
}

MapSchema& MapSchema::Key(const std::string& name, ConfigNode schema, const std::string& help) {
  keys_.Add(name, Described(std::move(schema), help));
  return *this;
}

MapSchema& MapSchema::Require(const std::string& name) {
  required_.items.push_back(Text(name));
  return *this;
}

ConfigNode MapSchema::Node() const {
  ConfigNode node = OfType("object");
  node.Add("properties", keys_);
  if (!required_.items.empty()) node.Add("required", required_);
  node.Add("additionalProperties", ConfigNode::Scalar("false"));
  return node;
}

std::vector<std::string> MapSchema::Names() const {
  std::vector<std::string> names;
  for (const auto& entry : keys_.entries) names.push_back(entry.first);
  return names;
}

ConfigNode NamesSchema(const std::vector<NamedSchema>& named) {
  std::vector<std::string> names, helps;
  for (const NamedSchema& one : named) {
    names.push_back(one.name);
    helps.push_back(one.help);
  }
  return ChoiceSchema(names, helps);
}

ConfigNode NamedMapSchema(const std::string& name_key, const std::string& help,
                          const std::vector<NamedSchema>& named, Unnamed unnamed) {
  ConfigNode node = OfType("object");
  node.Add("properties", With(name_key.c_str(), Described(NamesSchema(named), help)));
  if (unnamed == Unnamed::kRefused) node.Add("required", Texts({name_key}));
  ConfigNode& all = node.Add("allOf", ConfigNode::List());
  const auto when = [&all](ConfigNode condition, const char* then, ConfigNode schema) {
    ConfigNode rule = With("if", std::move(condition));
    rule.Add(then, std::move(schema));
    all.items.push_back(std::move(rule));
  };
  // The name is judged once, above.
  const auto with_name = [&](MapSchema keys) {
    return keys.Key(name_key, AnythingSchema()).Node();
  };
  for (const NamedSchema& one : named) {
    ConfigNode condition = Says(name_key, one.name);
    const bool is_usual = unnamed == Unnamed::kFirst && &one == &named.front();
    if (!is_usual) condition.Add("required", Texts({name_key}));
    when(std::move(condition), "then", with_name(one.keys));
  }
  if (unnamed == Unnamed::kAny) when(Has(name_key), "else", with_name(United(named)));
  return node;
}

ConfigNode PluginMapSchema(const std::vector<NamedSchema>& named) {
  MapSchema map;
  for (const NamedSchema& one : named) map.Key(one.name, OrNull(one.keys.Node()), one.help);
  return map.Node();
}

}  // namespace floorproof
