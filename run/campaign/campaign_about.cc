// SPDX-License-Identifier: Apache-2.0
#include "run/campaign/campaign_about.h"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "base/file_output.h"
#include "base/quantity.h"
#include "run/episode/records.h"
#include "run/scenario/resolved_scenario.h"
#include "run/scenario/scenario_file.h"

namespace floorproof {
namespace {

namespace fs = std::filesystem;

// The first key whose values differ, with both; empty: none.
std::string WhatDiffers(const ConfigNode& a, const ConfigNode& b, const std::string& path) {
  const auto shown = [](const ConfigNode* node) {
    if (node == nullptr) return std::string("nothing");
    if (node->IsList()) return CountText(node->items.size(), "value");
    return node->IsScalar() ? node->scalar
                            : std::string(node->IsNull() ? "nothing" : "other parts");
  };
  const auto below = [&](const std::string& key) { return path.empty() ? key : path + "." + key; };
  if (a.IsMap() && b.IsMap()) {
    for (const auto& [key, value] : a.entries) {
      const ConfigNode* other = b.Find(key);
      if (other == nullptr) return below(key) + " was " + shown(&value) + ", is not there now";
      if (std::string text = WhatDiffers(value, *other, below(key)); !text.empty()) return text;
    }
    for (const auto& [key, value] : b.entries)
      if (a.Find(key) == nullptr) return below(key) + " was not there, is " + shown(&value);
    return "";
  }
  if (a.IsList() && b.IsList() && a.items.size() == b.items.size()) {
    for (std::size_t i = 0; i < a.items.size(); ++i)
      if (std::string text = WhatDiffers(a.items[i], b.items[i], below(std::to_string(i)));
          !text.empty())
        return text;
    return "";
  }
  if (WriteYaml(a) == WriteYaml(b)) return "";
  return path + " was " + shown(&a) + ", is " + shown(&b);
}

}  // namespace

CampaignAbout DescribeCampaign(const ScenarioFile& file) {
  const Scenario base = file.Read(std::nullopt);
  // All files that an episode may read, those that only variants or draws name too.
  for (const Variant& variant : file.variants()) file.Read(std::nullopt, variant);
  file.CheckDraws();
  const fs::path folder = base.spec.file.parent_path();  // shards are driven anywhere
  ConfigNode resolved = ParseYaml(ResolvedScenario(base, folder, file.files().All()), "scenario");
  if (ConfigNode* files = resolved.Find("files"))  // in whatever order they were read
    std::ranges::sort(files->entries,
                      [](const auto& x, const auto& y) { return x.first < y.first; });

  CampaignAbout about;
  about.scenario = WriteYaml(resolved);
  about.versions = VersionsJson().dump();
  about.id = Sha256(about.scenario + about.versions).substr(0, 16);
  return about;
}

std::vector<std::pair<std::string, std::string>> VersionsOf(const CampaignAbout& about) {
  try {
    std::vector<std::pair<std::string, std::string>> versions;
    const auto json = nlohmann::ordered_json::parse(about.versions);
    for (const auto& [name, version] : json.items()) versions.emplace_back(name, version);
    return versions;
  } catch (const nlohmann::ordered_json::exception& e) {
    throw InternalError(e.what());
  }
}

void RequireSame(const CampaignAbout& there, const CampaignAbout& now,
                 const std::filesystem::path& where) {
  if (there.id == now.id) return;
  const auto parse = [](const std::string& text) { return ParseYaml(text, "campaign"); };
  std::string difference = WhatDiffers(parse(there.versions), parse(now.versions), "version");
  if (difference.empty()) difference = WhatDiffers(parse(there.scenario), parse(now.scenario), "");
  if (difference.empty()) difference = "its keys stand in another order";
  throw InputError({where.string(), 0}, "", "", "holds another campaign: " + difference);
}

bool HoldsDatabase(const fs::path& folder, const char* name, const char* what, bool resume) {
  std::error_code ignored;
  if (!fs::exists(folder / name, ignored)) return false;
  if (!resume)
    throw InputError(
        {folder.string(), 0}, "", "",
        std::string("holds ") + what + ": --resume goes on with it, --out names another folder");
  return true;
}

CampaignStore OpenOrCreate(const fs::path& file, const CampaignAbout& about, bool there) {
  if (!there) {
    MakeFolder(file.parent_path());
    return CampaignStore::Create(file, about);
  }
  CampaignStore store = CampaignStore::Open(file, false);
  RequireSame(store.about(), about, file);
  store.MakeWritable();
  return store;
}

}  // namespace floorproof
