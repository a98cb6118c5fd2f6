// SPDX-License-Identifier: Apache-2.0
#include "env/core/battery.h"

#include <algorithm>
#include <cmath>

namespace floorproof {

void Battery::Visit(ParamVisitor& v) {
  v("voltage_v", voltage_v, Between(1, 1000),
    "open circuit, and most that the motors' drivers give (V); none: as the robot's model says");
  v("resistance_ohm", resistance_ohm, Between(0, 100), "internal (ohm); 0: the voltage never sags");
  v("capacity_wh", capacity_wh, Positive(),
    "drawn empty the battery cuts off (Wh); none: never empty");
}

BatteryOutput Feed(double voltage_v, double resistance_ohm, double load_w) {
  const double root = voltage_v * voltage_v - 4 * resistance_ohm * load_w;
  if (root < 0) return {};
  const double v = (voltage_v + std::sqrt(root)) / 2;
  return {v, load_w / v};
}

double MotorPower(double torque_nm, double speed_radps, double resistance_ohm, double constant) {
  const double current = torque_nm / constant;
  return std::max(0.0, current * (resistance_ohm * current + constant * speed_radps));
}

double DriveTorque(const VelocityDrive& drive, double command_radps, double speed_radps) {
  const double emf = drive.constant * speed_radps;
  double volt =
      drive.resistance_ohm / drive.constant * drive.gain * (command_radps - speed_radps) + emf;
  if (drive.voltage_v > 0) volt = std::clamp(volt, -drive.voltage_v, drive.voltage_v);
  const double torque = drive.constant * (volt - emf) / drive.resistance_ohm;
  return drive.torque_nm > 0 ? std::clamp(torque, -drive.torque_nm, drive.torque_nm) : torque;
}

BatteryInUse::BatteryInUse(const Battery& battery) : battery_(battery) {
  constexpr double kUsual_v = 12;
  if (!battery_.voltage_v) battery_.voltage_v = kUsual_v;
  voltage_v_ = built_v_ = *battery_.voltage_v;
}

void BatteryInUse::Weaken(double share) {
  const double before_v = *battery_.voltage_v, now_v = share * built_v_;
  battery_.voltage_v = now_v;
  voltage_v_ *= now_v / before_v;
}

BatteryOutput BatteryInUse::Feed(double load_w, double dt_s) {
  BatteryOutput out;
  if (!cut_off()) out = floorproof::Feed(*battery_.voltage_v, battery_.resistance_ohm, load_w);
  overloaded_ = overloaded_ || (!empty() && out.voltage_v == 0);
  drawn_j_ += *battery_.voltage_v * out.current_a * dt_s;
  voltage_v_ = out.voltage_v;
  return out;
}

std::optional<double> BatteryInUse::left() const {
  if (!battery_.capacity_wh) return std::nullopt;
  return std::max(0.0, 1 - drawn_j_ / (*battery_.capacity_wh * 3600));
}

}  // namespace floorproof
