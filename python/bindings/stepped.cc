// SPDX-License-Identifier: Apache-2.0
// An episode that is commanded from Python, a control period at a time.

#include <nlohmann/json.hpp>

#include "controllers/twist_tracker.h"
#include "python/bindings/arrays.h"
#include "python/bindings/describe.h"
#include "python/bindings/drawing.h"
#include "python/bindings/host.h"
#include "python/bindings/modules.h"
#include "python/bindings/observed.h"
#include "report/drive_video.h"
#include "report/progress.h"
#include "run/episode/free_navigator.h"
#include "run/episode/make_plan.h"
#include "run/episode/records.h"
#include "run/episode/robot_side.h"
#include "run/scenario/agents.h"
#include "run/scenario/floors.h"
#include "run/scenario/scenario.h"

namespace floorproof {
namespace {

using namespace nb::literals;

// Asks for whatever twist it was given.
class Commanded final : public TwistTracker {
 public:
  explicit Commanded(bool free) : TwistTracker(free) {}
  void Command(const BodyTwist& twist) { twist_ = twist; }
  // Where a tracker would head for; none before the first period.
  const std::optional<Vec2>& target_W() const { return target_W_; }

 private:
  BodyTwist Twist(const Situation& now) override {
    target_W_ = now.target_W;
    return twist_;
  }
  BodyTwist twist_;
  std::optional<Vec2> target_W_;
};

// The plan where nothing is planned: it stands.
PlanResult NoPlan(const Scenario& s) {
  PlanResult plan;
  Waypoint start;
  start.p_W = s.world.start.p();
  plan.path = {start};
  plan.status = PlanStatus::kSuccess;
  plan.clear = s.world.robot.spec.clear;
  plan.tool = s.world.robot.spec.tool;
  plan.tool_width_m = s.world.robot.spec.tool_width_m;
  plan.risk = std::make_shared<const RiskMap>(
      ComputeRisk(KnownFloor(s.world), s.world.robot.spec, s.spec.fmea, s.spec.risk));
  return plan;
}

class Stepped {
 public:
  // `planned`: the plan to follow, by which it is judged; nullptr: it goes where it likes.
  // `record`: states are kept for pictures. `spaces`: in which it is told; nullptr: its own.
  Stepped(std::shared_ptr<Scenario> scenario, const std::shared_ptr<Planned>& planned,
          int local_cells, double local_cell_m, int plan_points, double plan_step_m, bool record,
          const SpaceBounds* spaces)
      : driven_(std::make_shared<Driven>()) {
    driven_->scenario = std::move(scenario);
    WithoutGil([&] {
      Begin(planned ? &planned->plan : nullptr,
            {local_cells, local_cell_m, plan_points, plan_step_m}, record, spaces);
      return 0;
    });
  }

  ~Stepped() {
    if (!picture_) return;
    if (!Py_IsInitialized()) {  // at its end, whoever draws may never let another
      static_cast<void>(picture_.release());
      return;
    }
    const NoGil released;  // who draws may ask for it
    const std::lock_guard alone(Drawing());
    picture_.reset();
  }

  // So many control periods; the outcome where one of them ended the episode. Not after that.
  std::optional<std::string> Step(double vx_mps, double vy_mps, double wz_radps, int periods) {
    const Busy busy(*this);
    if (!episode_ || ended_) throw InputError("the episode has ended: reset() begins another");
    tracker_->Command({vx_mps, vy_mps, wz_radps});
    WithoutGil([&] {
      for (int i = 0; i < periods && !ended_; ++i) {
        ended_ = episode_->Advance();
        if (ended_) driven_->record = episode_->Finish(*ended_);
        Note();
      }
      told_->Look(*episode_, tracker_->target_W());
      return 0;
    });
    if (!ended_) return std::nullopt;
    Close();
    return std::string(Name(*ended_));
  }

  // Once it has ended: its record, and all that pictures of it need.
  std::shared_ptr<Driven> finished() const {
    const Busy busy(*this);
    if (!ended_) throw InputError("the episode has not ended");
    return driven_;
  }

