// SPDX-License-Identifier: Apache-2.0
// F4, bounce back: body or wheels meet an obstacle at a closing speed > v; then, within window_s
// and against the command, the whole robot
//   kind `reversed`: comes off it faster than u and than rebound_share of the closing speed;
//   kind `parted`: leaves a gap of more than part_m to it, or goes back by that much more than a
//     soft contact pushes it out of itself.
//
// An impact is a contact that begins; the closing speed is that just before it. The whole robot has
// moved back where both its centre of mass and what touched have, along the contact's normal: a
// body that pitches or turns at the obstacle moves one of them only. What touched is the outermost
// point of the clear shape against the normal, at the contact's height, so that turning beside a
// wall does not count as parting. "Against the command": the watch ends as soon as the commanded
// twist moves that point away from the obstacle, because a robot that backs off on purpose does not
// bounce. Contacts are soft: a robot that is still pushed out of one has not come off it, and is
// back by some 7 ms of its closing speed, less than 3 mm, before it has. An elastic contact is over
// in 40 ms, the liveliest, which are soft, in 60 ms. A robot that still touches kPressS after the
// impact presses on a dead obstacle, unless it comes off before kSoftestS and as fast as from a
// lively one (wheel_share); where it comes off later, it rocks and chatters against it.
// A driven wheel that meets a face rubs itself up it and comes down again: from a dead kerb hTetro
// comes off at 0.25 to 0.42 of its closing speed, by up to 4 mm. So where a wheel meets the
// obstacle the share is wheel_share, and the gap grows with the closing speed.
//
// Once an inequality is met, the event waits until the rebound ends, mostly about 0.1 s, so that
// the peak speed and travel are in the evidence. Its time and place are those at which the
// inequality was met. A distance of centimetres would not do: a robot limited by its wheels'
// traction travels back only 5-26 mm from a nearly elastic wall. Definition: ours.
#include <algorithm>
#include <array>
#include <limits>

#include "env/core/blocks.h"
#include "env/failures/detector.h"
#include "env/failures/evidence.h"
#include "env/failures/posture.h"

namespace floorproof {
namespace {

constexpr double kTimeSlackS = 1e-9;     // sums of time steps are not exact
constexpr double kBackingOffMps = 1e-3;  // a command this fast away from the obstacle retreats
constexpr double kSamePlaceM = 0.1;      // contacts this near with like normals are one contact
constexpr double kSameNormalCos = 0.9;
constexpr double kPressS = 0.05, kSoftestS = 0.08;
constexpr double kTread_s = 0.015;  // way of a wheel up a face, over the closing speed
constexpr double kSoft_s = 0.008;   // way out of a soft contact, over the closing speed
constexpr double kPast_m = 0.002;   // beyond where it touched
constexpr double kSlapShare = 0.5;  // of the first corner's closing speed
constexpr double kChatterS = 0.1;   // a contact lost for less than this has not ended

class BounceBack final : public Detector {
 public:
  void Visit(ParamVisitor& v) override {
    v("closing_mps", closing_mps_, NonNegative(), "v: slower meetings are touches, not impacts");
    v("rebound_mps", rebound_mps_, Positive(), "u: speed off the obstacle that is a rebound");
    v("rebound_share", rebound_share_, Between(0, 1),
      "least share of the closing speed that is a rebound, where it is more than rebound_mps");
    v("wheel_share", wheel_share_, Between(0, 1),
      "the same where a wheel meets the obstacle, or the contact lasts for more than 50 ms");
    v("part_m", part_m_, Positive(), "gap to the obstacle after the impact that is a rebound");
    v("window_s", window_s_, Positive(), "how long after the impact a rebound counts");
  }

  FailureMode mode() const override { return FailureMode::kBounceBack; }

  void Start(const EpisodeContext& context) override {
    map_ = &context.map;
    robot_ = &context.robot;
    clear_ = &robot_->clear;
    meetings_ = {};
    timestep_s_ = context.timestep_s;
    active_ = 0;
    armed_ = true;
    last_contact_s_ = -std::numeric_limits<double>::infinity();
    StartMargin(rebound_mps_);
  }

  bool Update(const Sample& sample) override {
    bool fires = false;
    if (sample.num_contacts > 0 || active_ > 0) fires = Follow(sample);
    if (!armed_ && sample.t_s - last_contact_s_ > window_s_) armed_ = true;
    return fires;
  }

 private:
  // Along the contact's normal: of the centre of mass, and of what touched.
  using Along = std::array<double, 2>;
  static double Least(const Along& now, const Along& then) {
    return std::min(now[0] - then[0], now[1] - then[1]);
  }

