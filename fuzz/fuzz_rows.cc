// SPDX-License-Identifier: Apache-2.0
// A campaign's database of the right form with other values in its rows, read as `report`, `merge`
// and `compare` do. (fuzz_campaign changes the file's bytes, most of which SQLite itself refuses.)
// The input is a list of values: table, column, kind, length, bytes.
#include <sqlite3.h>

#include <array>
#include <cstring>

#include "fuzz/read_or_refuse.h"
#include "run/campaign/campaign_store.h"
#include "run/campaign/campaign_summary.h"
#include "run/campaign/dependence.h"
#include "run/campaign/episodes_csv.h"

namespace floorproof {
namespace {

constexpr std::array kTables = {"episode", "extra", "encounter", "about", "timing"};

// Two episodes that count and one that does not, with their encounters.
std::string SoundDatabase() {
  const auto file = Folder() / "sound.sqlite";
  {
    CampaignStore store =
        CampaignStore::Create(file, {"0123456789abcdef", "seed: 1\n", R"({"floorproof": "1"})"});
    std::vector<EpisodeRow> rows(3);
    for (std::uint64_t i = 0; i < rows.size(); ++i) {
      EpisodeRow& row = rows[i];
      row.variant = "default";
      row.episode = i;
      row.outcome = i == 0 ? "failure" : "timeout";
      row.events_of[0] = i == 0;
      for (auto& metric : row.metrics) metric = 0.5;
      row.drawn = R"({"site.floor.friction": 0.5, "floor": "wet"})";
      row.plan = R"({"status": "success"})";
      row.events = R"([{"mode": "stuck", "kind": "", "hazard": "", "t_s": 1, "x_m": 0, "y_m": 0}])";
      row.timeout = R"({"t_s": 60, "x_m": 1.5, "y_m": 2, "yaw_rad": 0, "hazard": ""})";
      row.encounters.resize(1);
    }
    store.Add(rows);
    store.SetExtraFrom("default", 2);
  }
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

// Takes bytes from the front.
struct Input {
  std::string_view left;
  std::size_t Byte() {
    if (left.empty()) return 0;
    const auto byte = static_cast<unsigned char>(left.front());
    left.remove_prefix(1);
    return byte;
  }
  std::string_view Take(std::size_t n) {
    const std::string_view taken = left.substr(0, n);
    left.remove_prefix(taken.size());
    return taken;
  }
};

std::vector<std::string> ColumnsOf(sqlite3* db, const std::string& table) {
  std::vector<std::string> names;
  sqlite3_stmt* all = nullptr;
  sqlite3_prepare_v2(db, ("SELECT * FROM " + table).c_str(), -1, &all, nullptr);
  for (int i = 0; i < sqlite3_column_count(all); ++i) names.push_back(sqlite3_column_name(all, i));
  sqlite3_finalize(all);
  return names;
}

void SetValue(sqlite3* db, Input& input) {
  const std::string table = kTables[input.Byte() % kTables.size()];
  const std::vector<std::string> columns = ColumnsOf(db, table);
  const std::string column = columns[input.Byte() % columns.size()];
  sqlite3_stmt* update = nullptr;
  const std::string sql = "UPDATE OR IGNORE " + table + " SET " + column + " = ?";
  sqlite3_prepare_v2(db, sql.c_str(), -1, &update, nullptr);
  const std::size_t kind = input.Byte() % 5;
  const std::string_view bytes = input.Take(kind == 1 || kind == 2 ? 8 : input.Byte());
  char number[8] = {};
  std::memcpy(number, bytes.data(), std::min(bytes.size(), sizeof number));
  std::int64_t whole = 0;
  double real = 0;
  std::memcpy(&whole, number, sizeof whole);
  std::memcpy(&real, number, sizeof real);
  const int length = static_cast<int>(bytes.size());
  if (kind == 1) sqlite3_bind_int64(update, 1, whole);
  if (kind == 2) sqlite3_bind_double(update, 1, real);
  if (kind == 3) sqlite3_bind_text(update, 1, bytes.data(), length, SQLITE_TRANSIENT);
  if (kind == 4) sqlite3_bind_blob(update, 1, bytes.data(), length, SQLITE_TRANSIENT);
  sqlite3_step(update);  // a value that a table itself refuses stays as it was
  sqlite3_finalize(update);
}

void Read(const CampaignStore& store) {
  std::vector<Variant> variants;
  for (const std::string& name : store.Variants()) variants.push_back({name, {}});
  for (const Variant& variant : variants) {
    store.ForEach(
        variant.name,
        [&](const EpisodeRow& row) {
          EventsOf(row);
          TimeoutOf(row);
          MadePlan(row);
          FromLine(ToLine(row));
          store.EncountersOf(variant.name, row.episode);
        },
        true);
    store.ForEachEncounter(variant.name, [](std::uint64_t, const Encounter&) {});
  }
  EpisodesCsv(store, variants);
  DependenceOf(store, Summarise(store, variants, {}, ""));
}

}  // namespace
}  // namespace floorproof

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace floorproof;
  static const std::string sound = SoundDatabase();
  const auto file = Save("campaign.sqlite", sound);
  for (const char* end : {"-wal", "-shm", "-journal"}) std::filesystem::remove(file.string() + end);
  sqlite3* db = nullptr;
  sqlite3_open(file.c_str(), &db);
  sqlite3_exec(db, "PRAGMA synchronous=OFF; PRAGMA journal_mode=MEMORY; BEGIN", nullptr, nullptr,
               nullptr);
  Input input{View(data, size)};
  for (int values = 0; values < 8 && !input.left.empty(); ++values) SetValue(db, input);
  sqlite3_exec(db, "COMMIT", nullptr, nullptr, nullptr);
  sqlite3_close(db);
  ReadOrRefuse([&] { Read(CampaignStore::Open(file, false)); });
  return 0;
}
