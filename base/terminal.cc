// SPDX-License-Identifier: Apache-2.0
#include "base/terminal.h"

#include <sys/ioctl.h>
#include <unistd.h>

#include <charconv>
#include <cstdlib>
#include <string_view>

namespace floorproof {
namespace {

constexpr int kUsualWidth = 80;

std::string_view Environment(const char* name) {
  const char* value = std::getenv(name);
  return value == nullptr ? "" : value;
}

}  // namespace

bool IsTerminal(int fd) {
  const std::string_view kind = Environment("TERM");
  return isatty(fd) != 0 && !kind.empty() && kind != "dumb";
}

int TerminalWidth(int fd) {
  if (isatty(fd) == 0) return kUsualWidth;
  winsize window{};
  if (ioctl(fd, TIOCGWINSZ, &window) == 0 && window.ws_col > 0) return window.ws_col;
  const std::string_view columns = Environment("COLUMNS");
  int width = 0;
  std::from_chars(columns.data(), columns.data() + columns.size(), width);
  return width > 0 ? width : kUsualWidth;
}

bool HasColours(int fd) { return IsTerminal(fd) && Environment("NO_COLOR").empty(); }

}  // namespace floorproof
