// SPDX-License-Identifier: Apache-2.0
#include "render/cell_stage.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "base/error.h"
#include "base/quantity.h"
#include "render/heatmap_legend.h"
#include "render/heatmap_marks.h"
#include "render/strokes.h"

namespace floorproof {
namespace {

constexpr double kSlack = 1e-9;  // of the window, in cells
constexpr Rgb kBar = {18, 24, 32};
constexpr double kFirstLine = 4.6, kLine = 1.1;  // of the legend, in units: bases

// Cells whose middles lie within it, from its own.
std::vector<Cell> WindowCells(double radius) {
  std::vector<Cell> cells;
  const int reach = static_cast<int>(radius + kSlack);
  for (int iy = -reach; iy <= reach; ++iy)
    for (int ix = -reach; ix <= reach; ++ix)
      if (std::hypot(ix, iy) <= radius + kSlack) cells.push_back({ix, iy});
  return cells;
}

std::string Percent(double share) { return fmt::format("{:.1f} %", 100 * share); }

}  // namespace

// Title or verdict above, the status bar below, the floor between them and the legend beside it.
struct CellStage::Layout {
  Layout(int w, int h) : width(w), height(h) {
    Image size;
    size.width = w;
    size.height = h;
    const OverlayRows rows = RowsOf(size);
    top = rows.top;
    bottom = rows.bottom;
    unit = top / 2.0;
    pad = static_cast<int>(0.5 * unit);
    column = w >= 24 * unit ? static_cast<int>(10.5 * unit) : 0;
  }
  int room_width() const { return std::max(16, width - 2 * pad - (column > 0 ? column + pad : 0)); }
  int room_height() const { return std::max(16, bottom - top - pad); }

