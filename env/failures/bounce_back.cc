// SPDX-License-Identifier: Apache-2.0
// F4, bounce back: the body meets an obstacle at a closing speed > v; then, within window_s, it
// parts from the obstacle by > part_m, or its normal velocity reverses by > u, against the command.
//
// An impact is a contact that begins; the closing speed is that just before it. From then on the
// detector follows the body's distance to the plane through the contact. It is measured from the
// outermost point of the clear shape against the contact normal, so that turning beside a wall does
// not count as parting. "Against the command": the watch ends as soon as the commanded twist moves
// that point away from the obstacle, because a robot that backs off on purpose does not bounce.
// Only the first reversal counts, until the body approaches again or still touches kPressS after
// the impact (an elastic contact is over in about 10 ms). A robot that keeps driving into a dead
// wall rocks and chatters against it at about 0.03 m/s; it has not been thrown back. Neither has
// one whose rebound is below rebound_share of its closing speed: a critically damped contact, which
// is what "dead" means in a compliant engine, gives back exp(-2) = 0.135 of it (Schwager & Poeschel
// 2007, "Coefficient of restitution and linear-dashpot model revisited", eq. 20).
//
// Once the inequality is met, the event waits until the rebound ends, mostly about 0.1 s, so that
// the peak speed and travel are in the evidence. Its time and place are those at which the
// inequality was met. The detector judges by velocity and separation, and not by a distance of
// centimetres: a robot limited by its wheels' traction travels back only 5-26 mm from a nearly
// elastic wall. Definition: ours.
#include <algorithm>
#include <array>
#include <limits>

#include "env/core/blocks.h"
#include "env/failures/detector.h"
#include "env/failures/evidence.h"

namespace floorproof {
namespace {

constexpr double kTimeSlackS = 1e-9;     // sums of time steps are not exact
constexpr double kBackingOffMps = 1e-3;  // a command this fast away from the obstacle retreats
constexpr double kSamePlaceM = 0.1;      // contacts this near with like normals are one contact
constexpr double kSameNormalCos = 0.9;
constexpr double kPressS = 0.05;   // still touching this long after the impact, it presses
constexpr double kChatterS = 0.1;  // a contact lost for less than this has not ended

class BounceBack final : public Detector {
 public:
  void Visit(ParamVisitor& v) override {
    v("closing_mps", closing_mps_, NonNegative(), "v: slower meetings are touches, not impacts");
    v("rebound_mps", rebound_mps_, Positive(), "u: speed away from the obstacle that is a rebound");
    v("rebound_share", rebound_share_, Between(0, 1),
      "least share of the closing speed that is a rebound, where it is more than rebound_mps");
    v("part_m", part_m_, Positive(), "gap to the obstacle after the impact that is a rebound");
    v("window_s", window_s_, Positive(), "how long after the impact a rebound counts");
  }

  FailureMode mode() const override { return FailureMode::kBounceBack; }

  void Start(const EpisodeContext& context) override {
    map_ = &context.map;
    robot_ = &context.robot;
    clear_ = &robot_->clear;
    touches_ = {};
    active_ = 0;
    armed_ = true;
    last_contact_s_ = -std::numeric_limits<double>::infinity();
    margin_ = rebound_mps_;
  }

  bool Update(const Sample& sample) override {
    bool fires = false;
    if (sample.num_contacts > 0 || active_ > 0) fires = Follow(sample);
    if (!armed_ && sample.t_s - last_contact_s_ > window_s_) armed_ = true;
    return fires;
  }

 private:
  struct Touch {
    bool live = false, touching = false, seen = false;
    bool watched = false, met = false, settled = false;
    int hazard = -1;
    std::size_t block = 0;
    Vec2 p_W = Vec2::Zero(), normal_W = Vec2::Zero();
    double since_s = 0, last_seen_s = 0;
    double closing_mps = 0, threshold_mps = 0;
    double away_mps = 0;  // as the contact itself says, when touching
    double touch_m = 0,
           deepest_m = 0;  // distances along the normal: when last touching, at the deepest
    double peak_mps = 0, gap_m = 0, back_m = 0;
    bool by_speed = false;  // which inequality was met first
    double t_s = 0;         // then and there
    Pose2 X_WB;
  };

