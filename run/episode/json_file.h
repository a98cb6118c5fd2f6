// SPDX-License-Identifier: Apache-2.0
// JSON files that an earlier command wrote, read back and checked value by value.
//
// A file that is not JSON, a key that is missing and a value of another type are bad input: one
// line that names the file and the key, and quotes nothing of the file.
#pragma once

#include <concepts>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace floorproof {

template <class T>
concept JsonScalar =
    std::same_as<T, bool> || std::same_as<T, int> || std::same_as<T, std::int64_t> ||
    std::same_as<T, std::uint64_t> || std::same_as<T, double> || std::same_as<T, std::string>;

// A value in such a file. Keeps the whole file in memory.
class JsonValue {
 public:
  using Json = nlohmann::ordered_json;

  // The value of a key. Throws InputError if this is not an object or lacks the key.
  JsonValue at(std::string_view key) const;
  // None if this is not an object or lacks the key.
  std::optional<JsonValue> Find(std::string_view key) const;
  // The value as a bool, whole number, number or text. Throws InputError if it is something else or
  // does not fit.
  template <JsonScalar T>
  T get() const;
  template <JsonScalar T>
  operator T() const {  // NOLINT: reads like the JSON library's own
    return get<T>();
  }
  // The value of a key, or `otherwise` if the key is missing. Throws InputError as at() and get().
  template <JsonScalar T>
  T value(std::string_view key, T otherwise) const {
    const auto found = Find(key);
    return found ? found->get<T>() : otherwise;
  }
  // The entries of an object in the order written. Throws InputError if this is not an object.
  std::vector<std::pair<std::string, JsonValue>> items() const;
  // The values of a list. Throws InputError if this is not a list.
  std::vector<JsonValue> elements() const;
  bool is_null() const { return json_->is_null(); }
  const Json& json() const { return *json_; }
  // Throws InputError that names the file and this key.
  [[noreturn]] void Refuse(std::string_view rule) const;

 private:
  friend JsonValue ReadJsonFile(const std::filesystem::path& file, std::string_view what,
                                std::uintmax_t most_bytes, void (*adapt)(Json&));
  struct Source {
    std::string file;
    Json root;
  };
  JsonValue(std::shared_ptr<const Source> source, const Json& json, std::string path)
      : source_(std::move(source)), json_(&json), path_(std::move(path)) {}
  JsonValue Below(const std::string& key, const Json& json) const;

  std::shared_ptr<const Source> source_;
  const Json* json_;
  std::string path_;  // keys with dots in between
};

// The file's object. Throws InputError if it cannot be read, or is not a JSON object of at most 100
// levels and 20,000 keys an object: "FILE: is not WHAT (a JSON object)". `adapt` brings what
// earlier versions wrote up to date.
JsonValue ReadJsonFile(const std::filesystem::path& file, std::string_view what,
                       std::uintmax_t most_bytes, void (*adapt)(JsonValue::Json&) = nullptr);

}  // namespace floorproof
