// SPDX-License-Identifier: Apache-2.0
#include "run/campaign/campaign_store.h"

#include <sys/statvfs.h>

#include <algorithm>
#include <utility>

#include "base/config.h"
#include "base/error.h"
#include "base/file_output.h"
#include "base/input_files.h"
#include "base/result_folder.h"
#include "run/campaign/campaign_tables.h"

namespace floorproof {
namespace {

namespace fs = std::filesystem;

constexpr int kMaxText_bytes = 16 << 20;                              // of any value
constexpr int kMaxColumns = 300;                                      // of any table
constexpr std::uintmax_t kMaxFile_bytes = std::uintmax_t{256} << 30;  // SQLite needs a bit a page

std::string Placeholders(std::size_t columns) {
  std::string marks = "?";
  for (std::size_t i = 1; i < columns; ++i) marks += ",?";
  return marks;
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
      throw InputError(
          {file_.string(), 0}, "", "",
          "is damaged (reading it takes too much time or memory); it was left as it is");
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
  const auto remove_part = [&] {
    for (const char* end : {"", "-journal", "-wal", "-shm"}) remove(part, end);
  };
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
  for (const std::string& table : CampaignTables()) store.Run(table);
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
  // Before the file gets its name: the change needs a rollback journal, and the only file that may
  // ever be beside a campaign is its write-ahead log.
  store.Run("PRAGMA journal_mode=WAL");
}

CampaignStore CampaignStore::Connect(const fs::path& file, int flags) {
  sqlite3* db = nullptr;
  const std::string name = flags == SQLITE_OPEN_READONLY ? ReadOnlyName(file) : file.string();
  const int code = sqlite3_open_v2(name.c_str(), &db, flags | SQLITE_OPEN_URI, nullptr);
  CampaignStore store(file, db);
  if (code != SQLITE_OK) store.Refuse(code);
  store.Distrust();
  if (flags == SQLITE_OPEN_READONLY) store.Run("PRAGMA query_only=ON");
  return store;
}

CampaignStore CampaignStore::Open(const fs::path& file, bool write) {
  std::error_code ignored;
  if (!fs::exists(fs::symlink_status(file, ignored)))
    throw InputError({file.string(), 0}, "", "", "cannot be opened: no such file");
  for (const std::string end : {"", "-wal", "-shm", "-journal"}) {
    const fs::path path = file.string() + end;
    const fs::file_status status = fs::symlink_status(path, ignored);
    if (!fs::exists(status)) continue;
    if (!fs::is_regular_file(status))
      throw InputError({path.string(), 0}, "", "", "is no plain file");
    // SQLite writes to these even where the database is only read.
    if (!end.empty() && fs::hard_link_count(path, ignored) > 1)
      throw InputError({path.string(), 0}, "", "", "is a hard link: it has another name, too");
    // SQLite would play it into the database after that was checked.
    if (end == "-journal" && fs::file_size(path, ignored) > 0)
      throw InputError({path.string(), 0}, "", "",
                       "is a rollback journal, and campaigns leave none");
  }
  if (fs::file_size(file, ignored) > kMaxFile_bytes)
    throw InputError({file.string(), 0}, "", "",
                     "is larger than " + std::to_string(kMaxFile_bytes >> 30) + " GiB");
  RequirePlainResults(file.parent_path());
  // Looked through read-only first: opening a damaged file for writing could change it.
  CampaignStore store = Connect(file, SQLITE_OPEN_READONLY);
  store.Check();
  if (write) store.MakeWritable();
  return store;
}

void CampaignStore::MakeWritable() {
  RequireColumns();
  std::error_code ignored;
  if (fs::hard_link_count(file_, ignored) > 1)
    throw InputError({file_.string(), 0}, "", "",
                     "is a hard link: its other name would change, too");
  CampaignStore writable = Connect(file_, SQLITE_OPEN_READWRITE);
  sqlite3_close(std::exchange(db_, std::exchange(writable.db_, nullptr)));
  // In this order: who owns the shared index when it closes also removes it.
  Run("PRAGMA journal_mode=WAL; SELECT count(*) FROM about");
  Run("PRAGMA locking_mode=EXCLUSIVE; PRAGMA synchronous=NORMAL");
  Run("BEGIN IMMEDIATE; COMMIT");  // takes the lock now, or says who has it
}

// SQLite's own advice for files from elsewhere (sqlite.org/security.html): nothing of the file's is
// run, and what is read has bounds.
void CampaignStore::Distrust() const {
  for (const auto& [option, value] : {std::pair(SQLITE_DBCONFIG_DEFENSIVE, 1),
                                      {SQLITE_DBCONFIG_TRUSTED_SCHEMA, 0},
                                      {SQLITE_DBCONFIG_ENABLE_TRIGGER, 0},
                                      {SQLITE_DBCONFIG_ENABLE_VIEW, 0}})
    sqlite3_db_config(db_, option, value, nullptr);
  for (const auto& [limit, value] : {std::pair(SQLITE_LIMIT_LENGTH, kMaxText_bytes),
                                     {SQLITE_LIMIT_SQL_LENGTH, 64 << 10},
                                     {SQLITE_LIMIT_COLUMN, kMaxColumns},
                                     {SQLITE_LIMIT_VARIABLE_NUMBER, kMaxColumns},
                                     {SQLITE_LIMIT_EXPR_DEPTH, 50},
                                     {SQLITE_LIMIT_COMPOUND_SELECT, 4},
                                     {SQLITE_LIMIT_ATTACHED, 0},
                                     {SQLITE_LIMIT_TRIGGER_DEPTH, 1},
                                     {SQLITE_LIMIT_WORKER_THREADS, 0}})
    sqlite3_limit(db_, limit, value);
  sqlite3_exec(db_, "PRAGMA cell_size_check=ON; PRAGMA mmap_size=0", nullptr, nullptr, nullptr);
}

void CampaignStore::RequireInPlace() const {
  int moved = 0;
  sqlite3_file_control(db_, "main", SQLITE_FCNTL_HAS_MOVED, &moved);
  if (moved != 0)
    throw InternalError(
        file_.string() +
        ": was removed or moved while it was being written, with the episodes in it");
}

void CampaignStore::Add(std::span<const EpisodeRow> rows) {
  if (rows.empty()) return;
  RequireInPlace();
  for (const EpisodeRow& row : rows)  // before it is named
    if (!row.made.empty() && kept_.insert(Sha256(row.made)).second)
      KeepText(row.made, file_.parent_path());
  Run("BEGIN");
  try {
    Statement insert(*this,
                     "INSERT INTO episode VALUES (" + Placeholders(EpisodeColumns().size()) + ")");
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
      *this, "INSERT INTO encounter VALUES (" + Placeholders(EncounterTableColumns().size()) + ")");
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

void CampaignStore::DropFromFirstError(const std::string& variant) {
  Run("BEGIN");
  for (const char* table : {"encounter", "episode"}) {  // the one that says which, last
    Statement drop(*this, "DELETE FROM " + std::string(table) +
                              " WHERE variant = ?1 AND episode >= (SELECT MIN(episode) FROM episode"
                              " WHERE variant = ?1 AND outcome = 'error')");
    drop.Bind(1, variant);
    drop.Step();
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
