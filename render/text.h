// SPDX-License-Identifier: Apache-2.0
// Lettering on pictures, smooth at any size.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <string_view>

#include "media/media.h"

namespace floorproof {

using Rgb = std::array<std::uint8_t, 3>;

enum class Anchor { kLeft, kCentre, kRight };

struct TextStyle {
  double cap_px = 14;  // height of a capital letter
  Rgb colour = {255, 255, 255};
  Anchor anchor = Anchor::kLeft;
  bool bold = false;
};

// The text without its last letter, of however many bytes.
std::string_view WithoutLastLetter(std::string_view text);
double TextWidth(std::string_view text, const TextStyle& style);  // px
// Writes onto an RGB picture with the base line at y_px; the text begins, is centred or ends at
// x_px. What lies beyond the picture is cut off. Letters are drawn in an installed font that has
// them, each word in its own direction of writing; where none has them, they are escaped (\u4e2d),
// and ASCII is drawn in strokes. Control characters and bytes that are no UTF-8 become '?'.
void DrawText(Image& image, double x_px, double y_px, std::string_view text,
              const TextStyle& style);
// Mixes `colour` over the rectangle [x0, x1) x [y0, y1); alpha 0 leaves it, 1 covers it.
void FillRectangle(Image& image, int x0, int y0, int x1, int y1, const Rgb& colour, double alpha);

}  // namespace floorproof
