// SPDX-License-Identifier: Apache-2.0
// A thing seen from above, from the side and from the front, on one sheet as a draughtsman lays it
// out: one scale, the side below the top, the front beside the side; figures in the free corner.
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "env/geometry/polygon.h"
#include "media/media.h"
#include "render/text.h"

namespace floorproof {

// Points are in m, x to the right and y up on the sheet.
struct ViewShape {
  Polygon outline;  // convex
  Rgb fill = {255, 255, 255};
  double alpha = 1;
};

struct ViewLine {
  std::vector<Vec2> points;
  Rgb colour = {0, 0, 0};
  bool dashed = false;
  std::string label;  // beside its last point
};

struct ViewMark {
  enum class Kind { kDisc, kRing, kMassCentre };
  Kind kind = Kind::kDisc;
  Vec2 at = Vec2::Zero();
  Rgb colour = {0, 0, 0};
};

// A length between two points, written beside a line along x or y that lies so many rows outside of
// the view (below it or to its right; negative: above it or to its left).
struct ViewDimension {
  Vec2 a = Vec2::Zero(), b = Vec2::Zero();
  bool along_x = true;
  int row = 1;
  std::string text;
};

// A short text at a place, on a light ground.
struct ViewNote {
  Vec2 at = Vec2::Zero();
  std::string text;
  Rgb colour = {0, 0, 0};
};

struct View {
  std::string title;
  std::vector<ViewShape> shapes;  // the farthest first
  std::vector<ViewLine> lines;    // over the shapes
  std::vector<ViewDimension> dimensions;
  std::vector<ViewMark> marks;
  std::vector<ViewNote> notes;
  bool floor = false;  // at y = 0, hatched
};

struct SheetKey {
  std::string label;
  ViewMark::Kind mark = ViewMark::Kind::kDisc;
  Rgb colour = {0, 0, 0};
  bool line = false;  // a stroke in place of the mark
  bool dashed = false;
};

struct ViewSheet {
  std::string title, subtitle;
  View top, side, front;
  std::vector<std::pair<std::string, std::string>> figures;  // name, value
  std::vector<std::string> remarks;                          // below the figures, wrapped
  std::vector<SheetKey> keys;
};

Image DrawViewSheet(const ViewSheet& sheet);

}  // namespace floorproof
