// SPDX-License-Identifier: Apache-2.0
// F2, stuck: a move is commanded, yet displacement < r and turn < a within T.
//
// A sliding window covers the last T seconds in which a move was commanded; standing still on
// purpose stops its clock. Displacement and turn are the largest from the window's first pose, so a
// robot that drives out and back counts as moving. This follows Nav2's pose progress checker, but r
// scales with what was commanded: r = min(displacement_m, fraction * d_cmd). d_cmd is the largest
// displacement that the commands of the window lead to; where they go straight ahead it is v_cmd T.
// So a slow robot is not stuck for being slow, nor is one that is told to wind about in a corner.
// Where next to no translation was commanded, the turn is judged in the same way: a = min(turn_rad,
// fraction * w_cmd * T). Poses are kept ten times a second, in a ring made in Start().
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include "env/failures/detector.h"
#include "env/failures/evidence.h"

namespace floorproof {
namespace {

constexpr double kGravity = 9.81;
constexpr double kSampleS = 0.1;      // between kept poses; 1 % of the default window
constexpr double kTimeSlackS = 1e-9;  // sums of time steps are not exact
// Least r: tyres and suspension give by millimetres, which is no progress.
constexpr double kLeastDisplacementM = 0.02;

class Stuck final : public Detector {
 public:
  void Visit(ParamVisitor& v) override {
    v("window_s", window_s_, Between(0.1, 3600),
      "T: time with a move commanded that is looked back upon");
    v("displacement_m", displacement_m_, Positive(),
      "r: displacement that counts as progress, at most");
    v("commanded_fraction", fraction_, Between(0, 1),
      "share of the commanded displacement that counts as progress where it is less than that");
    v("turn_rad", turn_rad_, Positive(), "a: turn that counts as progress");
    v("least_speed_mps", least_speed_mps_, Positive(), "a command below this is no move");
    v("least_yaw_rate_radps", least_yaw_rate_radps_, Positive(), "a command below this is no turn");
    v("belly_share", belly_share_, Between(0, 1),
      "kind high_centred: mean share of the weight on the belly, at least");
  }

  FailureMode mode() const override { return FailureMode::kStuck; }

  void Start(const EpisodeContext& context) override {
    map_ = &context.map;
    weight_n_ = context.robot.mass_kg * kGravity;
    timestep_s_ = context.timestep_s;
    const auto intervals =
        static_cast<std::size_t>(std::max(10.0, std::ceil(window_s_ / kSampleS)));
    period_s_ = window_s_ / static_cast<double>(intervals);
    ring_.assign(intervals + 1, {});
    count_ = 0;
    newest_ = intervals;
    clock_s_ = angle_rad_ = belly_ns_ = 0;
    commanded_W_.setZero();
    ticks_ = 0;
    started_ = reported_ = false;
    hazards_.Start(context);
    belly_hazard_ = -1;
    margin_ = displacement_m_;
  }

  bool Update(const Sample& sample) override {
    hazards_.Update(sample);
    if (sample.belly_hazard >= 0) {
      belly_hazard_ = sample.belly_hazard;
      belly_t_s_ = sample.t_s;
    }
    const double dt_s = started_ ? sample.t_s - last_t_s_ : timestep_s_;
    started_ = true;
    last_t_s_ = sample.t_s;
    const BodyTwist& cmd = sample.command.twist;
    const double speed_mps = std::sqrt(cmd.vx_mps * cmd.vx_mps + cmd.vy_mps * cmd.vy_mps);
    // A block that is to turn on its hinge counts as a turn of the robot.
    double yaw_rate_radps = std::abs(cmd.wz_radps), folded_rad = 0;
    for (std::size_t h = 0; h < static_cast<std::size_t>(sample.hinges.n); ++h) {
      yaw_rate_radps = std::max(yaw_rate_radps, std::abs(sample.command.hinges.radps[h]));
      folded_rad += sample.hinges.rad[h];
    }
    folded_rad_ = folded_rad;
    if (sample.command.dwelling || sample.command.done ||
        (speed_mps < least_speed_mps_ && yaw_rate_radps < least_yaw_rate_radps_))
      return false;
    if (count_ == 0) Keep(sample);
    clock_s_ += dt_s;
    commanded_W_ += Pose2{0, 0, sample.yaw_rad}.Rotate({cmd.vx_mps, cmd.vy_mps}) * dt_s;
    angle_rad_ += yaw_rate_radps * dt_s;
    belly_ns_ += sample.belly_load_n * dt_s;
    if (clock_s_ < static_cast<double>(ticks_ + 1) * period_s_ - kTimeSlackS) return false;
    ++ticks_;
    Keep(sample);
    return count_ == ring_.size() && Judge(sample);
  }

