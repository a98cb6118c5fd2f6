// SPDX-License-Identifier: Apache-2.0
// The films, frames and maps that lie in a campaign's folder.
#pragma once

#include <filesystem>
#include <functional>
#include <string>

#include "report/page.h"

namespace floorproof {

// Fills `films` and `films_left_out`: the first films by variant and episode; larger ones are
// linked. `what` says how an episode ended.
void AddFilms(const std::filesystem::path& folder,
              const std::function<std::string(const std::string&, std::uint64_t)>& what,
              Report& report);

}  // namespace floorproof
