// SPDX-License-Identifier: Apache-2.0
// Where the bundled robots, sites and scenarios are.
#pragma once

#include <filesystem>

namespace floorproof {

// Folder of the bundled models: FLOORPROOF_MODELS, else the one that was set, else where this
// program was built from.
std::filesystem::path ModelsFolder();
// For a package that carries them along (python/). Before anything is read.
void SetModelsFolder(const std::filesystem::path& folder);

}  // namespace floorproof
