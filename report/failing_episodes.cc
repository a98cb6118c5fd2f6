// SPDX-License-Identifier: Apache-2.0
#include "report/failing_episodes.h"

#include <fmt/format.h>

#include "base/file_output.h"
#include "base/printable.h"
#include "base/quantity.h"
#include "base/shell_word.h"
#include "base/words.h"
#include "env/core/failure_text.h"
#include "run/campaign/episodes_csv.h"
#include "run/campaign/replay_shelf.h"

namespace floorproof {

std::string WhatFailed(const EpisodeRow& row, const std::vector<Event>& events) {
  if (events.empty()) return Words(row.outcome);
  return FailureName(events.front());
}

ReportEpisode FailingEpisode(const EpisodeRow& row, const std::vector<Event>& events,
                             const std::string& named, bool variants) {
  ReportEpisode e{.variant = row.variant, .episode = row.episode, .what = WhatFailed(row, events)};
  e.detail = events.empty() ? row.message : events.front().hazard;
  if (!events.empty()) {
    e.t_s = events.front().t_s;
    e.x_m = events.front().x_m;
    e.y_m = events.front().y_m;
    e.further = static_cast<int>(events.size()) - 1;
  } else if (const std::optional<Timeout> timeout = TimeoutOf(row)) {
    e.t_s = timeout->t_s;
    e.x_m = timeout->X_WB.x_m;
    e.y_m = timeout->X_WB.y_m;
    if (!timeout->hazard.empty()) e.detail = timeout->hazard;
  }
  e.command = fmt::format("floorproof replay {} --episode {}", ShellWord(named), row.episode);
  if (variants) e.command += " --variant " + ShellWord(row.variant);
  e.command += " --video";
  return e;
}

std::uint64_t ListFailingEpisodes(const CampaignStore& store, const std::vector<Variant>& variants,
                                  const std::filesystem::path& folder, const Console& console) {
  constexpr std::uint64_t kShown = 3;  // of each variant
  std::string csv = "variant,episode,outcome,what,hazard_or_reason,t_s,x_m,y_m,drawn,command\n";
  std::uint64_t all = 0, shown = 0;
  for (const Variant& variant : variants) {
    std::uint64_t listed = 0;
    store.ForEach(variant.name, [&](const EpisodeRow& row) {
      if (!IsListed(row)) return;
      const ReportEpisode e =
          FailingEpisode(row, EventsOf(row), folder.string(), variants.size() > 1);
      const auto number = [](const std::optional<double>& value) {
        return value ? fmt::format("{}", *value) : "";
      };
      csv += fmt::format("{},{},{},{},{},{},{},{},{},{}\n", CsvField(e.variant), e.episode,
                         row.outcome, CsvField(e.what), CsvField(e.detail), number(e.t_s),
                         number(e.x_m), number(e.y_m), CsvField(row.drawn), CsvField(e.command));
      ++all;
      if (listed++ >= kShown || shown >= 4 * kShown) return;
      ++shown;
      console.Say(fmt::format("  {}{}{}: {}", e.what, e.detail.empty() ? "" : ", " + e.detail,
                              e.t_s ? " at " + FixedText(*e.t_s, 1) + " s" : "", e.command));
    });
  }
  WriteFileWhole(folder / "failing_episodes.csv", csv);
  return all;
}

}  // namespace floorproof