  struct Meeting {
    bool live = false, touching = false, seen = false;
    bool watched = false, met = false, pressed = false, settled = false;
    bool first = true, wheel = false;  // of this face; by a wheel
    int hazard = -1;
    std::size_t block = 0;
    Vec2 p_W = Vec2::Zero(), normal_W = Vec2::Zero();
    double height_m = 0;  // in the body's frame
    bool rolls = false;   // a wheel touches, here: at this point of its block's frame
    Vec2 p_K = Vec2::Zero();
    double rolled_m = 0;  // of that point along the normal, when last touching
    double since_s = 0, last_seen_s = 0;
    double closing_mps = 0, threshold_mps = 0;
    double part_m = 0, soft_m = 0;
    Along at{}, touched{}, deepest{};  // at the last step, when last touching, at the deepest
    double peak_mps = 0, gap_m = 0;
    double swing_m = 0, back_m = 0;  // way back until it settles, and until the watch ends
    bool by_speed = false;           // which inequality was met first
    double t_s = 0;                  // then and there
    Pose2 X_WB;
  };

  // The outermost point against the normal, from the body's origin: of the block that touches,
  // where blocks swing; else of the clear shape. (A circle's radius does not change.)
  Vec2 Outermost(const Meeting& meeting, const Sample& sample) const {
    const Pose2 X_WB = sample.X_WB();
    const bool swings = sample.hinges.n > 0;
    const BlockMotion& block = now_.block[meeting.block];
    const Polygon& outline = swings ? robot_->blocks[meeting.block].outline_K : clear_->footprint_B;
    Vec2 r_W = -clear_->radius_m * meeting.normal_W;
    double least_m = std::numeric_limits<double>::infinity();
    if (swings || clear_->kind == Shape2::Kind::kFootprint)
      for (const Vec2& p_K : outline) {
        const Vec2 corner_W = X_WB.Rotate(swings ? block.X_BK * p_K : p_K);
        if (corner_W.dot(meeting.normal_W) >= least_m) continue;
        least_m = corner_W.dot(meeting.normal_W);
        r_W = corner_W;
      }
    return r_W;
  }

  // The commanded speed of that point away from the obstacle.
  double CommandedAway(const Meeting& meeting, const Vec2& r_W, const Sample& sample) const {
    const Pose2 X_WB = sample.X_WB();
    const BodyTwist& cmd = sample.command.twist;
    Vec2 v_cmd_W = X_WB.Rotate({cmd.vx_mps, cmd.vy_mps}) + cmd.wz_radps * Vec2(-r_W.y(), r_W.x());
    if (sample.hinges.n > 0) {
      const Vec2 r_B = Pose2{0, 0, -X_WB.yaw_rad}.Rotate(r_W);
      v_cmd_W += X_WB.Rotate(commanded_.block[meeting.block].VelocityAt(r_B));
    }
    return v_cmd_W.dot(meeting.normal_W);
  }

  Along Place(const Meeting& meeting, const Vec2& r_W, const Sample& sample) const {
    const Mat3 R_WB = Attitude(sample);
    const Vec2 r_B = Pose2{0, 0, -sample.yaw_rad}.Rotate(r_W);
    const auto along = [&](const Vec3& p_B) {
      return (sample.p_WB + R_WB * p_B).head<2>().dot(meeting.normal_W);
    };
    const double touched_m = along({r_B.x(), r_B.y(), meeting.height_m});
    // A block that swings is thrown back on its hinge, and not the robot.
    return {sample.hinges.n > 0 ? touched_m : along(robot_->p_BCom), touched_m};
  }

  // The frame of what touches, which a turn moves as it moves the robot's corners.
  Pose2 Frame(const Meeting& meeting, const Sample& sample) const {
    return sample.hinges.n > 0 ? sample.X_WB() * now_.block[meeting.block].X_BK : sample.X_WB();
  }

  bool Follow(const Sample& sample) {
    if (sample.hinges.n > 0) {
      HingeState commanded = sample.hinges;
      commanded.radps = sample.command.hinges.radps;
      now_ = MoveBlocks(robot_->blocks, robot_->hinges, sample.hinges);
      commanded_ = MoveBlocks(robot_->blocks, robot_->hinges, commanded);
    }
    for (Meeting& meeting : meetings_) meeting.seen = false;
    for (int i = 0; i < sample.num_contacts; ++i)
      See(sample.contacts[static_cast<std::size_t>(i)], sample);
    if (sample.num_contacts > 0) last_contact_s_ = sample.t_s;

    bool fires = false;
    active_ = 0;
    for (Meeting& meeting : meetings_) {
      if (!meeting.live) continue;
      meeting.touching = StillTouches(meeting);
      if (meeting.touching && sample.t_s - meeting.since_s > kSoftestS) meeting.settled = true;
      if (meeting.watched && Watch(meeting, sample) && armed_) {
        Report(meeting, sample);
        armed_ = false;
        fires = true;
      }
      meeting.live = meeting.watched || sample.t_s - meeting.last_seen_s <= kChatterS;
      active_ += meeting.live ? 1 : 0;
    }
    if (fires)
      for (Meeting& meeting : meetings_) meeting.watched = false;
    return fires;
  }