 private:
  struct Kept {
    Vec2 p_WB = Vec2::Zero();
    double yaw_rad = 0;                  // unwrapped
    double folded_rad = 0;               // sum of the hinges' angles
    Vec2 commanded_W = Vec2::Zero();     // where commands alone would have led
    double angle_rad = 0, belly_ns = 0;  // commanded turn, and belly load, summed up to here
    double t_s = 0;
  };

  void Keep(const Sample& sample) {
    const double yaw_rad =
        count_ == 0 ? sample.yaw_rad
                    : ring_[newest_].yaw_rad + WrapAngle(sample.yaw_rad - ring_[newest_].yaw_rad);
    newest_ = (newest_ + 1) % ring_.size();
    ring_[newest_] = {sample.p_WB.head<2>(),
                      yaw_rad,
                      folded_rad_,
                      commanded_W_,
                      angle_rad_,
                      belly_ns_,
                      sample.t_s};
    count_ = std::min(count_ + 1, ring_.size());
  }

  bool Judge(const Sample& sample) {
    const Kept& first = ring_[(newest_ + 1) % ring_.size()];
    const Kept& last = ring_[newest_];
    double squared_m2 = 0, commanded_m2 = 0, turned_rad = 0;
    for (const Kept& kept : ring_) {
      squared_m2 = std::max(squared_m2, (kept.p_WB - first.p_WB).squaredNorm());
      commanded_m2 = std::max(commanded_m2, (kept.commanded_W - first.commanded_W).squaredNorm());
      turned_rad = std::max({turned_rad, std::abs(kept.yaw_rad - first.yaw_rad),
                             std::abs(kept.folded_rad - first.folded_rad)});
    }
    const double moved_m = std::sqrt(squared_m2);
    const double commanded_m = std::sqrt(commanded_m2);
    const double commanded_rad = last.angle_rad - first.angle_rad;
    const double least_m =
        std::min(displacement_m_, std::max(kLeastDisplacementM, fraction_ * commanded_m));
    const bool rotation_only = fraction_ * commanded_m < kLeastDisplacementM;
    const double least_rad =
        rotation_only ? std::min(turn_rad_, fraction_ * commanded_rad) : turn_rad_;

    const bool stuck = moved_m < least_m && turned_rad < least_rad;
    // Progress by turning counts as so much displacement: the margin is in metres, and its sign is
    // the verdict.
    const double turned_share = least_rad > 0 ? turned_rad / least_rad : 1;
    const double margin_m = (std::max(moved_m / least_m, turned_share) - 1) * least_m;
    margin_ = std::min(margin_, margin_m);
    if (!stuck) reported_ = false;
    if (!stuck || reported_) return false;
    reported_ = true;

    const double belly_n = (last.belly_ns - first.belly_ns) / window_s_;
    const bool high_centred = weight_n_ > 0 && belly_n >= belly_share_ * weight_n_;
    const bool on_hazard = high_centred && belly_hazard_ >= 0 && belly_t_s_ >= first.t_s;
    std::string hazard = on_hazard ? HazardId(*map_, belly_hazard_, false) : "";
    if (hazard.empty()) hazard = hazards_.Recall(first.t_s);
    event_ = MakeEvent(mode(), high_centred ? "high_centred" : "", sample, std::move(hazard),
                       moved_m, least_m);
    event_.evidence = {{"turn_rad", turned_rad},     {"turn_threshold_rad", least_rad},
                       {"commanded_m", commanded_m}, {"commanded_rad", commanded_rad},
                       {"belly_load_n", belly_n},    {"since_s", first.t_s}};
    return true;
  }

  double window_s_ = 10, displacement_m_ = 0.5, fraction_ = 0.25, turn_rad_ = 0.5;
  double least_speed_mps_ = 0.01, least_yaw_rate_radps_ = 0.05;
  double belly_share_ = 0.1;  // a belly that only grazes carries less

  const HazardMap* map_ = nullptr;
  double weight_n_ = 0, timestep_s_ = 0;
  std::vector<Kept> ring_;
  std::size_t count_ = 0, newest_ = 0;
  double period_s_ = kSampleS;
  double clock_s_ = 0;  // time with a move commanded
  Vec2 commanded_W_ = Vec2::Zero();
  double angle_rad_ = 0, belly_ns_ = 0, folded_rad_ = 0;
  std::int64_t ticks_ = 0;
  double last_t_s_ = 0;
  bool started_ = false, reported_ = false;
  HazardMemory hazards_{&HazardMemory::Holds};
  int belly_hazard_ = -1;
  double belly_t_s_ = 0;
};

}  // namespace

FP_DEFINE_PLUGIN(Detector, Stuck)

}  // namespace floorproof
