// SPDX-License-Identifier: Apache-2.0
#include "run/campaign/campaign_merge.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <set>

#include "base/file_output.h"
#include "base/input_file.h"
#include "base/input_files.h"
#include "run/campaign/campaign_about.h"
#include "run/campaign/campaign_files.h"
#include "run/campaign/replay_shelf.h"
#include "run/scenario/resolved_scenario.h"
#include "run/scenario/scenario_file.h"

namespace floorproof {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kBatch = 1000;

// The first column in which the rows of one episode differ; empty: none. Wall times are no result.
std::string DifferenceOfRows(const EpisodeRow& a, const EpisodeRow& b) {
  if (a.outcome != b.outcome) return "outcome, " + a.outcome + " and " + b.outcome;
  if (a.events_of != b.events_of || a.events != b.events) return "events";
  for (std::size_t i = 0; i < a.metrics.size(); ++i)
    if (a.metrics[i] != b.metrics[i]) return std::string(kMetrics[i].name);
  if (a.drawn != b.drawn) return "drawn";
  if (a.plan != b.plan) return "plan";
  return a.message == b.message ? "" : "message";
}

// Episodes that stand in two shards must be the same in both. Throws InputError naming the shards
// (`names`, as `shards`), variant, episode and the column that differs.
void CheckOverlaps(std::span<const CampaignStore> shards, std::span<const std::string> names,
                   std::span<const Variant> variants) {
  for (const Variant& variant : variants) {
    std::vector<std::vector<std::uint64_t>> ids;
    for (const CampaignStore& shard : shards) ids.push_back(shard.Episodes(variant.name));
    for (std::size_t a = 0; a < shards.size(); ++a)
      for (std::size_t b = a + 1; b < shards.size(); ++b) {
        std::vector<std::uint64_t> both;
        std::ranges::set_intersection(ids[a], ids[b], std::back_inserter(both));
        if (both.empty()) continue;
        std::map<std::uint64_t, EpisodeRow> rows;
        const auto shared = [&](const EpisodeRow& row) {
          return std::ranges::binary_search(both, row.episode);
        };
        const auto note = [&](const EpisodeRow& row) {
          if (shared(row)) rows[row.episode] = row;
        };
        const auto check = [&](const EpisodeRow& row) {
          const auto found = rows.find(row.episode);
          if (found == rows.end()) return;
          if (const std::string what = DifferenceOfRows(found->second, row); !what.empty())
            throw InputError({names[b], 0}, "", "",
                             "episode " + std::to_string(row.episode) + " of " + variant.name +
                                 " is not that of " + names[a] + ": they differ in " + what);
        };
        shards[a].ForEach(variant.name, note, true);
        shards[b].ForEach(variant.name, check, true);
      }
  }
}

// Copies each episode once, with the plan that a program made for it; returns the number behind the
// last one. `names`, as `shards`: their folders.
std::uint64_t MergeRows(std::span<const CampaignStore> shards, std::span<const std::string> names,
                        std::span<const Variant> variants, CampaignStore& into) {
  std::uint64_t end = 0;
  for (const Variant& variant : variants)
    for (std::size_t i = 0; i < shards.size(); ++i) {
      const CampaignStore& shard = shards[i];
      std::set<std::string> taken;
      const std::vector<std::uint64_t> there = into.Episodes(variant.name);
      std::vector<EpisodeRow> batch;
      const auto copy = [&](const EpisodeRow& row) {
        end = std::max(end, row.episode + 1);
        if (std::ranges::binary_search(there, row.episode)) return;
        batch.push_back(row);
        batch.back().encounters = shard.EncountersOf(variant.name, row.episode);
        if (const std::string made = MadePlan(row); !made.empty() && taken.insert(made).second)
          batch.back().made = ReadInputFile(FindCopy(names[i], made), kMaxResultBytes);
        if (batch.size() < kBatch) return;
        into.Add(batch);
        batch.clear();
      };
      shard.ForEach(variant.name, copy, true);
      into.Add(batch);
    }
  return end;
}

bool IsFixed(const ScenarioFile& scenario, std::uint64_t n) {
  const auto gate = CampaignGate::Read(scenario.gate(), n, scenario.drives());
  return gate && gate->fixed();
}

// Writes the settings with their paths valid from `out`; as they are where what they name is gone.
// Returns what to say of that.
std::string WriteSettings(const fs::path& settings, const fs::path& out) {
  std::optional<ScenarioFile> scenario;
  std::optional<Scenario> base;
  try {
    base = scenario.emplace(settings).Read(std::nullopt);
  } catch (const InputError& e) {
    const fs::path file = out / "scenario.resolved.yaml";
    WriteFileWhole(file, ReadInputFile(settings, kMaxResultBytes));
    return fmt::format("{}: its paths hold from {}, not from here ({})", file.string(),
                       settings.parent_path().string(), e.what());
  }
  WriteResolvedScenario(*base, out, scenario->files().All());
  return "";
}

// What `there`, ascending, lacks of 0:end.
std::vector<EpisodeRange> Missing(const std::vector<std::uint64_t>& there, std::uint64_t end) {
  std::vector<EpisodeRange> missing;
  std::uint64_t next = 0;
  const auto gap = [&](std::uint64_t to) {
    if (to > next) missing.push_back({next, to});
    next = to + 1;
  };
  for (const std::uint64_t episode : there) gap(std::min(episode, end));
  gap(end);
  return missing;
}

void RefuseCampaign(const fs::path& folder) {
  std::error_code ignored;
  if (fs::exists(folder / "campaign.sqlite", ignored))
    throw InputError({folder.string(), 0}, "", "", "holds a campaign: --out names another folder");
}

}  // namespace

