// SPDX-License-Identifier: Apache-2.0
#include "run/scenario/matrix.h"

#include <algorithm>
#include <filesystem>
#include <set>

#include "base/json_schema.h"
#include "base/params.h"
#include "base/quantity.h"

namespace floorproof {
namespace {

constexpr std::size_t kMaxVariants = 1'000;
constexpr std::size_t kLongestName = 200;  // films and pictures carry it in their files' names

// What all variants share, their draws above all, and what is read before they are made.
const std::vector<std::string> kShared = {"scenario", "name",   "seed", "episode", "randomise",
                                          "sampling", "matrix", "gate", "files"};

[[noreturn]] void RefuseMany(const SourceMark& mark, const std::string& key, std::size_t count) {
  throw InputError(mark, key, CountText(count, "variant"),
                   "must be at most " + std::to_string(kMaxVariants) + " variants");
}

std::string LastPart(const std::string& key_path) {
  return key_path.substr(key_path.rfind('.') + 1);
}

// A file by its stem; a value as it is written.
std::string Label(const std::string& value) {
  const std::filesystem::path path(value);
  for (const char* extension : {".yaml", ".yml", ".xml", ".csv"})
    if (path.extension() == extension) return path.stem().string();
  return value;
}

// One list's entries, each with its name and what it changes.
std::vector<Variant> Axis(const std::string& key, const ConfigNode& list) {
  const std::string path = "matrix." + key;
  if (!list.IsList() || list.items.empty())
    throw InputError(list.mark, path, list.scalar, "must be a list of a value or more");
  if (list.items.size() > kMaxVariants) RefuseMany(list.mark, path, list.items.size());
  std::vector<Variant> axis;
  std::set<std::string> names;
  for (const ConfigNode& item : list.items) {
    Variant variant;
    if (item.IsScalar()) {
      variant.name = LastPart(key) + "=" + Label(item.scalar);
      variant.overrides.emplace_back(key, item);
    } else if (const ConfigNode* label = item.Find("label"); label != nullptr) {
      variant.name = LastPart(key) + "=" + AsString(*label, path + ".label");
      for (const auto& [name, value] : item.entries)
        if (name != "label") variant.overrides.emplace_back(name, value);
    } else {
      throw InputError(item.mark, path, "",
                       "must be a value, or a map with a label and keys that change together");
    }
    for (const auto& [name, value] : variant.overrides)
      if (std::ranges::find(kShared, name.substr(0, name.find('.'))) != kShared.end())
        throw InputError(value.mark, path, name, "this key cannot differ between variants");
    if (variant.name.find_first_of(",:/\n") != std::string::npos)
      throw InputError(
          item.mark, path, variant.name,
          "a variant's name, its label where it has one, has no comma, colon, slash or line break");
    if (!names.insert(variant.name).second)
      throw InputError(item.mark, path, variant.name, "two variants of one name: give them labels");
    axis.push_back(std::move(variant));
  }
  return axis;
}

}  // namespace

ConfigNode MatrixSchema() {
  ConfigNode labelled = AnyKeysSchema(AnythingSchema(), kShared);
  labelled.Add("properties", ConfigNode::Map()).Add("label", TextSchema());
  labelled.Add("required", ConfigNode::List({ConfigNode::Scalar("label", true)}));
  return AnyOf(
      {AnyKeysSchema(ListSchema(AnyOf({TextSchema(), std::move(labelled)}), 1, kMaxVariants)),
       NoneSchema()});
}

std::vector<Variant> ReadMatrix(const ConfigNode* node) {
  if (node == nullptr || node->IsNull()) return {{"default", {}}};
  if (!node->IsMap() || node->entries.empty())
    throw InputError(node->mark, "matrix", node->scalar, "must be a map of key: list of values");
  std::vector<Variant> variants = {{"", {}}};
  for (const auto& [key, list] : node->entries) {
    const std::vector<Variant> axis = Axis(key, list);
    if (const std::size_t count = variants.size() * axis.size(); count > kMaxVariants)
      RefuseMany(node->mark, "matrix", count);
    std::vector<Variant> product;
    for (const Variant& base : variants)
      for (const Variant& entry : axis) {
        Variant variant = base;
        for (const auto& [name, value] : entry.overrides)
          for (const auto& [before, _] : base.overrides)
            if (before == name || before.starts_with(name + "."))
              throw InputError(value.mark, "matrix." + key, name,
                               "a key above sets " + before + ", which this would undo");
        variant.name += (base.name.empty() ? "" : ",") + entry.name;
        variant.overrides.insert(variant.overrides.end(), entry.overrides.begin(),
                                 entry.overrides.end());
        if (variant.name.size() > kLongestName)
          throw InputError(list.mark, "matrix." + key, variant.name,
                           "a variant's name has at most " + std::to_string(kLongestName) +
                               " bytes: give the values shorter labels");
        product.push_back(std::move(variant));
      }
    variants = std::move(product);
  }
  return variants;
}

}  // namespace floorproof
