// SPDX-License-Identifier: Apache-2.0
#include "run/campaign/campaign_store.h"

#include <sqlite3.h>
#include <sys/statvfs.h>

#include <algorithm>
#include <utility>

#include "base/config.h"
#include "base/error.h"
#include "base/file_output.h"
#include "base/input_files.h"
#include "base/printable.h"
#include "run/campaign/campaign_about.h"
#include "run/episode/encounter_table.h"

namespace floorproof {
namespace {

namespace fs = std::filesystem;

constexpr int kFormat = 1;
constexpr std::size_t kFirst = 5 + kNumFailureModes;  // columns before the metrics
constexpr int kMaxText_bytes = 16 << 20;              // of any value

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

// The last columns of the tables of episodes: JSON.
struct RowText {
  std::string_view name;
  std::string EpisodeRow::*text;
};
constexpr std::array<RowText, 4> kTexts = {{{"drawn", &EpisodeRow::drawn},
                                            {"plan", &EpisodeRow::plan},
                                            {"events", &EpisodeRow::events},
                                            {"timeout", &EpisodeRow::timeout}}};
constexpr std::size_t kLeastTexts = 3;  // files of earlier versions have no `timeout`

struct Column {
  std::string name, type;
};

// Of the tables of episodes, in order.
std::vector<Column> Columns() {
  const std::string text = "TEXT NOT NULL", count = "INTEGER NOT NULL";
  std::vector<Column> columns = {{"campaign", text},
                                 {"variant", text},
                                 {"episode", count},
                                 {"outcome", text},
                                 {"message", text}};
  for (int mode = 0; mode < kNumFailureModes; ++mode)
    columns.push_back({std::string(Name(static_cast<FailureMode>(mode))), count});
  for (const MetricColumn& metric : kMetrics) columns.push_back({std::string(metric.name), "REAL"});
  for (const RowText& t : kTexts) columns.push_back({std::string(t.name), text});
  return columns;
}

// Of table `encounter`, in order.
std::vector<Column> ColumnsOfEncounters() {
  std::vector<Column> columns = {{"campaign", "TEXT NOT NULL"},
                                 {"variant", "TEXT NOT NULL"},
                                 {"episode", "INTEGER NOT NULL"},
                                 {"number", "INTEGER NOT NULL"}};
  for (const EncounterColumn& column : EncounterColumns())
    columns.push_back(
        {std::string(column.name), column.is_text ? "TEXT NOT NULL" : "REAL NOT NULL"});
  return columns;
}
constexpr int kFirstOfEncounter = 4;  // column that is the encounter's own

// As this version calls it.
std::string NameNow(const std::string& column) {
  const MetricColumn* metric = FindMetric(column);
  return metric == nullptr ? column : std::string(metric->name);
}

std::string Placeholders(std::size_t columns) {
  std::string marks = "?";
  for (std::size_t i = 1; i < columns; ++i) marks += ",?";
  return marks;
}

std::string Declared(const std::vector<Column>& columns) {
  std::string text;
  for (const Column& column : columns) text += column.name + " " + column.type + ", ";
  return text;
}

// A database whose log is empty is read as it is: no index file is made beside it, and it may lie
// on a disk that cannot be written.
std::string ReadOnlyName(const fs::path& file) {
  std::error_code error;
  const auto log_bytes = fs::file_size(file.string() + "-wal", error);
  if (!error && log_bytes > 0) return file.string();
  std::string uri = "file:";
  for (const char c : fs::absolute(file).string())
    uri += c == '%' ? "%25" : c == '?' ? "%3f" : c == '#' ? "%23" : std::string(1, c);
  return uri + "?immutable=1";
}

std::error_code Full() { return std::make_error_code(std::errc::no_space_on_device); }

// SQLite does not keep why a file, or a log beside it, cannot be opened.
bool HasRoomForAFile(const fs::path& file) {
  struct statvfs disk {};
  if (statvfs(fs::absolute(file).parent_path().c_str(), &disk) != 0) return true;
  return disk.f_bavail > 0 && (disk.f_files == 0 || disk.f_favail > 0);  // 0: it counts no files
}

}  // namespace

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
  // one.
  Encounter EncounterAt(int column) const {
    std::vector<EncounterValue> values;
    for (const EncounterColumn& of : EncounterColumns()) {
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

CampaignStore::CampaignStore(const fs::path& file, sqlite3* db) : file_(file), db_(db) {}

CampaignStore::CampaignStore(CampaignStore&& other) noexcept
    : file_(std::move(other.file_)),
      db_(std::exchange(other.db_, nullptr)),
      about_(std::move(other.about_)),
      asked_(other.asked_),
      sound_(other.sound_),
      has_encounters_(other.has_encounters_),
      kept_(std::move(other.kept_)) {}

CampaignStore::~CampaignStore() { sqlite3_close(db_); }

void CampaignStore::Refuse(int code) const {
  const std::string why = sqlite3_errmsg(db_);
  switch (code & 0xff) {
    case SQLITE_CORRUPT:
    case SQLITE_NOTADB:
      throw InputError({file_.string(), 0}, "", "",
                       "is damaged (" + why + "); it was left as it is");
    case SQLITE_FULL:
    case SQLITE_IOERR:
      RefuseToWrite(file_, Full(), "cannot be written: " + why + "; episodes before are kept");
    case SQLITE_READONLY:
    case SQLITE_PERM:
    case SQLITE_CANTOPEN:
      RefuseToWrite(file_, HasRoomForAFile(file_) ? std::error_code() : Full(),
                    "cannot be written: " + why + "; episodes before are kept");
    case SQLITE_TOOBIG:
      throw InputError({file_.string(), 0}, "", "",
                       "is damaged (a text of more than " + std::to_string(kMaxText_bytes >> 20) +
                           " MiB); it was left as it is");
    case SQLITE_INTERRUPT:
      throw InputError({file_.string(), 0}, "", "",
                       "is damaged (reading it does not end); it was left as it is");
    case SQLITE_BUSY:
    case SQLITE_LOCKED:
      throw InputError({file_.string(), 0}, "", "", "is in use by another campaign");
    case SQLITE_ERROR:  // of statements that are right: what the file says of itself cannot be read
      if (!sound_)
        throw InputError({file_.string(), 0}, "", "",
                         "is damaged (" + why + "); it was left as it is");
      [[fallthrough]];
    default:
      throw InternalError(file_.string() + ": " + why);
  }
}

void CampaignStore::Run(const std::string& sql) {
  if (const int code = sqlite3_exec(db_, sql.c_str(), nullptr, nullptr, nullptr); code != SQLITE_OK)
    Refuse(code);
}

CampaignStore CampaignStore::Create(const fs::path& file, const CampaignAbout& about) {
  // Under another name until it is whole: a kill in between must not leave a file that is refused.
  const fs::path part = file.string() + ".part";
  const auto remove = [](const fs::path& path, const char* end) {
    std::error_code ignored;
    fs::remove(path.string() + end, ignored);
  };
  const auto remove_part = [&] { remove(part, ""), remove(part, "-journal"); };
  remove_part();
  try {
    Fill(file, part, about);
    // A journal that lost its database must not be taken for the new one's.
    for (const char* end : {"-wal", "-shm", "-journal"}) remove(file, end);
    fs::rename(part, file);
  } catch (const fs::filesystem_error& e) {
    remove_part();
    RefuseToWrite(file, e.code(), "cannot be written: " + e.code().message());
  } catch (...) {
    remove_part();
    throw;
  }
  return Open(file, true);
}

void CampaignStore::Fill(const fs::path& file, const fs::path& part, const CampaignAbout& about) {
  sqlite3* db = nullptr;
  const int code =
      sqlite3_open_v2(part.c_str(), &db, SQLITE_OPEN_READWRITE | SQLITE_OPEN_CREATE, nullptr);
  CampaignStore store(file, db);
  if (code != SQLITE_OK) store.Refuse(code);
  store.sound_ = true;  // its own
  store.Run("BEGIN");
  store.Run("CREATE TABLE about (key TEXT PRIMARY KEY, value TEXT NOT NULL) WITHOUT ROWID");
  for (const char* table : {"episode", "extra"})
    store.Run("CREATE TABLE " + std::string(table) + " (" + Declared(Columns()) +
              "PRIMARY KEY (campaign, variant, episode)) WITHOUT ROWID");
  store.Run("CREATE TABLE encounter (" + Declared(ColumnsOfEncounters()) +
            "PRIMARY KEY (campaign, variant, episode, number)) WITHOUT ROWID");
  store.Run(
      "CREATE TABLE timing (variant TEXT NOT NULL, episode INTEGER NOT NULL, wall_s REAL NOT NULL, "
      "PRIMARY KEY (variant, episode)) WITHOUT ROWID");
  {
    Statement insert(store, "INSERT INTO about VALUES (?, ?)");
    for (const auto& [key, value] :
         {std::pair<std::string, std::string>("format", std::to_string(kFormat)),
          {"campaign", about.id},
          {"scenario", about.scenario},
          {"versions", about.versions}}) {
      insert.Bind(1, key);
      insert.Bind(2, value);
      insert.Step();
      insert.Again();
    }
  }
  store.Run("COMMIT");
}

CampaignStore CampaignStore::Connect(const fs::path& file, int flags) {
  sqlite3* db = nullptr;
  const std::string name = flags == SQLITE_OPEN_READONLY ? ReadOnlyName(file) : file.string();
  const int code = sqlite3_open_v2(name.c_str(), &db, flags | SQLITE_OPEN_URI, nullptr);
  CampaignStore store(file, db);
  if (code != SQLITE_OK) store.Refuse(code);
  store.Distrust();
  return store;
}

CampaignStore CampaignStore::Open(const fs::path& file, bool write) {
  std::error_code ignored;
  if (!fs::exists(fs::symlink_status(file, ignored)))
    throw InputError({file.string(), 0}, "", "", "cannot be opened: no such file");
  for (const char* end : {"", "-wal", "-shm", "-journal"}) {
    const fs::file_status status = fs::symlink_status(file.string() + end, ignored);
    if (fs::exists(status) && !fs::is_regular_file(status))
      throw InputError({file.string() + end, 0}, "", "", "is no plain file");
  }
  // Looked through read-only first: opening a damaged file for writing could change it.
  CampaignStore store = Connect(file, SQLITE_OPEN_READONLY);
  store.Check();
  if (write) store.MakeWritable();
  return store;
}

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

void CampaignStore::MakeWritable() {
  RequireColumns();
  CampaignStore writable = Connect(file_, SQLITE_OPEN_READWRITE);
  sqlite3_close(std::exchange(db_, std::exchange(writable.db_, nullptr)));
  // In this order: who owns the shared index when it closes also removes it.
  Run("PRAGMA journal_mode=WAL; SELECT count(*) FROM about");
  Run("PRAGMA locking_mode=EXCLUSIVE; PRAGMA synchronous=NORMAL");
  Run("BEGIN IMMEDIATE; COMMIT");  // takes the lock now, or says who has it
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

// SQLite's own advice for files from elsewhere (sqlite.org/security.html): nothing of the file's is
// run, and what is read has bounds.
void CampaignStore::Distrust() const {
  for (const auto& [option, value] : {std::pair(SQLITE_DBCONFIG_DEFENSIVE, 1),
                                      {SQLITE_DBCONFIG_TRUSTED_SCHEMA, 0},
                                      {SQLITE_DBCONFIG_ENABLE_TRIGGER, 0},
                                      {SQLITE_DBCONFIG_ENABLE_VIEW, 0}})
    sqlite3_db_config(db_, option, value, nullptr);
  sqlite3_limit(db_, SQLITE_LIMIT_LENGTH, kMaxText_bytes);
  sqlite3_exec(db_, "PRAGMA cell_size_check=ON; PRAGMA mmap_size=0", nullptr, nullptr, nullptr);
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
    refuse("table encounter has not the columns of one");
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
    for (int i = 0; i < static_cast<int>(columns.size()) && why.empty(); ++i) {
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

void CampaignStore::Add(std::span<const EpisodeRow> rows) {
  if (rows.empty()) return;
  for (const EpisodeRow& row : rows)  // before it is named
    if (!row.made.empty() && kept_.insert(Sha256(row.made)).second)
      KeepText(row.made, file_.parent_path());
  Run("BEGIN");
  try {
    Statement insert(*this, "INSERT INTO episode VALUES (" + Placeholders(Columns().size()) + ")");
    Statement timing(*this, "INSERT OR REPLACE INTO timing VALUES (?, ?, ?)");
    for (const EpisodeRow& row : rows) {
      int at = 0;
      insert.Bind(++at, about_.id);
      insert.Bind(++at, row.variant);
      insert.Bind(++at, static_cast<std::int64_t>(row.episode));
      insert.Bind(++at, row.outcome);
      insert.Bind(++at, row.message);
      for (const int n : row.events_of) insert.Bind(++at, std::int64_t{n});
      for (const auto& value : row.metrics) insert.Bind(++at, value);
      for (const RowText& text : kTexts) insert.Bind(++at, row.*text.text);
      insert.Step();
      insert.Again();
      timing.Bind(1, row.variant);
      timing.Bind(2, static_cast<std::int64_t>(row.episode));
      timing.Bind(3, std::optional(row.wall_s));
      timing.Step();
      timing.Again();
    }
    AddEncounters(rows);
    Run("COMMIT");
  } catch (...) {
    sqlite3_exec(db_, "ROLLBACK", nullptr, nullptr, nullptr);
    throw;
  }
}

void CampaignStore::AddEncounters(std::span<const EpisodeRow> rows) {
  Statement insert(
      *this, "INSERT INTO encounter VALUES (" + Placeholders(ColumnsOfEncounters().size()) + ")");
  for (const EpisodeRow& row : rows)
    for (std::size_t number = 0; number < row.encounters.size(); ++number) {
      int at = 0;
      insert.Bind(++at, about_.id);
      insert.Bind(++at, row.variant);
      insert.Bind(++at, static_cast<std::int64_t>(row.episode));
      insert.Bind(++at, static_cast<std::int64_t>(number));
      for (const EncounterValue& value : EncounterValues(row.encounters[number])) {
        if (const auto* text = std::get_if<std::string>(&value))
          insert.Bind(++at, *text);
        else
          insert.Bind(++at, std::optional(std::get<double>(value)));
      }
      insert.Step();
      insert.Again();
    }
}

std::vector<Encounter> CampaignStore::EncountersOf(const std::string& variant,
                                                   std::uint64_t episode) const {
  std::vector<Encounter> encounters;
  if (!has_encounters_) return encounters;
  Statement select(*this,
                   "SELECT * FROM encounter WHERE campaign = ? AND variant = ? AND episode = ? "
                   "ORDER BY number");
  select.Bind(1, about_.id);
  select.Bind(2, variant);
  select.Bind(3, static_cast<std::int64_t>(episode));
  while (select.Step()) encounters.push_back(select.EncounterAt(kFirstOfEncounter));
  return encounters;
}

void CampaignStore::ForEachEncounter(
    const std::string& variant,
    const std::function<void(std::uint64_t, const Encounter&)>& visit) const {
  if (!has_encounters_) return;
  Statement select(*this,
                   "SELECT * FROM encounter WHERE campaign = ?1 AND variant = ?2 AND episode IN "
                   "(SELECT episode FROM episode WHERE campaign = ?1 AND variant = ?2) ORDER BY "
                   "episode, number");
  select.Bind(1, about_.id);
  select.Bind(2, variant);
  while (select.Step())
    visit(static_cast<std::uint64_t>(sqlite3_column_int64(select.handle, 2)),
          select.EncounterAt(kFirstOfEncounter));
}

std::vector<std::string> CampaignStore::Variants() const {
  Statement select(*this, "SELECT DISTINCT variant FROM episode ORDER BY variant");
  std::vector<std::string> variants;
  while (select.Step()) variants.push_back(select.Text(0));
  return variants;
}

std::vector<std::uint64_t> CampaignStore::Episodes(const std::string& variant) const {
  Statement select(*this,
                   "SELECT episode FROM episode WHERE campaign = ?1 AND variant = ?2 UNION SELECT "
                   "episode FROM extra WHERE campaign = ?1 AND variant = ?2 ORDER BY 1");
  select.Bind(1, about_.id);
  select.Bind(2, variant);
  std::vector<std::uint64_t> episodes;
  while (select.Step())
    episodes.push_back(static_cast<std::uint64_t>(sqlite3_column_int64(select.handle, 0)));
  return episodes;
}

void CampaignStore::ForEach(const std::string& variant,
                            const std::function<void(const EpisodeRow&)>& visit, bool extra) const {
  const std::string rows = " WHERE campaign = ?1 AND variant = ?2";
  Statement select(*this, "SELECT * FROM episode" + rows +
                              (extra ? " UNION ALL SELECT * FROM extra" + rows : "") +
                              " ORDER BY episode");
  select.Bind(1, about_.id);
  select.Bind(2, variant);
  const auto places = select.PlacesOfColumns();
  while (select.Step()) visit(select.Row(places));
}

std::optional<EpisodeRow> CampaignStore::Find(const std::string& variant,
                                              std::uint64_t episode) const {
  Statement select(*this,
                   "SELECT * FROM episode WHERE campaign = ?1 AND variant = ?2 AND episode = ?3 "
                   "UNION ALL SELECT * FROM extra WHERE campaign = ?1 AND variant = ?2 AND episode "
                   "= ?3");
  select.Bind(1, about_.id);
  select.Bind(2, variant);
  select.Bind(3, static_cast<std::int64_t>(episode));
  if (!select.Step()) return std::nullopt;
  return select.Row(select.PlacesOfColumns());
}

void CampaignStore::SetAsked(std::uint64_t episodes) {
  if (episodes == asked_) return;
  Statement insert(*this, "INSERT OR REPLACE INTO about VALUES ('asked', ?)");
  insert.Bind(1, std::to_string(episodes));
  insert.Step();
  asked_ = episodes;
}

void CampaignStore::DropErrors() {
  Run("BEGIN");
  for (const std::string table : {"episode", "extra"}) {
    Run("DELETE FROM encounter WHERE (variant, episode) IN (SELECT variant, episode FROM " + table +
        " WHERE outcome = 'error')");
    Run("DELETE FROM " + table + " WHERE outcome = 'error'");
  }
  Run("COMMIT");
}

void CampaignStore::Settle() { Run("PRAGMA wal_checkpoint(TRUNCATE)"); }

void CampaignStore::SetExtraFrom(const std::string& variant, std::uint64_t episode) {
  Run("BEGIN");
  const auto move = [&](const char* from, const char* to, const char* which) {
    for (const std::string& sql :
         {"INSERT OR REPLACE INTO " + std::string(to) + " SELECT * FROM " + from,
          "DELETE FROM " + std::string(from)}) {
      Statement statement(*this,
                          sql + " WHERE campaign = ? AND variant = ? AND episode " + which + " ?");
      statement.Bind(1, about_.id);
      statement.Bind(2, variant);
      statement.Bind(3, static_cast<std::int64_t>(episode));
      statement.Step();
    }
  };
  move("episode", "extra", ">=");
  move("extra", "episode", "<");
  Run("COMMIT");
}

}  // namespace floorproof
