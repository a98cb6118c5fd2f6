// SPDX-License-Identifier: Apache-2.0
#include "env/scene/wall_pool.h"

#include <algorithm>

#include "env/scene/edge_contacts.h"
#include "env/scene/engine.h"
#include "env/scene/robot_reach.h"
#include "env/scene/walls.h"
#include "env/scene/wheel_collider.h"

namespace floorproof {
namespace {

constexpr std::size_t kFew = 128;  // boxes, at some 10 ns a step each

}  // namespace

WallPool MakeWallPool(const std::vector<Box2>& boxes, const Pose2& X_WG, const mjSpec* spec,
                      const mjVFS* assets) {
  if (boxes.size() <= kFew) return {};
  const SpecPtr copy(mj_copySpec(spec));
  const ModelPtr model = CompileSpec(copy.get(), assets);
  InflateWheelBounds(model.get());
  const int base = mj_name2id(model.get(), mjOBJ_BODY, "base");
  if (!NearnessIsKnown(model.get(), base)) return {};
  WallPool pool{BoxGrid(boxes), X_WG, -1, 0};
  const int most =
      pool.grid.MostNear(ComputeReach(model.get(), base).surface_m + kLookAhead_m + kSlack_m);
  if (static_cast<std::size_t>(most) >= boxes.size()) return {};
  pool.num = std::max(most, 1);
  return pool;
}

void PlaceWall(const Box2& box, const Pose2& X_WG, mjtNum* pos, mjtNum* size) {
  const Vec2 p_W = X_WG * Vec2((box.low + box.high) / 2);
  pos[0] = p_W.x();
  pos[1] = p_W.y();
  pos[2] = kWallHeight_m / 2;
  size[0] = box.Size().x() / 2;
  size[1] = box.Size().y() / 2;
  size[2] = kWallHeight_m / 2;
}

void ParkWall(mjtNum* pos, mjtNum* size) {
  constexpr double kDeep_m = 100, kSmall_m = 0.01;
  mju_zero3(pos);
  pos[2] = -kDeep_m;
  size[0] = size[1] = size[2] = kSmall_m;
}

}  // namespace floorproof
