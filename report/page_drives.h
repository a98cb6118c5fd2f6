// SPDX-License-Identifier: Apache-2.0
// The drives that a page replays, each on the map of its own floor.
#pragma once

#include <cstddef>
#include <string>

#include "report/html_page.h"
#include "report/page_data.h"
#include "report/run_record.h"

namespace floorproof {

// Where the scripts show map and drives. `still`: HTML in the map's place without them; `note`:
// HTML that stays.
std::string TheaterHtml(const std::string& still = "", const std::string& note = "");

class PageDrives {
 public:
  explicit PageDrives(HtmlPage& page) : page_(page) {}

  // The number of the next drive, whose film is "film-<number>" on the page.
  std::size_t size() const { return drives_.size(); }
  // A drive by its record (RunRecord::Show). Returns what of it could not be read.
  std::string Add(const RunRecord& record, const std::string& name, const std::string& command,
                  bool filmed);
  // One of which there is no more than its film.
  void AddFilm(const std::string& name);
  // Hands them to the page's scripts, once all are here.
  void Finish();

 private:
  HtmlPage& page_;
  PageJson drives_ = PageJson::array(), maps_ = PageJson::array();
};

}  // namespace floorproof
