// SPDX-License-Identifier: Apache-2.0
// Where a reconfigurable robot's blocks stand and how they move: plane kinematics of a tree of
// hinges (RobotSpec::blocks, hinges).
#pragma once

#include <array>
#include <span>
#include <string_view>

#include "env/core/motion.h"
#include "env/core/robot_spec.h"

namespace floorproof {

struct BlockMotion {
  Pose2 X_BK;               // the block's frame in the body frame
  Vec2 v_B = Vec2::Zero();  // of K's origin against B, in B's axes, m/s
  double wz_radps = 0;      // of the block against B
  Vec2 VelocityAt(const Vec2& p_B) const {
    const Vec2 arm = p_B - X_BK.p();
    return v_B + wz_radps * Vec2(-arm.y(), arm.x());
  }
};

struct BlockMotions {
  std::array<BlockMotion, HingeState::kMax + 1> block;  // the first RobotSpec::blocks.size() hold
  Vec2 p_RB = Vec2::Zero();                             // of B's origin in the base block's frame
  Vec2 v_RB = Vec2::Zero();                             // its velocity there, R's axes
};

// `hinges` holds RobotSpec::hinges' angles and rates. Allocates nothing.
BlockMotions MoveBlocks(std::span<const BlockSpec> blocks, std::span<const HingeSpec> hinges,
                        const HingeState& state);

// The state at rest with these angles.
HingeState AtRest(std::span<const double> hinge_rad);

// The robot's hinges at rest in its start shape (n = 0 where its blocks are locked), its steered
// wheels straight ahead.
HingeState StartState(const RobotSpec& robot);

// The outline of all blocks together, in B: touching blocks become one polygon, with what lies
// between blocks that stand up to 0.25 m apart. Empty where there is no one such outline: blocks
// are farther apart, or thinner than a micrometre.
Polygon Footprint(std::span<const BlockSpec> blocks, std::span<const HingeSpec> hinges,
                  std::span<const double> hinge_rad);

// What the tool sweeps across the way in the shape of this index: the robot's own width at the
// start; of another shape's footprint its lesser extent; 0 between two shapes (-1).
double ToolWidth(const RobotSpec& robot, int shape);

// The shape of that name, -1 when there is none.
int FindShape(const RobotSpec& robot, std::string_view name);
inline constexpr double kInShape_rad = 0.05;  // play within which hinges count as in a shape
// The shape in which the hinges stand, each to within `tolerance_rad`; -1: between two.
int ShapeOf(const RobotSpec& robot, const HingeState& state, double tolerance_rad);

}  // namespace floorproof
