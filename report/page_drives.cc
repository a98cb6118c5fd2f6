// SPDX-License-Identifier: Apache-2.0
#include "report/page_drives.h"

#include <fmt/format.h>

#include <utility>

namespace floorproof {

std::string TheaterHtml(const std::string& still, const std::string& note) {
  const bool empty = still.empty() && note.empty();
  return "<div class=\"card theater\" id=\"theater\"" + std::string(empty ? " hidden" : "") +
         "><div><div id=\"map-view\" class=\"map\" hidden></div><div class=\"replaced-by-map\">" +
         still + "</div>" + note +
         "</div><div id=\"drive-view\"></div><div id=\"drive-curves\" "
         "class=\"across\"></div></div>\n";
}

std::string PageDrives::Add(const RunRecord& record, const std::string& name,
                            const std::string& command, bool filmed) {
  RunRecord::Shown shown = record.Show(size(), command, filmed, page_);
  shown.drive["name"] = name;
  if (!shown.map.is_null()) {
    shown.drive["map"] = maps_.size();
    maps_.push_back(std::move(shown.map));
  }
  drives_.push_back(std::move(shown.drive));
  return shown.note;
}

void PageDrives::AddFilm(const std::string& name) {
  drives_.push_back({{"name", name},
                     {"events", PageJson::array()},
                     {"film", fmt::format("film-{}", drives_.size())}});
}

void PageDrives::Finish() {
  page_.data = PageText({{"drives", std::move(drives_)}, {"maps", std::move(maps_)}});
  page_.shows_plots = true;
}

}  // namespace floorproof
