// SPDX-License-Identifier: Apache-2.0
// Independent jobs on all cores.
#pragma once

#include <functional>

namespace floorproof {

// Calls run(0) ... run(n - 1), each once, on `jobs` threads that take the next index. The first
// exception that a job throws is thrown on here once all threads have ended; no new job begins
// after it, nor after an interrupt.
void RunParallel(int n, int jobs, const std::function<void(int)>& run);

}  // namespace floorproof
