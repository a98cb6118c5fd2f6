// SPDX-License-Identifier: Apache-2.0
#include "run/episode/json_file.h"

#include <limits>

#include "base/error.h"
#include "base/input_file.h"
#include "run/episode/bounded_json.h"

namespace floorproof {
namespace {

using Json = JsonValue::Json;

template <class T>
constexpr const char* kTypeRule = "must be a whole number";
template <>
constexpr const char* kTypeRule<bool> = "must be true or false";
template <>
constexpr const char* kTypeRule<double> = "must be a number";
template <>
constexpr const char* kTypeRule<std::string> = "must be text";

template <JsonScalar T>
bool Is(const Json& json) {
  if constexpr (std::same_as<T, bool>) {
    return json.is_boolean();
  } else if constexpr (std::same_as<T, std::string>) {
    return json.is_string();
  } else if constexpr (std::same_as<T, double>) {
    return json.is_number();
  } else {
    if (json.is_number_unsigned()) return std::in_range<T>(json.get<std::uint64_t>());
    return json.is_number_integer() && std::in_range<T>(json.get<std::int64_t>());
  }
}

}  // namespace

void JsonValue::Refuse(std::string_view rule) const {
  throw InputError({source_->file, 0}, path_, "", rule);
}

JsonValue JsonValue::Below(const std::string& key, const Json& json) const {
  return {source_, json, path_.empty() ? key : path_ + "." + key};
}

JsonValue JsonValue::at(std::string_view key) const {
  if (!json_->is_object()) Refuse("must be an object");
  auto found = Find(key);
  if (!found) Below(std::string(key), *json_).Refuse("is missing: damaged, or of another version");
  return *std::move(found);
}

std::optional<JsonValue> JsonValue::Find(std::string_view key) const {
  if (!json_->is_object()) return std::nullopt;
  const auto found = json_->find(std::string(key));
  if (found == json_->end()) return std::nullopt;
  return Below(found.key(), *found);
}

template <JsonScalar T>
T JsonValue::get() const {
  constexpr bool kWhole = std::integral<T> && !std::same_as<T, bool>;
  if (!Is<T>(*json_))
    Refuse(kWhole && json_->is_number_integer() ? "is out of range" : kTypeRule<T>);
  return json_->get<T>();
}

template bool JsonValue::get() const;
template int JsonValue::get() const;
template std::int64_t JsonValue::get() const;
template std::uint64_t JsonValue::get() const;
template double JsonValue::get() const;
template std::string JsonValue::get() const;

std::vector<std::pair<std::string, JsonValue>> JsonValue::items() const {
  if (!json_->is_object()) Refuse("must be an object");
  std::vector<std::pair<std::string, JsonValue>> entries;
  for (const auto& [key, value] : json_->items()) entries.emplace_back(key, Below(key, value));
  return entries;
}

std::vector<JsonValue> JsonValue::elements() const {
  if (!json_->is_array()) Refuse("must be a list");
  std::vector<JsonValue> values;
  for (std::size_t i = 0; i < json_->size(); ++i)
    values.push_back(Below(std::to_string(i), (*json_)[i]));
  return values;
}

JsonValue ReadJsonFile(const std::filesystem::path& file, std::string_view what,
                       std::uintmax_t most_bytes, void (*adapt)(Json&)) {
  const std::string text = ReadInputFile(file, most_bytes);
  auto source = std::make_shared<JsonValue::Source>();
  source->file = file.string();
  const auto refuse = [&](const std::string& why) {
    throw InputError({source->file, 0}, "", "",
                     "is not " + std::string(what) + " (a JSON object)" + why);
  };
  const JsonLimits limits{.bytes = most_bytes, .keys = 20'000, .levels = 100};  // hazards by name
  if (const std::string why = WhyUnboundedJson(text, limits); !why.empty()) refuse(": it " + why);
  source->root = Json::parse(text);
  if (!source->root.is_object()) refuse("");
  if (adapt != nullptr) adapt(source->root);
  const Json& root = source->root;
  return {std::move(source), root, ""};
}

}  // namespace floorproof