namespace {

// Replays go with their episodes: as many as one campaign would have kept.
void CarryReplays(const std::vector<CampaignStore>& from, const std::vector<std::string>& shards,
                  const std::vector<Variant>& variants, const fs::path& out) {
  constexpr std::uintmax_t kLargest = 16u << 20;
  ReplayShelf shelf(out);
  for (std::size_t i = 0; i < from.size(); ++i)
    for (const Variant& variant : variants)
      from[i].ForEach(variant.name, [&](const EpisodeRow& row) {
        if (!IsListed(row)) return;
        EpisodeRow carried = row;
        carried.replay = ReadPlainFile(
            EpisodeFolder(shards[i], row.variant, row.episode) / "replay.bin", kLargest);
        shelf.Take(carried);
      });
}

}  // namespace

MergeOutcome MergeCampaigns(const std::vector<std::string>& shards, const fs::path& out) {
  if (shards.empty()) throw InputError({}, "shards", "", "there are none to merge");
  const fs::path file = out / "campaign.sqlite";
  RefuseCampaign(out);
  SayWhenInterrupted(out.string() + " is as before, or holds part of the shards");
  std::vector<CampaignStore> from;
  for (const std::string& shard : shards) {
    from.push_back(CampaignStore::Open(fs::path(shard) / "campaign.sqlite", false));
    RequireSame(from.front().about(), from.back().about(), shard);
  }
  const ScenarioFile scenario =
      ScenarioFile::Recorded(fs::path(shards.front()) / "scenario.resolved.yaml");
  const std::vector<Variant>& variants = scenario.variants();
  CheckOverlaps(from, shards, variants);
  for (std::size_t i = 1; i < from.size(); ++i)
    if (from[i].asked() != from[0].asked() && IsFixed(scenario, from[i].asked()))
      throw InputError({shards[i], 0}, "-n", std::to_string(from[i].asked()),
                       fmt::format("{} was driven with -n {}: a fixed gate is judged at one n",
                                   shards[0], from[0].asked()));

  auto hold = std::make_unique<HoldInterrupts>();
  auto results =
      std::make_unique<ResultFolder>(out, CampaignResults(), std::span<const fs::path>());
  results->Begin();
  RefuseCampaign(out);  // another may have begun it since
  CampaignStore store = CampaignStore::Create(file, from.front().about());
  std::uint64_t end = MergeRows(from, shards, variants, store);
  for (const CampaignStore& shard : from) end = std::max(end, shard.asked());
  CarryReplays(from, shards, variants, out);
  store.SetAsked(end);
  std::string paths_note = WriteSettings(scenario.file(), out);
  CampaignOptions options;
  options.end = end;
  options.jobs = 0;  // nothing more is driven
  options.gate = CampaignGate::Read(scenario.gate(), end, scenario.drives());
  CampaignRun run = RunCampaign(scenario, store, options);
  std::vector<MergeGap> gaps;
  for (std::size_t v = 0; v < variants.size(); ++v)
    if (run.end == CampaignEnd::kMissing && run.variants[v].prefix < end)
      gaps.push_back({variants[v].name, Missing(store.Episodes(variants[v].name), end)});
  CampaignSummary summary = WriteSummaryFiles(store, scenario, run, out);
  store.RequireInPlace();
  results->RequireInPlace({"scenario.resolved.yaml", "summary.json"});
  return {{std::move(hold), std::move(results), std::move(store), variants, std::move(run),
           std::move(summary)},
          std::move(paths_note),
          std::move(gaps)};
}

}  // namespace floorproof
