// SPDX-License-Identifier: Apache-2.0
#include "base/console.h"

#include <cstdio>

#include "base/printable.h"

namespace floorproof {

void Console::Say(const std::string& line) const {
  if (listener) listener(Printable(line));
  if (quiet || listener) return;
  std::FILE* out = json ? stderr : stdout;
  std::fprintf(out, "%s\n", Printable(line).c_str());
  std::fflush(out);
}

}  // namespace floorproof
