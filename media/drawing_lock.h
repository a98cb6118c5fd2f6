// SPDX-License-Identifier: Apache-2.0
// Whose turn it is to draw.
#pragma once

#include <mutex>

namespace floorproof {

// GL and the codecs are of the process: one picture at a time, where several threads drive. (Who
// draws may be called back and draw.)
inline std::recursive_mutex& Drawing() {
  static auto& drawing = *new std::recursive_mutex;  // a thread may hold it at the end
  return drawing;
}

}  // namespace floorproof
