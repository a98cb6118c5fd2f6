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

// Descriptors of our own that no child is to hold: a lock would outlive whoever took it, and a pipe
// would not end. What else is open may be a plug-in's, its log file say, and stays open in
// children.
void Own(int fd);
// As pipe(2), both ends our own; false and errno.
bool OwnPipe(int (&ends)[2]);
void CloseOwn(int fd);

// In a child.
void CloseAllOwnBut(std::initializer_list<int> kept);
// In a child, of all that lies beyond stderr: it goes on as another program.
void CloseAllBut(std::initializer_list<int> kept);

}  // namespace floorproof
