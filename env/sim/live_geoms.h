// SPDX-License-Identifier: Apache-2.0
// The part of a scene that the robot can touch now.
//
// MuJoCo tests every explicit pair of geoms and moves through every static geom at each step, near
// or far: 200 plates on the floor halve the speed of a robot on 16 Mecanum wheels, and 25,000 walls
// take nine tenths of it. So the simulation steps a model that shares all arrays with the scene's,
// but for a few of its own: pairs whose geoms are within reach, and a pool of boxes
// (env/scene/wall_pool.h) that stand for the walls near the robot. Both keep the order in which the
// whole scene has them, and what is left out is what MuJoCo would have found too far away: contacts
// are the same, in the same order, and so are the states, bit for bit.
//
// What is live lies within kSlack_m of a colliding geom of the robot. It is chosen anew before a
// step in which such a geom's centre may have moved by more than kTrigger_m since: by the base's
// way, its turn times the geoms' distance, and each joint's turn times what it swings. These come
// from qpos itself, so a robot that is put elsewhere is seen at once, whatever its speed.
// Where that cannot be told (NearnessIsKnown), and on small scenes, all is live.
#pragma once

#include <mujoco/mujoco.h>

#include <vector>

#include "env/scene/scene.h"

namespace floorproof {

class LiveGeoms {
 public:
  // Both outlive this; `model` is the scene's, or a copy of it whose values may change.
  LiveGeoms(const Scene& scene, const mjModel& model);
  // The model points into this object.
  LiveGeoms(const LiveGeoms&) = delete;
  LiveGeoms& operator=(const LiveGeoms&) = delete;

  const mjModel* model() const { return &model_; }
  mjModel* model() { return &model_; }
  // Before each step, and before anything else that looks for contacts at a new qpos. Allocates
  // nothing. Throws InternalError if more walls are near than the pool holds, which its size rules
  // out.
  void Update(mjData* data);
  // Values of `model` have changed: the next Update takes them over.
  void Refresh() { chosen_ = false; }

 private:
  struct Ball {  // about a colliding geom of the robot
    int geom = -1;
    double radius_m = 0;  // of the geom, wherever it turns
  };
  struct Bounds {  // world frame
    Vec3 low_W, high_W;
    bool Meets(const Bounds& other) const;
    double Distance(const Vec3& p_W) const;
  };
  struct Swing {  // a joint that moves the centres of geoms
    int joint = -1;
    double arm_m = 0;
  };
  // Values of pairs, all of them and those that are live.
  template <class T>
  struct Column {
    const T* all;
    std::vector<T> live;
    int width;
  };

  template <class T>
  void Own(T*& values, std::size_t count, std::vector<T>& store);
  void OwnPool();
  void OwnTree();
  void OwnPairs();
  template <class T>
  void OwnColumn(T*& values, int width, std::vector<Column<T>>& columns);
  Bounds StaticBounds(int geom) const;
  double Moved(const mjtNum* qpos);
  void Choose(mjData* data);
  void ChooseWalls(const mjData* data);
  void BuildTree();
  void ChoosePairs(const mjData* data);
  int AddNode(std::vector<int>::iterator begin, std::vector<int>::iterator end);

  const Scene& scene_;
  mjModel model_;  // borrows the arrays of the model it was made from, but for those below
  std::vector<Ball> balls_;   // by colliding geom of the robot
  std::vector<int> ball_of_;  // by geom; -1: none of the robot's
  std::vector<Swing> swings_;
  std::vector<int> fixed_;      // geoms of the world that can be touched, but for the pool's
  std::vector<Bounds> bounds_;  // by geom; of the world's
  std::vector<char> near_;      // by geom; of the world's

  bool chosen_ = false;
  std::vector<mjtNum> qpos_;          // when they were chosen
  double reach_m_ = 0;                // of the balls' centres from the base's origin, then
  std::vector<double> body_moved_m_;  // scratch

  std::vector<int> found_;                          // indices into the grid's boxes
  std::vector<mjtNum> pos_, size_, aabb_, rbound_;  // of all geoms
  std::vector<int> leaves_, child_, nodeid_;        // the world's tree of bounding boxes
  std::vector<mjtNum> node_aabb_;
  int nodes_ = 0;
  std::vector<Column<int>> int_columns_;
  std::vector<Column<mjtNum>> columns_;
};

}  // namespace floorproof