  // A point of what touches: from the body's origin, its velocity, and the one commanded.
  struct Point {
    Vec2 r_W, v_W, v_cmd_W;
  };

  // The outermost point against the normal: of the block that touches, where blocks swing; else of
  // the clear shape. (A circle's radius does not change, so that its centre will do.)
  Point Outermost(const Touch& touch, const Sample& sample) const {
    const Pose2 X_WB = sample.X_WB();
    const bool swings = sample.hinges.n > 0;
    const BlockMotion& block = now_.block[touch.block];
    const Polygon& outline = swings ? robot_->blocks[touch.block].outline_K : clear_->footprint_B;
    Vec2 r_W = -clear_->radius_m * touch.normal_W;
    double least_m = std::numeric_limits<double>::infinity();
    if (swings || clear_->kind == Shape2::Kind::kFootprint)
      for (const Vec2& p_K : outline) {
        const Vec2 corner_W = X_WB.Rotate(swings ? block.X_BK * p_K : p_K);
        if (corner_W.dot(touch.normal_W) >= least_m) continue;
        least_m = corner_W.dot(touch.normal_W);
        r_W = corner_W;
      }
    const BodyTwist& cmd = sample.command.twist;
    const Vec2 arm_W(-r_W.y(), r_W.x());
    Point point{r_W, sample.v_WB_W.head<2>() + sample.V_WB_B.wz_radps * arm_W,
                X_WB.Rotate({cmd.vx_mps, cmd.vy_mps}) + cmd.wz_radps * arm_W};
    if (swings) {
      const Vec2 r_B = Pose2{0, 0, -X_WB.yaw_rad}.Rotate(r_W);
      point.v_W += X_WB.Rotate(block.VelocityAt(r_B));
      point.v_cmd_W += X_WB.Rotate(commanded_.block[touch.block].VelocityAt(r_B));
    }
    return point;
  }

  bool Follow(const Sample& sample) {
    if (sample.hinges.n > 0) {
      HingeState commanded = sample.hinges;
      commanded.radps = sample.command.hinges.radps;
      now_ = MoveBlocks(robot_->blocks, robot_->hinges, sample.hinges);
      commanded_ = MoveBlocks(robot_->blocks, robot_->hinges, commanded);
    }
    for (Touch& touch : touches_) touch.seen = false;
    for (int i = 0; i < sample.num_contacts; ++i)
      See(sample.contacts[static_cast<std::size_t>(i)], sample.t_s);
    if (sample.num_contacts > 0) last_contact_s_ = sample.t_s;

    bool fires = false;
    active_ = 0;
    for (Touch& touch : touches_) {
      if (!touch.live) continue;
      touch.touching = touch.seen;
      if (touch.watched && Watch(touch, sample) && armed_) {
        Report(touch, sample);
        armed_ = false;
        fires = true;
      }
      touch.live = touch.watched || sample.t_s - touch.last_seen_s <= kChatterS;
      active_ += touch.live ? 1 : 0;
    }
    if (fires)
      for (Touch& touch : touches_) touch.watched = false;
    return fires;
  }

  Touch* Find(const ObstacleContact& contact) {
    for (Touch& touch : touches_)
      if (touch.live && touch.hazard == contact.hazard &&
          (touch.p_W - contact.p_W).squaredNorm() < kSamePlaceM * kSamePlaceM &&
          touch.normal_W.dot(contact.normal_W) > kSameNormalCos)
        return &touch;
    return nullptr;
  }

