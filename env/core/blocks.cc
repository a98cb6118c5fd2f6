// SPDX-License-Identifier: Apache-2.0
#include "env/core/blocks.h"

#include <algorithm>
#include <cmath>

#include "env/geometry/box.h"

namespace floorproof {
namespace {

Vec2 Left(const Vec2& v) { return {-v.y(), v.x()}; }

}  // namespace

BlockMotions MoveBlocks(std::span<const BlockSpec> blocks, std::span<const HingeSpec> hinges,
                        const HingeState& state) {
  BlockMotions out;
  // In the base block's frame first; B's origin, the mean of the centres, is taken off at the end.
  for (std::size_t h = 0; h < hinges.size(); ++h) {
    const HingeSpec& hinge = hinges[h];
    const BlockMotion& parent = out.block[static_cast<std::size_t>(hinge.parent)];
    BlockMotion& block = out.block[static_cast<std::size_t>(hinge.block)];
    const double turn = hinge.sign * (state.rad[h] - hinge.model_rad);
    const Vec2 axis = parent.X_BK * hinge.p_K;
    block.X_BK.yaw_rad = WrapAngle(parent.X_BK.yaw_rad + turn);
    const Vec2 origin = axis - block.X_BK.Rotate(hinge.p_K);
    block.X_BK.x_m = origin.x();
    block.X_BK.y_m = origin.y();
    block.wz_radps = parent.wz_radps + hinge.sign * state.radps[h];
    block.v_B = parent.VelocityAt(axis) + block.wz_radps * Left(origin - axis);
  }
  const auto n = static_cast<double>(blocks.size());
  for (std::size_t k = 0; k < blocks.size(); ++k) {
    const Vec2 centre = out.block[k].X_BK * blocks[k].centre_K;
    out.p_RB += centre / n;
    out.v_RB += out.block[k].VelocityAt(centre) / n;
  }
  for (std::size_t k = 0; k < blocks.size(); ++k) {
    out.block[k].X_BK.x_m -= out.p_RB.x();
    out.block[k].X_BK.y_m -= out.p_RB.y();
    out.block[k].v_B -= out.v_RB;
  }
  return out;
}

HingeState AtRest(std::span<const double> hinge_rad) {
  HingeState state;
  state.n = static_cast<int>(hinge_rad.size());
  std::ranges::copy(hinge_rad, state.rad.begin());
  return state;
}

HingeState StartState(const RobotSpec& robot) {
  HingeState state;
  if (!robot.hinges.empty())
    state = AtRest(robot.shapes[static_cast<std::size_t>(robot.shape)].hinge_rad);
  state.steered = robot.steering.has_value();
  return state;
}

Polygon Footprint(std::span<const BlockSpec> blocks, std::span<const HingeSpec> hinges,
                  std::span<const double> hinge_rad) {
  // Edges that should touch do so to the last digit only on a grid.
  constexpr double kGrid_m = 1e-6;
  const BlockMotions motions = MoveBlocks(blocks, hinges, AtRest(hinge_rad));
  std::vector<Polygon> outlines;
  for (std::size_t k = 0; k < blocks.size(); ++k) {
    Polygon outline_B;
    for (const Vec2& p_K : blocks[k].outline_K) {
      const Vec2 p_B = motions.block[k].X_BK * p_K;
      outline_B.emplace_back(std::round(p_B.x() / kGrid_m) * kGrid_m,
                             std::round(p_B.y() / kGrid_m) * kGrid_m);
    }
    outlines.push_back(std::move(outline_B));
  }
  // Blocks that a hinge holds a little apart are one robot: what lies between them is its own.
  constexpr double kFarthestApart_m = 0.25;
  const std::vector<Region> apart = Union(outlines);
  std::vector<Region> regions = apart;
  for (double gap_m = 1e-3; regions.size() > 1 && gap_m <= kFarthestApart_m; gap_m *= 1.25)
    regions = Closed(apart, gap_m / 2);
  if (regions.size() != 1) return {};
  // Corners on a straight, where two blocks meet, are none.
  const Polygon& outer = regions.front().outer;
  Polygon whole;
  for (std::size_t i = 0; i < outer.size(); ++i) {
    const Vec2 in = outer[i] - outer[(i + outer.size() - 1) % outer.size()];
    const Vec2 out = outer[(i + 1) % outer.size()] - outer[i];
    if (std::abs(Cross(in, out)) > 2 * kGrid_m * (in.norm() + out.norm()))
      whole.push_back(outer[i]);
  }
  return whole;
}

double ToolWidth(const RobotSpec& robot, int shape) {
  if (shape < 0) return 0;
  if (shape == robot.shape || robot.tool.kind != Shape2::Kind::kFootprint)
    return robot.tool_width_m;
  return BoxAround(robot.shapes[static_cast<std::size_t>(shape)].footprint_B).Size().minCoeff();
}

int FindShape(const RobotSpec& robot, std::string_view name) {
  const auto found = std::ranges::find(robot.shapes, name, &ShapeSpec::name);
  return found == robot.shapes.end() ? -1 : static_cast<int>(found - robot.shapes.begin());
}

int ShapeOf(const RobotSpec& robot, const HingeState& state, double tolerance_rad) {
  for (std::size_t s = 0; s < robot.shapes.size(); ++s) {
    bool there = true;
    for (std::size_t h = 0; h < static_cast<std::size_t>(state.n); ++h)
      there = there && std::abs(state.rad[h] - robot.shapes[s].hinge_rad[h]) <= tolerance_rad;
    if (there) return static_cast<int>(s);
  }
  return -1;
}

}  // namespace floorproof
