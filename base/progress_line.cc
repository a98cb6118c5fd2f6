// SPDX-License-Identifier: Apache-2.0
#include "base/progress_line.h"

#include <unistd.h>

#include <cstdio>

#include "base/printable.h"
#include "base/terminal.h"
#include "base/text_width.h"

namespace floorproof {

ProgressLine::ProgressLine(const Console& console)
    : quiet_(console.quiet || console.listener), terminal_(IsTerminal(STDERR_FILENO)) {}

bool ProgressLine::IsDue() {
  if (quiet_) return false;
  const auto now = std::chrono::steady_clock::now();
  if (now - last_ < std::chrono::milliseconds(terminal_ ? 200 : 10000)) return false;
  last_ = now;
  return true;
}

void ProgressLine::Show(const std::string& line) {
  const std::string text = Printable(line);
  // One that went on below its row would not be rewritten, but repeated.
  if (terminal_)
    std::fprintf(stderr, "\r\033[K%s", CutText(text, TerminalWidth(STDERR_FILENO) - 1).c_str());
  else
    std::fprintf(stderr, "%s\n", text.c_str());
  std::fflush(stderr);
  shown_ = true;
}

void ProgressLine::Clear() {
  if (shown_ && terminal_) std::fprintf(stderr, "\r\033[K");
  shown_ = false;
}

}  // namespace floorproof
