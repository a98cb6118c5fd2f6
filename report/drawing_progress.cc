// SPDX-License-Identifier: Apache-2.0
#include "report/drawing_progress.h"

#include <fmt/format.h>

namespace floorproof {

void DrawingProgress::Show(int done, int all) {
  if (!line_.IsDue()) return;
  std::string text = fmt::format("  {}: {} of {}", what_, done, all);
  if (done > 0) {
    const double to_go_s = line_.wall_s() * (all - done) / done;
    text += fmt::format(", about {:.0f} s to go", to_go_s);
  }
  line_.Show(text);
}

}  // namespace floorproof
