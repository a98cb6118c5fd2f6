// SPDX-License-Identifier: Apache-2.0
// A battery that feeds motors' drivers and hotel load, and DC motors' power: plain functions.
//
// The battery is a constant voltage behind a resistance (Thevenin). A driver passes its motor's
// power on without loss, and nothing comes back from a motor that brakes. Energy is counted at the
// terminals, E = integral of v(t) i(t) dt ("audit-sampling", Eq. 5). Not modelled: a voltage that
// falls with the charge, temperature, ageing, losses of the drivers.
#pragma once

#include <optional>

#include "base/params.h"

namespace floorproof {

struct Battery {
  std::optional<double> voltage_v = {};  // open circuit; none: that of the robot's motor drivers
  double resistance_ohm = 0;             // internal; 0: the voltage never sags
  std::optional<double> capacity_wh =
      {};  // that it can give, own losses included; none: never empty
  void Visit(ParamVisitor& v);
};

// At the terminals of a battery.
struct BatteryOutput {
  double voltage_v = 0, current_a = 0;
  double power_w() const { return voltage_v * current_a; }
};

// The voltage and current that a load of this power (W, >= 0) gets from `voltage_v` behind
// `resistance_ohm`: the larger root of v (V - v) / R = P. No battery can feed a load above V^2 / (4
// R); such a load gets 0 V and no current.
BatteryOutput Feed(double voltage_v, double resistance_ohm, double load_w);

// Electrical power of a DC motor with its driver, W: v i with the current i = torque / K and the
// voltage v = R i + K omega. Nothing comes back when braking.
double MotorPower(double torque_nm, double speed_radps, double resistance_ohm, double constant);

// A motor whose driver holds a speed: MuJoCo's `dcmotor` with a velocity input.
struct VelocityDrive {
  double resistance_ohm = 0, constant = 0;  // R; K, at the joint
  double gain = 0;                          // N m s/rad
  double voltage_v = 0;                     // most that the driver gives; 0: no limit
  double torque_nm = 0;                     // most that it lets pass; 0: no limit
};
// The torque, N m, at the joint: gain (command - speed), as far as the voltage and the limit allow.
double DriveTorque(const VelocityDrive& drive, double command_radps, double speed_radps);

// A battery in use. It cuts off when its capacity is used up, or when a load is more than it can
// feed. From then on it gives no voltage and no current.
class BatteryInUse {
 public:
  // Without a voltage: 12 V.
  explicit BatteryInUse(const Battery& battery);
  // Feeds this load for this time. A battery that runs empty within it is empty after it.
  BatteryOutput Feed(double load_w, double dt_s);
  // From now on it is one of this share of its voltage.
  void Weaken(double share);
  bool empty() const { return battery_.capacity_wh && drawn_j_ >= *battery_.capacity_wh * 3600; }
  bool cut_off() const { return overloaded_ || empty(); }
  // Share of the capacity, 1: full; none without a capacity.
  std::optional<double> left() const;
  // The terminals' voltage at the last load; before it, the open circuit's.
  double voltage_v() const { return voltage_v_; }

 private:
  Battery battery_;
  double built_v_ = 0;
  bool overloaded_ = false;
  double drawn_j_ = 0;  // from the cells: at open-circuit voltage
  double voltage_v_ = 0;
};

}  // namespace floorproof
