// SPDX-License-Identifier: Apache-2.0
// Coulomb friction, by a block on a slope: it holds below atan(mu) and slides above, there with
// the acceleration g (sin a - mu cos a). The slope is a solid of the scene, as a hazard's flank is.
//
// Tolerances: with soft friction a block that holds creeps by a few mm/s. So "slides" means above 2
// cm/s after a second, which g (sin a - mu cos a) reaches 0.14 deg above the angle; the bisection
// leaves 0.1 deg. The acceleration is taken from the distance slid from rest, 2 s / t^2, to 2 %:
// MuJoCo's convex contacts lift what slides, so that it hops by some tenths of a millimetre, and
// its velocity is noisy where its distance is not.
#include <fmt/format.h>

#include "validate/bisect.h"
#include "validate/law.h"

namespace floorproof {
namespace {

constexpr double kAngle_deg = 0.25, kAccel = 0.02;
constexpr double kSlides_mps = 0.02;
constexpr double kDegree = kPi / 180;
constexpr const char* kBlock = R"(<mujoco><worldbody><body name="base"><freejoint/>
  <geom type="box" size="0.1 0.1 0.01" pos="0 0 0.01" mass="2" contype="0" conaffinity="1"/>
  </body></worldbody></mujoco>)";

// Let go at rest on a slope of this angle: the way slid after a second, and the speed.
struct Slide {
  double way_m = 0, v_mps = 0;
};
constexpr double kTime_s = 1;

Slide LetGo(double mu, double slope_rad, const WrongModel& wrong) {
  // A ridge along y whose flank rises from x = 1 to x = 3, the block in the flank's middle.
  constexpr double kFoot_m = 1, kRun_m = 2, kRidge_m = 0.1;
  const double end_m = kFoot_m + kRun_m;
  RigOptions options{.friction = mu, .wrong = wrong};
  options.hazards.push_back(Prism("slope", Rectangle({kFoot_m, -1}, {end_m + kRidge_m + kRun_m, 1}),
                                  Rectangle({end_m, -1}, {end_m + kRidge_m, 1}),
                                  kRun_m * std::tan(slope_rad)));
  Rig rig(BodyFromMjcf(kBlock), options);
  const Eigen::Quaterniond q_WB(Eigen::AngleAxisd(-slope_rad, Vec3::UnitY()));
  const Vec3 down_W(-std::cos(slope_rad), 0, -std::sin(slope_rad));
  const Vec3 start_W(kFoot_m + kRun_m / 2, 0, kRun_m / 2 * std::tan(slope_rad));
  rig.SetBase(start_W, q_WB, Vec3::Zero());
  while (rig.truth().t_s < kTime_s - 1e-9) rig.Step();
  return {(rig.truth().p_WB - start_W).dot(down_W), rig.truth().v_WB_W.dot(down_W)};
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
      const double steepest_deg =
          Bisect(holds_rad / kDegree - 10, holds_rad / kDegree + 10, 0.1, [&](double slope_deg) {
            return !(LetGo(mu, slope_deg * kDegree, wrong).v_mps > kSlides_mps);
          });
      rows.push_back({fmt::format("friction/block/mu{}/holds", mu), holds_rad / kDegree,
                      steepest_deg, kAngle_deg, "deg"});
      const double steep_rad = holds_rad + 8 * kDegree;
      const double a = kGravity_mps2 * (std::sin(steep_rad) - mu * std::cos(steep_rad));
      rows.push_back({fmt::format("friction/block/mu{}/slides", mu), a,
                      2 * LetGo(mu, steep_rad, wrong).way_m / (kTime_s * kTime_s), kAccel * a,
                      "m/s^2"});
    }
  }
};

}  // namespace

FP_DEFINE_PLUGIN(Law, BlockFriction)

}  // namespace floorproof
