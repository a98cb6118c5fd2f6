// SPDX-License-Identifier: Apache-2.0
// Letters of any script, drawn with the fonts that are installed.
#pragma once

#include <optional>
#include <string_view>

#include "media/media.h"

namespace floorproof {

struct Lettering {
  Image coverage;         // one channel: how much of each pixel the letters cover, 0 to 255
  int base = 0;           // row of the base line
  double advance_px = 0;  // from the text's begin, column 0, to where text after it begins
};

// One line of UTF-8 that is written in one direction, at this height of a capital letter. None
// where no installed font has all of its letters. Throws InternalError.
std::optional<Lettering> DrawLettering(std::string_view utf8, double cap_px, bool bold);

}  // namespace floorproof
