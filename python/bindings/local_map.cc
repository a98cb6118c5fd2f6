// SPDX-License-Identifier: Apache-2.0
#include "python/bindings/local_map.h"

#include <cmath>

#include "base/error.h"
#include "run/scenario/floors.h"
#include "run/scenario/world.h"

namespace floorproof {
namespace {

SweepArea KnownArea(const World& world) {
  const RobotSpec& robot = world.robot.spec;
  return ComputeSweepArea(KnownFloor(world), robot, robot.clear, robot.tool, world.start);
}

enum : std::uint8_t { kObstacle = 1, kSweepable = 2 };

std::vector<std::uint8_t> WhatIsKnown(const Grid<std::uint8_t>& obstacles,
                                      const Grid<std::uint8_t>& sweepable) {
  std::vector<std::uint8_t> floor(obstacles.cells.size());
  for (std::size_t i = 0; i < floor.size(); ++i)
    floor[i] = static_cast<std::uint8_t>((obstacles.cells[i] != 0 ? kObstacle : 0) |
                                         (sweepable.cells[i] != 0 ? kSweepable : 0));
  return floor;
}

int Checked(int cells, double cell_m) {
  constexpr int kMost = 512;
  if (cells < 1 || cells > kMost)
    throw InputError({}, "local_map_cells", std::to_string(cells),
                     "must be between 1 and " + std::to_string(kMost));
  if (!(cell_m > 0 && cell_m <= 10))
    throw InputError({}, "local_map_cell_m", std::to_string(cell_m),
                     "must be > 0 and at most 10 m");
  return cells;
}

// The cells of a grid under the middles of the picture's, row by row from above: steps along a
// straight line, so that no cell costs a change of frames.
class Raster {
 public:
  Raster(const GridFrame& frame, const Pose2& X_WB, int cells, double cell_m)
      : cells_(cells),
        width_(static_cast<unsigned>(frame.width)),
        height_(static_cast<unsigned>(frame.height)) {
    const Pose2 X_GB = frame.X_WG.Inverse() * X_WB;
    const double scale = cell_m / frame.cell_m, half = 0.5 * (cells - 1);
    right_ = scale * Vec2(std::cos(X_GB.yaw_rad), std::sin(X_GB.yaw_rad));
    down_ = Vec2(right_.y(), -right_.x());
    first_ = X_GB.p() / frame.cell_m - half * right_ - half * down_;
    // Farther off than this a cell has no number; a pose that is not finite lies nowhere.
    constexpr double kFar = 1e6;
    if (!(first_.norm() + 2 * cells * scale < kFar)) width_ = 0, first_ = right_ = down_ = {0, 0};
  }

  // Calls inside(i, index of the grid's cell), or outside(i), for each cell i of the picture.
  template <class Inside, class Outside>
  void ForEach(const Inside& inside, const Outside& outside) const {
    constexpr int kUp = 1 << 21;  // truncation is floor where all is positive
    std::size_t i = 0;
    for (int row = 0; row < cells_; ++row) {
      double x = first_.x() + row * down_.x() + kUp, y = first_.y() + row * down_.y() + kUp;
      for (int column = 0; column < cells_; ++column, ++i, x += right_.x(), y += right_.y()) {
        const auto ix = static_cast<unsigned>(static_cast<int>(x) - kUp);
        const auto iy = static_cast<unsigned>(static_cast<int>(y) - kUp);
        if (ix < width_ && iy < height_)  // below 0 is beyond, too
          inside(i, iy * width_ + ix);
        else
          outside(i);
      }
    }
  }

 private:
  int cells_;
  unsigned width_, height_;
  Vec2 right_, down_, first_;
};

}  // namespace

LocalMap::LocalMap(const World& world, int cells, double cell_m)
    : cells_(Checked(cells, cell_m)),
      cell_m_(cell_m),
      area_(KnownArea(world)),
      floor_(WhatIsKnown(ObstacleMask(KnownFloor(world), world.robot.spec.step_m, area_.frame),
                         area_.sweepable)),
      swept_(area_, world.robot.spec.tool),
      values_(3 * static_cast<std::size_t>(cells) * static_cast<std::size_t>(cells)) {}

void LocalMap::Look(const Pose2& X_WB, const KnownMap* drawn) {
  const std::size_t plane = values_.size() / 3;
  std::uint8_t* const obstacle = values_.data();
  std::uint8_t *const swept = obstacle + plane, *const left = swept + plane;
  const std::vector<std::uint8_t>& passes = swept_.passes().cells;
  const Raster raster(area_.frame, X_WB, cells_, cell_m_);
  raster.ForEach(
      [&](std::size_t i, std::size_t cell) {
        const std::uint8_t known = floor_[cell];
        const std::uint8_t done = passes[cell] > 0 ? 255 : 0;
        obstacle[i] = (known & kObstacle) != 0 ? 255 : 0;
        swept[i] = done;
        left[i] = (known & kSweepable) != 0 ? static_cast<std::uint8_t>(~done) : 0;
      },
      [&](std::size_t i) {
        obstacle[i] = 255;
        swept[i] = left[i] = 0;
      });
  if (drawn == nullptr) return;
  // It goes by its own map, and is to sweep what that says is free.
  Raster(drawn->frame, X_WB, cells_, cell_m_)
      .ForEach(
          [&](std::size_t i, std::size_t cell) {
            const auto width = static_cast<std::size_t>(drawn->frame.width);
            const CellState state =
                drawn->At(static_cast<int>(cell % width), static_cast<int>(cell / width));
            obstacle[i] = state == CellState::kOccupied  ? 255
                          : state == CellState::kUnknown ? 127
                                                         : 0;
            left[i] = state == CellState::kFree && swept[i] == 0 ? 255 : 0;
          },
          [&](std::size_t i) {
            obstacle[i] = 255;
            left[i] = 0;
          });
}

}  // namespace floorproof
