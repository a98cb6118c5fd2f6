// SPDX-License-Identifier: Apache-2.0
// A robot on a wide floor, driven by twists: what laws and tests look at.
#pragma once

#include <Eigen/Geometry>
#include <memory>
#include <string>
#include <vector>

#include "controllers/drive.h"
#include "env/scene/scene.h"
#include "env/sim/simulation.h"

namespace floorproof {

// What is made wrong on purpose, to see that a law notices. The simulation gets it; what the law
// expects, and the wheel speeds commanded, stay those of the true model.
struct WrongModel {
  double friction_factor = 1;     // of the floor and of hazards that state none
  double wheel_radius_add_m = 0;  // to the driven wheels'; the body rises with its axles
  double gravity_factor = 1;      // where neither of the above can be felt: in free fall
  double seam_step_m = 0;         // every second slab of a cut floor lies lower by this
  double battery_factor = 1;      // of its voltage
  double resistance_factor = 1;   // of the motors' windings
  double hotel_load_factor = 1;   // what all but the motors draws
  double restitution_factor = 1;  // of hazards'
  double drag_factor = 1;         // of hazards' rolling drag
  double steering_add_rad = 0;    // the fork points so much farther to the left than is thought
  double tyre_factor = 1;         // on the tyres' stiffness

  bool contacts_forget = false;  // from which side a body came to an edge (edge_contacts.h)

  bool operator==(const WrongModel&) const = default;
};

struct RigOptions {
  PhysicsParams physics = {};
  std::vector<Hazard> hazards = {};  // solids on the floor; ids and materials as in a site
  RobotChanges changes = {};
  Blocks blocks = Blocks::kLocked;
  bool rollers = false;  // on Mecanum wheels, as bodies (env/scene/roller_wheels.h)
  double friction = 0.8;
  bool holds_still = false;  // as its model says, when told to stand; else its wheels give way
  WrongModel wrong = {};
};

class Rig {
 public:
  // The robot (a bundled name or a file) at the origin of a floor of 20 x 20 m, at rest.
  explicit Rig(const std::string& robot_name, RigOptions options = {});
  // A body of one's own, as BodyFromMjcf makes it; options.changes and the wrong wheels are the
  // caller's affair.
  explicit Rig(RobotModel body, RigOptions options = {});

  // Wheel and hinge speeds for this motion from now on; hinges that are not mentioned hold still. A
  // robot that steers is told anew each step, by where its wheels point then.
  void Command(const BodyTwist& twist, HingeState hinges = {});
  // The same speed for every wheel from now on: a body of one's own.
  void CommandWheels(double wheel_radps);
  // Holds every driven wheel still by dry friction in its bearing, far above what the floor gives.
  void Brake();
  // Puts the base at this pose, with this velocity, everything else as it is.
  void SetBase(const Vec3& p_WB, const Eigen::Quaterniond& q_WB, const Vec3& v_WB_W);
  // Gravity of 9.81 m/s^2 along this direction, as a floor tilted the other way feels it.
  void SetGravity(const Vec3& direction_W);
  // One physics step; throws InternalError when the state diverged.
  void Step();
  // Drives this twist for a time; returns the body's mean velocity over the second half.
  BodyTwist Run(const BodyTwist& twist, double t_s);

  const Truth& truth() const { return sim_->truth(); }
  const RobotSpec& robot() const { return true_robot_; }  // of the true model
  Simulation& sim() { return *sim_; }
  mjData* data() { return sim_->data(); }
  const Scene& scene() const { return scene_; }
  const HazardMap& map() const { return map_; }
  const std::vector<Foot>& feet() const { return model_.feet; }

 private:
  void Build(RigOptions options);
  void Actuate();

  HazardMap map_;
  WrongModel wrong_;
  RobotSpec true_robot_;
  RobotModel model_;  // the one simulated
  Scene scene_;
  std::unique_ptr<Drive> drive_;  // none for a body of one's own
  std::vector<double> wheel_radps_;
  BodyTwist twist_;  // commanded, and the hinges
  HingeState hinges_;
  bool steers_ = false;  // by a twist, from now on
  std::unique_ptr<Simulation> sim_;
};

constexpr double kGravity_mps2 = 9.81;

// A body named `base` with a free joint, from MJCF text; each of its actuators drives a wheel. For
// a law that needs a cleaner body than a robot. Throws InternalError when MuJoCo refuses it.
RobotModel BodyFromMjcf(const std::string& mjcf);

// A straight-sided or flanked solid on the floor, for RigOptions::hazards: `top` empty: as `base`.
Hazard Prism(const std::string& id, const Polygon& base, const Polygon& top, double height_m);

}  // namespace floorproof
