// SPDX-License-Identifier: Apache-2.0
// The table of monitors, made from their list.
#include "controllers/monitors/monitor.h"

namespace floorproof {

std::string_view Name(MonitorKind kind) {
  constexpr std::string_view kNames[] = {"limit", "trend", "signal model", "process model",
                                         "multivariate"};
  return kNames[static_cast<int>(kind)];
}

#define FP_MONITOR(Class, name, help) std::unique_ptr<Monitor> Make##Class();
#include "controllers/monitors/list.inc"
#undef FP_MONITOR

std::span<const PluginEntry<Monitor>> Monitors() {
  static constexpr PluginEntry<Monitor> kTable[] = {
#define FP_MONITOR(Class, name, help) {name, help, &Make##Class},
#include "controllers/monitors/list.inc"
#undef FP_MONITOR
  };
  return kTable;
}

}  // namespace floorproof
