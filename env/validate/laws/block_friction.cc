// SPDX-License-Identifier: Apache-2.0
// Coulomb friction, by a block on a slope: it holds below atan(mu) and slides above, there with
// the acceleration g (sin a - mu cos a). The slope is a solid of the scene, as a hazard's flank is.
//
// Tolerances: soft friction lets a block that holds creep by a few mm/s, so "slides" is above
// 2 cm/s after a second, which g (sin a - mu cos a) reaches 0.14 deg above the angle; the bisection
// leaves 0.1 deg. Accelerations to 1 %.
#include <fmt/format.h>

#include "env/validate/law.h"

namespace floorproof {
namespace {

constexpr double kAngle_deg = 0.25, kAccel = 0.01;
constexpr double kSlides_mps = 0.02;
constexpr double kDegree = kPi / 180;
constexpr const char* kBlock = R"(<mujoco><worldbody><body name="base"><freejoint/>
  <geom type="box" size="0.05 0.05 0.02" pos="0 0 0.02" mass="2" contype="0" conaffinity="1"/>
  </body></worldbody></mujoco>)";

// Speed down a slope of this angle after times t1 and t2, let go at rest.
struct Slide {
  double early_mps = 0, late_mps = 0;
};
constexpr double kEarly_s = 0.4, kLate_s = 1.0;

Slide LetGo(double mu, double slope_rad, const WrongModel& wrong) {
  // A ridge along y whose flank rises from x = 1 to x = 3, the block in the flank's middle.
  constexpr double kFoot_m = 1, kRun_m = 2, kRidge_m = 0.1;
  const double end_m = kFoot_m + kRun_m;
  const Hazard slope =
      Prism("slope", Rectangle({kFoot_m, -1}, {end_m + kRidge_m + kRun_m, 1}),
            Rectangle({end_m, -1}, {end_m + kRidge_m, 1}), kRun_m * std::tan(slope_rad));
  RigOptions options{.friction = mu, .wrong = wrong};
  options.hazards.push_back(slope);
  Rig rig(BodyFromMjcf(kBlock), options);
  const Eigen::Quaterniond q_WB(Eigen::AngleAxisd(-slope_rad, Vec3::UnitY()));
  const Vec3 down_W(-std::cos(slope_rad), 0, -std::sin(slope_rad));
  rig.SetBase({kFoot_m + kRun_m / 2, 0, kRun_m / 2 * std::tan(slope_rad)}, q_WB, Vec3::Zero());
  Slide slide;
  const double start_s = rig.sample().t_s;
  while (rig.sample().t_s < start_s + kLate_s) {
    rig.Step();
    const double v_mps = rig.sample().v_WB_W.dot(down_W);
    (rig.sample().t_s < start_s + kEarly_s + 1e-9 ? slide.early_mps : slide.late_mps) = v_mps;
  }
  return slide;
}

class BlockFriction final : public Law {
 public:
  std::string_view statement() const override {
    return "a block on a slope holds below atan(mu); above, a = g (sin - mu cos)";
  }
  std::vector<WrongModel> notices() const override { return {kMoreFriction}; }

  void Check(const WrongModel& wrong, std::vector<LawRow>& rows) const override {
    for (const double mu : {0.4, 0.8}) {
      const double holds_rad = std::atan(mu);
      double low_deg = holds_rad / kDegree - 10, high_deg = holds_rad / kDegree + 10;
      while (high_deg - low_deg > 0.1) {
        const double middle_deg = (low_deg + high_deg) / 2;
        const bool slides = LetGo(mu, middle_deg * kDegree, wrong).late_mps > kSlides_mps;
        (slides ? high_deg : low_deg) = middle_deg;
      }
      rows.push_back({fmt::format("friction/block/mu{}/holds", mu), holds_rad / kDegree,
                      (low_deg + high_deg) / 2, kAngle_deg, "deg"});
      const double steep_rad = holds_rad + 8 * kDegree;
      const double a = kGravity_mps2 * (std::sin(steep_rad) - mu * std::cos(steep_rad));
      const Slide slide = LetGo(mu, steep_rad, wrong);
      rows.push_back({fmt::format("friction/block/mu{}/slides", mu), a,
                      (slide.late_mps - slide.early_mps) / (kLate_s - kEarly_s), kAccel * a,
                      "m/s^2"});
    }
  }
};

}  // namespace

FP_DEFINE_PLUGIN(Law, BlockFriction)

}  // namespace floorproof
