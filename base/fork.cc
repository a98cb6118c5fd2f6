// SPDX-License-Identifier: Apache-2.0
#include "base/fork.h"

#include <unistd.h>

#include <algorithm>
#include <cerrno>

namespace floorproof {
namespace {

ForkHooks g_hooks;

}  // namespace

void SetForkHooks(const ForkHooks& hooks) { g_hooks = hooks; }

pid_t Fork() {
  if (g_hooks.before) g_hooks.before();
  const pid_t child = fork();
  const int error = errno;
  void (*const after)() = child == 0 ? g_hooks.in_child : g_hooks.in_parent;
  if (after) after();
  errno = error;
  return child;
}

void CloseAllBut(std::initializer_list<int> kept) {
  constexpr unsigned kEnd = ~0u;
  for (unsigned from = 3;;) {
    unsigned next = kEnd;  // that is kept
    for (const int fd : kept)
      if (const auto end = static_cast<unsigned>(fd); end >= from) next = std::min(next, end);
    if (from < next) close_range(from, next - 1, 0);
    if (next == kEnd) return;
    from = next + 1;
  }
}

}  // namespace floorproof
