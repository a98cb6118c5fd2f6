// SPDX-License-Identifier: Apache-2.0
// F1, veer off: cross-track error > e for d.
//
// The error is that of the true position to the tracked segment. Progress is monotone: it is never
// measured to the nearest point of the whole path, which would forgive a robot that skipped a row.
// e is half the width between the obstacles across the segment there, and at most
// max_cross_track_m. A robot that is off by more is nearer to what bounds its lane than to its
// lane. The constant bound is that of Nav2's path-tracking bounds (Steve Macenski et al.). The
// error must last, so that the jerk of one step is no failure. The detector does not ask why the
// robot is off.
#include <algorithm>

#include "env/failures/detector.h"
#include "env/failures/evidence.h"

namespace floorproof {
namespace {

constexpr double kTimeSlackS = 1e-9;  // sums of time steps are not exact
constexpr double kRecallS = 5.0;      // a hazard met longer ago did not push the robot off

class VeerOff final : public Detector {
 public:
  void Visit(ParamVisitor& v) override {
    v("max_cross_track_m", max_cross_track_m_, Positive(),
      "cross-track error allowed where the lane is wide; half the free width where that is less");
    v("duration_s", duration_s_, NonNegative(), "how long the error must last");
  }

  FailureMode mode() const override { return FailureMode::kVeerOff; }

  void Start(const EpisodeContext& context) override {
    hazards_.Start(context);
    off_ = reported_ = false;
    StartMargin(max_cross_track_m_);
  }

  bool Update(const Sample& sample) override {
    hazards_.Update(sample);
    const double half_width_m = sample.cross_track_half_width_m;
    const double limit_m =
        half_width_m > 0 ? std::min(max_cross_track_m_, half_width_m) : max_cross_track_m_;
    const double margin_m = limit_m - sample.cross_track_m;
    if (!(margin_m < 0)) {
      off_ = reported_ = false;
      LowerMargin(margin_m, limit_m);
      return false;
    }
    if (!off_) {
      off_ = true;
      off_since_s_ = sample.t_s;
    }
    // Before the duration is over the threshold was exceeded, but the robot has not failed. The
    // margin's sign says which.
    const bool lasted = sample.t_s - off_since_s_ >= duration_s_ - kTimeSlackS;
    LowerMargin(lasted ? margin_m : 0.0, limit_m);
    if (!lasted || reported_) return false;
    reported_ = true;
    event_ = MakeEvent(mode(), "", sample, hazards_.Recall(sample.t_s - kRecallS),
                       sample.cross_track_m, limit_m);
    event_.evidence = {{"half_width_m", half_width_m}, {"since_s", off_since_s_}};
    return true;
  }

 private:
  double max_cross_track_m_ = 0.5;  // Nav2's bound for indoor robots
  double duration_s_ = 0.2;

  HazardMemory hazards_{&HazardMemory::PushesOff};
  bool off_ = false, reported_ = false;
  double off_since_s_ = 0;
};

}  // namespace

FP_DEFINE_PLUGIN(Detector, VeerOff)

}  // namespace floorproof
