// SPDX-License-Identifier: Apache-2.0
// The call into a plug-in that a worker is in, where whoever watches the worker sees it. What hangs
// within somebody's C code can be ended with its process alone.
#pragma once

#include <atomic>
#include <cstdint>
#include <optional>
#include <string>

namespace floorproof {

// May lie in memory that processes share; one process writes, others read.
struct WatchedCall {
  std::atomic<std::int64_t> until_ns = 0;  // of the steady clock, one for all processes; 0: no call
  char why[1024] = {};                     // one line, cut where it is longer
};

// What to say of a process that is beyond what its call may take; none: it is not.
std::optional<std::string> Overdue(const WatchedCall& call);

// Where this process tells of its calls from now on.
void TellCallsTo(WatchedCall* call);
// A call begins, and its process may be ended after `until_s` (of the steady clock) with `why`.
// Where nobody watches, nothing happens.
void BeginCall(double until_s, const std::string& why);
void EndCall();

// For a worker that nobody watches from outside: a thread of its own ends the process, with status
// 1, where a call is a second overdue.
void EndWhereOverdue();

}  // namespace floorproof
