// SPDX-License-Identifier: Apache-2.0
#include "base/progress_line.h"

#include <unistd.h>

#include <cstdio>

#include "base/printable.h"

namespace floorproof {

ProgressLine::ProgressLine(const Console& console)
    : quiet_(console.quiet || console.listener), terminal_(isatty(STDERR_FILENO) != 0) {}

bool ProgressLine::IsDue() {
  if (quiet_) return false;
  const auto now = std::chrono::steady_clock::now();
  if (now - last_ < std::chrono::milliseconds(terminal_ ? 200 : 10000)) return false;
  last_ = now;
  return true;
}

void ProgressLine::Show(const std::string& line) {
  std::fprintf(stderr, terminal_ ? "\r\033[K%s" : "%s\n", Printable(line).c_str());
  std::fflush(stderr);
  shown_ = true;
}

void ProgressLine::Clear() {
  if (shown_ && terminal_) std::fprintf(stderr, "\r\033[K");
  shown_ = false;
}

}  // namespace floorproof
