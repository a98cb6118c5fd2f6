// SPDX-License-Identifier: Apache-2.0
// Whether a file is a campaign's database, whole and of this version: whoever made it is not
// trusted.
#include <algorithm>
#include <cmath>
#include <map>

#include "base/config.h"
#include "base/error.h"
#include "base/file_output.h"
#include "base/printable.h"
#include "run/campaign/campaign_about.h"
#include "run/campaign/campaign_tables.h"
#include "run/campaign/drive_campaign.h"
#include "run/episode/bounded_json.h"

namespace floorproof {
namespace {

namespace fs = std::filesystem;

// Ends a statement that takes more steps of SQLite's machine, or more of its memory, than the file
// explains. SQLite reads the schema before anything of it can be checked.
class ReadLimit {
 public:
  ReadLimit(sqlite3* db, const fs::path& file) : db_(db) {
    std::error_code error;
    const std::uintmax_t bytes = fs::file_size(file, error);
    left_ = 100'000 + (error ? 0 : static_cast<std::int64_t>(bytes / 100));
    sqlite3_progress_handler(
        db, 1000, [](void* self) { return static_cast<ReadLimit*>(self)->IsOver() ? 1 : 0; }, this);
  }
  ~ReadLimit() { sqlite3_progress_handler(db_, 0, nullptr, nullptr); }
  ReadLimit(const ReadLimit&) = delete;
  ReadLimit& operator=(const ReadLimit&) = delete;

 private:
  static constexpr std::int64_t kMaxMemory_bytes = 64 << 20;
  bool IsOver() { return --left_ < 0 || sqlite3_memory_used() - before_ > kMaxMemory_bytes; }

