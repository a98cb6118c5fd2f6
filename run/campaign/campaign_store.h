// SPDX-License-Identifier: Apache-2.0
// campaign.sqlite: a row an episode, added in batches that a kill or a full disk leaves whole.
//
// Table `encounter` has the hazards that each episode met, kept or `extra`: the key is (campaign,
// variant, episode, number).
// Table `episode` has the key (campaign, variant, episode) and no other order, so that the same
// episodes give the same `.dump` whatever order they ended in. Episodes driven beyond an early stop
// stand in `extra`, wall times in `timing`, what the campaign is in `about`. Plans that programs
// made are kept beside the file, in `inputs`, by their SHA-256 (base/input_files.h).
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <set>
#include <span>
#include <string>
#include <vector>

#include "run/campaign/campaign_schema.h"
#include "run/campaign/episode_row.h"

struct sqlite3;

namespace floorproof {

// What a campaign is: rows of two may stand together only where all of it is the same.
struct CampaignAbout {
  std::string id;        // of the rest
  std::string scenario;  // its resolved text, paths as from the scenario's own folder
  std::string versions;  // JSON
};

class CampaignStore {
 public:
  // Makes the file, which must not be there.
  static CampaignStore Create(const std::filesystem::path& file, const CampaignAbout& about);
  // Opens one that is; read-only unless `write`. Whoever made it is not trusted: it may hold these
  // tables alone, and every text is parsed. Throws InputError, the file untouched, when it is
  // damaged or no campaign's.
  static CampaignStore Open(const std::filesystem::path& file, bool write);
  // What was opened to be read may be written from now on. Throws InputError, also where a version
  // of other metrics made it.
  void MakeWritable();
  CampaignStore(CampaignStore&&) noexcept;
  ~CampaignStore();

  const CampaignAbout& about() const { return about_; }

  // All rows or none. Throws InputError naming the file when the disk is full.
  void Add(std::span<const EpisodeRow> rows);
  // Of which there are episodes, in alphabetical order.
  std::vector<std::string> Variants() const;
  // Episodes of a variant that are there, `extra` ones too, ascending.
  std::vector<std::uint64_t> Episodes(const std::string& variant) const;
  // Rows of table `episode`, one variant's, in the order of their numbers; with `extra`, those that
  // are kept and not counted, too.
  void ForEach(const std::string& variant, const std::function<void(const EpisodeRow&)>& visit,
               bool extra = false) const;
  // One row of either table.
  std::optional<EpisodeRow> Find(const std::string& variant, std::uint64_t episode) const;
  // The hazards that an episode of either table met, in the order of their numbers.
  std::vector<Encounter> EncountersOf(const std::string& variant, std::uint64_t episode) const;
  // Of all of a variant's episodes in table `episode`, in the order of their numbers.
  void ForEachEncounter(
      const std::string& variant,
      const std::function<void(std::uint64_t episode, const Encounter&)>& visit) const;
  // How many episodes a variant were asked for, last; 0: nobody said.
  std::uint64_t asked() const { return asked_; }
  void SetAsked(std::uint64_t episodes);
  // Rows of outcome `error` are dropped, so that they are driven again.
  void DropErrors();
  // The first of the variant's, and all rows after it.
  void DropFromFirstError(const std::string& variant);
  // Throws InternalError if the file is no longer the one that was opened: removed, replaced, or
  // moved with its folder. Add checks it too, so that a campaign stops when its rows are lost.
  void RequireInPlace() const;
  // The log's rows go into the file itself, so that it is whole alone.
  void Settle();
  // Moves rows of this number and beyond from `episode` to `extra`; those before it back.
  void SetExtraFrom(const std::string& variant, std::uint64_t episode);

 private:
  struct Statement;
  CampaignStore(const std::filesystem::path& file, sqlite3* db);
  // Opens the file as it is.
  static CampaignStore Connect(const std::filesystem::path& file, int flags);
  // Makes the tables in `part`; errors name `file`.
  static void Fill(const std::filesystem::path& file, const std::filesystem::path& part,
                   const CampaignAbout& about);
  void Run(const std::string& sql);
  [[noreturn]] void Refuse(int code) const;
  void Check();
  void ReadAbout();
  void Distrust() const;
  CampaignSchema CheckTables();
  void CheckRows(const std::vector<Column>& columns) const;
  void CheckEncounters() const;
  [[noreturn]] void RefuseRow(const std::string& table, const std::string& why) const;
  void AddEncounters(std::span<const EpisodeRow> rows);
  void RequireColumns() const;

  std::filesystem::path file_;
  sqlite3* db_ = nullptr;
  CampaignAbout about_;
  std::uint64_t asked_ = 0;
  bool sound_ = false;          // looked through
  bool has_encounters_ = true;  // files of earlier versions have no such table
  std::set<std::string> kept_;  // SHA-256 of the plans that are
};

}  // namespace floorproof
