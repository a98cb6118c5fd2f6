// SPDX-License-Identifier: Apache-2.0
// The tables of campaign.sqlite, as the text that makes them.
//
// SQLite stores the text of every table that a file has. Comparing this text with the text that
// this program writes shows everything that a foreign file could add: computed columns, defaults,
// checks, foreign keys, collations, views, triggers and indexes. It is compared before any row is
// read.
#pragma once

#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace floorproof {

struct Column {
  std::string name, type;
  bool operator==(const Column&) const = default;
};

// Columns of the tables `episode` and `extra`, in order.
std::vector<Column> EpisodeColumns();
// Columns of the table `encounter`, in order.
std::vector<Column> EncounterTableColumns();

// CREATE TABLE statements of this version, one for each table.
std::vector<std::string> CampaignTables();

struct CampaignSchema {
  std::vector<Column> episode;  // columns of `episode` and of `extra`
  bool has_encounters = false;  // the first versions had no such table
};

// Reads the schema of a file: the text of each table by its name. Other versions may have other
// metrics and may lack the table `encounter` or the column `timeout`. On any other difference
// returns why in `why`, a phrase.
CampaignSchema ReadSchema(const std::map<std::string, std::string>& tables, std::string& why);

}  // namespace floorproof
