// SPDX-License-Identifier: Apache-2.0
#include "run/episode/cell_drive.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "env/core/failure_text.h"
#include "planners/online/robot_cells.h"
#include "run/episode/cell_world.h"
#include "run/episode/make_plan.h"
#include "run/episode/time_limit.h"
#include "run/scenario/floors.h"
#include "run/scenario/scenario.h"

namespace floorproof {
namespace {

constexpr int kLookEvery = 1000;  // moves; who looks on is asked so often
constexpr int kMostBumps = 100;   // targets missed in a row, before the planner is given up

class CellDrive {
 public:
  CellDrive(const Scenario& s, OnlinePlanner& online, Grid<std::uint8_t> blocked, Cell start,
            EpisodeObserver* observer)
      : s_(s),
        online_(online),
        observer_(observer),
        world_(s.world.site.map.frame, std::move(blocked), start, s.spec.online.radius_m),
        known_(s.world.site.map.frame),
        limit_s_(OnlineLimit_s(s.spec.episode)) {
    known_.changed.emplace();
    sample_.yaw_rad = s.world.start.yaw_rad;
    Look();
  }

  EpisodeRecord Run() {
    online_.Start(
        {world_.frame(), estimate_.X_WB, {}, {}, world_.frame().cell_m, PlanSeed(s_.spec)});
    std::optional<Outcome> ended;
    for (Trace(); !ended;) ended = Period();
    return Finish(*ended);
  }

 private:
  // From one target to the next.
  std::optional<Outcome> Period() {
    if (const auto stop = s_.spec.episode.stop_at_coverage; stop && world_.coverage() >= *stop)
      return Outcome::kSuccess;
    if (sample_.t_s >= limit_s_) return Outcome::kTimeout;
    if (observer_ != nullptr && world_.moves() % kLookEvery == 0 &&
        !observer_->OnControl({sample_, sensed_, estimate_, nullptr, world_.coverage(), 0}))
      return Outcome::kInterrupted;
    world_.Sense(known_);
    const OnlineStep next = online_.Next({known_, *known_.changed, estimate_, bumps_ > 0});
    known_.changed->clear();
    if (next.kind == OnlineStep::Kind::kTarget)
      return DriveTo(world_.frame().ToCell(next.target_W));
    record_.message = next.why;
    const bool nowhere = next.kind == OnlineStep::Kind::kNowhere && world_.moves() == 0;
    return nowhere ? Outcome::kNotPlanned : Outcome::kSuccess;
  }

  // Straight, cell by cell, as far as it can.
  std::optional<Outcome> DriveTo(Cell to) {
    const Cell from = world_.here();
    const Cell way = {to.ix - from.ix, to.iy - from.iy};
    const int n = std::max(std::abs(way.ix), std::abs(way.iy));
    for (int i = 1; i <= n; ++i)
      if (!Step(from + OnLine(way, i, n))) break;
    bumps_ = world_.here() == to && n > 0 ? 0 : bumps_ + 1;
    if (bumps_ < kMostBumps) return std::nullopt;
    const Vec2 p_W = world_.frame().Center(to);
    record_.message = fmt::format("{} goes for what it cannot reach, at {}", s_.spec.planner_name,
                                  PlaceText(p_W.x(), p_W.y()));
    return Outcome::kError;
  }

  bool Step(Cell next) {
    const Vec2 was_W = sample_.p_WB.head<2>();
    if (!world_.Step(next)) return false;
    const Vec2 way_W = world_.frame().Center(next) - was_W;
    const double yaw_rad = std::atan2(way_W.y(), way_W.x());
    turns_ += world_.moves() > 1 && std::abs(WrapAngle(yaw_rad - sample_.yaw_rad)) > 0.1;
    sample_.yaw_rad = yaw_rad;
    length_m_ += way_W.norm();
    sample_.t_s = length_m_ / s_.spec.online.speed_mps.value_or(s_.world.robot.spec.cruise_mps);
    Look();
    Trace();
    return true;
  }

  void Look() {
    const Vec2 p_W = world_.frame().Center(world_.here());
    sample_.p_WB = {p_W.x(), p_W.y(), 0};
    estimate_.X_WB = sample_.X_WB();
  }

  // A row a move; of very long drives every second, then every fourth, and so on.
  void Trace() {
    constexpr std::size_t kMostRows = 1'000'000;
    std::vector<TraceRow>& trace = record_.trace;
    if (world_.moves() % trace_every_ != 0) return;
    if (trace.size() == kMostRows) {
      trace_every_ *= 2;
      for (std::size_t i = 0; 2 * i < trace.size(); ++i) trace[i] = trace[2 * i];
      trace.resize(kMostRows / 2);
    }
    TraceRow& row = trace.emplace_back();
    row.t_s = sample_.t_s;
    row.x_m = row.est_x_m = sample_.p_WB.x();
    row.y_m = row.est_y_m = sample_.p_WB.y();
    row.yaw_rad = row.est_yaw_rad = static_cast<float>(sample_.yaw_rad);
    row.coverage = static_cast<float>(world_.coverage());
    row.revisited = static_cast<float>(world_.revisited_share());
  }

  EpisodeRecord Finish(Outcome ended) {
    Metrics& m = record_.metrics;
    m.coverage = world_.coverage();
    m.revisited = world_.revisited_share();
    m.overlap = static_cast<double>(world_.revisited()) / static_cast<double>(world_.visited());
    m.extra_visits = static_cast<double>(world_.moves() + 1 - world_.visited()) /
                     static_cast<double>(world_.reachable_cells());
    m.path_length_m = length_m_;
    m.duration_s = sample_.t_s;
    m.turns = turns_;
    record_.steps = world_.moves() + 1;
    record_.passes_frame = world_.frame();
    record_.passes = Grid<std::uint8_t>(world_.frame().width, world_.frame().height);
    std::ranges::transform(world_.visits().cells, record_.passes.cells.begin(),
                           [](int n) { return static_cast<std::uint8_t>(std::min(n, 255)); });
    record_.sweepable = world_.reachable();
    known_.changed.reset();
    record_.known = std::move(known_);
    record_.figures = online_.figures();
    record_.outcome = ended;
    record_.RequireCoverage(s_.spec.episode.min_coverage);
    if (ended == Outcome::kTimeout) record_.timeout = Timeout{sample_.t_s, sample_.X_WB(), ""};
    return std::move(record_);
  }

  const Scenario& s_;
  OnlinePlanner& online_;
  EpisodeObserver* observer_;
  CellWorld world_;
  KnownMap known_;
  double limit_s_, length_m_ = 0;
  int turns_ = 0, bumps_ = 0;
  std::int64_t trace_every_ = 1;  // moves
  Sample sample_;
  Observation sensed_;
  Estimate estimate_;
  EpisodeRecord record_;
};

}  // namespace

EpisodeRecord DriveCells(const Scenario& s, EpisodeObserver* observer) {
  const GridFrame& frame = s.world.site.map.frame;
  Grid<std::uint8_t> blocked = ObstacleMask(TrueFloor(s.world), s.world.robot.spec.step_m, frame);
  const Cell start = frame.ToCell(s.world.start.p());
  if (blocked(start)) {
    EpisodeRecord record;
    record.outcome = Outcome::kNotPlanned;
    record.message = "the robot starts in a cell that is not free";
    return record;
  }
  const auto planner = MakePlugin(OnlinePlanners(), PlannerOf(s.spec), "plan.planner");
  return CellDrive(s, *planner, std::move(blocked), start, observer).Run();
}

}  // namespace floorproof
