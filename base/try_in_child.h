// SPDX-License-Identifier: Apache-2.0
// Work in other people's code that may crash, hang or take all memory: tried in a child process, so
// that this one can say what came of it.
#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <string>

namespace floorproof {

struct TrialLimits {
  int cpu_s = 5;                          // of processor time, all threads
  int wall_s = 60;                        // where it waits instead of working
  std::size_t memory_bytes = 384u << 20;  // of data, beyond what this process holds already
};

struct TrialOutcome {
  std::optional<std::string> answer;  // what the work returned
  std::string failure;                // else: "crashed (...)", "took more than ..."
};

// Does `work` in a forked child, which has this process's memory and files and none of its threads:
// to be called where no other thread holds a lock that the work needs. Nothing that the work
// changes, prints or forgets to free is felt here. What it throws counts as a crash. Under the
// address sanitizer memory is not limited. Throws InternalError where no child can be had.
TrialOutcome TryInChild(const std::function<std::string()>& work, const TrialLimits& limits = {});

// Within the work: ends the child for want of memory, for allocators that would return nullptr.
// C++'s `new` does so by itself.
[[noreturn]] void EndForWantOfMemory();

}  // namespace floorproof
