// SPDX-License-Identifier: Apache-2.0
// OpenCV's stroke font, drawn three times too large and averaged down. So strokes as thin as a
// pixel come out even, which OpenCV's own anti-aliasing does not achieve.
#include "render/text.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>
#include <string>

namespace floorproof {
namespace {

constexpr int kFont = cv::FONT_HERSHEY_DUPLEX;
constexpr double kCapUnits = 22;  // cap height of that font at scale 1, px
constexpr int kOver = 3;

struct Lettering {
  std::string text;
  double scale;
  int thickness;
  cv::Size size;  // px, kOver times too large
  int below;      // of letters that reach below the base line, px
};

Lettering Layout(std::string_view text, const TextStyle& style) {
  Lettering l;
  for (const char c : text) {
    const auto u = static_cast<unsigned char>(c);
    if ((u & 0xC0) == 0x80) continue;  // the rest of a UTF-8 letter
    l.text += u >= 32 && u < 127 ? c : '?';
  }
  l.scale = kOver * style.cap_px / kCapUnits;
  l.thickness = std::max(
      1, static_cast<int>(std::lround(kOver * style.cap_px * (style.bold ? 0.135 : 0.085))));
  l.size = cv::getTextSize(l.text, kFont, l.scale, l.thickness, &l.below);
  l.below += l.thickness;
  return l;
}

std::uint8_t Mix(std::uint8_t under, std::uint8_t over, int alpha_255) {
  return static_cast<std::uint8_t>((under * (255 - alpha_255) + over * alpha_255 + 127) / 255);
}

}  // namespace

double TextWidth(std::string_view text, const TextStyle& style) {
  return static_cast<double>(Layout(text, style).size.width) / kOver;
}

void DrawText(Image& image, double x_px, double y_px, std::string_view text,
              const TextStyle& style) {
  const Lettering l = Layout(text, style);
  if (l.text.empty()) return;
  const int pad = kOver * 2;
  const auto whole = [](int v) { return (v + kOver - 1) / kOver * kOver; };
  cv::Mat large(whole(l.size.height + l.below + 2 * pad), whole(l.size.width + 2 * pad), CV_8U,
                cv::Scalar(0));
  const int above = whole(l.size.height + pad);
  cv::putText(large, l.text, {pad, above}, kFont, l.scale, cv::Scalar(255), l.thickness,
              cv::LINE_AA);
  cv::Mat mask;
  cv::resize(large, mask, {large.cols / kOver, large.rows / kOver}, 0, 0, cv::INTER_AREA);

  const double shift = style.anchor == Anchor::kLeft     ? 0
                       : style.anchor == Anchor::kCentre ? 0.5 * l.size.width / kOver
                                                         : 1.0 * l.size.width / kOver;
  const int left = static_cast<int>(std::lround(x_px - shift)) - pad / kOver;
  const int top = static_cast<int>(std::lround(y_px)) - above / kOver;
  for (int r = std::max(0, -top); r < std::min(mask.rows, image.height - top); ++r) {
    const std::uint8_t* alpha = mask.ptr<std::uint8_t>(r);
    std::uint8_t* row =
        image.data.data() + static_cast<std::size_t>(top + r) * image.width * image.channels;
    for (int c = std::max(0, -left); c < std::min(mask.cols, image.width - left); ++c) {
      if (alpha[c] == 0) continue;
      std::uint8_t* pixel = row + static_cast<std::ptrdiff_t>(left + c) * image.channels;
      for (int k = 0; k < 3; ++k) pixel[k] = Mix(pixel[k], style.colour[k], alpha[c]);
    }
  }
}

void FillRectangle(Image& image, int x0, int y0, int x1, int y1, const Rgb& colour, double alpha) {
  x0 = std::max(x0, 0);
  y0 = std::max(y0, 0);
  x1 = std::min(x1, image.width);
  y1 = std::min(y1, image.height);
  const int a = static_cast<int>(std::lround(255 * std::clamp(alpha, 0.0, 1.0)));
  for (int y = y0; y < y1; ++y) {
    std::uint8_t* pixel =
        image.data.data() + (static_cast<std::size_t>(y) * image.width + x0) * image.channels;
    for (int x = x0; x < x1; ++x, pixel += image.channels) {
      for (int k = 0; k < 3; ++k) pixel[k] = Mix(pixel[k], colour[k], a);
    }
  }
}

}  // namespace floorproof
