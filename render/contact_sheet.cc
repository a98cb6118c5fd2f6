// SPDX-License-Identifier: Apache-2.0
#include "render/contact_sheet.h"

#include <opencv2/imgproc.hpp>

#include "render/strokes.h"
#include "render/text.h"

namespace floorproof {
namespace {

constexpr int kSide_px = 200, kGap_px = 16, kCaption_px = 24, kTop_px = 64, kColumns = 6;
constexpr Rgb kRing = {214, 40, 57};

void DrawOne(const SheetImage& shown, int x, int y, Image& sheet) {
  const cv::Mat1b grey(shown.grey.height, shown.grey.width,
                       const_cast<std::uint8_t*>(shown.grey.cells.data()));  // read only
  cv::Mat small, upright;
  cv::resize(grey, small, {kSide_px, kSide_px}, 0, 0, cv::INTER_AREA);
  cv::flip(small, upright, 0);
  cv::Mat canvas = Canvas(sheet);
  cv::cvtColor(upright, canvas(cv::Rect(x, y, kSide_px, kSide_px)), cv::COLOR_GRAY2RGB);
  const Vec2 scale(1.0 * kSide_px / shown.grey.width, 1.0 * kSide_px / shown.grey.height);
  for (const Vec2& p : shown.ringed)
    Ring(canvas, {x + p.x() * scale.x(), y + kSide_px - p.y() * scale.y()}, 6, kRing, 1);
  DrawText(sheet, x, y + kSide_px + 16, shown.caption, {.cap_px = 9, .colour = kInk});
}

}  // namespace

Image DrawContactSheet(const std::string& title, const std::vector<SheetImage>& images) {
  const int rows = (static_cast<int>(images.size()) + kColumns - 1) / kColumns;
  Image sheet = GreyImage(kColumns * (kSide_px + kGap_px) + kGap_px,
                          kTop_px + rows * (kSide_px + kCaption_px + kGap_px), 255);
  DrawText(sheet, kGap_px, 36, title, {.cap_px = 15, .colour = kInk, .bold = true});
  for (int i = 0; i < static_cast<int>(images.size()); ++i)
    DrawOne(images[static_cast<std::size_t>(i)], kGap_px + i % kColumns * (kSide_px + kGap_px),
            kTop_px + i / kColumns * (kSide_px + kCaption_px + kGap_px), sheet);
  return sheet;
}

}  // namespace floorproof
