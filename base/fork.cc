// SPDX-License-Identifier: Apache-2.0
#include "base/fork.h"

#include <unistd.h>

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

}  // namespace floorproof