  sqlite3* db_;
  std::int64_t left_;  // thousands of steps
  const std::int64_t before_ = sqlite3_memory_used();
};

// Why a value of the row cannot be its column's, a phrase; empty: all can.
std::string WhyWrongValue(sqlite3_stmt* row, const std::vector<Column>& columns) {
  for (int i = 0; i < static_cast<int>(columns.size()); ++i) {
    const auto& [name, declared] = columns[static_cast<std::size_t>(i)];
    const int type = sqlite3_column_type(row, i);
    const std::string where = "in column " + name + " ";
    if (declared.starts_with("TEXT")) {
      if (type != SQLITE_TEXT) return where + "is no text";
      const auto* text = reinterpret_cast<const char*>(sqlite3_column_text(row, i));
      if (!IsUtf8Text({text, static_cast<std::size_t>(sqlite3_column_bytes(row, i))}))
        return where + "is no UTF-8";
    } else if (declared.starts_with("INTEGER")) {
      if (type != SQLITE_INTEGER) return where + "is no whole number";
      const std::int64_t count = sqlite3_column_int64(row, i);
      if (count < 0 || count > kMostEpisodes) return where + "is out of range";
    } else if (type != SQLITE_FLOAT && type != SQLITE_INTEGER) {
      if (type != SQLITE_NULL || declared != "REAL") return where + "is no number";
    } else if (!std::isfinite(sqlite3_column_double(row, i))) {
      return where + "is not finite";
    }
  }
  return "";
}

// As this version calls it.
std::string NameNow(const std::string& column) {
  const MetricColumn* metric = FindMetric(column);
  return metric == nullptr ? column : std::string(metric->name);
}

}  // namespace

void CampaignStore::Check() {
  const ReadLimit limit(db_, file_);
  const CampaignSchema schema = CheckTables();
  {
    Statement check(*this, "PRAGMA quick_check(1)");
    if (check.Step() && check.Text(0) != "ok")
      throw InputError({file_.string(), 0}, "", "",
                       "is damaged (" + check.Text(0) + "); it was left as it is");
  }
  ReadAbout();
  CheckRows(schema.episode);
  CheckEncounters();
  sound_ = true;
}

void CampaignStore::ReadAbout() {
  try {
    Statement select(*this, "SELECT key, value FROM about");
    std::string format;
    while (select.Step()) {
      const std::string key = select.Text(0), value = select.Text(1);
      if (key == "format") format = value;
      if (key == "campaign") about_.id = value;
      if (key == "scenario") about_.scenario = value;
      if (key == "versions") about_.versions = value;
      if (key == "asked") asked_ = std::strtoull(value.c_str(), nullptr, 10);
    }
    if (format == std::to_string(kFormat) && IsUtf8Text(about_.id) && asked_ <= kMostEpisodes &&
        WhyUnboundedJson(about_.versions).empty()) {
      ParseYaml(about_.scenario, file_.string() + ", scenario");
      VersionsOf(about_);
      return;
    }
  } catch (const DiskError&) {
    throw;
  } catch (const InternalError&) {
  }
  throw InputError({file_.string(), 0}, "", "", "is not a campaign's database (table about)");
}

// No views, triggers or indexes, and no table but a campaign's own, made by the program's own text.
CampaignSchema CampaignStore::CheckTables() {
  const auto refuse = [&](const std::string& what) {
    throw InputError({file_.string(), 0}, "", "", "is not a campaign's database (" + what + ")");
  };
  Statement schema(*this, "SELECT type, name, sql FROM sqlite_schema");
  std::map<std::string, std::string> tables;
  while (schema.Step()) {
    const std::string type = schema.Text(0), name = schema.Text(1);
    if (type != "table" || !schema.Text(2).starts_with("CREATE TABLE "))
      refuse("it holds a " + (type == "table" ? "virtual table" : type) + " " + name);
    if (!tables.emplace(name, schema.Text(2)).second) refuse("it holds two tables " + name);
  }
  std::string why;
  CampaignSchema read = ReadSchema(tables, why);
  if (!why.empty()) refuse(why);
  has_encounters_ = read.has_encounters;
  return read;
}

// No check of the database reads what lies in a row's further pages; and a text may be JSON of
// another kind than is asked for later, when rows have been added.
void CampaignStore::CheckRows(const std::vector<Column>& columns) const {
  for (const std::string table : {"episode", "extra"}) {
    Statement select(*this, "SELECT * FROM " + table);
    const auto places = select.PlacesOfColumns();
    while (select.Step()) {
      std::string why = WhyWrongValue(select.handle, columns);
      if (why.empty()) why = WhyUnreadableRow(select.Row(places));
      if (!why.empty()) RefuseRow(table, why);
    }
  }
}

void CampaignStore::CheckEncounters() const {
  if (!has_encounters_) return;
  const std::vector<Column> columns = EncounterTableColumns();
  const auto size = std::ranges::find(columns, "size", &Column::name) - columns.begin();
  Statement select(*this, "SELECT * FROM encounter");
  while (select.Step()) {
    std::string why = WhyWrongValue(select.handle, columns);
    if (why.empty()) why = WhyUnboundedJson(select.Text(static_cast<int>(size)));
    try {
      if (why.empty()) select.EncounterAt(kFirstOfEncounter);
    } catch (const InternalError&) {
      why = "is none of an encounter";
    }
    if (!why.empty()) RefuseRow("encounter", why);
  }
}

void CampaignStore::RefuseRow(const std::string& table, const std::string& why) const {
  throw InputError(
      {file_.string(), 0}, "", "",
      "is damaged (a value of a row of table " + table + " " + why + "); it was left as it is");
}

// A row is written by the places of its columns.
void CampaignStore::RequireColumns() const {
  if (!has_encounters_)
    throw InputError({file_.string(), 0}, "", "",
                     "is another version's: it has no table encounter; it can be read, not gone on "
                     "with: start anew in another folder");
  std::vector<std::string> wanted;
  for (const Column& column : EpisodeColumns()) wanted.push_back(column.name);
  for (const std::string table : {"episode", "extra"}) {
    std::vector<std::string> there;
    Statement info(*this, "PRAGMA table_info(" + table + ")");
    while (info.Step()) there.push_back(NameNow(info.Text(1)));
    if (there == wanted) continue;
    const auto lacked = [](const auto& from, const auto& in) {
      return std::ranges::find_if(
          from, [&](const auto& name) { return std::ranges::find(in, name) == in.end(); });
    };
    std::string what = "has its columns in another order";
    if (const auto missing = lacked(wanted, there); missing != wanted.end())
      what = "has no column " + *missing;
    else if (const auto unknown = lacked(there, wanted); unknown != there.end())
      what = "has a column " + *unknown + " that is not known";
    throw InputError({file_.string(), 0}, "", "",
                     "is another version's: its table " + table + " " + what +
                         "; it can be read, not gone on with: start anew in another folder");
  }
}

}  // namespace floorproof
