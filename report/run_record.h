// SPDX-License-Identifier: Apache-2.0
// What a drive left in its folder, read back for a page.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "env/core/hazard_map.h"
#include "report/html_page.h"
#include "report/page_data.h"
#include "run/episode/json_file.h"

namespace floorproof {

class RunRecord {
 public:
  // Throws InputError if result.json is missing or damaged. Other files are omitted if
  // they are missing or damaged.
  explicit RunRecord(const std::filesystem::path& folder);

  const JsonValue& result() const { return result_; }
  std::string Text(const char* key) const { return result_.value(key, std::string()); }
  std::optional<double> Metric(const std::string& name) const;
  const std::vector<JsonValue>& Events() const { return events_; }
  // "roll over (tipped)"
  static std::string WhatOf(const JsonValue& event);

  // Of the scenario, where it can still be read.
  const std::string& settings() const { return settings_; }  // its text
  const std::string& subject() const { return subject_; }    // SubjectOf
  const std::string& why_no_map() const { return why_no_map_; }
  bool estimates() const { return estimates_; }  // the robot does not simply know where it is

  // The drive for the page's scripts, as its `number`-th (page_drives.h), and its map, null where
  // there is none. `command` drives it again. Its replay goes into `page`; its film, if `filmed`,
  // is the page's "film-<number>".
  struct Shown {
    PageJson drive, map;
    std::string note;  // what could not be read, in words
  };
  Shown Show(std::size_t number, const std::string& command, bool filmed, HtmlPage& page) const;

 private:
  PageJson Failures(std::size_t number) const;

  std::filesystem::path folder_;
  JsonValue result_;
  std::vector<JsonValue> events_;
  std::string settings_, subject_, why_no_map_;
  bool estimates_ = true;
  std::optional<HazardMap> map_;
  std::optional<std::string> mission_;  // of a supervised drive; it may have no name
};

}  // namespace floorproof
