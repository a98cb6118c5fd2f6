// SPDX-License-Identifier: Apache-2.0
// campaign.sqlite: what is put comes back, in whole batches, and nothing else's file is touched.
#include "run/campaign/campaign_store.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sqlite3.h>
#include <sys/stat.h>

#include <algorithm>
#include <fstream>

#include "base/error.h"
#include "run/campaign/campaign_about.h"
#include "run/episode/encounter_table.h"
#include "tests/own_folder.h"
#include "tests/slurp.h"

namespace floorproof {
namespace {

namespace fs = std::filesystem;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

// Every file of a folder, by name.
std::map<std::string, std::string> Bytes(const fs::path& folder) {
  std::map<std::string, std::string> bytes;
  for (const auto& entry : fs::directory_iterator(folder))
    bytes[entry.path().filename().string()] = Slurp(entry.path());
  return bytes;
}

EpisodeRow Row(std::uint64_t episode, const std::string& variant = "default") {
  EpisodeRow row;
  row.variant = variant;
  row.episode = episode;
  row.outcome = "failure";
  row.message = "it's \"quoted\", and\nbroken";
  row.events_of = {0, 2, 0, 1};
  for (std::size_t i = 0; i < row.metrics.size(); ++i)
    if (i % 3 != 1) row.metrics[i] = 0.1 + static_cast<double>(i * episode);
  row.drawn = R"({"site.floor.friction": 0.30000000000000004})";
  row.plan = R"({"status": "success"})";
  row.events = R"([{"mode": "stuck", "kind": "", "hazard": "", "t_s": 1, "x_m": 0, "y_m": 0}])";
  row.timeout = R"({"t_s": 60, "x_m": 1.5, "y_m": 2, "yaw_rad": 0, "hazard": "it's"})";
  row.wall_s = 0.25;
  return row;
}

bool Same(const EpisodeRow& a, const EpisodeRow& b) {
  return a.variant == b.variant && a.episode == b.episode && a.outcome == b.outcome &&
         a.message == b.message && a.events_of == b.events_of && a.metrics == b.metrics &&
         a.drawn == b.drawn && a.plan == b.plan && a.events == b.events && a.timeout == b.timeout;
}

Encounter Met(const std::string& hazard, double speed_mps) {
  Encounter encounter;
  encounter.hazard = hazard;
  encounter.type = "step";
  encounter.size = {{"height_m", 0.1 + 0.2}};
  encounter.at.speed_mps = speed_mps;
  encounter.outcome = Encounter::Outcome::kFailed;
  encounter.mode = FailureMode::kRollOver;
  return encounter;
}

class CampaignStoreTest : public OwnFolderTest {
 protected:
  // A campaign of `n` episodes, closed.
  void Make(std::uint64_t n) {
    CampaignStore store = CampaignStore::Create(file_, about_);
    std::vector<EpisodeRow> rows;
    for (std::uint64_t episode = 0; episode < n; ++episode) rows.push_back(Row(episode));
    store.Add(rows);
  }
  void MakeWithEncounter(std::uint64_t episode) {
    EpisodeRow row = Row(episode);
    row.encounters = {Met("kerb", 0.1)};
    CampaignStore::Create(file_, about_).Add(std::vector{row});
  }
  // Changes a campaign as a stranger could; the file is closed again.
  void Change(const std::string& sql) {
    sqlite3* db = nullptr;
    ASSERT_EQ(sqlite3_open(file_.c_str(), &db), SQLITE_OK);
    char* error = nullptr;
    EXPECT_EQ(sqlite3_exec(db, sql.c_str(), nullptr, nullptr, &error), SQLITE_OK)
        << sql << ": " << error;
    sqlite3_free(error);
    sqlite3_close(db);
  }
  std::string WhyRefused(bool write) {
    try {
      CampaignStore::Open(file_, write);
    } catch (const InputError& e) {
      return e.what();
    }
    return "";
  }
  static std::vector<std::uint64_t> InTable(const CampaignStore& store,
                                            const std::string& variant = "default") {
    std::vector<std::uint64_t> episodes;
    store.ForEach(variant, [&](const EpisodeRow& row) { episodes.push_back(row.episode); });
    return episodes;
  }

