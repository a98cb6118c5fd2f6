// SPDX-License-Identifier: Apache-2.0
// A robot's compiled MJCF, as the readers of its parts ask it (spec_reader.h).
#pragma once

#include <mujoco/mujoco.h>

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/params.h"
#include "env/geometry/geometry.h"
#include "env/scene/engine.h"

namespace floorproof {

// How a caster swivels: a joint that no motor turns lets it trail behind an upright axis.
struct Swivel {
  Vec3 pivot_B;        // a point of the axis, base frame
  double trail_m = 0;  // from the axis to the caster's centre, along the floor
};

class CompiledRobot {
 public:
  // Poses it as its model stands. Throws InputError where no body `base` stands on a free joint.
  CompiledRobot(const mjModel* model, std::string file);

  const mjModel* model() const { return m_; }
  const mjData* data() const { return data_.get(); }
  const std::string& file() const { return file_; }
  int base() const { return blocks_.front(); }
  // Bodies of the blocks, the base first.
  const std::vector<int>& blocks() const { return blocks_; }
  void AddBlock(int body) { blocks_.push_back(body); }

  // Throws InputError that names the file.
  [[noreturn]] void Refuse(std::string_view key, std::string_view rule) const;

  // Numbers and texts under <custom>; refused where they are missing or break the rule.
  double Number(const char* name, const Bounds& rule) const;
  std::string Text(const char* name) const;
  // None where there is no such number or text.
  std::optional<double> OptionalNumber(const char* name, const Bounds& rule) const;
  std::optional<std::string> OptionalText(const char* name) const;
  // The words of a text; none where there is no such text.
  std::vector<std::string> Words(const char* name) const;

  Vec3 InBase(const mjtNum* p_W) const;
  bool IsBlock(int body) const;
  // Index of the block that the body is, or is carried by.
  int BlockOf(int body) const;

  bool Collides(int geom) const { return m_->geom_conaffinity[geom] || m_->geom_contype[geom]; }
  // By the wheels: part of the chassis.
  bool IsCarried(int geom) const { return IsBlock(m_->geom_bodyid[geom]); }
  // Points on the surface of a geom that bound it, in the base frame.
  std::vector<Vec3> SurfacePoints(int geom) const;
  // Of a caster's geom, by the first such joint between it and what carries it.
  std::optional<Swivel> SwivelOf(int geom) const;
  // Points that bound the geom wherever its caster swivels or its fork steers; of any other geom,
  // SurfacePoints.
  std::vector<Vec3> SweptPoints(int geom) const;

 private:
  // The first upright hinge between the geom and the block that carries it, of those that a motor
  // turns or of the others; -1: there is none.
  int UprightHinge(int geom, bool driven) const;

  const mjModel* m_;
  std::string file_;
  DataPtr data_;
  std::vector<int> blocks_;
};

}  // namespace floorproof
