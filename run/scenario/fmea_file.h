// SPDX-License-Identifier: Apache-2.0
// FMEA tables as a file (models/fmea/htetro.yaml is one).
#pragma once

#include <filesystem>

#include "base/input_files.h"
#include "planners/risk/fmea_tables.h"

namespace floorproof {

// Keys: fmea: 1; classes C1 to C4, each {name, detectability, modes: {F1 .. F4}}; modes F1 to F4,
// each {name, effects: {E1 .. E5}}; effects E1 to E5, each {name, severity}; names may be left out.
// Throws InputError naming file, line, key, value and rule: a missing or unknown key, a probability
// outside [0, 1], a row of modes or effects that does not sum to 1 (to 1e-6), a detectability or
// severity that is not positive.
FmeaTables ReadFmeaTables(const std::filesystem::path& file, const InputFiles& files = {});

}  // namespace floorproof
