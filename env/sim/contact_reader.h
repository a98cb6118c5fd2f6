// SPDX-License-Identifier: Apache-2.0
// What the engine's contacts mean: obstacles met, weight carried, and what each thing does to the
// robot. Where a step is walked in parts (fine_steps.h), what a thing does is the mean over them,
// and where the robot stands is as at the end of the last.
#pragma once

#include <mujoco/mujoco.h>

#include <array>
#include <span>
#include <vector>

#include "env/core/hazard_map.h"
#include "env/core/motion.h"
#include "env/core/robot_spec.h"
#include "env/scene/scene.h"
#include "env/sim/drop_meter.h"

namespace floorproof {

class ContactReader {
 public:
  // `scene` and `map` outlive it.
  ContactReader(const Scene& scene, const HazardMap& map, const RobotSpec& robot);

  // Forgets where the wheels stood: the robot is set down elsewhere.
  void Reset() { drops_.Reset(); }
  // Model and data of the calls below are those of a simulation of the scene. They allocate
  // nothing. A step of so many parts begins: forgets what was met in the last.
  void Begin(int parts, Truth& truth);
  // Adds what was met in a part that is not the last of its step.
  void ReadPart(const mjModel* m, const mjData* d, Truth& truth);
  // After the last part: all that `truth` says of contacts. Its pose stands there already, and the
  // model's time step is the whole one again. `lowest_W`: the lowest point of each driven wheel,
  // world frame.
  void Read(const mjModel* m, const mjData* d, std::span<const Vec3> lowest_W, Truth& truth);

 private:
  // One contact of the robot with the world.
  struct Contact {
    const mjContact* raw = nullptr;
    int geom = -1;       // the robot's
    GeomRole world;      // what it touches; the edge of a gap is the gap's
    bool wheel = false;  // a wheel or caster touches
    Vec3 p_W, normal_W;  // the normal towards the robot
    double normal_n = 0;
    Vec3 friction_W_n;  // on the robot
    Vec3 force_W_n() const { return normal_n * normal_W + friction_W_n; }
  };

  bool Understand(const mjModel* m, const mjData* d, int index, Contact& out) const;
  // Whether what this slab is a part of would be at this point, too.
  bool GoesOn(const GeomRole& slab, const Vec2& p_W) const;
  int CutAt(const Vec2& p_W) const;
  // What a contact did in a part of `part_s`.
  void AddDeed(const mjModel* m, const mjData* d, const Contact& contact, double part_s,
               Truth& truth);
  void AddTouch(const Contact& contact, Truth& truth) const;
  void AddObstacle(const mjModel* m, const mjData* d, const Contact& contact, double part_s,
                   Truth& truth);
  // Of the body into the obstacle, just before this part.
  double ClosingSpeed(const mjModel* m, const mjData* d, const Contact& contact,
                      const Vec2& normal_W) const;
  void AddBellyLoad(const Contact& contact, Truth& truth);
  void AddSupport(const Vec3& p_W);
  void AddFooting(const mjModel* m, const Contact& contact, Truth& truth);
  void AddLoad(const Contact& contact);
  void MeasureSupport(const mjModel* m, const mjData* d, Truth& truth);

  const Scene& scene_;
  const HazardMap& map_;
  std::vector<int> block_bodies_;  // the base alone of a robot without hinges
  std::vector<int> block_of_;      // by body: index of the block that it is, or is carried by
  std::vector<int> wheel_of_;      // by body: index of the driven wheel that it is part of, or -1
  DropMeter drops_;
  double far_m_;                      // of a robot that nothing carries
  std::vector<Vec2> support_, hull_;  // scratch, capacity fixed
  double support_z_m_ = 0;            // sum over them
  std::vector<double> belly_n_;       // by hazard, scratch
  int parts_ = 1;                     // of this step
  // Of the truth's obstacle contacts: between which geoms, and whether this part has it too.
  struct Pair {
    int geom[2] = {-1, -1};
    bool met = false;
  };
  std::array<Pair, Truth::kMaxContacts> pairs_;
  // Vertical force of what pushes from aside, and its moment about the world's origin on the floor,
  // as a shift of the centre of mass sees it.
  double load_n_ = 0;
  Vec2 load_nm_ = Vec2::Zero(), side_n_ = Vec2::Zero();
};

}  // namespace floorproof
