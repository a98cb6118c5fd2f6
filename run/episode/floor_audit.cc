// SPDX-License-Identifier: Apache-2.0
#include "run/episode/floor_audit.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "env/audit/brush.h"
#include "run/episode/episode_stream.h"
#include "run/scenario/floors.h"
#include "run/scenario/scenario.h"
#include "stats/student.h"

namespace floorproof {
namespace {

constexpr double kDirtCell_m = 0.1;  // of the map of true dirt: a tape covers a 25th of it

// Where a robot is that drives this path, turning on the spot at its corners unless the plan says
// how it heads.
std::vector<Pose2> PosesAlong(const Path& path) {
  std::vector<Pose2> poses;
  for (std::size_t i = 0; i < path.size(); ++i) {
    const Vec2& p_W = path[i].p_W;
    const auto add = [&](const Waypoint& to, const Vec2& way) {
      if (way.isZero()) return;
      poses.push_back({p_W.x(), p_W.y(), to.yaw_rad.value_or(std::atan2(way.y(), way.x()))});
    };
    if (i > 0) add(path[i], p_W - path[i - 1].p_W);
    if (i + 1 < path.size()) add(path[i + 1], path[i + 1].p_W - p_W);
  }
  return poses;
}

void Clean(const Scenario& s, const RiskMap& risk, DirtField& field) {
  const PlanResult plan = CleanerPlan(s, risk);
  const std::vector<Pose2> poses = PosesAlong(plan.path);
  Stream random = EpisodeStream(s.spec, "cleaning");
  for (int round = 0; round < s.world.dirt->cleaning.rounds; ++round)
    CleanAlong(field, plan.tool, poses, s.world.dirt->cleaning.brush, random);
}

void MeasureDirt(const DirtField& field, FloorAudit& audit) {
  const GridFrame& bins = field.frame();
  const int k = std::max(1, static_cast<int>(std::lround(kDirtCell_m / bins.cell_m)));
  GridFrame& frame = audit.dirt_frame;
  frame = bins;
  frame.cell_m = k * bins.cell_m;
  frame.width = (bins.width + k - 1) / k;
  frame.height = (bins.height + k - 1) / k;
  audit.dirt_per_m2 = Grid<float>(frame.width, frame.height, std::nanf(""));
  for (int cy = 0; cy < frame.height; ++cy)
    for (int cx = 0; cx < frame.width; ++cx) {
      std::int64_t particles = 0;
      int floor = 0;
      for (int iy = cy * k; iy < std::min((cy + 1) * k, bins.height); ++iy)
        for (int ix = cx * k; ix < std::min((cx + 1) * k, bins.width); ++ix)
          if (field.IsFloor(ix, iy)) ++floor, particles += field.CountIn(ix, iy);
      if (floor > 0)
        audit.dirt_per_m2(cx, cy) = static_cast<float>(static_cast<double>(particles) /
                                                       (floor * bins.cell_m * bins.cell_m));
    }
  if (const double floor_m2 = field.floor_m2(); floor_m2 > 0)
    audit.mean_dirt_per_m2 = static_cast<double>(field.size()) / floor_m2;
}

// `by_chance`: the places may lie anywhere, which an interval needs.
RegionScore ScoreOf(std::span<const Stratum> strata, bool by_chance) {
  RegionScore region{ScoreOfSpace(strata), {}};
  if (const auto& error = region.score.standard_error; error && by_chance) {
    region.interval = StudentInterval(*region.score.mean, *error, region.score.degrees_of_freedom,
                                      kReportedConfidence);
    region.interval->lower = std::max(region.interval->lower, -1.0);  // no score lies beyond
    region.interval->upper = std::min(region.interval->upper, 1.0);
  }
  return region;
}

void Score(const PlanResult& plan, int dirty_above, FloorAudit& audit) {
  const SampledParts parts = plan.sampled_parts.value_or(SampledParts{1, 0, true});
  // Near walls, or given; elsewhere; out of reach.
  Stratum strata[] = {
      {parts.near_walls, {}},
      {parts.elsewhere, {}},
      {std::max(0.0, 1 - parts.near_walls - parts.elsewhere), {}},
  };
  std::vector<int> counts;
  for (const AuditedSample& taken : audit.samples) {
    const SampleKinds& kinds = plan.samples[static_cast<std::size_t>(taken.stop.place)].kinds;
    audit.unreadable += !taken.sample.read();
    if (!taken.sample.read()) continue;
    counts.push_back(taken.sample.counted.count);
    strata[kinds.near_walls() || kinds.given ? 0 : 1].scores.push_back(taken.sample.score.score);
  }
  audit.gathering = Gather(counts, dirty_above);
  audit.region = ScoreOf(strata, parts.by_chance);
  if (!plan.sampled_parts) return;
  audit.near_walls = ScoreOf({strata, 1}, parts.by_chance);
  audit.elsewhere = ScoreOf({strata + 1, 1}, parts.by_chance);
}

}  // namespace

Pose2 TapePose(const RobotSpec& robot, const SampleStop& stop) {
  return stop.X_WB * Pose2{robot.audit_sensor_x_m, 0, 0};
}

double OffPlace(const RobotSpec& robot, const PlanResult& plan, const SampleStop& stop) {
  const SamplePlace& place = plan.samples[static_cast<std::size_t>(stop.place)];
  return (TapePose(robot, stop).p() - place.p_W).norm();
}

PlanResult CleanerPlan(const Scenario& s, const RiskMap& risk) {
  const HazardMap known = KnownFloor(s.world);
  const auto cleaner = MakePlugin(Planners(), s.world.dirt->cleaner, "dirt.cleaning.plan.planner");
  PlanResult plan = cleaner->Plan({known, s.world.robot.spec, s.world.start, s.world.goal,
                                   EpisodeStream(s.spec, "cleaner").Next(), &risk});
  if (plan.status != PlanStatus::kSuccess)
    throw InputError(s.world.dirt->cleaner_mark, "dirt.cleaning.plan.planner",
                     s.world.dirt->cleaner.name,
                     fmt::format("finds no plan ({}): {}", Name(plan.status), plan.message));
  return plan;
}

DirtField DirtyFloor(const Scenario& s, const RiskMap& risk) {
  DirtField field =
      LayDirt(s.world.site.map, s.world.dirt->params.laid, EpisodeStream(s.spec, "dirt").Next());
  if (s.world.dirt->cleaning.rounds > 0) Clean(s, risk, field);
  return field;
}

FloorAudit AuditFloor(const Scenario& s, const PlanResult& plan,
                      const std::vector<SampleStop>& stops, DirtField field) {
  FloorAudit audit;
  MeasureDirt(field, audit);
  Stream lift = EpisodeStream(s.spec, "samples_lift"),
         tapes = EpisodeStream(s.spec, "samples_tapes");
  for (const SampleStop& stop : stops) {
    const Pose2 X_WT = TapePose(s.world.robot.spec, stop);
    audit.samples.push_back(
        {stop, X_WT, TakeSample(field, X_WT, s.world.dirt->params.sampling, lift, tapes.Next())});
  }
  Score(plan, s.world.dirt->params.dirty_above, audit);
  return audit;
}

}  // namespace floorproof