  // As it stands now, or stood when it was finished.
  nb::ndarray<nb::numpy, std::uint8_t> Render(int width, int height, const std::string& camera,
                                              bool draft) {
    const Busy busy(*this);
    if (!driven_->recording) throw InputError("nothing is recorded that could be drawn");
    return ImageArray(DrawAlone([&] {
      if (recorder_) recorder_->Keep(episode_->view());
      if (!picture_)
        picture_ = std::make_unique<LivePicture>(
            *driven_->scenario, *driven_->scene, driven_->plan, *driven_->recording,
            static_cast<int>(told_->lidar.size()), width, height, camera,
            draft ? RenderQuality::kDraft : RenderQuality::kGood);
      return picture_->Draw(episode_ ? std::span(episode_->events()) : std::span(events_));
    }));
  }

  std::string Events() const {
    const Busy busy(*this);
    return EventsJson(episode_ ? episode_->events() : events_).dump();
  }
  std::size_t events() const {
    const Busy busy(*this);
    return episode_ ? episode_->events().size() : events_.size();
  }
  // The array lies in this object, which lives as long as it.
  template <class T>
  nb::object View(const T* values, std::initializer_list<std::size_t> shape) {
    return nb::cast(nb::ndarray<nb::numpy, const T>(values, shape, nb::find(this)));
  }
  nb::object local_map() {
    const auto n = static_cast<std::size_t>(told_->local.cells());
    return View(told_->local.values().data(), {3, n, n});
  }
  nb::object lidar() { return View(told_->lidar.data(), {told_->lidar.size()}); }
  nb::object state() { return View(told_->state.data(), {told_->state.size()}); }
  nb::object pose() { return View(told_->pose.data(), {told_->pose.size()}); }
  nb::object twist() { return View(told_->twist.data(), {told_->twist.size()}); }
  nb::object coverage() { return View(&told_->coverage, {1}); }
  nb::object plan_ahead() { return View(told_->ahead.data(), {told_->ahead.size()}); }

  const SpaceBounds& bounds() const { return told_->bounds; }
  const std::string& lacks() const { return told_->lacks; }
  nb::object LidarAngles() const {
    const Busy busy(*this);
    if (!episode_) throw InputError("the episode has ended: reset() begins another");
    std::vector<double> angles = episode_->view().sensed.scan.angle_rad;
    const std::size_t n = angles.size();
    return nb::cast(ArrayOf(std::move(angles), {n}));
  }

 private:
  // Python's threads take turns, but for the time in which physics runs.
  class Busy {
   public:
    explicit Busy(const Stepped& of) : of_(of) {
      if (std::exchange(of_.busy_, true)) {
        throw InputError("another thread is using this episode: each thread needs its own");
      }
    }
    ~Busy() { of_.busy_ = false; }
    Busy(const Busy&) = delete;
    Busy& operator=(const Busy&) = delete;

   private:
    const Stepped& of_;
  };

  void Close() {
    events_ = driven_->record.events;
    recorder_.reset();
    episode_.reset();
  }

  void Begin(const PlanResult* plan, const Outlook& outlook, bool record,
             const SpaceBounds* spaces) {
    Scenario& s = *driven_->scenario;
    if (s.spec.episode.drive != "physics")
      throw InputError({s.spec.file.string(), 0}, "drive", s.spec.episode.drive,
                       "must be physics where the robot is commanded step by step");
    told_.emplace(s, outlook);
    std::unique_ptr<Navigator> navigator;
    if (plan != nullptr) {
      driven_->plan = *plan;
      if (plan->status != PlanStatus::kSuccess)
        throw InputError({s.spec.file.string(), 0}, "plan", s.spec.planner_name,
                         "gives no plan to follow: " + plan->message);
      if (FirstFold(plan->path, s.world.robot.spec) != nullptr)
        throw InputError({s.spec.file.string(), 0}, "plan", s.spec.planner_name,
                         "folds the robot, which a twist cannot: reference=None drives without it");
    } else {
      GoFreely(s);
      driven_->plan = NoPlan(s);
      navigator = std::make_unique<FreeNavigator>(s.world.start);
    }
    driven_->scene.emplace(
        BuildScene(s.world.site.map, s.world.robot, s.world.physics, s.world.start));
    if (record) {
      driven_->recording.emplace(static_cast<int>(driven_->scene->model->nq));
      recorder_.emplace(s.world.robot.spec, s.spec.episode.control_hz, *driven_->recording);
    }
    Agents agents = MakeAgents(s.spec);
    auto tracker = std::make_unique<Commanded>(plan == nullptr);
    tracker_ = tracker.get();
    agents.tracker = std::move(tracker);
    episode_ = std::make_unique<SteppedEpisode>(s, std::move(agents), *driven_->scene,
                                                driven_->plan, std::move(navigator));
    told_->Begin(s, *episode_, plan != nullptr, spaces);
    Note();
    told_->Look(*episode_, tracker_->target_W());
  }

