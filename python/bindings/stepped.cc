// SPDX-License-Identifier: Apache-2.0
// An episode that is commanded from Python, a control period at a time.

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "controllers/twist_tracker.h"
#include "python/bindings/arrays.h"
#include "python/bindings/describe.h"
#include "python/bindings/host.h"
#include "python/bindings/modules.h"
#include "report/progress.h"
#include "run/episode/free_navigator.h"
#include "run/episode/make_plan.h"
#include "run/episode/records.h"
#include "run/episode/robot_side.h"
#include "run/scenario/floors.h"

namespace floorproof {
namespace {

using namespace nb::literals;

// Asks for whatever twist it was given.
class Commanded final : public TwistTracker {
 public:
  void Command(const BodyTwist& twist) { twist_ = twist; }

 private:
  BodyTwist Twist(const Situation&) override { return twist_; }
  BodyTwist twist_;
};

// What the robot knows around it, seen from its own pose: cells[channel][row][column], its x to the
// right, its y up, the robot in the middle. Channels: obstacles (255; 127: not known), floor that
// was swept, floor that is to be swept (255).
class LocalMap {
 public:
  LocalMap(const Scenario& s, int cells, double cell_m)
      : cells_(cells),
        cell_m_(cell_m),
        fine_(FineFrame(s.site.map.frame)),
        obstacles_(ObstacleMask(KnownFloor(s), s.robot.spec.step_m, fine_)),
        values_(3 * static_cast<std::size_t>(cells) * static_cast<std::size_t>(cells)) {}

  void Look(const Pose2& X_WB, const SteppedEpisode& episode) {
    const SweepArea& area = episode.area();
    const Grid<std::uint8_t>& passes = episode.swept().passes();
    const KnownMap* drawn = episode.robot().known();
    const std::size_t plane = values_.size() / 3;
    std::size_t at = 0;
    for (int row = cells_ - 1; row >= 0; --row)
      for (int column = 0; column < cells_; ++column, ++at) {
        const Vec2 p_W =
            X_WB * (cell_m_ * Vec2(column + 0.5 - cells_ / 2.0, row + 0.5 - cells_ / 2.0));
        values_[at] = drawn != nullptr ? Drawn(*drawn, p_W) : Given(p_W);
        const Cell cell = area.frame.ToCell(p_W);
        const bool inside = passes.Inside(cell);
        values_[plane + at] = inside && passes(cell) > 0 ? 255 : 0;
        values_[2 * plane + at] = inside && area.sweepable(cell) && passes(cell) == 0 ? 255 : 0;
      }
  }

  std::vector<std::uint8_t>& values() { return values_; }
  int cells() const { return cells_; }

 private:
  std::uint8_t Given(const Vec2& p_W) const {
    const Cell cell = fine_.ToCell(p_W);
    return !fine_.Inside(cell) || obstacles_(cell) ? 255 : 0;
  }
  static std::uint8_t Drawn(const KnownMap& map, const Vec2& p_W) {
    const Cell cell = map.frame.ToCell(p_W);
    if (!map.frame.Inside(cell)) return 255;
    const CellState state = map.At(cell);
    return state == CellState::kOccupied ? 255 : state == CellState::kUnknown ? 127 : 0;
  }

  int cells_;
  double cell_m_;
  GridFrame fine_;
  Grid<std::uint8_t> obstacles_;
  std::vector<std::uint8_t> values_;
};

class Stepped {
 public:
  // `follows`: the scenario's plan is what it is judged by; else it goes where it likes. `record`:
  // states are kept for pictures.
  Stepped(std::shared_ptr<Scenario> scenario, bool follows, int local_cells, double local_cell_m,
          bool record)
      : scenario_(std::move(scenario)), local_(*scenario_, local_cells, local_cell_m) {
    WithoutGil([&] {
      Begin(follows, record);
      return 0;
    });
  }

  // One control period; the outcome where it ended the episode. Not after that.
  std::optional<std::string> Step(double vx_mps, double vy_mps, double wz_radps) {
    if (!episode_ || ended_) throw InputError("the episode has ended: reset() begins another");
    tracker_->Command({vx_mps, vy_mps, wz_radps});
    WithoutGil([&] {
      ended_ = episode_->Advance();
      Look();
      return 0;
    });
    if (!ended_) return std::nullopt;
    return std::string(Name(*ended_));
  }

  // Ends it, where it has not ended; once. Until then pictures and figures are of a drive that goes
  // on.
  std::shared_ptr<Driven> Finish(bool timeout) {
    if (!episode_) throw InputError("the episode is finished: reset() begins another");
    const Outcome outcome = ended_.value_or(timeout ? Outcome::kTimeout : Outcome::kInterrupted);
    auto driven = std::make_shared<Driven>();
    driven->scenario = scenario_;
    driven->record = WithoutGil([&] { return episode_->Finish(outcome); });
    episode_.reset();
    recorder_.reset();
    driven->plan = std::move(*plan_);
    driven->scene = std::move(*scene_);
    driven->recording = std::move(recording_);
    return driven;
  }

