// SPDX-License-Identifier: Apache-2.0
// A scenario file as a JSON Schema (base/json_schema.h).
#pragma once

#include "base/config.h"

namespace floorproof {

// `gate`: the schema of what stands under that key, which campaigns read.
ConfigNode ScenarioSchema(ConfigNode gate);

}  // namespace floorproof