  // Matches a contact to those of the last step, or begins one.
  void See(const ObstacleContact& contact, double t_s) {
    Touch* touch = Find(contact);
    const bool begins = touch == nullptr;
    if (touch == nullptr) {
      const auto free = std::ranges::find_if(touches_, [](const Touch& t) { return !t.live; });
      if (free == touches_.end()) return;  // as many contacts as a sample can hold are followed
      touch = &*free;
      *touch = {};
      touch->live = true;
      touch->hazard = contact.hazard;
    }
    touch->seen = true;
    touch->last_seen_s = t_s;
    touch->p_W = contact.p_W;
    touch->away_mps = -contact.closing_mps;
    if (!touch->watched) {
      touch->normal_W = contact.normal_W;
      touch->block = static_cast<std::size_t>(contact.block);
    }
    if (!begins || !armed_ || !(contact.closing_mps > closing_mps_)) return;
    touch->watched = true;
    touch->since_s = t_s;
    touch->closing_mps = contact.closing_mps;
    touch->threshold_mps = std::max(rebound_mps_, rebound_share_ * contact.closing_mps);
    touch->deepest_m = std::numeric_limits<double>::infinity();
  }

  // One step after an impact. True when a rebound is over, and with it its evidence complete.
  bool Watch(Touch& touch, const Sample& sample) {
    const Vec2& n = touch.normal_W;
    const Point point = Outermost(touch, sample);
    const bool backing_off = point.v_cmd_W.dot(n) > kBackingOffMps;
    const bool late = sample.t_s - touch.since_s > window_s_ + kTimeSlackS;
    if (backing_off || late) {
      touch.watched = false;
      return touch.met;
    }

    // A robot is thrown back when it moves away as a whole. A body that pitches against the wall
    // moves away either where it touches or at its origin, and not at both.
    const double body_mps = point.v_W.dot(n);
    const double away_mps = touch.touching ? std::min(touch.away_mps, body_mps) : body_mps;
    const double along_m = (sample.p_WB.head<2>() + point.r_W).dot(n);
    if (touch.touching) touch.touch_m = along_m;
    touch.deepest_m = std::min(touch.deepest_m, along_m);
    const bool approaches_again = touch.peak_mps > 0 && away_mps <= 0;
    const bool presses = touch.touching && sample.t_s - touch.since_s > kPressS;
    touch.settled = touch.settled || approaches_again || presses;
    if (!touch.settled) touch.peak_mps = std::max(touch.peak_mps, away_mps);
    touch.gap_m = std::max(touch.gap_m, along_m - touch.touch_m);
    touch.back_m = std::max(touch.back_m, along_m - touch.deepest_m);
    const double share = std::max(touch.peak_mps / touch.threshold_mps, touch.gap_m / part_m_);
    margin_ = std::min(margin_, (1 - share) * rebound_mps_);
    if (!touch.met && share > 1) {
      touch.met = true;
      touch.by_speed = touch.peak_mps > touch.threshold_mps;
      touch.t_s = sample.t_s;
      touch.X_WB = sample.X_WB();
    }
    if (!touch.met || (away_mps > 0 && !sample.command.done)) return false;
    touch.watched = false;
    return true;
  }

  void Report(const Touch& touch, const Sample& sample) {
    event_ = MakeEvent(mode(), touch.by_speed ? "reversed" : "parted", sample,
                       HazardId(*map_, touch.hazard, true),
                       touch.by_speed ? touch.peak_mps : touch.gap_m,
                       touch.by_speed ? touch.threshold_mps : part_m_);
    event_.t_s = touch.t_s;
    event_.x_m = touch.X_WB.x_m;
    event_.y_m = touch.X_WB.y_m;
    event_.yaw_rad = touch.X_WB.yaw_rad;
    event_.evidence = {{"closing_mps", touch.closing_mps},
                       {"rebound_mps", touch.peak_mps},
                       {"travel_back_m", touch.back_m},
                       {"gap_m", touch.gap_m},
                       {"impact_t_s", touch.since_s}};
  }

  double closing_mps_ = 0.05, rebound_mps_ = 0.02, rebound_share_ = 0.2, part_m_ = 0.001,
         window_s_ = 1.0;

  const HazardMap* map_ = nullptr;
  const RobotSpec* robot_ = nullptr;
  const Shape2* clear_ = nullptr;
  BlockMotions now_, commanded_;  // of a robot whose blocks swing
  std::array<Touch, Sample::kMaxContacts> touches_;
  int active_ = 0;
  bool armed_ = true;
  double last_contact_s_ = 0;
};

}  // namespace

FP_DEFINE_PLUGIN(Detector, BounceBack)

}  // namespace floorproof
