// SPDX-License-Identifier: Apache-2.0
// A hazard's coefficient of restitution e, measured: a block of 1, 5 or 20 kg thrown flat against a
// wall, and a ball onto a floor, at 0.1-0.5 m/s; the speed it leaves with over that which it came
// with. Free impacts: no weight and no motor presses on meanwhile, as Newton's law of restitution
// has it. (A contact lasts 30 ms and more here, see env/scene/restitution.h; a ball let fall at
// 0.5-1 m/s comes back with 0.12, 0.39 and 0.62 where 0.3, 0.5 and 0.7 are chosen.) 0.9 is tried at
// steps of 1 ms.
//
// An impact's outcome depends on where within a time step it falls, so each is repeated from eight
// places. `mean` is over these, speeds and masses; `worst` is the largest |measured - e| of any
// single impact; `impulse` is the mean of the reported impulse over m v, which is 1 + e.
// Tolerances: 0.02 of the means; 0.08 for a single impact, whose contact lasts only some eight
// steps of 4 ms.
#include <fmt/format.h>

#include "validate/law.h"

namespace floorproof {
namespace {

constexpr double kMean = 0.02, kSingle = 0.08;
constexpr int kPlaces = 8;
constexpr double kAtDefaultStep = 0.7;  // livelier needs finer steps: env/scene/restitution.h
constexpr double kRadius_m = 0.05;
constexpr double kSpeeds_mps[] = {0.1, 0.2, 0.3, 0.5};

RobotModel Body(const char* geom, double mass_kg) {
  return BodyFromMjcf(fmt::format(
      R"(<mujoco><worldbody><body name="base"><freejoint/><geom {} mass="{}" contype="0"
         conaffinity="3"/></body></worldbody></mujoco>)",
      geom, mass_kg));
}

// Impacts of one body on one hazard.
class Impacts {
 public:
  Impacts(RobotModel body, Hazard hazard, double restitution, const WrongModel& wrong)
      : rig_(std::move(body), Options(std::move(hazard), restitution, wrong)),
        chosen_(restitution) {}

  Rig& rig() { return rig_; }
  // From here, at this velocity, until it moves away again along `axis`, the hazard behind it.
  void Throw(const Vec3& p_W, const Vec3& v_W, int axis) {
    constexpr int kMaxSteps = 2000;
    const double step_s = rig_.sim().model()->opt.timestep;
    rig_.SetBase(p_W, Eigen::Quaterniond::Identity(), v_W);
    double came = 0;
    double impulse_ns = 0;
    bool touched = false;
    for (int k = 0; k < kMaxSteps; ++k) {
      const double before = -rig_.truth().v_WB_W[axis];
      rig_.Step();
      const bool touches = rig_.data()->ncon > 0;
      for (int i = 0; i < rig_.truth().num_touches; ++i)
        impulse_ns +=
            rig_.truth().touches[static_cast<std::size_t>(i)].normal.force_W_n[axis] * step_s;
      if (touches && !touched) came = before;
      if (touched && !touches) break;
      touched = touched || touches;
    }
    const double e = std::max(0.0, rig_.truth().v_WB_W[axis]) / came;
    sum_ += e;
    impulse_ += impulse_ns / (rig_.robot().mass_kg * came);
    worst_ = std::max(worst_, std::abs(e - chosen_));
    ++n_;
  }
  double mean() const { return sum_ / n_; }
  double worst() const { return worst_; }
  // What the contacts gave, over mass and closing speed.
  double impulse() const { return impulse_ / n_; }

 private:
  static RigOptions Options(Hazard hazard, double restitution, const WrongModel& wrong) {
    RigOptions options{.wrong = wrong};
    hazard.material.restitution = restitution;
    options.hazards.push_back(std::move(hazard));
    if (restitution > kAtDefaultStep) options.physics.timestep_s = 0.001;
    return options;
  }
  Rig rig_;
  double chosen_, sum_ = 0, worst_ = 0, impulse_ = 0;
  int n_ = 0;
};

class Restitution final : public Law {
 public:
  std::string_view statement() const override {
    return "v after / v before = e, the impulse (1 + e) m v, at 0.1-0.5 m/s and 1-20 kg";
  }
  std::vector<WrongModel> notices() const override {
    // The least chosen, 0.05, needs more than 1.3 to leave its tolerance; the liveliest, 0.9, is
    // the most that the engine gives and can only be made less.
    return {{.restitution_factor = 1.3}, {.restitution_factor = 1.5}, {.restitution_factor = 0.7}};
  }

  void Check(const WrongModel& wrong, std::vector<LawRow>& rows) const override {
    for (const double e : {0.05, 0.1, 0.2, 0.3, 0.5, 0.7, 0.9}) {
      const std::string law = fmt::format("restitution/e{}", e);
      double mean = 0, worst = 0, impulse = 0;
      constexpr double kMasses_kg[] = {1, 5, 20};
      for (const double mass_kg : kMasses_kg) {
        const Impacts wall = AtWall(mass_kg, e, wrong);
        mean += wall.mean() / std::size(kMasses_kg);
        worst = std::max(worst, wall.worst());
        impulse += wall.impulse() / std::size(kMasses_kg);
      }
      rows.push_back({law + "/wall/mean", e, mean, kMean, ""});
      rows.push_back({law + "/wall/worst", 0, worst, kSingle, ""});
      rows.push_back({law + "/wall/impulse", 1 + e, impulse, kMean, ""});
      rows.push_back({law + "/floor/mean", e, AtFloor(e, wrong).mean(), kMean, ""});
    }
  }

 private:
  static Impacts AtWall(double mass_kg, double e, const WrongModel& wrong) {
    Impacts impacts(Body(R"(type="box" size="0.05 0.05 0.05")", mass_kg),
                    Prism("wall", {{-2, -2}, {-1, -2}, {-1, 2}, {-2, 2}}, {}, 0.4), e, wrong);
    impacts.rig().SetGravity(Vec3::Zero());
    const double step_s = impacts.rig().sim().model()->opt.timestep;
    for (const double v_mps : kSpeeds_mps)
      for (int k = 0; k < kPlaces; ++k) {
        const double gap_m = v_mps * step_s * (3 + (k + 0.5) / kPlaces);
        impacts.Throw({-1 + kRadius_m + gap_m, 0, 0.2}, {-v_mps, 0, 0}, 0);
      }
    return impacts;
  }
  static Impacts AtFloor(double e, const WrongModel& wrong) {
    constexpr double kTop_m = 0.1;
    Impacts impacts(Body(R"(type="sphere" size="0.05")", 1),
                    Prism("floor", {{1, -1}, {3, -1}, {3, 1}, {1, 1}}, {}, kTop_m), e, wrong);
    impacts.rig().SetGravity(Vec3::Zero());
    const double step_s = impacts.rig().sim().model()->opt.timestep;
    for (const double v_mps : kSpeeds_mps)
      for (int k = 0; k < kPlaces; ++k) {
        const double gap_m = v_mps * step_s * (3 + (k + 0.5) / kPlaces);
        impacts.Throw({2, 0, kTop_m + kRadius_m + gap_m}, {0, 0, -v_mps}, 2);
      }
    return impacts;
  }
};

}  // namespace

FP_DEFINE_PLUGIN(Law, Restitution)

}  // namespace floorproof
