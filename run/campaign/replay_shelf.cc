// SPDX-License-Identifier: Apache-2.0
#include "run/campaign/replay_shelf.h"

#include <charconv>

#include "base/error.h"
#include "base/file_output.h"
#include "base/result_folder.h"

namespace floorproof {
namespace {

namespace fs = std::filesystem;

constexpr const char* kReplay = "replay.bin";

ResultNames ReplayResults() {
  return {"episode", [](std::string_view name) { return name == kReplay; }, false};
}

}  // namespace

fs::path VariantFolder(const fs::path& campaign, const std::string& variant) {
  if (variant.find('/') != std::string::npos || variant == "." || variant == "..")
    throw InputError({campaign.string(), 0}, "variant", variant, "must not lead out of its folder");
  return campaign / "episodes" / variant;
}

fs::path EpisodeFolder(const fs::path& campaign, const std::string& variant,
                       std::uint64_t episode) {
  return VariantFolder(campaign, variant) / std::to_string(episode);
}

bool IsListed(const EpisodeRow& row) { return row.outcome != "success" || row.any_failure(); }

std::set<std::uint64_t>& ReplayShelf::Of(const std::string& variant) {
  const auto [entry, is_new] = kept_.try_emplace(variant);
  if (!is_new) return entry->second;
  std::error_code ignored;
  for (const auto& folder : fs::directory_iterator(VariantFolder(campaign_, variant), ignored)) {
    const std::string name = folder.path().filename().string();
    std::uint64_t id = 0;
    const auto [end, error] = std::from_chars(name.data(), name.data() + name.size(), id);
    if (error == std::errc() && end == name.data() + name.size() &&
        fs::exists(folder.path() / kReplay, ignored))
      entry->second.insert(id);
  }
  return entry->second;
}

void ReplayShelf::Take(const EpisodeRow& row) {
  if (row.replay.empty() || !IsListed(row)) return;
  std::set<std::uint64_t>& kept = Of(row.variant);
  if (kept.size() >= kMost && row.episode > *kept.rbegin()) return;
  const fs::path folder = EpisodeFolder(campaign_, row.variant, row.episode);
  RefuseLinks(campaign_, folder);
  {
    ResultFolder out(folder, ReplayResults(), {});
    out.Begin();
    WriteFileWhole(folder / kReplay, row.replay);
  }
  kept.insert(row.episode);
  if (kept.size() <= kMost) return;
  const std::uint64_t last = *kept.rbegin();
  kept.erase(last);
  const fs::path displaced = EpisodeFolder(campaign_, row.variant, last);
  std::error_code ignored;
  if (fs::exists(displaced / "result.json", ignored)) return;  // driven again since: it is whole
  fs::remove(displaced / kReplay, ignored);
  fs::remove(displaced / "files.sha256", ignored);
  fs::remove(displaced, ignored);
}

}  // namespace floorproof
