// SPDX-License-Identifier: Apache-2.0
// Time of the processor, which other work on the machine leaves alone for the most part.
#pragma once

#include <ctime>

namespace floorproof {

// Of this process, all its threads together.
inline double CpuSeconds() {
  timespec now{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

}  // namespace floorproof
