// SPDX-License-Identifier: Apache-2.0
#include "run/campaign/campaign_merge.h"

#include <algorithm>
#include <map>

namespace floorproof {
namespace {

constexpr std::size_t kBatch = 1000;

// The first column in which the rows of one episode differ; empty: none. Wall times are no result.
std::string Difference(const EpisodeRow& a, const EpisodeRow& b) {
  if (a.outcome != b.outcome) return "outcome, " + a.outcome + " and " + b.outcome;
  if (a.events_of != b.events_of || a.events != b.events) return "events";
  for (std::size_t i = 0; i < a.metrics.size(); ++i)
    if (a.metrics[i] != b.metrics[i]) return std::string(kMetrics[i].name);
  if (a.drawn != b.drawn) return "drawn";
  if (a.plan != b.plan) return "plan";
  return a.message == b.message ? "" : "message";
}

}  // namespace

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
          if (const std::string what = Difference(found->second, row); !what.empty())
            throw InputError({names[b], 0}, "", "",
                             "episode " + std::to_string(row.episode) + " of " + variant.name +
                                 " is not that of " + names[a] + ": they differ in " + what);
        };
        shards[a].ForEach(variant.name, note, true);
        shards[b].ForEach(variant.name, check, true);
      }
  }
}

std::uint64_t MergeRows(std::span<const CampaignStore> shards, std::span<const Variant> variants,
                        CampaignStore& into) {
  std::uint64_t end = 0;
  for (const Variant& variant : variants)
    for (const CampaignStore& shard : shards) {
      const std::vector<std::uint64_t> there = into.Episodes(variant.name);
      std::vector<EpisodeRow> batch;
      const auto copy = [&](const EpisodeRow& row) {
        end = std::max(end, row.episode + 1);
        if (std::ranges::binary_search(there, row.episode)) return;
        batch.push_back(row);
        if (batch.size() < kBatch) return;
        into.Add(batch);
        batch.clear();
      };
      shard.ForEach(variant.name, copy, true);
      into.Add(batch);
    }
  return end;
}

}  // namespace floorproof
