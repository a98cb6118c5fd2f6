// SPDX-License-Identifier: Apache-2.0
// The tables of campaign.sqlite, and statements over them. For the store's own files alone.
#pragma once

#include <sqlite3.h>

#include <algorithm>
#include <array>
#include <string>
#include <string_view>
#include <vector>

#include "run/campaign/campaign_schema.h"
#include "run/campaign/campaign_store.h"
#include "run/episode/encounter_table.h"

namespace floorproof {

inline constexpr int kFormat = 1;                            // of the database
inline constexpr std::size_t kFirst = 5 + kNumFailureModes;  // columns before the metrics

// The last columns of the tables of episodes: JSON.
struct RowText {
  std::string_view name;
  std::string EpisodeRow::*text;
};
inline constexpr std::array<RowText, 4> kTexts = {{{"drawn", &EpisodeRow::drawn},
                                                   {"plan", &EpisodeRow::plan},
                                                   {"events", &EpisodeRow::events},
                                                   {"timeout", &EpisodeRow::timeout}}};
inline constexpr std::size_t kLeastTexts = 3;  // files of earlier versions have no `timeout`

inline constexpr int kFirstOfEncounter = 4;  // column that is the encounter's own

// A prepared statement; its calls throw as the store's do.
struct CampaignStore::Statement {
  Statement(const CampaignStore& of, const std::string& sql) : store(of) {
    Check(sqlite3_prepare_v2(of.db_, sql.c_str(), -1, &handle, nullptr));
  }
  ~Statement() { sqlite3_finalize(handle); }
  Statement(const Statement&) = delete;
  Statement& operator=(const Statement&) = delete;

  void Check(int code) const {
    if (code != SQLITE_OK) store.Refuse(code);
  }
  void Bind(int at, const std::string& text) {
    Check(sqlite3_bind_text(handle, at, text.data(), static_cast<int>(text.size()),
                            SQLITE_TRANSIENT));
  }
  void Bind(int at, std::int64_t number) { Check(sqlite3_bind_int64(handle, at, number)); }
  void Bind(int at, std::optional<double> number) {
    Check(number ? sqlite3_bind_double(handle, at, *number) : sqlite3_bind_null(handle, at));
  }
  bool Step() {
    const int code = sqlite3_step(handle);
    if (code != SQLITE_ROW && code != SQLITE_DONE) store.Refuse(code);
    return code == SQLITE_ROW;
  }
  void Again() { Check(sqlite3_reset(handle)); }
  std::string Text(int column) const {
    const auto* text = reinterpret_cast<const char*>(sqlite3_column_text(handle, column));
    return text == nullptr
               ? ""
               : std::string(text, static_cast<std::size_t>(sqlite3_column_bytes(handle, column)));
  }

  // Where a SELECT * from a table of episodes has its metrics and texts; -1: it has not.
  struct Places {
    std::array<int, kMetrics.size()> metrics;
    std::array<int, kTexts.size()> texts;
  };
  Places PlacesOfColumns() const {
    Places places;
    places.metrics.fill(-1);
    places.texts.fill(-1);
    for (int i = 0; i < sqlite3_column_count(handle); ++i) {
      const std::string_view name = sqlite3_column_name(handle, i);
      if (const MetricColumn* metric = FindMetric(name))
        places.metrics[static_cast<std::size_t>(metric - kMetrics.data())] = i;
      if (const auto text = std::ranges::find(kTexts, name, &RowText::name); text != kTexts.end())
        places.texts[static_cast<std::size_t>(text - kTexts.begin())] = i;
    }
    return places;
  }

  // Of such a SELECT.
  EpisodeRow Row(const Places& places) const {
    EpisodeRow row;
    row.variant = Text(1);
    row.episode = static_cast<std::uint64_t>(sqlite3_column_int64(handle, 2));
    row.outcome = Text(3);
    row.message = Text(4);
    int at = 5;
    for (int& n : row.events_of) n = sqlite3_column_int(handle, at++);
    for (std::size_t i = 0; i < row.metrics.size(); ++i)
      if (const int column = places.metrics[i];
          column >= 0 && sqlite3_column_type(handle, column) != SQLITE_NULL)
        row.metrics[i] = sqlite3_column_double(handle, column);
    for (std::size_t i = 0; i < kTexts.size(); ++i)
      if (places.texts[i] >= 0) row.*kTexts[i].text = Text(places.texts[i]);
    return row;
  }

  // Of a SELECT of the columns of table `encounter` from kFirstOfEncounter on, which begin at this
  // one and stand last.
  Encounter EncounterAt(int column) const {
    const int end = sqlite3_column_count(handle);
    std::vector<EncounterValue> values;
    for (const EncounterColumn& of : EncounterColumns()) {
      if (column == end) break;
      if (of.is_text)
        values.emplace_back(Text(column));
      else
        values.emplace_back(sqlite3_column_double(handle, column));
      ++column;
    }
    return EncounterOf(values);
  }

  const CampaignStore& store;
  sqlite3_stmt* handle = nullptr;
};

}  // namespace floorproof
