// SPDX-License-Identifier: Apache-2.0
#include "base/watched_call.h"

#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <thread>

namespace floorproof {
namespace {

using Clock = std::chrono::steady_clock;

WatchedCall* g_call = nullptr;

std::int64_t Now_ns() {
  return std::chrono::duration_cast<std::chrono::nanoseconds>(Clock::now().time_since_epoch())
      .count();
}

}  // namespace

std::optional<std::string> Overdue(const WatchedCall& call) {
  const std::int64_t until_ns = call.until_ns.load();
  if (until_ns == 0 || Now_ns() < until_ns) return std::nullopt;
  std::string why = call.why;
  if (call.until_ns.load() != until_ns)
    return std::nullopt;  // it ended, and another may have begun
  return why;
}

void TellCallsTo(WatchedCall* call) { g_call = call; }

void BeginCall(double until_s, const std::string& why) {
  if (g_call == nullptr) return;
  std::size_t size = std::min(why.size(), sizeof g_call->why - 1);
  while (size < why.size() && size > 0 && (why[size] & 0xC0) == 0x80) --size;  // whole letters
  why.copy(g_call->why, size);
  g_call->why[size] = '\0';
  g_call->until_ns = static_cast<std::int64_t>(until_s * 1e9);
}

void EndCall() {
  if (g_call != nullptr) g_call->until_ns = 0;
}

void EndWhereOverdue() {
  static WatchedCall call;
  if (g_call == &call) return;
  TellCallsTo(&call);
  std::thread([] {
    constexpr int kLate = 10;  // looks: whoever can still say why ends the process before
    for (int late = 0; late < kLate; late = Overdue(call) ? late + 1 : 0)
      std::this_thread::sleep_for(std::chrono::milliseconds(100));
    _exit(1);
  }).detach();
}

}  // namespace floorproof
