// SPDX-License-Identifier: Apache-2.0
// What the engine's contacts mean: obstacles met, weight carried, and what each thing does to the
// robot. Where a step is divided (fine_steps.h), forces are the mean over its parts, and impulses
// their sum. Where the robot stands is read from the last part.
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
  // Call these in turn, with the model and data of a simulation of the scene. They allocate
  // nothing.
  // 1. Before a step: forgets the contacts of the last one. `truth` holds the pose from which the
  // step starts.
  void BeginStep(int parts, Truth& truth);
  // 2. After each part but the last: adds its forces. The model's time step is that of a part.
  void ReadPart(const mjModel* m, const mjData* d, Truth& truth);
  // 3. After the last part: adds its forces and reads where the robot stands. The model's time step
  // is that of the whole step, and `truth` holds the new pose. `lowest_W`: the lowest point of each
  // driven wheel, world frame.
  void ReadLastPart(const mjModel* m, const mjData* d, std::span<const Vec3> lowest_W,
                    Truth& truth);

 private:
  // A contact whose normal stands steeper than this carries; one flatter than that obstructs.
  static constexpr double kSteep = 0.7;
  static constexpr double kWedged = 0.3;  // a wheel in a groove rests on rims as steep as this
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
    bool carries() const { return normal_W.z() > (wheel ? kWedged : kSteep); }
  };

  // Calls `use(contact)` for each contact with the world: those of the body first, because a sample
  // holds only so many.
  template <class Use>
  void ForEachContact(const mjModel* m, const mjData* d, const Use& use) const;
  bool Understand(const mjModel* m, const mjData* d, int index, bool wheel, Contact& out) const;
  // Whether what this slab is a part of would be at this point, too.
  bool GoesOn(const GeomRole& slab, const Vec2& p_W) const;
  int CutAt(const Vec2& p_W) const;
  // Forces and impulses, over a part of `part_s`.
  void AddForces(const mjModel* m, const mjData* d, const Contact& contact, double part_s,
                 Truth& truth);
  void AddTouch(const Contact& contact, Truth& truth) const;
  void AddObstacle(const mjModel* m, const mjData* d, const Contact& contact, double part_s,
                   Truth& truth);
  // The record of this contact: of an earlier part, or a new one; nothing where there is no room.
  ObstacleContact* RecordOf(const mjModel* m, const mjData* d, const Contact& contact,
                            const Vec2& normal_W, Truth& truth);
  // The body's speed into the obstacle, just before this part.
  double ClosingSpeed(const mjModel* m, const mjData* d, const Contact& contact,
                      const Vec2& normal_W) const;
  void AddBellyLoad(const Contact& contact, Truth& truth);
  void AddSideLoad(const Contact& contact);
  int DrivenWheel(const mjModel* m, const Contact& contact) const;  // -1: none that stands
  void AddSupport(const Vec3& p_W);
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
  // The step being read.
  int parts_ = 1;
  Vec3 origin_W_ = Vec3::Zero();  // of the body, before it
  struct Record {                 // of each of the truth's obstacle contacts
    int geom[2] = {-1, -1};
    bool seen_in_part = false;
    double hardest_ns = 0;  // of any part
  };
  std::array<Record, Truth::kMaxContacts> records_;
  // Vertical force of what pushes from aside, and its moment about the world's origin on the floor,
  // as a shift of the centre of mass sees it.
  double load_n_ = 0;
  Vec2 load_nm_ = Vec2::Zero(), side_n_ = Vec2::Zero();
};

}  // namespace floorproof