  // There or elsewhere along the same face.
  bool StillTouches(const Meeting& meeting) const {
    return std::ranges::any_of(meetings_, [&](const Meeting& other) {
      return other.live && other.seen && other.hazard == meeting.hazard &&
             other.normal_W.dot(meeting.normal_W) > kSameNormalCos;
    });
  }

  Meeting* Find(const ObstacleContact& contact) {
    for (Meeting& meeting : meetings_)
      if (meeting.live && meeting.hazard == contact.hazard &&
          (meeting.p_W - contact.p_W).squaredNorm() < kSamePlaceM * kSamePlaceM &&
          meeting.normal_W.dot(contact.normal_W) > kSameNormalCos)
        return &meeting;
    return nullptr;
  }

  // The meeting of that face that was the hardest, of those before this one. A robot meets a face
  // with several corners and wheels, one after the other.
  const Meeting* Harder(const Meeting& meeting, const ObstacleContact& contact) const {
    const Meeting* hardest = nullptr;
    for (const Meeting& other : meetings_)
      if (&other != &meeting && other.live && other.hazard == meeting.hazard &&
          other.normal_W.dot(contact.normal_W) > kSameNormalCos &&
          other.closing_mps >= (hardest ? hardest->closing_mps : contact.closing_mps))
        hardest = &other;
    return hardest;
  }

  // Matches a contact to those of the last step, or begins one.
  void See(const ObstacleContact& contact, const Sample& sample) {
    Meeting* meeting = Find(contact);
    const bool begins = meeting == nullptr;
    if (meeting == nullptr) {
      const auto free = std::ranges::find_if(meetings_, [](const Meeting& m) { return !m.live; });
      if (free == meetings_.end()) return;  // as many contacts as a sample can hold are followed
      meeting = &*free;
      *meeting = {};
      meeting->live = true;
      meeting->hazard = contact.hazard;
      meeting->since_s = sample.t_s;
      meeting->closing_mps = contact.closing_mps;
    }
    meeting->seen = true;
    meeting->last_seen_s = sample.t_s;
    meeting->p_W = contact.p_W;
    if (!meeting->watched) {
      meeting->normal_W = contact.normal_W;
      meeting->block = static_cast<std::size_t>(contact.block);
      meeting->height_m = contact.height_m - sample.p_WB.z();
    }
    if (!begins || !armed_ || !(contact.closing_mps > closing_mps_)) return;
    const Meeting* harder = Harder(*meeting, contact);
    // What presses on a dead face rocks against it; that is softer than the slap of a second
    // corner.
    if (harder != nullptr && harder->settled &&
        contact.closing_mps < kSlapShare * harder->closing_mps)
      return;
    meeting->watched = true;
    meeting->first = harder == nullptr;
    meeting->wheel = contact.wheel || (harder != nullptr && harder->wheel);
    const double closing_mps = harder != nullptr ? harder->closing_mps : contact.closing_mps;
    meeting->threshold_mps =
        std::max(rebound_mps_, (meeting->wheel ? wheel_share_ : rebound_share_) * closing_mps);
    meeting->rolls = contact.wheel;
    meeting->p_K = Frame(*meeting, sample).Inverse() * contact.p_W;
    meeting->rolled_m = contact.p_W.dot(meeting->normal_W);
    meeting->part_m = part_m_ + (meeting->wheel ? kTread_s * closing_mps : 0);
    meeting->soft_m = kSoft_s * closing_mps;
    meeting->at = meeting->touched = meeting->deepest =
        Place(*meeting, Outermost(*meeting, sample), sample);
  }

