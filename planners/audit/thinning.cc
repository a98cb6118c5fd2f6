// SPDX-License-Identifier: Apache-2.0
#include "planners/audit/thinning.h"

#include "base/error.h"
#include "base/load_module.h"
#include "planners/audit/thinning_api.h"

namespace floorproof {

void Thin(Grid<std::uint8_t>& set) {
  static const auto thin = reinterpret_cast<ThinFunction*>(
      LoadModule(kThinningModule, kThinningSymbol, "OpenCV's thinning"));
  if (set.cells.empty()) return;
  for (std::uint8_t& cell : set.cells) cell = cell ? 255 : 0;
  if (const char* error = thin(set.cells.data(), set.width, set.height))
    throw InternalError(std::string("thinning failed: ") + error);
  for (std::uint8_t& cell : set.cells) cell = cell ? 1 : 0;
}

}  // namespace floorproof
