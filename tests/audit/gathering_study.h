// SPDX-License-Identifier: Apache-2.0
// One room of the study of the dirt gathering efficiency ("audit-sampling", section 6.1, Eq. 4):
// its dirt, five rounds of a cleaning robot, and tapes at two choices of places.
#pragma once

#include <algorithm>
#include <cmath>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "base/streams.h"
#include "env/audit/audit_sample.h"
#include "env/audit/brush.h"
#include "env/audit/dirt_field.h"
#include "env/audit/gathering.h"
#include "env/core/coverage.h"
#include "env/geometry/distance.h"
#include "planners/audit/find_samples.h"
#include "run/episode/execute.h"
#include "run/scenario/scenario_file.h"
#include "tests/audit/study_rooms.h"

namespace floorproof::testing {

inline constexpr int kStudyRounds = 5;

// How the places are chosen, the same in every room. The distances take the one or two rows of
// cells nearest to a wall that BELUGA's nose gets to (7 and 12 cm from it): "closer to the walls".
// The interval then gives nearly as many places as the paper has, 51 and 59.
inline SampleParams StudySamples(double boundary_m = 0.2) {
  SampleParams params;
  params.du_m = 0.3;
  params.boundary_m = boundary_m;
  params.corner_m = boundary_m;
  params.random_share = 0.02;
  return params;
}

struct StudyPlaces {
  std::vector<Vec2> geometric, uniform;  // p_W, as many of each
};

class StudyFloor {
 public:
  StudyFloor(Trial trial, std::uint64_t seed, const std::string& cleaner = kStudyCleaner)
      : seed_(seed),
        scenario_(
            ScenarioFile::FromText(StudyScenario(DrawStudyRoom(trial, seed), cleaner), "study.yaml")
                .Read()),
        plan_(MakePlan(scenario_)),
        area_(ComputeSweepArea(map(), robot().clear, robot().tool, robot().step_m,
                               scenario_.world.start.p())),
        away_(DistanceToCentres(area_.reachable)) {}

  const HazardMap& map() const { return scenario_.world.site.map; }
  const RobotSpec& robot() const { return scenario_.world.robot.spec; }
  const PlanResult& plan() const { return plan_; }
  const SweepArea& area() const { return area_; }

  // The sweep: the plan itself.
  std::vector<Pose2> Sweep() const {
    std::vector<Pose2> poses;
    for (const Waypoint& w : plan_.path) poses.push_back({w.p_W.x(), w.p_W.y(), 0});
    return poses;
  }
  // Where the robot was as it drove the plan through physics, a pose a centimetre.
  std::vector<Pose2> Drive(EpisodeRecord& record) {
    std::optional<Scene> scene;
    record = ExecutePlan(scenario_, plan_, scene);
    std::vector<Pose2> poses;
    for (const TraceRow& row : record.trace)
      if (poses.empty() || (Vec2(row.x_m, row.y_m) - poses.back().p()).norm() >= 0.01)
        poses.push_back({row.x_m, row.y_m, static_cast<double>(row.yaw_rad)});
    return poses;
  }

  // Each round begins where the first did: the robot is carried back. `luck` names the brush's.
  DirtField Cleaned(std::span<const Pose2> poses, const CleaningParams& cleaning = {},
                    std::string_view luck = "study_cleaning") const {
    DirtField field = LayDirt(map(), {}, seed_);
    Stream random(seed_, 0, luck);
    for (int round = 0; round < kStudyRounds; ++round)
      CleanAlong(field, plan_.tool, poses, cleaning, random);
    return field;
  }

  // Whether BELUGA can put its nose there, where its sensor is: some place of its middle that is
  // clear of walls, and connected with the start, lies so far from it.
  bool WithinReach(const Vec2& p_W) const {
    constexpr double kNose_m = 0.135;
    constexpr int kBearings = 72;
    if (!IsFree(p_W)) return false;
    for (int i = 0; i < kBearings; ++i) {
      const double bearing = 2 * kPi * i / kBearings;
      const Vec2 middle = p_W + kNose_m * Vec2(std::cos(bearing), std::sin(bearing));
      const Cell c = area_.frame.ToCell(middle);
      constexpr float kNear = 2;  // cells: to one of those whose own middle is clear
      if (area_.frame.Inside(c) && away_(c) <= kNear && ToWall(middle) >= robot().clear.radius_m)
        return true;
    }
    return false;
  }
  // From the nearest wall's or furniture's face.
  double ToWall(const Vec2& p_W) const {
    const GridFrame& frame = map().frame;
    const Cell c = frame.ToCell(p_W);
    const auto around = static_cast<int>(std::ceil(0.75 / frame.cell_m));
    double nearest_m = around * frame.cell_m;
    for (int iy = c.iy - around; iy <= c.iy + around; ++iy)
      for (int ix = c.ix - around; ix <= c.ix + around; ++ix)
        if (map().IsWall(ix, iy)) {
          const Vec2 d = (p_W - frame.Center(ix, iy)).cwiseAbs();
          const double half_m = frame.cell_m / 2;
          nearest_m = std::min(
              nearest_m, std::hypot(std::max(0.0, d.x() - half_m), std::max(0.0, d.y() - half_m)));
        }
    return nearest_m;
  }

