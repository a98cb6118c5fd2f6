// SPDX-License-Identifier: Apache-2.0
// Jobs in worker processes, so that one that takes its process down takes nothing else with it.
//
// The parent forks the workers, hands each one job at a time over a pipe and knows what is in
// flight. A worker that dies is replaced and its job tried once more; a job that takes its process
// down twice is reported as crashed. A worker whose call into a plug-in is overdue
// (base/watched_call.h) is ended and replaced, and its job is not tried again. Workers ignore
// Ctrl-C, which is the parent's, and die with it. The parent must not have threads.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>

namespace floorproof {

using Job = std::uint64_t;

struct PoolCallbacks {
  std::function<std::string(Job)> work;        // in a worker: the answer, any bytes
  std::function<std::optional<Job>()> next;    // in the parent: none, there is no more to do
  std::function<void(Job, std::string)> done;  // in the parent
  // In the parent: given up. The text says how it ended, to go behind "crashed: ".
  std::function<void(Job, std::string)> crashed;
  // In the parent: given up, as a call into a plug-in would not end. The text is the call's.
  std::function<void(Job, std::string)> hung;
  std::function<bool()> stop;  // asked every 0.1 s or so: give up what flies
};

// Who does jobs: RunInWorkers, or workers that a caller has elsewhere. It asks `next` for jobs,
// hands each to a worker and calls `done`, `crashed` or `hung` once for each, in any order, unless
// `stop` says to give up. All calls but `work` come from the thread that it was called on.
using WorkerPool = std::function<void(const PoolCallbacks&)>;

// Returns when all jobs are done, or when `stop` said so: workers are killed then, and what they
// had in hand is not done. Throws InternalError when no process can be made.
void RunInWorkers(int workers, const PoolCallbacks& callbacks);

}  // namespace floorproof
