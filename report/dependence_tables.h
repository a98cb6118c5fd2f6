// SPDX-License-Identifier: Apache-2.0
// A report's part on what failures depend on: rates by each drawn value and by pairs of them, the
// most telling first, and up to which value the rate is shown to be low.
#pragma once

#include <string>

#include "report/page.h"

namespace floorproof {

// Empty where no variant drew anything.
std::string DependenceTables(const Report& report);

}  // namespace floorproof
