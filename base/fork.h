// SPDX-License-Identifier: Apache-2.0
// A child process that goes on from here. A program that holds this one as a library may have to
// prepare itself (an interpreter, say).
#pragma once

#include <sys/types.h>

#include <initializer_list>

namespace floorproof {

// Called around each Fork(): before it, then behind it in the parent, or in the child.
struct ForkHooks {
  void (*before)() = nullptr;
  void (*in_parent)() = nullptr;
  void (*in_child)() = nullptr;
};
void SetForkHooks(const ForkHooks& hooks);

// As fork(2): 0 in the child, the child in the parent, or -1 and errno.
pid_t Fork();

// In a child, of what lies beyond stderr: the locks and pipes of whoever forked must not live on in
// it.
void CloseAllBut(std::initializer_list<int> kept);

}  // namespace floorproof
