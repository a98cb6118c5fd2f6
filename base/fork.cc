// SPDX-License-Identifier: Apache-2.0
#include "base/fork.h"

#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <mutex>
#include <vector>

namespace floorproof {
namespace {

ForkHooks g_hooks;

// Held around each fork, so that a child of any thread knows all that are open in it.
std::mutex g_own_mutex;
std::vector<int> g_own;

}  // namespace

void SetForkHooks(const ForkHooks& hooks) { g_hooks = hooks; }

pid_t Fork() {
  if (g_hooks.before) g_hooks.before();
  g_own_mutex.lock();
  const pid_t child = fork();
  const int error = errno;
  g_own_mutex.unlock();
  void (*const after)() = child == 0 ? g_hooks.in_child : g_hooks.in_parent;
  if (after) after();
  errno = error;
  return child;
}

void Own(int fd) {
  const std::lock_guard lock(g_own_mutex);
  g_own.push_back(fd);
}

bool OwnPipe(int (&ends)[2]) {
  const std::lock_guard lock(g_own_mutex);
  if (pipe(ends) != 0) return false;
  g_own.insert(g_own.end(), {ends[0], ends[1]});
  return true;
}

void CloseOwn(int fd) {
  const std::lock_guard lock(g_own_mutex);
  std::erase(g_own, fd);
  close(fd);
}

void CloseAllOwnBut(std::initializer_list<int> kept) {
  const std::lock_guard lock(g_own_mutex);
  std::erase_if(g_own, [&](int fd) {
    if (std::ranges::find(kept, fd) != kept.end()) return false;
    close(fd);
    return true;
  });
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
