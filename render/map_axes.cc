// SPDX-License-Identifier: Apache-2.0
#include "render/map_axes.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>
#include <utility>

#include "render/strokes.h"

namespace floorproof {
namespace {

constexpr TextStyle kTickLabel = {.cap_px = 10, .colour = kInk},
                    kAxisName = {.cap_px = 11, .colour = kInk, .bold = true};
constexpr int kTick_px = 6, kGap_px = 4;
constexpr double kApart_px = 14;  // of labels side by side
constexpr Rgb kGrid = {186, 192, 200};

std::size_t Longest(const AxisTicks& ticks) {
  std::size_t longest = 0;
  for (const std::string& label : ticks.labels) longest = std::max(longest, label.size());
  return longest;
}

}  // namespace

AxisTicks TicksAt(double step, double low, double high) {
  AxisTicks ticks;
  ticks.step = step;
  const int decimals = std::max(0, static_cast<int>(std::ceil(-std::log10(step) - 1e-9)));
  const double first = std::ceil(low / step - 1e-9), last = std::floor(high / step + 1e-9);
  constexpr int kMost = 1000;
  for (int i = 0; i < kMost && first + i <= last; ++i) {
    const double whole = first + i;
    ticks.at.push_back(whole * step);
    ticks.labels.push_back(fmt::format("{:.{}f}", whole == 0 ? 0.0 : whole * step, decimals));
  }
  return ticks;
}

AxisTicks RoundTicks(double low, double high, double length_px, double least_px, double letter_px) {
  const double per_px = (high - low) / length_px;
  AxisTicks ticks = TicksAt(NiceStep(per_px * least_px), low, high);
  while (ticks.at.size() > 1 &&
         ticks.step < per_px * (least_px + letter_px * static_cast<double>(Longest(ticks))))
    ticks = TicksAt(NiceStep(1.5 * ticks.step), low, high);
  // A short border may lie between two of them. It shows a finer one then.
  for (int finer = 0; finer < 12 && ticks.at.empty(); ++finer)
    ticks = TicksAt(NiceStep(0.35 * ticks.step), low, high);
  return ticks;
}

MapAxes::MapAxes(const PanelFrame& frame) : height_px_(frame.height) {
  const double w = frame.width, h = frame.height, digit_px = TextWidth("00", kTickLabel) / 2;
  below_ = MakeBorder(frame, {0, h}, {w, 0}, {0, -1}, kApart_px + 40, digit_px);
  left_ = MakeBorder(frame, {0, h}, {0, -h}, {1, 0}, 44, 0);
  // One step for both, the coarser.
  below_.TakeStep(left_.ticks.step);
  left_.TakeStep(below_.ticks.step);
  double widest = TextWidth("y [m]", kAxisName);
  for (const std::string& label : left_.ticks.labels)
    widest = std::max(widest, TextWidth(label, kTickLabel));
  left_px_ = kTick_px + kGap_px + static_cast<int>(std::ceil(widest));
}

// The coordinate that grows faster along the border.
MapAxes::Border MapAxes::MakeBorder(const PanelFrame& frame, const cv::Point2d& from,
                                    const cv::Point2d& along, const cv::Point2d& inward,
                                    double least_px, double letter_px) {
  const double length_px = std::hypot(along.x, along.y);
  const Vec2 a = frame.World(from.x, from.y),
             slope = (frame.World(from.x + along.x, from.y + along.y) - a) / length_px,
             in = frame.World(from.x + inward.x, from.y + inward.y) - a;
  // Of an even choice the lower border takes x.
  const bool level = along.y == 0;
  const bool x = std::abs(slope.x()) > std::abs(slope.y()) * (level ? 1 - 1e-9 : 1 + 1e-9);
  Border border{x ? 'x' : 'y', 0, 0, length_px, 0, {}};
  const int k = x ? 0 : 1;
  border.first = a[k];
  border.per_px = slope[k];
  border.per_px_inward = in[k];
  border.ticks = RoundTicks(std::min(border.first, border.last()),
                            std::max(border.first, border.last()), length_px, least_px, letter_px);
  return border;
}

void MapAxes::Border::TakeStep(double step) {
  if (step <= ticks.step) return;
  AxisTicks coarser = TicksAt(step, std::min(first, last()), std::max(first, last()));
  if (coarser.at.size() > 1) ticks = std::move(coarser);
}

void MapAxes::DrawGrid(cv::Mat panel) const {
  constexpr double kStraight = 1e-6;
  const double reach = panel.cols + panel.rows;
  const auto draw = [&](const Border& border, auto at) {
    const double askew = -border.per_px_inward / border.per_px;  // px along, a px inward
    if (std::abs(askew) < kStraight) return;
    // Lines that meet the border beyond its ends cross the panel too.
    const double aside = std::abs(askew) * reach;
    const double step_px = std::abs(border.ticks.step / border.per_px);
    const double origin = border.ticks.at.empty() ? 0 : border.Pixel(border.ticks.at.front());
    const int before = static_cast<int>(std::ceil((origin + aside) / step_px)),
              after = static_cast<int>(std::ceil((border.length_px + aside) / step_px));
    for (int i = -before; i <= after; ++i) {
      const double px = origin + i * step_px;
      Line(panel, at(px, 0.0), at(px + askew * reach, reach), kGrid, 1);
    }
  };
  draw(below_, [&](double along, double in) { return cv::Point2d(along, height_px_ - in); });
  draw(left_, [&](double along, double in) { return cv::Point2d(in, height_px_ - along); });
}

void MapAxes::Draw(Image& image, const cv::Rect& panel) const {
  cv::Mat canvas = Canvas(image);
  const double bottom = panel.br().y;
  double end = -1e9;  // of the last label
  std::vector<std::pair<double, std::string>> shown;
  for (std::size_t i = 0; i < below_.ticks.at.size(); ++i)
    shown.emplace_back(panel.x + below_.Pixel(below_.ticks.at[i]), below_.ticks.labels[i]);
  std::ranges::sort(shown);
  for (const auto& [x, label] : shown) {
    Line(canvas, {x, bottom}, {x, bottom + kTick_px}, kInk, 1);
    const double half = TextWidth(label, kTickLabel) / 2;
    if (x - half < end + kApart_px / 2) continue;
    end = x + half;
    DrawText(image, x, bottom + kTick_px + kGap_px + kTickLabel.cap_px, label,
             {.cap_px = kTickLabel.cap_px, .colour = kInk, .anchor = Anchor::kCentre});
  }
  const auto name = [](const Border& border) { return fmt::format("{} [m]", border.name); };
  DrawText(image, panel.x + 0.5 * panel.width, bottom + 42, name(below_),
           {.cap_px = kAxisName.cap_px, .colour = kInk, .anchor = Anchor::kCentre, .bold = true});

  TextStyle right = kTickLabel;
  right.anchor = Anchor::kRight;
  double top = 1e9;  // of the last label; upward
  shown.clear();
  for (std::size_t i = 0; i < left_.ticks.at.size(); ++i)
    shown.emplace_back(-(bottom - left_.Pixel(left_.ticks.at[i])), left_.ticks.labels[i]);
  std::ranges::sort(shown);
  for (const auto& [minus_y, label] : shown) {
    const double y = -minus_y;
    Line(canvas, {1.0 * panel.x - kTick_px - 1, y}, {1.0 * panel.x - 1, y}, kInk, 1);
    if (y + 0.5 * kTickLabel.cap_px > top - kGap_px) continue;
    top = y - 0.5 * kTickLabel.cap_px;
    DrawText(image, panel.x - kTick_px - kGap_px, y + 0.5 * kTickLabel.cap_px, label, right);
  }
  right = kAxisName;
  right.anchor = Anchor::kRight;
  DrawText(image, panel.x - kTick_px - kGap_px, panel.y - 14, name(left_), right);
}

}  // namespace floorproof
