// SPDX-License-Identifier: Apache-2.0
// The films, frames and maps that lie in a campaign's folder.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "report/page.h"

namespace floorproof {

inline constexpr std::uintmax_t kLargestFilm = 8u << 20;  // in a page, bytes; larger: linked

// The pictures of that prefix that lie in a folder; one that shows what another did is left out.
std::vector<ReportPicture> PicturesIn(const std::filesystem::path& folder,
                                      const std::string& prefix);

// Fills `films` and `films_left_out`: the first films by variant and episode; larger ones are
// linked. `what` says how an episode ended.
void AddFilms(const std::filesystem::path& folder,
              const std::function<std::string(const std::string&, std::uint64_t)>& what,
              Report& report);

}  // namespace floorproof
