// SPDX-License-Identifier: Apache-2.0
#include "render/overlay.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/quantity.h"
#include "env/core/failure_text.h"
#include "render/text.h"

namespace floorproof {
namespace {

constexpr Rgb kBannerInk = {18, 24, 32}, kPaper = {245, 247, 250}, kDim = {168, 180, 194};
constexpr Rgb kDone = {64, 200, 172};

// The measure of all others, px.
double Unit(const Image& image) { return std::max(18.0, image.height / 22.0); }

Rgb ToneColour(Banner::Tone tone) {
  switch (tone) {
    case Banner::Tone::kFailure:
      return {178, 32, 40};
    case Banner::Tone::kWarning:
      return {176, 108, 12};
    case Banner::Tone::kSuccess:
      return {22, 118, 84};
  }
  return kBannerInk;
}

std::string Clock(double t_s) {
  const auto tenths = static_cast<long>(std::floor(t_s * 10 + 1e-6));
  return fmt::format("{}:{:02}.{}", tenths / 600, tenths / 10 % 60, tenths % 10);
}

std::string Pace(double speed_up) {
  if (speed_up == 0) return "";
  if (std::abs(speed_up - 1) < 1e-9) return "real time";
  if (speed_up < 1) return "slow motion x" + NumberText(speed_up, 2);
  return speed_up < 9.95 ? "time lapse x" + NumberText(speed_up, 2)
                         : "time lapse x" + FixedText(speed_up, 0);
}

// The longest beginning of `text` that fits, with dots if it is not the whole.
std::string Fit(const std::string& text, double width_px, const TextStyle& style) {
  if (TextWidth(text, style) <= width_px) return text;
  std::string cut = text;
  while (!cut.empty() && TextWidth(cut + "...", style) > width_px) cut = WithoutLastLetter(cut);
  return cut.empty() ? "" : cut + "...";
}

void DrawStatus(const Overlay& overlay, Image& image, double unit) {
  const int top = RowsOf(image).bottom;
  const double base = image.height - 0.40 * unit, margin = 0.55 * unit, w = image.width;
  FillRectangle(image, 0, top, image.width, image.height, kBannerInk, 0.72);
  const TextStyle big{.cap_px = 0.42 * unit, .colour = kPaper, .bold = true};
  const TextStyle small{.cap_px = 0.34 * unit, .colour = kDim};
  TextStyle right = small;
  right.anchor = Anchor::kRight;
  DrawText(image, margin, base, Clock(overlay.t_s), big);
  const std::string pace = Pace(overlay.speed_up);
  DrawText(image, w - margin, base, pace, right);

  // From the middle outwards: the gauge, then the title in what is left of it.
  double gauge =
      w - 2 * margin - std::max(TextWidth("time lapse x9999", right), TextWidth(pace, right));
  if (overlay.coverage >= 0) {
    const double length = 0.20 * w;
    TextStyle percent = big;
    percent.anchor = Anchor::kRight;
    const std::string text = fmt::format("{:.1f} %", 100 * overlay.coverage);
    DrawText(image, gauge, base, text, percent);
    const int x1 = static_cast<int>(gauge - TextWidth("100.0 %", big) - 0.5 * margin);
    const int x0 = static_cast<int>(x1 - length);
    const int xm =
        x0 + static_cast<int>(std::lround(std::clamp(overlay.coverage, 0.0, 1.0) * (x1 - x0)));
    const int y1 = static_cast<int>(base), y0 = static_cast<int>(base - 0.42 * unit);
    FillRectangle(image, x0, y0, x1, y1, kPaper, 0.22);
    FillRectangle(image, x0, y0, xm, y1, kDone, 1.0);
    right.colour = kPaper;
    DrawText(image, x0 - 0.5 * margin, base, "covered", right);
    gauge = x0 - 0.5 * margin - TextWidth("covered", right);
  }
  const double from = margin + TextWidth("99:59.9", big) + margin;
  DrawText(image, from, base, Fit(overlay.title, gauge - margin - from, small), small);
}

void DrawBanner(const Banner& banner, Image& image, double unit) {
  const int bottom = RowsOf(image).top;
  const double margin = 0.55 * unit, room = image.width - 2 * margin;
  FillRectangle(image, 0, 0, image.width, bottom, ToneColour(banner.tone), 0.86);
  const TextStyle head{.cap_px = 0.52 * unit, .colour = kPaper, .bold = true};
  const TextStyle body{.cap_px = 0.36 * unit, .colour = kPaper};
  const bool two = !banner.detail.empty();
  DrawText(image, margin, two ? 0.92 * unit : 1.26 * unit, Fit(banner.headline, room, head), head);
  if (two) DrawText(image, margin, 1.66 * unit, Fit(banner.detail, room, body), body);
}

}  // namespace

OverlayRows RowsOf(const Image& image) {
  const double unit = Unit(image);
  return {static_cast<int>(2.0 * unit), image.height - static_cast<int>(1.25 * unit)};
}

void DrawOverlay(const Overlay& overlay, Image& image) {
  const double unit = Unit(image);
  DrawStatus(overlay, image, unit);
  if (overlay.banner != nullptr) DrawBanner(*overlay.banner, image, unit);
}

Banner FailureBanner(const Event& event, const HazardMap& map) {
  return {Banner::Tone::kFailure,
          "FAILURE   " + FailureName(event) + (event.hazard.empty() ? "" : "   at " + event.hazard),
          FailureSentence(event, map) + ";  t " + FixedText(event.t_s, 1) + " s"};
}

}  // namespace floorproof
