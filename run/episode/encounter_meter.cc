// SPDX-License-Identifier: Apache-2.0
#include "run/episode/encounter_meter.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "env/core/wall_gap.h"

namespace floorproof {
namespace {

constexpr double kMoved_m = 0.005, kTurned_rad = 0.02;  // less is not looked at
// A failure is established later than it began: `stuck` takes ten seconds.
constexpr double kLater_s = 15;
constexpr std::size_t kAtWall = 0, kOnFloor = 1;

}  // namespace

EncounterMeter::EncounterMeter(const HazardMap& map, const RobotSpec& robot, bool holds_yaw,
                               const HazardSight* sight)
    : map_(map),
      robot_(robot),
      holds_yaw_(holds_yaw),
      sight_(sight),
      parts_(map, IsOfTheSite),
      watch_(parts_, map.hazards.size(), robot) {
  constexpr std::size_t kLive = 32;
  live_.reserve(kLive);
}

void EncounterMeter::OnControl(const Sample& sample, const Estimate& estimate, const Path* path) {
  const Pose2 X_WB = sample.X_WB();
  const double way_m = has_last_ ? (X_WB.p() - last_.p()).norm() : 0;
  const bool moved = !has_last_ || way_m >= kMoved_m ||
                     std::abs(WrapAngle(X_WB.yaw_rad - last_.yaw_rad)) >= kTurned_rad;
  if (!moved) return;
  way_m_ += way_m;
  estimate_error_m_ = (estimate.X_WB.p() - X_WB.p()).norm();
  estimate_error_rad_ = std::abs(WrapAngle(estimate.X_WB.yaw_rad - X_WB.yaw_rad));
  const Vec2 travel_W = way_m >= kMoved_m ? Vec2((X_WB.p() - last_.p()) / way_m) : Vec2(0, 0);
  if (!parts_.empty()) {
    watch_.Update(X_WB, travel_W, way_m_, sample.shape);
    if (!watched_) Follow(sample, path);
  }
  if (!watched_) AddExposure(sample, way_m, has_last_ ? sample.t_s - last_s_ : 0);
  last_ = X_WB;
  last_s_ = sample.t_s;
  speed_mps_ = sample.v_WB_W.head<2>().norm();
  has_last_ = true;
}

void EncounterMeter::Follow(const Sample& sample, const Path* path) {
  for (const Meeting& meeting : watch_.ended()) End(meeting);
  for (const Meeting& meeting : watch_.open()) {
    const auto at = std::ranges::find(live_, meeting.id, &Live::meeting);
    const bool begins = at == live_.end();
    Live& live = begins ? Begin(meeting, sample, path) : *at;
    Encounter& row = rows_[live.row];
    const bool enters = begins || live.from_m != meeting.from_m;
    if (enters && !begins) {
      live.from_m = meeting.from_m;
      TakeEntry(meeting, sample, row);
    }
    TakeSensed(sample, enters, live);
    row.at.heading_rad = meeting.heading_rad;
    row.at.lead_rad = meeting.lead_rad;
    if (meeting.inside) row.time_s = sample.t_s - row.t_s;
    row.way_m = live.before_m + meeting.to_m - meeting.from_m;
    if (live.planned) continue;
    row.passage = meeting.over ? Passage::kOver : Passage::kBeside;
    row.at.gap_m = meeting.gap_m;
    row.at.width_share = meeting.width_share;
    row.at.turn_rad = meeting.turn_rad;
    row.at.turn_gap_m = meeting.turn_gap_m;
    row.at.over_m = row.way_m;
  }
}

// As it enters; and anew when it is upon it, up to which it could have stopped as well.
void EncounterMeter::TakeSensed(const Sample& sample, bool enters, Live& live) {
  if (live.seen_as < 0) return;
  const bool comes_upon = !live.upon && sight_->IsUpon(live.seen_as, sample);
  live.upon = live.upon || comes_upon;
  if (comes_upon || (enters && !live.upon))
    rows_[live.row].sensed =
        sight_->InTime(live.seen_as) ? Encounter::Sensed::kInTime : Encounter::Sensed::kNotInTime;
}

EncounterMeter::Live& EncounterMeter::Begin(const Meeting& meeting, const Sample& sample,
                                            const Path* path) {
  const Hazard& hazard = map_.hazards[static_cast<std::size_t>(meeting.hazard)];
  Encounter row;
  row.hazard = hazard.id;
  row.type = hazard.type;
  TakeEntry(meeting, sample, row);
  Live live{meeting.id, rows_.size(), meeting.from_m};
  // Who meets it again has had it under its sensors.
  if (sight_ != nullptr && std::ranges::find(rows_, hazard.id, &Encounter::hazard) == rows_.end())
    live.seen_as = sight_->IndexOf(hazard.id);
  if (path != nullptr && !path->empty())
    if (const auto planned = NextPassage(parts_, map_, robot_, sample.X_WB(), *path,
                                         sample.command.segment, holds_yaw_, meeting.hazard)) {
      live.planned = true;
      TakePlanned(*planned, row);
    }
  rows_.push_back(std::move(row));
  live_.push_back(live);
  return live_.back();
}

void EncounterMeter::TakeEntry(const Meeting& meeting, const Sample& sample, Encounter& row) const {
  const Hazard& hazard = map_.hazards[static_cast<std::size_t>(meeting.hazard)];
  const Vec2 v_W = sample.v_WB_W.head<2>();
  const double speed_mps = v_W.norm();
  const Vec2 heading(std::cos(sample.yaw_rad), std::sin(sample.yaw_rad));
  row.size = SizeAsMet(hazard, speed_mps > 0 ? Vec2(v_W / speed_mps) : heading);
  row.t_s = sample.t_s;
  row.x_m = sample.p_WB.x();
  row.y_m = sample.p_WB.y();
  row.at.speed_mps = speed_mps;
  row.at.wall_m = WallGap(map_, robot_.clear, sample.X_WB(), kFarWall_m);
  row.at.friction = map_.floor_friction;
  row.at.mass_kg = robot_.mass_kg;
  row.at.clearance_m = robot_.clearance_m;
  row.at.estimate_error_m = estimate_error_m_;
  row.at.estimate_error_rad = estimate_error_rad_;
}

void EncounterMeter::TakePlanned(const PlannedPassage& planned, Encounter& row) const {
  row.passage = planned.passage;
  row.at.gap_m = planned.at.gap_m;
  row.at.width_share = planned.at.width_share;
  row.at.turn_rad = planned.at.turn_rad;
  row.at.turn_gap_m = planned.at.turn_gap_m;
  row.at.over_m = planned.at.over_m;
}

void EncounterMeter::End(const Meeting& meeting) {
  const auto at = std::ranges::find(live_, meeting.id, &Live::meeting);
  if (at == live_.end() || GoesOn(meeting, *at)) return;
  Encounter& row = rows_[at->row];
  if (row.outcome == Encounter::Outcome::kCensored) row.outcome = Encounter::Outcome::kCleared;
  live_.erase(at);
}

// A robot that falls back from what its plan leads over and tries again is still in the same
// encounter.
bool EncounterMeter::GoesOn(const Meeting& meeting, Live& live) {
  constexpr double kDone = 0.5;  // of the way over it that was planned
  const Encounter& row = rows_[live.row];
  const auto again = std::ranges::find(watch_.open(), meeting.hazard, &Meeting::hazard);
  if (again == watch_.open().end() || !live.planned || row.passage != Passage::kOver ||
      row.way_m >= kDone * row.at.over_m)
    return false;
  live.meeting = again->id;
  live.from_m = again->from_m;
  live.before_m = row.way_m;
  return true;
}

Encounter* EncounterMeter::Blamed(const Event& event) {
  const auto is_open = [&](std::size_t row) {
    return std::ranges::find(live_, row, &Live::row) != live_.end();
  };
  for (std::size_t i = rows_.size(); i-- > 0;)
    if (rows_[i].hazard == event.hazard &&
        (is_open(i) || rows_[i].t_s + rows_[i].time_s >= event.t_s - kLater_s))
      return &rows_[i];
  // What it is in, entered last; at a wall, too: way within a hazard is no way beside the wall.
  for (const Meeting& meeting : watch_.open())
    if (meeting.inside) {
      const auto live = std::ranges::find(live_, meeting.id, &Live::meeting);
      if (live != live_.end()) return &rows_[live->row];
    }
  return nullptr;
}

void EncounterMeter::OnEvent(const Event& event) {
  if (Encounter* row = Blamed(event)) {
    if (row->outcome == Encounter::Outcome::kFailed) return;  // the first is what it is counted by
    row->outcome = Encounter::Outcome::kFailed;
    row->mode = event.mode;
    if (!failed_) failed_ = {false, static_cast<std::size_t>(row - rows_.data())};
    return;
  }
  const bool wall = event.hazard == "wall" || at_wall_;
  CloseExposure(wall ? kWallBeside : kFreeFloor, Encounter::Outcome::kFailed, event.mode);
  if (!failed_) failed_ = {true, exposures_.size() - 1};
}

Encounter* EncounterMeter::Failed() {
  if (!failed_) return nullptr;
  return &(failed_->is_exposure ? exposures_ : rows_)[failed_->row];
}

void EncounterMeter::OnBlow(double energy_j) {
  const auto take = [energy_j](Encounter& row) { row.energy_j = std::max(row.energy_j, energy_j); };
  if (Encounter* failed = Failed(); failed != nullptr && watched_) return take(*failed);
  for (const Live& live : live_) take(rows_[live.row]);
}

bool EncounterMeter::HasLeftFailure() const {
  if (!failed_ || failed_->is_exposure) return true;
  return std::ranges::none_of(watch_.open(), [&](const Meeting& meeting) {
    return meeting.inside &&
           map_.hazards[static_cast<std::size_t>(meeting.hazard)].id == rows_[failed_->row].hazard;
  });
}

void EncounterMeter::TakeAfter(Encounter::After after) {
  if (Encounter* failed = Failed()) failed->after = after;
}

void EncounterMeter::Lift() {
  watch_.Lift();
  live_.clear();  // censored, if nothing failed there
  has_last_ = false;
}

void EncounterMeter::AddExposure(const Sample& sample, double way_m, double time_s) {
  const double gap_m = WallGap(map_, robot_.clear, sample.X_WB(), kReach_m);
  at_wall_ = gap_m < kReach_m;
  const bool in_hazard = std::ranges::any_of(watch_.open(), &Meeting::inside);
  if (in_hazard || way_m == 0) return;
  Exposure& exposure = exposed_[at_wall_ ? kAtWall : kOnFloor];
  if (exposure.way_m == 0) exposure.t_s = sample.t_s, exposure.p_W = sample.p_WB.head<2>();
  exposure.way_m += way_m;
  exposure.time_s += time_s;
  exposure.wall_m2 += way_m * gap_m;
  exposure.error_m2 += way_m * estimate_error_m_;
  exposure.error_rad_m += way_m * estimate_error_rad_;
}

void EncounterMeter::CloseExposure(std::string_view type, Encounter::Outcome outcome,
                                   FailureMode mode) {
  Exposure& exposure = exposed_[type == kWallBeside ? kAtWall : kOnFloor];
  const bool failed = outcome == Encounter::Outcome::kFailed;
  if (exposure.way_m == 0 && !failed) return;
  Encounter row;
  row.type = type;
  row.passage = Passage::kBeside;
  row.t_s = exposure.t_s;
  row.x_m = exposure.p_W.x();
  row.y_m = exposure.p_W.y();
  row.time_s = exposure.time_s;
  row.way_m = exposure.way_m;
  row.at.speed_mps = exposure.time_s > 0 ? exposure.way_m / exposure.time_s : speed_mps_;
  const auto mean = [&](double sum, double without) {
    return exposure.way_m > 0 ? sum / exposure.way_m : without;
  };
  row.at.wall_m = type == kFreeFloor ? kFarWall_m : mean(exposure.wall_m2, 0);
  row.at.estimate_error_m = mean(exposure.error_m2, estimate_error_m_);
  row.at.estimate_error_rad = mean(exposure.error_rad_m, estimate_error_rad_);
  row.at.over_m = exposure.way_m;
  row.at.friction = map_.floor_friction;
  row.at.mass_kg = robot_.mass_kg;
  row.at.clearance_m = robot_.clearance_m;
  row.outcome = outcome;
  row.mode = mode;
  exposures_.push_back(std::move(row));
  exposure = {};
}

std::vector<Encounter> EncounterMeter::Finish() {
  for (const std::string_view type : {kWallBeside, kFreeFloor})
    CloseExposure(type, Encounter::Outcome::kCleared, {});
  for (Encounter& row : exposures_) rows_.push_back(std::move(row));
  exposures_.clear();
  return std::move(rows_);
}

}  // namespace floorproof