  StudyPlaces Places(const SampleParams& params = StudySamples()) const {
    const std::vector<Vec2> geometric = Geometric(params);
    return {geometric, Lattice(geometric.size())};
  }
  // Those of the planner `audit`, as far as they are within reach.
  std::vector<Vec2> Geometric(const SampleParams& params) const {
    const Room room = MakeRoom(map(), area_, robot().circumscribed_radius_m);
    Grid<float> within(room.inside.width, room.inside.height);
    for (int iy = 0; iy < within.height; ++iy)
      for (int ix = 0; ix < within.width; ++ix)
        if (room.inside(ix, iy) && WithinReach(room.frame.Center(ix, iy))) within(ix, iy) = 1;
    std::vector<Vec2> places;
    for (const SamplePlace& place :
         FindSamples(room, within, 2 * robot().inscribed_radius_m, params, seed_).places)
      if (WithinReach(place.p_W)) places.push_back(place.p_W);
    return places;
  }

 private:
  bool IsFree(const Vec2& p_W) const { return !map().IsWall(map().frame.ToCell(p_W)); }

  // So many places within reach, on a square lattice whose cells share the floor within reach among
  // them, to within 3 per cent. It lies as chance has it: the first that has just so many. (The
  // widest lattice that has so many would have a row just within reach more often than not.) A bare
  // room may have none: then the one with the fewest too many, which are left out evenly.
  std::vector<Vec2> Lattice(std::size_t wanted) const {
    constexpr double kFine_m = 0.025;
    constexpr int kTries = 2000;
    const double width_m = map().frame.width * map().frame.cell_m;
    const auto within = [&](double first_x, double first_y, double step_m) {
      std::vector<Vec2> places;
      for (double y = first_y; y < width_m; y += step_m)
        for (double x = first_x; x < width_m; x += step_m)
          if (WithinReach({x, y})) places.push_back({x, y});
      return places;
    };
    const double area_m2 =
        static_cast<double>(within(kFine_m / 2, kFine_m / 2, kFine_m).size()) * kFine_m * kFine_m;
    const double even_m = std::sqrt(area_m2 / static_cast<double>(wanted));
    Stream random(seed_, 0, "study_lattice");
    std::vector<Vec2> best;
    for (int i = 0; i < 2 * kTries && best.size() != wanted; ++i) {
      const double spread = i < kTries ? 0.03 : 0.1;
      const double step_m = even_m * random.Uniform(1 - spread, 1 + spread);
      const double x = random.Uniform(0, step_m), y = random.Uniform(0, step_m);
      const std::vector<Vec2> places = within(x, y, step_m);
      if (places.size() >= wanted && (best.empty() || places.size() < best.size())) best = places;
    }
    std::vector<Vec2> places;
    for (std::size_t i = 0; i < wanted && !best.empty(); ++i)
      places.push_back(best[i * best.size() / wanted]);
    return places;
  }

  std::uint64_t seed_;
  Scenario scenario_;
  PlanResult plan_;
  SweepArea area_;
  Grid<float> away_;
};

// What the microscope counts on a tape at each place.
inline std::vector<int> SampleAt(DirtField field, std::span<const Vec2> places,
                                 std::uint64_t seed) {
  Stream lift(seed, 0, "study_lift"), tape(seed, 0, "study_tape");
  std::vector<int> counts;
  for (const Vec2& p_W : places)
    counts.push_back(TakeSample(field, {p_W.x(), p_W.y(), 0}, {}, lift, tape.Next()).counted.count);
  return counts;
}

}  // namespace floorproof::testing