  const fs::path file_ = folder_ / "campaign.sqlite";
  const CampaignAbout about_ = {"0123456789abcdef", "seed: 1\nsite:\n  name: a\n",
                                R"({"floorproof": "1"})"};
};

TEST_F(CampaignStoreTest, RowsComeBackAsPut) {
  EpisodeRow bare;  // an episode that crashed
  bare.variant = "robot=b";
  bare.outcome = "error";
  {
    CampaignStore store = CampaignStore::Create(file_, about_);
    store.Add(std::vector{Row(3), Row(1), bare});
    store.Add(std::vector{Row(2)});
    store.Add({});
    EXPECT_THAT(InTable(store), ElementsAre(1, 2, 3));
  }
  for (const bool write : {false, true}) {
    const CampaignStore store = CampaignStore::Open(file_, write);
    EXPECT_EQ(store.about().id, about_.id);
    EXPECT_EQ(store.about().scenario, about_.scenario);
    EXPECT_EQ(store.about().versions, about_.versions);
    EXPECT_THAT(store.Episodes("default"), ElementsAre(1, 2, 3));
    EXPECT_THAT(store.Episodes("robot=b"), ElementsAre(0));
    EXPECT_THAT(store.Episodes("robot=c"), IsEmpty());
    store.ForEach("default", [](const EpisodeRow& row) {
      EXPECT_TRUE(Same(row, Row(row.episode))) << row.episode;
    });
    store.ForEach("robot=b", [&](const EpisodeRow& row) { EXPECT_TRUE(Same(row, bare)); });
  }
  EXPECT_EQ(Bytes(folder_).size(), 1u) << "closed, it is one file";
}

// They have a table of their own, go with their episode, and are forgotten with one that is driven
// again.
TEST_F(CampaignStoreTest, EncountersStandBesideTheirEpisodes) {
  EpisodeRow first = Row(0), second = Row(1), broken = Row(2);
  first.encounters = {Met("kerb", 0.1), Met("it's", 0.3)};
  second.encounters = {Met("sill", 0.2)};
  broken.outcome = "error";
  broken.encounters = {Met("none", 0)};
  CampaignStore store = CampaignStore::Create(file_, about_);
  store.Add(std::vector{FromLine(ToLine(first)), second, broken});
  const auto met = [&] {
    std::vector<std::string> all;
    store.ForEachEncounter("default", [&](std::uint64_t episode, const Encounter& e) {
      all.push_back(std::to_string(episode) + " " + e.hazard);
    });
    return all;
  };
  EXPECT_THAT(met(), ElementsAre("0 kerb", "0 it's", "1 sill", "2 none"));
  ASSERT_EQ(store.EncountersOf("default", 0).size(), 2u);
  EXPECT_EQ(EncounterValues(store.EncountersOf("default", 0)[1]),
            EncounterValues(Met("it's", 0.3)));
  store.DropErrors();
  EXPECT_THAT(met(), ElementsAre("0 kerb", "0 it's", "1 sill"));
  store.SetExtraFrom("default", 1);
  EXPECT_THAT(met(), ElementsAre("0 kerb", "0 it's")) << "what is kept and not counted is left out";
  EXPECT_EQ(store.EncountersOf("default", 1).size(), 1u) << "but it is there";
  store.SetExtraFrom("default", 2);
  EXPECT_THAT(met(), ElementsAre("0 kerb", "0 it's", "1 sill"));
}

TEST_F(CampaignStoreTest, AFileWithoutEncountersIsReadAndNotGoneOnWith) {
  Make(3);
  Change("DROP TABLE encounter");
  EXPECT_THAT(WhyRefused(true), HasSubstr("has no table encounter"));
  const CampaignStore dut = CampaignStore::Open(file_, false);
  EXPECT_THAT(InTable(dut), ElementsAre(0, 1, 2));
  EXPECT_THAT(dut.EncountersOf("default", 1), IsEmpty());
}

TEST_F(CampaignStoreTest, WhatCameAfterAFailureIsKept) {
  EpisodeRow row = Row(0);
  row.encounters = {Met("kerb", 0.1)};
  row.encounters[0].energy_j = 3;
  row.encounters[0].after = Encounter::After::kNeedsHelp;
  row.encounters[0].sensed = Encounter::Sensed::kInTime;
  CampaignStore store = CampaignStore::Create(file_, about_);
  store.Add(std::vector{FromLine(ToLine(row))});
  const Encounter dut = store.EncountersOf("default", 0).at(0);
  EXPECT_EQ(dut.energy_j, 3);
  EXPECT_EQ(dut.after, Encounter::After::kNeedsHelp);
  EXPECT_EQ(dut.sensed, Encounter::Sensed::kInTime);
}

TEST_F(CampaignStoreTest, DamagedEncountersAreRefused) {
  for (const char* sql :
       {"UPDATE encounter SET outcome = 'fine'", "UPDATE encounter SET size = '{'",
        "UPDATE encounter SET speed_mps = 'fast'", "UPDATE encounter SET passage = 'under'",
        "UPDATE encounter SET after = 'lost'", "UPDATE encounter SET sensed = 'perhaps'",
        "ALTER TABLE encounter ADD COLUMN more REAL",
        "ALTER TABLE encounter DROP COLUMN turn_gap_m"}) {
    fs::remove(file_);
    MakeWithEncounter(0);
    EXPECT_EQ(WhyRefused(false), "");
    Change(sql);
    EXPECT_THAT(WhyRefused(false), HasSubstr("encounter")) << sql;
  }
}

// mean_estimate_position_std_m was mean_estimate_spread_m.
TEST_F(CampaignStoreTest, AMetricsFormerNameIsStillRead) {
  Make(4);
  for (const std::string table : {"episode", "extra"})
    Change("ALTER TABLE " + table +
           " RENAME COLUMN mean_estimate_position_std_m TO mean_estimate_spread_m");
  CampaignStore store = CampaignStore::Open(file_, true);
  store.Add(std::vector{Row(4)});
  store.SetExtraFrom("default", 3);
  store.SetExtraFrom("default", 4);
  int rows = 0;
  store.ForEach(
      "default",
      [&](const EpisodeRow& row) {
        EXPECT_TRUE(Same(row, Row(row.episode))) << row.episode;
        ++rows;
      },
      true);
  EXPECT_EQ(rows, 5);
  EXPECT_TRUE(Same(*store.Find("default", 4), Row(4)));
}

// One made before a metric was added, after it was removed, or before it was moved.
TEST_F(CampaignStoreTest, AnotherVersionsColumnsAreReadAndNotWritten) {
  const auto alter = [&](const std::string& sql) {
    for (const std::string table : {"episode", "extra"}) Change("ALTER TABLE " + table + sql);
  };
  const auto expect_refused = [&](const char* why) {
    const auto before = Bytes(folder_);
    const std::string said = WhyRefused(true);
    EXPECT_THAT(said, HasSubstr(file_.string()));
    EXPECT_THAT(said, HasSubstr(why));
    EXPECT_THAT(said, HasSubstr("start anew in another folder"));
    EXPECT_EQ(std::ranges::count(said, '\n'), 0) << said;
    EXPECT_EQ(Bytes(folder_), before);
    EXPECT_THAT(InTable(CampaignStore::Open(file_, false)), ElementsAre(0, 1, 2));
  };
  Make(3);
  alter(" DROP COLUMN turns");
  expect_refused("has no column turns");
  CampaignStore::Open(file_, false).ForEach("default", [](const EpisodeRow& row) {
    EpisodeRow want = Row(row.episode);
    want.metrics[MetricIndex(&Metrics::turns)].reset();
    EXPECT_TRUE(Same(row, want)) << row.episode;
  });
  fs::remove(file_);
  Make(3);
  alter(" RENAME COLUMN contacts TO knocks");
  expect_refused("has no column contacts");
  fs::remove(file_);
  Make(3);
  alter(" ADD COLUMN knocks REAL");
  expect_refused("has a column knocks that is not known");
  fs::remove(file_);
  Make(3);
  for (const char* sql : {" RENAME COLUMN turns TO x", " RENAME COLUMN contacts TO turns",
                          " RENAME COLUMN x TO contacts"})
    alter(sql);
  expect_refused("has its columns in another order");
}

TEST_F(CampaignStoreTest, ABatchIsAllOrNothing) {
  CampaignStore store = CampaignStore::Create(file_, about_);
  store.Add(std::vector{Row(5)});
  EXPECT_ANY_THROW(store.Add(std::vector{Row(4), Row(5), Row(6)})) << "5 is there";
  EXPECT_THAT(store.Episodes("default"), ElementsAre(5));
  store.Add(std::vector{Row(4), Row(6)});
  EXPECT_THAT(store.Episodes("default"), ElementsAre(4, 5, 6));
}

TEST_F(CampaignStoreTest, ExtraRowsGoAndComeBack) {
  Make(6);
  CampaignStore store = CampaignStore::Open(file_, true);
  store.Add(std::vector{Row(0, "other"), Row(5, "other")});
  store.SetExtraFrom("default", 4);
  EXPECT_THAT(InTable(store), ElementsAre(0, 1, 2, 3));
  EXPECT_THAT(store.Episodes("default"), ElementsAre(0, 1, 2, 3, 4, 5)) << "done all the same";
  EXPECT_THAT(InTable(store, "other"), ElementsAre(0, 5)) << "another variant's stay";
  store.SetExtraFrom("default", 2);
  EXPECT_THAT(InTable(store), ElementsAre(0, 1));
  store.SetExtraFrom("default", 5);
  EXPECT_THAT(InTable(store), ElementsAre(0, 1, 2, 3, 4));
  store.SetExtraFrom("default", 9);
  EXPECT_THAT(InTable(store), ElementsAre(0, 1, 2, 3, 4, 5));
  store.ForEach("default", [](const EpisodeRow& row) {
    EXPECT_TRUE(Same(row, Row(row.episode))) << row.episode;
  });
}

TEST_F(CampaignStoreTest, OneAtATimeWrites) {
  Make(2);
  const CampaignStore first = CampaignStore::Open(file_, true);
  EXPECT_THAT(WhyRefused(true), HasSubstr("is in use by another campaign"));
}

// Of a version that did not keep where time ran out.
TEST_F(CampaignStoreTest, AFileWithoutTimeoutsIsReadAndNotGoneOnWith) {
  Make(3);
  Change("ALTER TABLE episode DROP COLUMN timeout; ALTER TABLE extra DROP COLUMN timeout");
  EXPECT_THAT(WhyRefused(true), HasSubstr("has no column timeout"));
  const CampaignStore dut = CampaignStore::Open(file_, false);
  const auto row = dut.Find("default", 2);
  ASSERT_TRUE(row);
  EXPECT_EQ(row->events, Row(2).events);
  EXPECT_EQ(row->timeout, "null");
  EXPECT_FALSE(TimeoutOf(*row));
}

// What a kill while it was made leaves behind is no campaign, and in nobody's way.
TEST_F(CampaignStoreTest, AHalfMadeFileIsMadeAnew) {
  std::ofstream(folder_ / "campaign.sqlite.part") << "half of a file";
  std::ofstream(folder_ / "campaign.sqlite-wal") << "a journal without its database";
  Make(2);
  EXPECT_EQ(WhyRefused(true), "");
  EXPECT_EQ(Bytes(folder_).size(), 1u);
}

TEST_F(CampaignStoreTest, WhatIsNoCampaignIsRefusedAndLeft) {
  const auto expect_refused = [&](const char* why) {
    const auto before = Bytes(folder_);
    for (const bool write : {false, true}) {
      const std::string said = WhyRefused(write);
      EXPECT_THAT(said, HasSubstr(file_.string()));
      EXPECT_THAT(said, HasSubstr(why));
      EXPECT_EQ(std::ranges::count(said, '\n'), 0);
      EXPECT_EQ(Bytes(folder_), before);
    }
  };
  std::ofstream(file_) << "";
  expect_refused("is not a campaign's database");
  std::ofstream(file_) << "variant,episode\ndefault,0\n" << std::string(4096, 'x');
  expect_refused("is damaged");
  fs::remove(file_);
  sqlite3* db = nullptr;
  ASSERT_EQ(sqlite3_open(file_.c_str(), &db), SQLITE_OK);
  ASSERT_EQ(sqlite3_exec(db, "CREATE TABLE photo (a)", nullptr, nullptr, nullptr), SQLITE_OK);
  sqlite3_close(db);
  expect_refused("is not a campaign's database");
  fs::remove(file_);
  fs::create_directory(file_);
  EXPECT_NE(WhyRefused(true), "");
}

// Each page overwritten, the file cut at each quarter: either it is refused with one line and left
// byte for byte, or what it says is read.
TEST_F(CampaignStoreTest, ADamagedFileIsRefusedAndLeft) {
  Make(200);
  const std::string whole = Slurp(file_);
  constexpr std::size_t kPage = 4096;
  ASSERT_GT(whole.size(), 8 * kPage);
  std::vector<std::string> damaged;
  for (std::size_t page = 0; page < whole.size(); page += kPage) {
    damaged.push_back(whole);
    for (std::size_t i = page; i < page + kPage; i += 3) damaged.back()[i] ^= '\x5a';
  }
  for (std::size_t quarter = 1; quarter < 4; ++quarter)
    damaged.push_back(whole.substr(0, whole.size() * quarter / 4));
  for (const std::string& bytes : damaged) {
    std::ofstream(file_, std::ios::binary | std::ios::trunc) << bytes;
    const std::string said = WhyRefused(true);
    EXPECT_THAT(said, HasSubstr(file_.string()));
    EXPECT_EQ(std::ranges::count(said, '\n'), 0) << said;
    EXPECT_TRUE(Slurp(file_) == bytes);
    for (const char* end : {"-wal", "-shm"}) fs::remove(file_.string() + end);
  }
}

// The header's bytes are sizes, versions and numbers of pages; some may be anything.
TEST_F(CampaignStoreTest, AnyByteOfTheHeaderIsTakenOrRefused) {
  Make(3);
  const std::string whole = Slurp(file_);
  int refused = 0;
  for (std::size_t i = 0; i < 100; ++i) {
    std::string bytes = whole;
    bytes[i] = '\x20';
    std::ofstream(file_, std::ios::binary | std::ios::trunc) << bytes;
    const std::string said = WhyRefused(false);
    refused += !said.empty();
    EXPECT_EQ(std::ranges::count(said, '\n'), 0) << said;
    EXPECT_TRUE(Slurp(file_) == bytes);
    for (const char* end : {"-wal", "-shm"}) fs::remove(file_.string() + end);
  }
  EXPECT_GT(refused, 20);
}

// A file from elsewhere: what stands in it is refused before anything of it is run or written to.
TEST_F(CampaignStoreTest, NothingOfAForeignFileIsRun) {
  const auto expect_refused = [&](const std::string& sql, const char* why) {
    fs::remove(file_);
    Make(3);
    Change(sql);
    const auto before = Bytes(folder_);
    for (const bool write : {false, true}) EXPECT_THAT(WhyRefused(write), HasSubstr(why)) << sql;
    EXPECT_EQ(Bytes(folder_), before) << sql;
  };
  const std::string endless =
      "WITH RECURSIVE r(n) AS (SELECT 1 UNION ALL SELECT n + 1 FROM r) SELECT 'format', n FROM r";
  expect_refused("DROP TABLE about; CREATE VIEW about(key, value) AS " + endless, "holds a view");
  expect_refused("DROP TABLE extra; CREATE VIEW extra AS SELECT * FROM episode", "holds a view");
  expect_refused("CREATE TRIGGER t AFTER INSERT ON episode BEGIN DELETE FROM episode; END",
                 "holds a trigger");
  expect_refused("CREATE INDEX i ON episode(message)", "holds a index");
  expect_refused("CREATE TABLE more(a)",
                 "its tables are not about, encounter, episode, extra, timing");
  expect_refused("ALTER TABLE episode ADD COLUMN c TEXT", "has not the columns of one");
  expect_refused("ALTER TABLE episode ADD COLUMN c REAL AS (episode * 2)",
                 "episode has not the columns of one");
  expect_refused("ALTER TABLE episode ADD COLUMN c REAL DEFAULT 1", "has not the columns of one");
  expect_refused("ALTER TABLE timing ADD COLUMN c TEXT", "timing has not the columns of one");
  expect_refused("ALTER TABLE encounter ADD COLUMN c TEXT AS (hex(zeroblob(8000000)))",
                 "encounter has not the columns of one");
  expect_refused("CREATE VIRTUAL TABLE more USING fts5(a)", "holds a virtual table");
  for (const char* change :
       {"extra ADD COLUMN c REAL", "episode DROP COLUMN turns", "extra RENAME COLUMN turns TO c"})
    expect_refused(std::string("ALTER TABLE ") + change, "have not the same columns");
}

TEST_F(CampaignStoreTest, EveryTextIsReadBeforeAnyIsWritten) {
  const auto expect_refused = [&](const std::string& set) {
    fs::remove(file_);
    Make(3);
    Change("UPDATE episode SET " + set + " WHERE episode = 2");
    const auto before = Bytes(folder_);
    EXPECT_THAT(WhyRefused(true), HasSubstr("is damaged")) << set;
    EXPECT_EQ(Bytes(folder_), before) << set;
  };
  for (const char* set :
       {"drawn = '[]'", "drawn = '3'", "plan = 'null'", "events = '{}'", "events = '[3]'",
        "events = '[{\"mode\": 3}]'", "plan = '{\"a\": '", "outcome = 'triumph'", "message = x'ff'",
        "message = CAST(x'41ff' AS TEXT)", "drawn = CAST(x'7b7dff' AS TEXT)", "turns = 'many'",
        "stuck = -1", "message = zeroblob(17000000)"})
    expect_refused(set);
  const auto repeated = [](const std::string& text, int n) {
    std::string out;
    for (int i = 0; i < n; ++i) out += text;
    return out;
  };
  expect_refused("drawn = '{\"a\": " + repeated("[", 40) + repeated("]", 40) + "}'");
  expect_refused("drawn = printf('{\"a\": \"%.*c\"}', 5000000, 'a')");
  std::string keys;
  for (int i = 0; i < 1001; ++i) keys += (i == 0 ? "\"" : ", \"") + std::to_string(i) + "\": 0";
  expect_refused("plan = '{" + keys + "}'");
}

// A number of SQLite's may be infinite; a column keeps a text that is no number.
TEST_F(CampaignStoreTest, NumbersOfAnotherKindAreRefused) {
  for (const char* sql :
       {"UPDATE episode SET coverage = 9e999", "UPDATE episode SET coverage = -9e999",
        "UPDATE episode SET coverage = 'NaN'", "UPDATE episode SET coverage = x'00'",
        "UPDATE episode SET stuck = 1.5", "UPDATE episode SET stuck = 4294967297",
        "UPDATE episode SET episode = 9223372036854775807 WHERE episode = 2",
        "UPDATE encounter SET speed_mps = 9e999", "UPDATE encounter SET size = '{\"a\": 1e999}'",
        "UPDATE encounter SET number = -1"}) {
    fs::remove(file_);
    MakeWithEncounter(2);
    EXPECT_EQ(WhyRefused(false), "");
    Change(sql);
    EXPECT_THAT(WhyRefused(false), HasSubstr("is damaged (a value of a row of table ")) << sql;
  }
  fs::remove(file_);
  Make(1);
  Change("INSERT INTO about VALUES ('asked', '18446744073709551615')");
  EXPECT_THAT(WhyRefused(false), HasSubstr("is not a campaign's database (table about)"));
}

// SQLite builds the schema in memory before anything of it can be checked.
TEST_F(CampaignStoreTest, ASchemaThatTakesMuchMemoryIsRefused) {
  Make(1);
  std::string columns = "a0";
  for (int i = 1; i < 290; ++i) columns += ",a" + std::to_string(i);
  Change(
      "PRAGMA writable_schema=ON;"
      "WITH RECURSIVE r(n) AS (SELECT 1 UNION ALL SELECT n + 1 FROM r WHERE n < 10000)"
      "INSERT INTO sqlite_schema SELECT 'table', 't' || n, 't' || n, 3, 'CREATE TABLE t' || n || "
      "'(" +
      columns + ")' FROM r");
  EXPECT_THAT(WhyRefused(false), HasSubstr("takes too much time or memory"));
}

TEST_F(CampaignStoreTest, OnlyPlainFilesAreOpened) {
  Make(1);
  fs::rename(file_, folder_ / "elsewhere");
  fs::create_symlink(folder_ / "elsewhere", file_);
  EXPECT_THAT(WhyRefused(true), HasSubstr("is no plain file"));
  fs::remove(file_);
  ASSERT_EQ(mkfifo(file_.c_str(), 0600), 0);
  EXPECT_THAT(WhyRefused(false), HasSubstr("is no plain file"));
  fs::remove(file_);
  fs::rename(folder_ / "elsewhere", file_);
  ASSERT_EQ(mkfifo((file_.string() + "-wal").c_str(), 0600), 0);
  EXPECT_THAT(WhyRefused(true), HasSubstr("is no plain file"));
  fs::remove(file_.string() + "-wal");
  fs::create_hard_link(file_, folder_ / "elsewhere");
  EXPECT_EQ(WhyRefused(false), "");
  EXPECT_THAT(WhyRefused(true), HasSubstr("is a hard link"));
  std::ofstream(folder_ / "mine") << "my notes";
  fs::create_hard_link(folder_ / "mine", file_.string() + "-shm");
  EXPECT_THAT(WhyRefused(false), HasSubstr("is a hard link"));
  EXPECT_EQ(Slurp(folder_ / "mine"), "my notes");
}

TEST_F(CampaignStoreTest, AFileThatIsTooLargeIsRefusedUnread) {
  Make(1);
  fs::resize_file(file_, std::uintmax_t{257} << 30);  // a hole: it takes no space
  EXPECT_THAT(WhyRefused(false), HasSubstr("is larger than 256 GiB"));
}

// SQLite would play a rollback journal into the database when it is opened to be written, after it
// was checked.
TEST_F(CampaignStoreTest, AJournalBesideTheFileIsRefused) {
  Make(3);
  const std::string sound = Slurp(file_);
  // What a kill leaves in the middle of a change that makes the whole file another one.
  sqlite3* db = nullptr;
  ASSERT_EQ(sqlite3_open(file_.c_str(), &db), SQLITE_OK);
  ASSERT_EQ(sqlite3_exec(db,
                         "PRAGMA journal_mode=DELETE; CREATE TABLE more(a); BEGIN;"
                         "PRAGMA cache_size=1; DROP TABLE more;",
                         nullptr, nullptr, nullptr),
            SQLITE_OK);
  sqlite3_db_cacheflush(db);
  const std::string journal = Slurp(file_.string() + "-journal");
  sqlite3_exec(db, "ROLLBACK", nullptr, nullptr, nullptr);
  sqlite3_close(db);
  ASSERT_FALSE(journal.empty());
  std::ofstream(file_, std::ios::binary | std::ios::trunc) << sound;
  std::ofstream(file_.string() + "-journal", std::ios::binary) << journal;
  const auto before = Bytes(folder_);
  for (const bool write : {false, true})
    EXPECT_THAT(WhyRefused(write), HasSubstr("is a rollback journal"));
  EXPECT_EQ(Bytes(folder_), before);
}

TEST_F(CampaignStoreTest, ACampaignThatGoesOnIsNotRead) {
  Make(2);
  CampaignStore first = CampaignStore::Open(file_, true);
  first.Add(std::vector{Row(2)});
  EXPECT_THAT(WhyRefused(false), HasSubstr("is in use by another campaign"));
}

std::string WhyOther(const CampaignAbout& there, CampaignAbout now) {
  now.id = "another";
  try {
    RequireSame(there, now, "o/campaign.sqlite");
  } catch (const InputError& e) {
    return e.what();
  }
  return "";
}

TEST_F(CampaignStoreTest, AnotherCampaignIsToldByWhatDiffers) {
  CampaignAbout now = about_;
  EXPECT_NO_THROW(RequireSame(about_, now, file_));
  now.scenario = "seed: 2\nsite:\n  name: a\n";
  EXPECT_EQ(WhyOther(about_, now), "o/campaign.sqlite: holds another campaign: seed was 1, is 2");
  now.scenario = "seed: 1\nsite:\n  name: b\n";
  EXPECT_THAT(WhyOther(about_, now), HasSubstr("site.name was a, is b"));
  now.scenario = "seed: 1\nsite:\n  name: a\n  start: [1, 2]\n";
  EXPECT_THAT(WhyOther(about_, now), HasSubstr("site.start was not there, is 2 values"));
  now.scenario = "seed: 1\n";
  EXPECT_THAT(WhyOther(about_, now), HasSubstr("site was other parts, is not there now"));
  now.scenario = "site:\n  name: a\nseed: 1\n";
  EXPECT_THAT(WhyOther(about_, now), HasSubstr("its keys stand in another order"));
  now = about_;
  now.versions = R"({"floorproof": "2"})";
  EXPECT_THAT(WhyOther(about_, now), HasSubstr("version.floorproof was 1, is 2"));
}

}  // namespace
}  // namespace floorproof
