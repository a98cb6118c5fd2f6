// SPDX-License-Identifier: Apache-2.0
// The table of methods, made from its list.
#include "validate/suite/method.h"

namespace floorproof {

#define FP_METHOD(Class, name, help) std::unique_ptr<Method> Make##Class();
#include "validate/suite/methods/list.inc"
#undef FP_METHOD

std::span<const PluginEntry<Method>> Methods() {
  static constexpr PluginEntry<Method> kTable[] = {
#define FP_METHOD(Class, name, help) {name, help, &Make##Class},
#include "validate/suite/methods/list.inc"
#undef FP_METHOD
  };
  return kTable;
}

}  // namespace floorproof