  // Where nothing is planned, enough coverage is the end, and the time is what three sweeps of the
  // floor take, and a minute, unless the scenario says otherwise.
  void GoFreely(Scenario& s) const {
    const RobotSpec& robot = s.world.robot.spec;
    if (s.spec.plan_by == PlanBy::kOnline) s.spec.plan_by = PlanBy::kNobody;
    if (!s.spec.episode.stop_at_coverage)
      s.spec.episode.stop_at_coverage =
          s.spec.episode.min_coverage > 0 ? s.spec.episode.min_coverage : 1;
    if (!s.spec.episode.time_limit_s)
      s.spec.episode.time_limit_s =
          60 + 3 * told_->local.sweepable_m2() / (robot.tool_width_m * robot.cruise_mps);
  }

  // Of each control period.
  void Note() {
    const EpisodeView now = episode_->view();
    told_->Note(now.estimate);
    if (recorder_) recorder_->OnControl(now);
  }

  // Scenario, plan, scene and states live here from the start: what is driven refers to them, and
  // the record is given away with them.
  std::shared_ptr<Driven> driven_;
  std::optional<Observed> told_;
  Commanded* tracker_ = nullptr;
  std::optional<StateRecorder> recorder_;
  std::unique_ptr<SteppedEpisode> episode_;
  std::unique_ptr<LivePicture> picture_;
  std::optional<Outcome> ended_;
  std::vector<Event> events_;  // of the finished one
  mutable bool busy_ = false;  // guarded by the GIL
};

}  // namespace

void BindStepped(nb::module_& m) {
  nb::class_<SpaceBounds>(m, "SpaceBounds")
      .def_ro("holonomic", &SpaceBounds::holonomic)
      .def_ro("max_speed_mps", &SpaceBounds::max_speed_mps)
      .def_ro("max_yaw_rate_radps", &SpaceBounds::max_yaw_rate_radps)
      .def_ro("beams", &SpaceBounds::beams)
      .def_ro("lidar_m", &SpaceBounds::lidar_m)
      .def_ro("low", &SpaceBounds::low)
      .def_ro("high", &SpaceBounds::high)
      .def_ro("fastest", &SpaceBounds::fastest)
      .def_ro("plan_m", &SpaceBounds::plan_m);

  nb::class_<Stepped>(m, "Stepped")
      .def(nb::init<std::shared_ptr<Scenario>, const std::shared_ptr<Planned>&, int, double, int,
                    double, bool, const SpaceBounds*>(),
           "scenario"_a, "plan"_a.none(), "local_cells"_a, "local_cell_m"_a, "plan_points"_a,
           "plan_step_m"_a, "record"_a, "spaces"_a.none())
      .def("step", &Stepped::Step, "vx_mps"_a, "vy_mps"_a, "wz_radps"_a, "periods"_a)
      .def_prop_ro("finished", &Stepped::finished)
      .def("render", &Stepped::Render, "width"_a, "height"_a, "camera"_a, "draft"_a)
      .def_prop_ro("lidar", &Stepped::lidar)
      .def_prop_ro("local_map", &Stepped::local_map)
      .def_prop_ro("state", &Stepped::state)
      .def_prop_ro("pose", &Stepped::pose)
      .def_prop_ro("twist", &Stepped::twist)
      .def_prop_ro("coverage", &Stepped::coverage)
      .def_prop_ro("plan_ahead", &Stepped::plan_ahead)
      .def_prop_ro("bounds", &Stepped::bounds, nb::rv_policy::copy)
      .def_prop_ro("lacks", &Stepped::lacks)
      .def_prop_ro("lidar_angles", &Stepped::LidarAngles)
      .def_prop_ro("num_events", [](const Stepped& s) { return s.events(); })
      .def_prop_ro("events", [](const Stepped& s) { return s.Events(); });
}

}  // namespace floorproof
