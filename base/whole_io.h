// SPDX-License-Identifier: Apache-2.0
// Bytes between processes, whole: however often a call is interrupted or moves only a part.
#pragma once

#include <cstddef>

namespace floorproof {

// All of it, or false: the other end is gone. (A pipe's writer is sent SIGPIPE then.)
bool WriteAll(int fd, const void* data, std::size_t size);
bool ReadAll(int fd, void* data, std::size_t size);

}  // namespace floorproof
