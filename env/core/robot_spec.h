// SPDX-License-Identifier: Apache-2.0
// What planners, controllers and detectors know of a robot; read from its MJCF once (env/scene).
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "env/core/battery.h"
#include "env/core/measured_limits.h"
#include "env/geometry/polygon.h"

namespace floorproof {

struct WheelSpec {
  std::string name;          // of the wheel's joint and actuator
  Vec3 p_BW = Vec3::Zero();  // wheel centre in the body frame B
  double radius_m = 0;       // rollers included
  double half_width_m = 0;   // of the wheel's cylinder: of a Mecanum wheel's core, without rollers
  // Mecanum wheels (env/scene/wheel_collider.h): the radius of the rollers, 0 for a plain wheel;
  // and the angle from the wheel's axle (left, +y) to its rollers' axes at the floor, seen from
  // above, positive counter-clockwise.
  double roller_radius_m = 0;
  double roller_angle_rad = 0;
  double yaw_rad = 0;          // of the wheel's own x (forward) in B
  int block = 0;               // the block that carries it
  double max_speed_radps = 0;  // no-load speed of the motor at the wheel
  double max_torque_nm = 0;    // at the wheel
  VelocityDrive motor;         // as built; gain 0: its driver holds no speed
};

// The shape that must stay free of obstacles, or that the tool sweeps, at the robot's centre.
struct Shape2 {
  enum class Kind { kCircle, kFootprint };
  Kind kind = Kind::kCircle;
  double radius_m = 0;  // kCircle
  Polygon footprint_B;  // kFootprint; held at quarter turns of the map or its walls
};

// From the shape's centre to its edge in this direction of its own frame, m.
double EdgeAlong(const Shape2& shape, double bearing_rad);
// The shape with so much room around it.
Shape2 Grown(Shape2 shape, double margin_m);

// A reconfigurable robot: blocks joined by hinges about vertical axes. R is the frame of block 0,
// the MJCF's `base`. In the model's own shape the frame K of every block coincides with R. The body
// frame B has R's axes; its origin is the mean of the blocks' centres, on the floor.
struct BlockSpec {
  std::string name;  // of its body
  Polygon outline_K;
  Vec2 centre_K = Vec2::Zero();
};
struct HingeSpec {
  std::string name;                 // of its joint and actuator
  int parent = 0, block = 0;        // `block` hangs on `parent`, which stands before it
  Vec2 p_K = Vec2::Zero();          // the axis, in either block's frame
  double sign = 1;                  // +1: the angle grows as `block` turns counterclockwise
  double model_rad = 0;             // the angle in the model's own shape
  double min_rad = 0, max_rad = 0;  // its stops
  double max_rate_radps = 0;        // no-load speed of its motor, gear included
};
// A wheel that is steered: its fork turns about an upright axis through the wheel's centre.
struct SteeringSpec {
  std::string name;                 // of the fork's joint and actuator
  std::size_t wheel = 0;            // index into RobotSpec::wheels
  double min_rad = 0, max_rad = 0;  // its stops; 0: straight ahead, positive: to the left
  double max_rate_radps = 0;        // no-load speed of its motor, gear included
};
struct ShapeSpec {
  std::string name;
  std::vector<double> hinge_rad;
  Polygon footprint_B;
  double static_tip_rad = 0;
};

// How a robot stands still once it is told to: by brakes on its driven wheels, by motors that hold
// their wheels' positions, or not at all, its motors told to stand but giving way.
enum class Standstill { kBrake, kHold, kFree };
std::string_view Name(Standstill standstill);
// The default: a heavy robot has brakes, others have motors that hold.
constexpr double kHeavyRobot_kg = 40;
Standstill UsualStandstill(double mass_kg);

struct RobotSpec {
  std::string name;
  std::string model_file;                // the MJCF
  std::string drive;                     // the name of a drive, see controllers/drives.inc
  std::vector<WheelSpec> wheels;         // the driven ones, in actuator order
  std::optional<SteeringSpec> steering;  // none: no wheel is steered
  // The tightest arc that B's origin can be driven on, by the steering's stops; 0 without one.
  double turn_radius_m = 0;

  std::vector<BlockSpec> blocks;  // empty: the robot does not change its shape
  std::vector<HingeSpec> hinges;  // empty: the blocks are locked in `shape`
  std::vector<ShapeSpec> shapes;  // those that it knows
  int shape = 0;                  // at the start; clear, tool and the rest below are this shape's

  Shape2 clear;  // kept free of obstacles
  Shape2 tool;   // swept
  double tool_width_m = 0;
  double inscribed_radius_m = 0, circumscribed_radius_m = 0;
  // Convex polygons that together contain everything that collides: the footprint, cut into convex
  // parts, or, of a robot that keeps a circle clear, the outlines of its geoms. Round geoms are
  // polygons of 72 corners, too small by 0.1 % of their radius.
  std::vector<Polygon> outline_B;
  double height_m = 0;

  Standstill standstill = Standstill::kHold;
  double mass_kg = 0;
  Vec3 p_BCom = Vec3::Zero();
  double clearance_m = 0;     // belly above the floor
  double step_m = 0;          // highest level change it is trusted to cross
  MeasuredLimits measured;    // what its model's file says that the ladder measured
  double static_tip_rad = 0;  // least atan(d / h) over the edges of the wheels' support polygon
  // From the ladder's capability chart: the steepest flanks of a 20 mm cable cover that the robot
  // crosses at 0.2 m/s on friction 0.8, 3 degrees off square, forward and sideways, and the chart's
  // highest speed, at which it crosses most. 0: the model states none.
  double cover_forward_rad = 0, cover_sideways_rad = 0, cover_speed_mps = 0;

  double cruise_mps = 0;  // default speed along a plan
  double max_speed_mps = 0;
  double max_accel_mps2 = 0;
  double max_yaw_rate_radps = 0;
  double max_yaw_accel_radps2 = 0;
  double hotel_load_w = 0;  // computer and sensors, drawn all the time
  Battery battery;          // its voltage set, to that of the motors' drivers
  // An audit's pace: speed from stop to stop and time a sample takes. 0: the model states none.
  double audit_speed_mps = 0, audit_dwell_s = 0;
  double audit_sensor_x_m = 0;  // of what takes the sample, in B
};

}  // namespace floorproof
