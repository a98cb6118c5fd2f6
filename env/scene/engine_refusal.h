// SPDX-License-Identifier: Apache-2.0
// What MuJoCo says of a model that it does not read or compile, as one line of bad input.
#pragma once

#include <filesystem>
#include <string_view>

#include "base/error.h"

namespace floorproof {

// "FILE:LINE: RULE: MESSAGE". MuJoCo names lines of the file itself alone: an error within an
// include has none. Files below the model's folder are named relative to it, and quotes from the
// model are cut to 60 characters.
InputError EngineRefusal(const std::filesystem::path& file, std::string_view rule,
                         std::string_view message);

}  // namespace floorproof
