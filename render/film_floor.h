// SPDX-License-Identifier: Apache-2.0
// What a film paints on the floor: the plan, what was swept, what the robot senses and thinks. For
// film.cc only.
#pragma once

#include <span>
#include <vector>

#include "render/film.h"
#include "render/floor_paint.h"

namespace floorproof {

inline constexpr double kFilmJump_m = 0.3;  // between two states: the robot was carried

// The floor that is painted: the map's, or where there is none the base floor.
class PaintedFloor {
 public:
  explicit PaintedFloor(const HazardMap* map);  // outlives it
  // What lies so high over the floor at this place.
  Lie At(const Vec2& p_W, double over_m) const;
  bool IsLevel() const { return map_ == nullptr; }

 private:
  const HazardMap* map_;  // none: level all over
};

void PaintPlan(const Path& plan, double width_m, const PaintedFloor& floor, FloorPaint& paint);

// Paints what was driven as few straight stripes with round corners, as a disc-shaped tool sweeps.
class Trail {
 public:
  Trail(const PaintedFloor& floor, FloorPaint& paint) : floor_(floor), paint_(paint) {}
  void Add(const Vec3& p, double width_m);

 private:
  void Begin(const Vec2& p, const Lie& lie);

  const PaintedFloor& floor_;
  FloorPaint& paint_;
  double width_m_ = 0;
  Lie lie_ = 0;
  std::vector<Vec2> run_;  // points since the last corner
  std::size_t stripe_ = 0;
};

// What is swept again, over what was swept.
class SweptAgain {
 public:
  // All outlive it; the patches ascend in time.
  SweptAgain(std::span<const FloorPatch> patches, const PaintedFloor& floor, FloorPaint& paint)
      : patches_(patches), floor_(floor), paint_(paint) {}
  void Show(double t_s);

 private:
  std::span<const FloorPatch> patches_;
  const PaintedFloor& floor_;
  FloorPaint& paint_;
  std::size_t next_ = 0;
};

// The last scan as a fan of beams on the floor, and the shaft of an arrow where the robot thinks it
// is. These stripes move.
class Fan {
 public:
  // `senses` may grow; nullptr: nothing is shown. `beams`: so many there may be then.
  Fan(const std::vector<Recording::Senses>* senses, int beams, double reach_m, FloorPaint& paint);
  void Show(std::size_t state);

 private:
  const std::vector<Recording::Senses>* all_;
  FloorPaint& paint_;
  double reach_m_;
  std::vector<std::size_t> beams_;
  std::size_t estimate_ = 0, at_ = 0;
  std::size_t gap_ = 1;  // least, between two turns of the lidar, in states
};

// A thin circle around a place, which moves: the rolling window.
class WindowRing {
 public:
  WindowRing(double radius_m, double width_m, FloorPaint& paint);  // 0: none
  void Show(const Vec2& p_W);

 private:
  double radius_m_;
  FloorPaint& paint_;
  std::vector<std::size_t> chords_;
};

}  // namespace floorproof
