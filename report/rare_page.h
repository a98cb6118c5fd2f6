// SPDX-License-Identifier: Apache-2.0
// The page of a search for rare failures: what its rare.json says, with the films of the likeliest.
#pragma once

#include <filesystem>
#include <string>

namespace floorproof {

// Whether such a search lies in the folder.
bool HoldsRareSearch(const std::filesystem::path& folder);

struct RarePage {
  std::string verdict;  // in a sentence
  std::string html;  // needs nothing beside it and loads nothing; films that are large are linked
};
// From what the folder records alone. Throws InputError where it cannot be read.
RarePage MakeRarePage(const std::filesystem::path& folder);

}  // namespace floorproof