  EpisodeView Now() const {
    if (!episode_) throw InputError("the episode is finished: reset() begins another");
    return episode_->view();
  }
  std::string Events() const {
    if (!episode_) throw InputError("the episode is finished: reset() begins another");
    return EventsJson(episode_->events()).dump();
  }
  nb::object local_map() {
    const auto n = static_cast<std::size_t>(local_.cells());
    return nb::cast(nb::ndarray<nb::numpy, const std::uint8_t>(local_.values().data(), {3, n, n},
                                                               nb::find(this)));
  }
  nb::object lidar() {
    return nb::cast(
        nb::ndarray<nb::numpy, const float>(lidar_.data(), {lidar_.size()}, nb::find(this)));
  }
  const Scenario& scenario() const { return *scenario_; }

 private:
  void Begin(bool follows, bool record) {
    Scenario& s = *scenario_;
    auto tracker = std::make_unique<Commanded>();
    tracker_ = tracker.get();
    s.tracker = std::move(tracker);
    plan_ = std::make_unique<PlanResult>();
    std::unique_ptr<Navigator> navigator;
    if (follows) {
      WarnOfProgram(s);
      *plan_ = MakePlan(s);
      if (plan_->status != PlanStatus::kSuccess)
        throw InputError({s.file.string(), 0}, "plan", s.planner_name,
                         "gives no plan to follow: " + plan_->message);
    } else {
      s.online.reset();
      Waypoint start;
      start.p_W = s.start.p();
      plan_->path = {start};
      plan_->status = PlanStatus::kSuccess;
      plan_->clear = s.robot.spec.clear;
      plan_->tool = s.robot.spec.tool;
      plan_->tool_width_m = s.robot.spec.tool_width_m;
      plan_->risk =
          std::make_shared<const RiskMap>(ComputeRisk(KnownFloor(s), s.robot.spec, s.fmea, s.risk));
      navigator = std::make_unique<FreeNavigator>(s.start);
    }
    scene_ = std::make_unique<Scene>(BuildScene(s.site.map, s.robot, s.physics, s.start));
    if (record) {
      recording_.emplace(static_cast<int>(scene_->model->nq));
      recorder_.emplace(Console{.quiet = true}, s.robot.spec, s.episode.control_hz, &*recording_);
    }
    episode_ = std::make_unique<SteppedEpisode>(s, *scene_, *plan_, std::move(navigator));
    Look();
  }

  void Look() {
    const EpisodeView now = episode_->view();
    const LidarScan& scan = now.sensed.scan;
    lidar_.resize(scan.range_m.size());  // the same after the first time
    for (std::size_t i = 0; i < lidar_.size(); ++i)
      lidar_[i] = static_cast<float>(std::min(scan.range_m[i], scan.most_m));
    local_.Look(now.estimate.X_WB, *episode_);
    if (recorder_) recorder_->OnControl(now);
  }

  std::shared_ptr<Scenario> scenario_;
  LocalMap local_;
  Commanded* tracker_ = nullptr;
  std::unique_ptr<PlanResult> plan_;
  std::unique_ptr<Scene> scene_;
  std::optional<Recording> recording_;
  std::optional<ProgressObserver> recorder_;
  std::unique_ptr<SteppedEpisode> episode_;
  std::optional<Outcome> ended_;
  std::vector<float> lidar_;
};

}  // namespace

void BindStepped(nb::module_& m) {
  nb::class_<Stepped>(m, "Stepped")
      .def(nb::init<std::shared_ptr<Scenario>, bool, int, double, bool>(), "scenario"_a,
           "follows"_a, "local_cells"_a, "local_cell_m"_a, "record"_a)
      .def("step", &Stepped::Step, "vx_mps"_a, "vy_mps"_a, "wz_radps"_a)
      .def("finish", &Stepped::Finish, "timeout"_a)
      .def_prop_ro("local_map", &Stepped::local_map)
      .def_prop_ro("lidar", &Stepped::lidar)
      .def_prop_ro("events", &Stepped::Events)
      .def_prop_ro("t_s", [](const Stepped& s) { return s.Now().sample.t_s; })
      .def_prop_ro("coverage", [](const Stepped& s) { return s.Now().coverage; })
      .def_prop_ro("plan_fraction", [](const Stepped& s) { return s.Now().plan_fraction; })
      .def_prop_ro("estimate", [](const Stepped& s) { return PoseTuple(s.Now().estimate.X_WB); })
      .def_prop_ro("pose", [](const Stepped& s) { return PoseTuple(s.Now().sample.X_WB()); })
      .def_prop_ro("twist", [](const Stepped& s) {
        const BodyTwist& V = s.Now().estimate.V_WB_B;
        return nb::make_tuple(V.vx_mps, V.vy_mps, V.wz_radps);
      });
}

}  // namespace floorproof
