// SPDX-License-Identifier: Apache-2.0
// The table of laws, made from its list.
#include "validate/law.h"

namespace floorproof {

#define FP_LAW(Class, name, help) std::unique_ptr<Law> Make##Class();
#include "validate/laws/list.inc"
#undef FP_LAW

std::span<const PluginEntry<Law>> Laws() {
  static constexpr PluginEntry<Law> kTable[] = {
#define FP_LAW(Class, name, help) {name, help, &Make##Class},
#include "validate/laws/list.inc"
#undef FP_LAW
  };
  return kTable;
}

}  // namespace floorproof