  int width, height, top, bottom, pad, column;
  double unit;
};

CellStage::CellStage(const CellFilmScript& script, int width, int height)
    : CellStage(script, Layout(width, height)) {}

CellStage::CellStage(const CellFilmScript& script, const Layout& layout)
    : script_(script),
      unit_px_(layout.unit),
      floor_(*script.map, *script.in_reach, layout.room_width(), layout.room_height()),
      window_(WindowCells(script.window_m / script.map->frame.cell_m)) {
  const int beside = layout.column > 0 ? layout.column + layout.pad : 0;
  left_px_ = std::max(0, (layout.width - floor_.image().width - beside) / 2);
  top_px_ = layout.top + std::max(0, (layout.room_height() - floor_.image().height) / 2);
  column_px_ = layout.column > 0 ? left_px_ + floor_.image().width + layout.pad : -1;
  DrawBackdrop(layout);
}

TextStyle CellStage::Headline() const {
  return {.cap_px = 0.46 * unit_px_, .colour = kInk, .bold = true};
}

void CellStage::DrawBackdrop(const Layout& layout) {
  backdrop_ = GreyImage(layout.width, layout.height, 255);
  FillRectangle(backdrop_, 0, layout.bottom, layout.width, layout.height, kBar, 1);
  const double u = unit_px_;
  if (layout.column > 0) DrawText(backdrop_, 0.55 * u, 1.26 * u, script_.title, Headline());
  cv::Mat canvas = Canvas(backdrop_);
  cv::rectangle(
      canvas,
      cv::Rect(left_px_ - 1, top_px_ - 1, floor_.image().width + 2, floor_.image().height + 2),
      Colour(kGrey), 1);
  if (column_px_ < 0) return;
  const TextStyle small{.cap_px = 0.34 * u, .colour = kGrey},
      label{.cap_px = 0.36 * u, .colour = kInk};
  DrawText(backdrop_, column_px_, top_px_ + 1.5 * u, "covered", small);
  DrawText(backdrop_, column_px_, top_px_ + 3.4 * u, "covered twice or more", small);

  double y = top_px_ + kFirstLine * u;
  const auto line = [&](std::string_view text, const auto& swatch) {
    if (y > layout.bottom - 0.3 * u) return;
    swatch(cv::Rect(column_px_, static_cast<int>(y - 0.55 * u), static_cast<int>(0.9 * u),
                    static_cast<int>(0.7 * u)));
    DrawText(backdrop_, column_px_ + 1.25 * u, y, text, label);
    y += kLine * u;
  };
  const auto area = [&](const Rgb& colour) {
    return [&, colour](const cv::Rect& place) {
      cv::rectangle(canvas, place, Colour(colour), cv::FILLED);
      cv::rectangle(canvas, place, Colour(kGrey), 1);
    };
  };
  for (int i = 0; i < kNumCellProperties; ++i)
    if (static_cast<CellProperty>(i) != CellProperty::kOutOfReach || floor_.any_out_of_reach())
      line(Name(static_cast<CellProperty>(i)), area(ColourOf(static_cast<CellProperty>(i))));
  line("wall, furniture", area(kWallColour));
  line("not seen yet", [&](const cv::Rect& place) {
    for (int r = place.y; r < place.br().y; ++r)
      for (int c = place.x; c < place.br().x; ++c) {
        const Rgb colour = Veiled(ColourOf(CellProperty::kNotCovered), c, r);
        canvas.at<cv::Vec3b>(r, c) = {colour[0], colour[1], colour[2]};
      }
    cv::rectangle(canvas, place, Colour(kGrey), 1);
  });
  line(fmt::format("robot, window {} m", NumberText(script_.window_m)), [&](const cv::Rect& place) {
    RingMark(canvas, 0.5 * (cv::Point2d(place.tl()) + cv::Point2d(place.br())), 0.4 * u, 2,
             kWindowBlue);
  });
  for (const LegendLine& mark : floor_.marks())
    line(mark.label, [&](const cv::Rect& place) { DrawSwatch(backdrop_, place, mark); });
}

void CellStage::Look(Cell from) {
  for (const Cell by : window_) {
    const Cell cell = {from.ix + by.ix, from.iy + by.iy};
    if (!script_.map->frame.Inside(cell)) continue;
    if (script_.known != nullptr && script_.known->At(cell) == CellState::kUnknown) continue;
    floor_.See(cell);
  }
}

void CellStage::Reach(double t_s) {
  for (; next_ < script_.steps.size() && script_.steps[next_].t_s <= t_s; ++next_) {
    const Cell cell = script_.map->frame.ToCell(script_.steps[next_].p_W);
    if (!script_.map->frame.Inside(cell)) continue;
    floor_.SetVisits(cell, floor_.visits(cell) + 1);
    Look(cell);
  }
}

void CellStage::Leave() {
  const Grid<std::uint8_t>& visits = *script_.visits;
  for (int iy = 0; iy < visits.height; ++iy)
    for (int ix = 0; ix < visits.width; ++ix)
      if (visits(ix, iy) > 0) floor_.SetVisits({ix, iy}, visits(ix, iy));
}

void CellStage::DrawNumbers() {
  const double u = unit_px_, right = column_px_ + 10 * u;
  const CellStep& now = script_.steps[next_ - 1];
  if (column_px_ < 0) {  // in place of the title
    DrawText(image_, 0.55 * u, 1.26 * u,
             "J_hc " + Percent(now.covered) + "   J_cc " + Percent(now.revisited), Headline());
    return;
  }
  const TextStyle big{.cap_px = 0.52 * u, .colour = kInk, .bold = true};
  TextStyle number = big;
  number.anchor = Anchor::kRight;
  const auto measure = [&](const char* name, double share, double y) {
    DrawText(image_, column_px_, top_px_ + y * u, name, big);
    DrawText(image_, right, top_px_ + y * u, Percent(share), number);
  };
  measure("J_hc", now.covered, 0.75);
  measure("J_cc", now.revisited, 2.65);
  const auto& counts = floor_.counts();
  std::int64_t all = 0;
  for (const std::int64_t n : counts) all += n;
  number.cap_px = 0.36 * u;
  number.bold = false;
  double y = top_px_ + kFirstLine * u;
  for (int i = 0; i < kNumCellProperties; ++i, y += kLine * u)
    if (static_cast<CellProperty>(i) != CellProperty::kOutOfReach)
      DrawText(image_, right, y,
               Percent(static_cast<double>(counts[static_cast<std::size_t>(i)]) /
                       static_cast<double>(std::max<std::int64_t>(all, 1))),
               number);
}

const Image& CellStage::Draw(const FilmFrame& frame, bool last) {
  Reach(frame.t_s);
  if (next_ == 0) throw InternalError("a film that begins before its drive");
  if (last) Leave();
  image_ = backdrop_;
  const Image& floor = floor_.image();
  const cv::Mat from(floor.height, floor.width, CV_8UC3,
                     const_cast<std::uint8_t*>(floor.data.data()));
  cv::Mat place = Canvas(image_)(cv::Rect(left_px_, top_px_, floor.width, floor.height));
  from.copyTo(place);
  const double px_per_m = floor_.frame().px_per_m();
  RingMark(place, floor_.frame().Pixel(script_.steps[next_ - 1].p_W), script_.window_m * px_per_m,
           std::max(3.0, 0.33 * px_per_m * script_.map->frame.cell_m), kWindowBlue);
  DrawNumbers();
  if (last && script_.closing)  // in place of the title
    FillRectangle(image_, 0, 0, image_.width, RowsOf(image_).top, kWhite, 1);
  const Banner* banner = last && script_.closing ? &*script_.closing : nullptr;
  DrawOverlay({"", frame.t_s, script_.steps[next_ - 1].covered, frame.speed_up, banner}, image_);
  return image_;
}

}  // namespace floorproof