  // One step after an impact. True when a rebound is over, and with it its evidence complete.
  bool Watch(Meeting& meeting, const Sample& sample) {
    const Vec2 r_W = Outermost(meeting, sample);
    const bool backing_off = CommandedAway(meeting, r_W, sample) > kBackingOffMps;
    const bool late = sample.t_s - meeting.since_s > window_s_ + kTimeSlackS;
    if (backing_off || late) {
      meeting.watched = false;
      return meeting.met;
    }

    const Along before = meeting.at;
    meeting.at = Place(meeting, r_W, sample);
    const double away_mps = Least(meeting.at, before) / timestep_s_;
    for (std::size_t i = 0; i < meeting.at.size(); ++i)
      meeting.deepest[i] = std::min(meeting.deepest[i], meeting.at[i]);
    meeting.back_m = std::max(meeting.back_m, Least(meeting.at, meeting.deepest));
    if (!meeting.settled) meeting.swing_m = meeting.back_m;
    const double rolled_m =
        meeting.rolls ? (Frame(meeting, sample) * meeting.p_K).dot(meeting.normal_W) : 0;
    if (meeting.touching) {
      meeting.touched = meeting.at;
      meeting.rolled_m = rolled_m;
      if (sample.t_s - meeting.since_s > kPressS) {
        meeting.pressed = true;
        meeting.threshold_mps = std::max(meeting.threshold_mps, wheel_share_ * meeting.closing_mps);
      }
    } else if (!meeting.settled) {
      meeting.peak_mps = std::max(meeting.peak_mps, away_mps);
      if (!meeting.pressed)
        meeting.gap_m = std::max(meeting.gap_m, Least(meeting.at, meeting.touched));
    }
    // Driven on, over it: what comes later is another obstacle's. A robot that turns where it
    // stands drives on with a wheel alone.
    const bool past = std::max(meeting.at[0] - meeting.touched[0],
                               meeting.at[1] - meeting.touched[1]) < -kPast_m ||
                      (meeting.rolls && rolled_m - meeting.rolled_m < -kPast_m);
    if (past && !meeting.touching && !meeting.met) {
      meeting.watched = false;
      // Forgotten, so that a new touch is a new impact.
      meeting.last_seen_s = -std::numeric_limits<double>::infinity();
      return false;
    }
    Judge(meeting, sample);
    if (!meeting.met || (away_mps > 0 && !sample.command.done)) return false;
    meeting.watched = false;
    return true;
  }

  struct Way {
    double m, most_m;
    double share() const { return m / most_m; }
  };
  // The gap, or the way back, whichever is more beyond what it may be.
  static Way Parted(const Meeting& meeting) {
    const Way gap{meeting.gap_m, meeting.part_m};
    const Way back{meeting.swing_m, meeting.soft_m + meeting.part_m};
    return gap.share() > back.share() ? gap : back;
  }

  void Judge(Meeting& meeting, const Sample& sample) {
    double by_speed = meeting.peak_mps / meeting.threshold_mps;
    // A second corner comes off as the robot swings about the first.
    if (!meeting.first) by_speed = std::min(by_speed, meeting.swing_m / meeting.soft_m);
    const double share = std::max(by_speed, Parted(meeting).share());
    margin_ = std::min(margin_, (1 - share) * rebound_mps_);
    if (meeting.met || !(share > 1)) return;
    meeting.met = true;
    meeting.by_speed = by_speed > 1;
    meeting.t_s = sample.t_s;
    meeting.X_WB = sample.X_WB();
  }

  void Report(const Meeting& meeting, const Sample& sample) {
    const Way parted = Parted(meeting);
    event_ = MakeEvent(mode(), meeting.by_speed ? "reversed" : "parted", sample,
                       HazardId(*map_, meeting.hazard, true),
                       meeting.by_speed ? meeting.peak_mps : parted.m,
                       meeting.by_speed ? meeting.threshold_mps : parted.most_m);
    event_.t_s = meeting.t_s;
    event_.x_m = meeting.X_WB.x_m;
    event_.y_m = meeting.X_WB.y_m;
    event_.yaw_rad = meeting.X_WB.yaw_rad;
    event_.evidence = {{"closing_mps", meeting.closing_mps},
                       {"rebound_mps", meeting.peak_mps},
                       {"travel_back_m", meeting.back_m},
                       {"gap_m", meeting.gap_m},
                       {"impact_t_s", meeting.since_s}};
  }

  double closing_mps_ = 0.05, rebound_mps_ = 0.025, rebound_share_ = 0.15, wheel_share_ = 0.5,
         part_m_ = 0.001, window_s_ = 1.0;
  double timestep_s_ = 0.004;

  const HazardMap* map_ = nullptr;
  const RobotSpec* robot_ = nullptr;
  const Shape2* clear_ = nullptr;
  BlockMotions now_, commanded_;  // of a robot whose blocks swing
  std::array<Meeting, Sample::kMaxContacts> meetings_;
  int active_ = 0;
  bool armed_ = true;
  double last_contact_s_ = 0;
};

}  // namespace

FP_DEFINE_PLUGIN(Detector, BounceBack)

}  // namespace floorproof
