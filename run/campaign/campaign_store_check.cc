// SPDX-License-Identifier: Apache-2.0
// Whether a file is a campaign's database, whole and of this version: whoever made it is not
// trusted.
#include <algorithm>

#include "base/config.h"
#include "base/error.h"
#include "base/file_output.h"
#include "base/printable.h"
#include "run/campaign/campaign_about.h"
#include "run/campaign/campaign_tables.h"

namespace floorproof {
namespace {

namespace fs = std::filesystem;

// Ends a statement that takes more steps of SQLite's machine than the file's size explains.
class StepLimit {
 public:
  StepLimit(sqlite3* db, const fs::path& file) : db_(db) {
    std::error_code error;
    const std::uintmax_t bytes = fs::file_size(file, error);
    left_ = 100'000 + (error ? 0 : static_cast<std::int64_t>(bytes / 100));
    sqlite3_progress_handler(
        db, 1000, [](void* self) { return --static_cast<StepLimit*>(self)->left_ < 0 ? 1 : 0; },
        this);
  }
  ~StepLimit() { sqlite3_progress_handler(db_, 0, nullptr, nullptr); }
  StepLimit(const StepLimit&) = delete;
  StepLimit& operator=(const StepLimit&) = delete;

 private:
  sqlite3* db_;
  std::int64_t left_;  // thousands of steps
};

// As this version calls it.
std::string NameNow(const std::string& column) {
  const MetricColumn* metric = FindMetric(column);
  return metric == nullptr ? column : std::string(metric->name);
}

}  // namespace

void CampaignStore::Check() {
  const StepLimit limit(db_, file_);
  CheckTables();
  {
    Statement check(*this, "PRAGMA quick_check(1)");
    if (check.Step() && check.Text(0) != "ok")
      throw InputError({file_.string(), 0}, "", "",
                       "is damaged (" + check.Text(0) + "); it was left as it is");
  }
  ReadAbout();
  CheckRows();
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
    if (format == std::to_string(kFormat) && IsUtf8Text(about_.id)) {
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

// No views, triggers or indexes, and no table but a campaign's own with the columns of one.
void CampaignStore::CheckTables() {
  const auto refuse = [&](const std::string& what) {
    throw InputError({file_.string(), 0}, "", "", "is not a campaign's database (" + what + ")");
  };
  Statement schema(*this, "SELECT type, name, sql FROM sqlite_master");
  std::vector<std::string> tables;
  while (schema.Step()) {
    const std::string type = schema.Text(0), name = schema.Text(1);
    if (type != "table" || !schema.Text(2).starts_with("CREATE TABLE "))
      refuse("it holds a " + (type == "table" ? "virtual table" : type) + " " + name);
    tables.push_back(name);
  }
  std::ranges::sort(tables);
  if (tables.empty()) refuse("table about");
  has_encounters_ = std::erase(tables, "encounter") > 0;
  if (tables != std::vector<std::string>{"about", "episode", "extra", "timing"})
    refuse("its tables are not about, encounter, episode, extra, timing");
  std::vector<Column> of_episode;
  for (const std::string table : {"episode", "extra"}) {
    std::vector<Column> there;
    Statement info(*this, "PRAGMA table_xinfo(" + table + ")");
    while (info.Step()) {
      if (info.Text(6) != "0") refuse("table " + table + " computes a column");
      there.push_back({info.Text(1), info.Text(2)});
    }
    // Behind the first columns stand the metrics of whatever version, and the texts.
    const std::vector<Column> wanted = Columns();
    const auto same = [](const Column& a, const Column& b) {
      return a.name == b.name && !a.type.empty() && b.type.starts_with(a.type);
    };
    bool right = there.size() >= kFirst + kLeastTexts &&
                 std::equal(there.begin(), there.begin() + kFirst, wanted.begin(), same);
    std::size_t texts = 0;
    for (std::size_t i = kFirst; right && i < there.size(); ++i) {
      const bool is_text = std::ranges::find(kTexts, there[i].name, &RowText::name) != kTexts.end();
      texts += is_text;
      right = there[i].type == (is_text ? "TEXT" : "REAL");
    }
    right = right && texts >= kLeastTexts;
    if (!right) refuse("table " + table + " has not the columns of one");
    if (of_episode.empty()) of_episode = std::move(there);
    // Rows of both are read by one statement, by the places of their columns.
    else if (!std::ranges::equal(there, of_episode, {}, &Column::name, &Column::name))
      refuse("tables episode and extra have not the same columns");
  }
  if (!has_encounters_) return;
  std::vector<Column> there;
  Statement info(*this, "PRAGMA table_xinfo(encounter)");
  while (info.Step()) {
    if (info.Text(6) != "0") refuse("table encounter computes a column");
    there.push_back({info.Text(1), info.Text(2)});
  }
  if (!std::ranges::equal(there, ColumnsOfEncounters(), [](const Column& a, const Column& b) {
        return a.name == b.name && b.type == a.type + " NOT NULL";
      }))
    refuse("table encounter has not the columns of one, or another version's");
}

// What lies in a row's further pages no check of the database looks at; and a text may be JSON of
// another kind than is asked for later, when rows have been added.
void CampaignStore::CheckRows() const {
  for (const std::string table : {"episode", "extra"}) {
    Statement select(*this, "SELECT * FROM " + table);
    const auto places = select.PlacesOfColumns();
    const int columns = sqlite3_column_count(select.handle);
    while (select.Step()) {
      std::string why;
      for (int i = 0; i < columns && why.empty(); ++i) {
        const int type = sqlite3_column_type(select.handle, i);
        const bool is_json = std::ranges::find(places.texts, i) != places.texts.end();
        const bool is_text = is_json || i < 2 || i == 3 || i == 4;
        const bool is_count = !is_text && i < static_cast<int>(kFirst);
        if (is_text    ? type != SQLITE_TEXT
            : is_count ? type != SQLITE_INTEGER || sqlite3_column_int64(select.handle, i) < 0
                       : type != SQLITE_NULL && type != SQLITE_FLOAT && type != SQLITE_INTEGER)
          why = "is of another type";
        else if (is_text && !IsUtf8Text(select.Text(i)))
          why = "is no UTF-8";
      }
      if (why.empty()) why = WhyUnreadableRow(select.Row(places));
      if (!why.empty())
        throw InputError({file_.string(), 0}, "", "",
                         "is damaged (a text of a row of table " + table + " " + why +
                             "); it was left as it is");
    }
  }
}

void CampaignStore::CheckEncounters() const {
  if (!has_encounters_) return;
  Statement select(*this, "SELECT * FROM encounter");
  const std::vector<Column> columns = ColumnsOfEncounters();
  while (select.Step()) {
    std::string why;
    for (int i = 0; i < sqlite3_column_count(select.handle) && why.empty(); ++i) {
      const std::string& declared = columns[static_cast<std::size_t>(i)].type;
      const int type = sqlite3_column_type(select.handle, i);
      const bool is_text = declared.starts_with("TEXT");
      if (is_text                           ? type != SQLITE_TEXT
          : declared.starts_with("INTEGER") ? type != SQLITE_INTEGER
                                            : type != SQLITE_FLOAT && type != SQLITE_INTEGER)
        why = "is of another type";
      else if (is_text && !IsUtf8Text(select.Text(i)))
        why = "is no UTF-8";
    }
    try {
      if (why.empty()) select.EncounterAt(kFirstOfEncounter);
    } catch (const InternalError&) {
      why = "is none of an encounter";
    }
    if (!why.empty())
      throw InputError(
          {file_.string(), 0}, "", "",
          "is damaged (a value of a row of table encounter " + why + "); it was left as it is");
  }
}

// A row is written by the places of its columns.
void CampaignStore::RequireColumns() const {
  if (!has_encounters_)
    throw InputError({file_.string(), 0}, "", "",
                     "is another version's: it has no table encounter; it can be read, not gone on "
                     "with: start anew in another folder");
  std::vector<std::string> wanted;
  for (const Column& column : Columns()) wanted.push_back(column.name);
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
