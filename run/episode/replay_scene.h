// SPDX-License-Identifier: Apache-2.0
// The shapes of a scene and the bodies that move, as replay.bin has them. For replay_track.cc only.
#pragma once

#include <cstdint>
#include <memory>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "env/geometry/box.h"
#include "env/scene/scene.h"

namespace floorproof {

// True of a body that can only turn about one axis on a body that turns, and carries none itself: a
// roller, round about that axis. Its turning cannot be seen.
bool IsRoller(const mjModel* model, int body);

struct ReplayScene {
  ReplayScene();
  ReplayScene(ReplayScene&&) noexcept;
  ~ReplayScene();

  // Bodies that move, parents first, the world before all: its parent, the place in it and the
  // joints of each, as MuJoCo has them.
  std::unique_ptr<nlohmann::ordered_json> links;
  int base_link = 0;
  std::vector<float> shapes;  // kShapeFloats each
  struct Mesh {
    std::vector<float> vertices;  // x y z
    std::vector<std::uint32_t> faces;
  };
  std::vector<Mesh> meshes;
};

// type, link, mesh, look, r g b a, size (3), position (3) and quaternion (4) in the link.
inline constexpr int kShapeFloats = 18;

// What of the world lies within `around` (world frame) is kept, and all of the robot. `first_of`:
// by joint, where its positions begin in a state of the replay; -1: it has none there.
ReplayScene ReplaySceneOf(const Scene& scene, const Box2& around, const std::vector<int>& first_of);

}  // namespace floorproof
