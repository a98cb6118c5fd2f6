// SPDX-License-Identifier: Apache-2.0
// Whether a JSON Schema (base/json_schema.h) takes a value: the keywords that our schemas use.
#pragma once

#include <algorithm>
#include <charconv>
#include <functional>
#include <map>
#include <optional>
#include <regex>
#include <stdexcept>
#include <string>

#include "base/config.h"

namespace floorproof {

inline std::optional<double> NumberOf(const ConfigNode& node) {
  double number = 0;
  const char* end = node.scalar.data() + node.scalar.size();
  const auto read = std::from_chars(node.scalar.data(), end, number);
  const bool whole = !node.scalar.empty() && read.ec == std::errc() && read.ptr == end;
  return node.IsScalar() && !node.quoted && whole ? std::optional(number) : std::nullopt;
}

// As YAML 1.2 and JSON have it.
inline std::string TypeOf(const ConfigNode& node) {
  if (node.IsNull()) return "null";
  if (node.IsList()) return "array";
  if (node.IsMap()) return "object";
  if (!node.quoted && (node.scalar == "true" || node.scalar == "false")) return "boolean";
  return NumberOf(node) ? "number" : "string";
}

inline bool IsOfType(const ConfigNode& type, const ConfigNode& value) {
  if (type.IsList())
    return std::ranges::any_of(type.items, [&](const auto& one) { return IsOfType(one, value); });
  const auto number = NumberOf(value);
  if (type.scalar == "integer")
    return number && *number == static_cast<double>(static_cast<long long>(*number));
  return type.scalar == TypeOf(value);
}

inline bool Same(const ConfigNode& a, const ConfigNode& b) {
  return TypeOf(a) == TypeOf(b) && a.scalar == b.scalar && !a.IsList() && !a.IsMap();
}

inline bool Matches(const std::string& text, const std::string& pattern) {
  static std::map<std::string, std::regex> kept;  // made once each: that is what takes time
  return std::regex_search(text, kept.try_emplace(pattern, pattern).first->second);
}

inline bool Takes(const ConfigNode& schema, const ConfigNode& value);

inline bool TakesKeys(const ConfigNode& schema, const ConfigNode& value) {
  const ConfigNode* known = schema.Find("properties");
  const ConfigNode* others = schema.Find("additionalProperties");
  return std::ranges::all_of(value.entries, [&](const auto& entry) {
    const ConfigNode* own = known != nullptr ? known->Find(entry.first) : nullptr;
    if (own == nullptr) own = others;
    return own == nullptr || Takes(*own, entry.second);
  });
}

using Rule = bool (*)(const ConfigNode& schema, const ConfigNode& rule, const ConfigNode& value);

inline bool Annotation(const ConfigNode&, const ConfigNode&, const ConfigNode&) { return true; }

// Whether a number keeps a bound; what is none does.
template <class Compare>
bool Bounded(const ConfigNode&, const ConfigNode& rule, const ConfigNode& value) {
  const auto number = NumberOf(value);
  return !number || Compare()(*number, *NumberOf(rule));
}

template <class Compare>
bool Counted(const ConfigNode&, const ConfigNode& rule, const ConfigNode& value) {
  return !value.IsList() || Compare()(static_cast<double>(value.items.size()), *NumberOf(rule));
}

inline const std::map<std::string, Rule, std::less<>>& Keywords() {
  using Node = const ConfigNode&;
  static const std::map<std::string, Rule, std::less<>> kKeywords = {
      {"description", Annotation},
      {"default", Annotation},
      {"enumDescriptions", Annotation},
      {"patternErrorMessage", Annotation},
      {"then", Annotation},
      {"else", Annotation},
      {"type", [](Node, Node rule, Node value) { return IsOfType(rule, value); }},
      {"const", [](Node, Node rule, Node value) { return Same(rule, value); }},
      {"enum",
       [](Node, Node rule, Node value) {
         return std::ranges::any_of(rule.items, [&](Node one) { return Same(one, value); });
       }},
      {"minimum", Bounded<std::greater_equal<>>},
      {"exclusiveMinimum", Bounded<std::greater<>>},
      {"maximum", Bounded<std::less_equal<>>},
      {"exclusiveMaximum", Bounded<std::less<>>},
      {"minItems", Counted<std::greater_equal<>>},
      {"maxItems", Counted<std::less_equal<>>},
      {"maxLength",
       [](Node, Node rule, Node value) {
         return TypeOf(value) != "string" || value.scalar.size() <= std::stoul(rule.scalar);
       }},
      {"maxProperties",
       [](Node, Node rule, Node value) { return value.entries.size() <= std::stoul(rule.scalar); }},
      {"pattern",
       [](Node, Node rule, Node value) {
         return TypeOf(value) != "string" || Matches(value.scalar, rule.scalar);
       }},
      {"items",
       [](Node, Node rule, Node value) {
         return std::ranges::all_of(value.items, [&](Node item) { return Takes(rule, item); });
       }},
      {"properties", [](Node schema, Node, Node value) { return TakesKeys(schema, value); }},
      {"additionalProperties",
       [](Node schema, Node, Node value) { return TakesKeys(schema, value); }},
      {"propertyNames",
       [](Node, Node rule, Node value) {
         return std::ranges::all_of(value.entries, [&](const auto& entry) {
           return Takes(rule, ConfigNode::Scalar(entry.first, true));
         });
       }},
      {"required",
       [](Node, Node rule, Node value) {
         return !value.IsMap() || std::ranges::all_of(rule.items, [&](Node key) {
           return value.Find(key.scalar) != nullptr;
         });
       }},
      {"anyOf",
       [](Node, Node rule, Node value) {
         return std::ranges::any_of(rule.items, [&](Node one) { return Takes(one, value); });
       }},
      {"allOf",
       [](Node, Node rule, Node value) {
         return std::ranges::all_of(rule.items, [&](Node one) { return Takes(one, value); });
       }},
      {"oneOf",
       [](Node, Node rule, Node value) {
         return std::ranges::count_if(rule.items, [&](Node one) { return Takes(one, value); }) == 1;
       }},
      {"not", [](Node, Node rule, Node value) { return !Takes(rule, value); }},
      {"if",
       [](Node schema, Node rule, Node value) {
         const ConfigNode* next = schema.Find(Takes(rule, value) ? "then" : "else");
         return next == nullptr || Takes(*next, value);
       }},
  };
  return kKeywords;
}

inline bool Takes(const ConfigNode& schema, const ConfigNode& value) {
  if (schema.IsScalar()) return schema.scalar == "true";
  return std::ranges::all_of(schema.entries, [&](const auto& entry) {
    const auto keyword = Keywords().find(entry.first);
    if (keyword == Keywords().end()) throw std::logic_error("no rule of ours: " + entry.first);
    return keyword->second(schema, entry.second, value);
  });
}

}  // namespace floorproof
