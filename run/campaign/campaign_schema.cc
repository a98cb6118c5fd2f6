// SPDX-License-Identifier: Apache-2.0
#include "run/campaign/campaign_schema.h"

#include <algorithm>
#include <array>
#include <optional>

#include "run/campaign/campaign_tables.h"
#include "run/episode/encounter_table.h"

namespace floorproof {
namespace {

constexpr std::string_view kText = "TEXT NOT NULL", kCount = "INTEGER NOT NULL", kReal = "REAL",
                           kRealSet = "REAL NOT NULL";
constexpr std::array kTypes = {kText, kCount, kReal, kRealSet};
constexpr std::string_view kAbout =
    "CREATE TABLE about (key TEXT PRIMARY KEY, value TEXT NOT NULL) WITHOUT ROWID";
constexpr std::string_view kTiming =
    "CREATE TABLE timing (variant TEXT NOT NULL, episode INTEGER NOT NULL, wall_s REAL NOT NULL, "
    "PRIMARY KEY (variant, episode)) WITHOUT ROWID";

std::string Begin(std::string_view table) { return "CREATE TABLE " + std::string(table) + " ("; }
std::string End(std::string_view table) {
  return std::string("PRIMARY KEY (campaign, variant, episode") +
         (table == "encounter" ? ", number" : "") + ")) WITHOUT ROWID";
}

std::string TableText(std::string_view table, const std::vector<Column>& columns) {
  std::string text = Begin(table);
  for (const Column& column : columns) text += column.name + " " + column.type + ", ";
  return text + End(table);
}

bool IsPlainName(std::string_view name) {
  return !name.empty() && name.size() <= 64 && std::ranges::all_of(name, [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || c == '_';
  });
}

// The inverse of TableText; none if the text is any other.
std::optional<std::vector<Column>> ColumnsIn(std::string_view text, std::string_view table) {
  const std::string begin = Begin(table), end = End(table);
  if (text.size() < begin.size() + end.size() || !text.starts_with(begin) || !text.ends_with(end))
    return std::nullopt;
  text = text.substr(begin.size(), text.size() - begin.size() - end.size());
  std::vector<Column> columns;
  while (!text.empty()) {
    const std::size_t comma = text.find(", "), space = text.find(' ');
    if (comma == text.npos || space >= comma) return std::nullopt;
    const std::string_view name = text.substr(0, space);
    const std::string_view type = text.substr(space + 1, comma - space - 1);
    if (!IsPlainName(name) || std::ranges::find(kTypes, type) == kTypes.end()) return std::nullopt;
    columns.push_back({std::string(name), std::string(type)});
    text.remove_prefix(comma + 2);
  }
  return columns;
}

// The first columns are the same in all versions. Behind them are the metrics of whatever version,
// and the texts.
bool AreOfEpisodes(const std::vector<Column>& columns) {
  const std::vector<Column> now = EpisodeColumns();
  if (columns.size() < kFirst + kLeastTexts ||
      !std::equal(columns.begin(), columns.begin() + kFirst, now.begin()))
    return false;
  std::size_t texts = 0;
  for (std::size_t i = kFirst; i < columns.size(); ++i) {
    const bool is_text = std::ranges::find(kTexts, columns[i].name, &RowText::name) != kTexts.end();
    texts += is_text;
    if (columns[i].type != (is_text ? kText : kReal)) return false;
  }
  return texts >= kLeastTexts;
}

}  // namespace

std::vector<Column> EpisodeColumns() {
  const std::string text(kText), count(kCount);
  std::vector<Column> columns = {{"campaign", text},
                                 {"variant", text},
                                 {"episode", count},
                                 {"outcome", text},
                                 {"message", text}};
  for (int mode = 0; mode < kNumFailureModes; ++mode)
    columns.push_back({std::string(Name(static_cast<FailureMode>(mode))), count});
  for (const MetricColumn& metric : kMetrics)
    columns.push_back({std::string(metric.name), std::string(kReal)});
  for (const RowText& t : kTexts) columns.push_back({std::string(t.name), text});
  return columns;
}

std::vector<Column> EncounterTableColumns() {
  const std::string text(kText), count(kCount);
  std::vector<Column> columns = {
      {"campaign", text}, {"variant", text}, {"episode", count}, {"number", count}};
  for (const EncounterColumn& column : EncounterColumns())
    columns.push_back({std::string(column.name), std::string(column.is_text ? kText : kRealSet)});
  return columns;
}

std::vector<std::string> CampaignTables() {
  return {std::string(kAbout), TableText("episode", EpisodeColumns()),
          TableText("extra", EpisodeColumns()), TableText("encounter", EncounterTableColumns()),
          std::string(kTiming)};
}

CampaignSchema ReadSchema(const std::map<std::string, std::string>& tables, std::string& why) {
  CampaignSchema schema;
  schema.has_encounters = tables.contains("encounter");
  if (tables.size() != (schema.has_encounters ? 5 : 4) ||
      std::ranges::any_of(std::array{"about", "episode", "extra", "timing"},
                          [&](const char* name) { return !tables.contains(name); })) {
    why = tables.empty() ? "table about"
                         : "its tables are not about, encounter, episode, extra, timing";
    return schema;
  }
  for (const auto& [name, text] : {std::pair("about", kAbout), {"timing", kTiming}})
    if (tables.at(name) != text) why = std::string("table ") + name + " has not the columns of one";
  for (const std::string name : {"episode", "extra"}) {
    const auto columns = ColumnsIn(tables.at(name), name);
    if (!columns || !AreOfEpisodes(*columns))
      why = "table " + name + " has not the columns of one";
    else if (schema.episode.empty())
      schema.episode = *columns;
    // Rows of both are read by one statement, by the places of their columns.
    else if (*columns != schema.episode)
      why = "tables episode and extra have not the same columns";
    if (!why.empty()) return schema;
  }
  if (schema.has_encounters &&
      tables.at("encounter") != TableText("encounter", EncounterTableColumns()))
    why = "table encounter has not the columns of one, or another version's";
  return schema;
}

}  // namespace floorproof
