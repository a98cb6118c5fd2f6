// SPDX-License-Identifier: Apache-2.0
#include "run/episode/episode.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <optional>
#include <utility>

#include "base/quantity.h"
#include "controllers/drive.h"
#include "env/core/failure_text.h"
#include "env/failures/evidence.h"
#include "env/sim/physics_plant.h"
#include "run/episode/aftermath.h"
#include "run/episode/arrival.h"
#include "run/episode/blow_meter.h"
#include "run/episode/encounter_meter.h"
#include "run/episode/episode_stream.h"
#include "run/episode/go_to_navigator.h"
#include "run/episode/intervention.h"
#include "run/episode/make_navigator.h"
#include "run/episode/path_error.h"
#include "run/episode/plan_progress.h"
#include "run/episode/recorder.h"
#include "run/episode/robot_side.h"
#include "run/episode/time_limit.h"
#include "run/scenario/agents.h"
#include "run/scenario/floors.h"
#include "run/scenario/scenario.h"

namespace floorproof {

namespace {

std::string Text(const Timeout& timeout, const HazardMap& map) {
  return fmt::format("still on its way after {} s, at {}{}", FixedText(timeout.t_s, 0),
                     PlaceText(timeout.X_WB.x_m, timeout.X_WB.y_m),
                     timeout.hazard.empty() ? "" : ", at " + ObstaclePhrase(map, timeout.hazard));
}

template <class T>
const T* OrNull(const std::optional<T>& value) {
  return value ? &*value : nullptr;
}

std::optional<HazardSight> SightOf(const ScenarioSpec& spec, const World& world) {
  std::vector<Reading> readings;
  for (const SensorSpec& each : spec.sensors) readings.push_back(each.fills);
  if (!HazardSight::Sees(readings)) return std::nullopt;
  return HazardSight(world.site.map, world.robot.spec, 1.0 / spec.episode.control_hz);
}

}  // namespace

// The two sides of an episode, and who looks on: the plant, the robot's side, the person who helps,
// the detectors, the recorder. They meet in the sample, which is written here alone.
class EpisodeLoop {
 public:
  // `navigator`: none: the scenario's own.
  EpisodeLoop(const ScenarioSpec& spec, const World& world, Agents& agents, Plant& plant,
              Simulation* simulation, const PlanResult& plan, EpisodeObserver* observer,
              std::unique_ptr<Navigator> navigator = nullptr);

  EpisodeRecord Run() {
    Begin();
    std::optional<Outcome> ended;
    while (!ended) ended = Advance();
    return Finish(*ended);
  }

  void Begin();

  // One control period: what was sensed is answered, the plant driven, and what came of it sensed.
  std::optional<Outcome> Advance() {
    std::optional<Outcome> ended = Control();
    for (std::int64_t step = 0; step < steps_a_control_ && !ended; ++step) ended = Step();
    if (!ended) Perceive(1.0 / spec_.episode.control_hz);
    return ended;
  }
  // The same; and where the next one would end it without driving, or only bring it to rest, it is
  // at its end now.
  std::optional<Outcome> AdvanceToEnd() {
    std::optional<Outcome> ended = AdvanceAndSweep();
    if (!ended && IsOver()) ended = AdvanceAndSweep();
    while (!ended && rest_.begun()) ended = AdvanceAndSweep();
    return ended;
  }
  // What came of a period that the end broke off. Not part of the record, which is made before.
  void PerceiveEnd() {
    const double dt_s = sample_.t_s - sensed_.t_s;
    if (dt_s > 0.5 * world_.physics.timestep_s) Perceive(dt_s);
  }

  EpisodeView View() {
    return {sample_,
            sensed_,
            robot_side_.estimate(),
            simulation_,
            recorder_.coverage(),
            recorder_.driven_m() / plan_m_};
  }
  const Recorder& recorder() const { return recorder_; }
  const SweepArea& area() const { return area_; }
  const RobotSide& robot() const { return robot_side_; }

  EpisodeRecord Finish(Outcome ended) {
    EpisodeRecord record = recorder_.Finish(ended, sample_, robot_side_, agents_.detectors,
                                            spec_.episode.min_coverage, plant_.battery_left());
    if (online_ && !navigator_->plan().empty()) record.figures = agents_.online->figures();
    if (ended == Outcome::kError) record.message = plant_.WhyBroken();
    if (record.message.empty()) record.message = navigator_->why();
    if (record.outcome == Outcome::kTimeout) {
      record.timeout = Unfinished();
      if (record.message.empty()) record.message = Text(*record.timeout, world_.site.map);
    }
    if (record.message.empty() && record.outcome == Outcome::kAborted)
      record.message = robot_side_.supervisor()->stopped();
    if (record.message.empty()) record.message = interventions_.why_not();
    if (spec_.episode.drive == "physics" && !(ended == Outcome::kSuccess && IsEnoughCovered()))
      record.RequireArrival(HowItArrived(), MostPlanLeft());
    record.TakeMissed(robot_side_.missed());
    encounters_.OnBlow(blows_.Take());
    if (aftermath_.watched()) encounters_.TakeAfter(After(ended));
    record.encounters = encounters_.Finish();
    return record;
  }

 private:
  std::optional<Outcome> Control();
  std::optional<Outcome> Step();
  std::optional<Outcome> Failed();

  std::optional<Outcome> AdvanceAndSweep() {
    const std::optional<Outcome> ended = Advance();
    if (!ended) recorder_.Sweep(sample_);
    return ended;
  }
  bool IsLate() const { return sample_.t_s >= limit_s_ + interventions_.extra_s(); }
  bool IsEnoughCovered() const {
    const std::optional<double>& enough = spec_.episode.stop_at_coverage;
    return enough && recorder_.coverage() >= *enough;
  }
  bool IsAtRest(const Supervisor& supervisor) const;
  Arrival HowItArrived() const;
  double MostPlanLeft() const {
    constexpr double kMost = 0.1;
    const bool goes_around = spec_.recovery || spec_.safety || spec_.episode.on_failure == "assist";
    return spec_.episode.max_plan_left.value_or(goes_around ? 1 : kMost);
  }
  bool HasRested() const {
    constexpr double kAtRest_s = 2;
    return sample_.t_s - moved_s_ >= kAtRest_s;
  }
  bool IsOver() const;
  bool HasComeToRest() const;
  void Perceive(double dt_s) {
    plant_.Sense(sensed_);
    robot_side_.Perceive(sensed_, dt_s);
  }
  void Look() { static_cast<Truth&>(sample_) = plant_.truth(); }
  void Act(const Actuation& actuation);
  void StartDetectors();
  bool Detect();
  std::optional<Outcome> HandedOver(const Supervisor& supervisor);
  Timeout Unfinished() const;
  Encounter::After After(Outcome ended) const;

  const ScenarioSpec& spec_;
  const World& world_;
  Agents& agents_;
  Plant& plant_;
  Simulation* simulation_;
  EpisodeObserver* observer_;
  const RobotSpec& robot_;
  bool online_;  // planned on the way
  HazardMap known_, true_;
  SweepArea area_;
  double plan_m_, limit_s_ = 0;
  std::int64_t steps_a_control_;
  Recorder recorder_;
  BlowMeter blows_;
  std::optional<HazardSight> sight_;  // none: it has no sensors that could tell of hazards
  EncounterMeter encounters_;
  Aftermath aftermath_;
  Interventions interventions_;
  std::unique_ptr<Navigator> navigator_;
  RobotSide robot_side_;
  Observation sensed_;
  Sample sample_;
  PlanProgress progress_;
  std::optional<PlanPassed> passed_;  // none: there was no plan beforehand
  RestWatch rest_;                    // begun where it says that it is at its end
  int carried_ = 0;
  double moved_s_ = 0;  // last, or its motors were not cut
  HazardMemory met_{&HazardMemory::Holds};
};

EpisodeLoop::EpisodeLoop(const ScenarioSpec& spec, const World& world, Agents& agents, Plant& plant,
                         Simulation* simulation, const PlanResult& plan, EpisodeObserver* observer,
                         std::unique_ptr<Navigator> navigator)
    : spec_(spec),
      world_(world),
      agents_(agents),
      plant_(plant),
      simulation_(simulation),
      observer_(observer),
      robot_(world.robot.spec),
      online_(spec.plan_by == PlanBy::kOnline),
      known_(KnownFloor(world)),
      true_(TrueFloor(world)),
      area_(ComputeSweepArea(true_, robot_, robot_.clear, robot_.tool, world.start)),
      plan_m_(online_ ? std::numeric_limits<double>::infinity()
                      : std::max(Length(plan.path), 1e-9)),
      steps_a_control_(std::lround(1.0 / (spec.episode.control_hz * world.physics.timestep_s))),
      recorder_(spec, world, area_, plan),
      blows_(robot_, world.physics.timestep_s),
      sight_(SightOf(spec, world)),
      encounters_(true_, robot_, IsHolonomic(robot_), OrNull(sight_)),
      interventions_(spec.episode, world),
      navigator_(navigator ? std::move(navigator)
                           : MakeNavigator(spec, world, agents.online.get(), plan, known_)),
      robot_side_(robot_, known_, *navigator_,
                  {*agents.tracker, *agents.estimator, OrNull(agents.mapper), OrNull(spec.recovery),
                   OrNull(spec.safety), !online_},
                  1.0 / spec.episode.control_hz) {
  if (!online_ && !LeadsItself(spec)) passed_.emplace(plan.path, spec.episode.arrival_m);
}

void EpisodeLoop::Begin() {
  plant_.Reset(world_.start, sensed_);
  Look();
  robot_side_.Start(world_.start, EpisodeStream(spec_, "estimator"));
  const double plan_s =
      LeadsItself(spec_) ? GoToDuration(navigator_->plan(), robot_) : agents_.tracker->Duration();
  limit_s_ = online_ ? OnlineLimit_s(spec_.episode) : PlanLimit_s(spec_.episode, plan_s);
  recorder_.Expect(plan_s);
  StartDetectors();
  Perceive(1.0 / spec_.episode.control_hz);
}

// What happens once a control period: command by what was sensed, keep a record, look on, help.
std::optional<Outcome> EpisodeLoop::Control() {
  Act(interventions_.awaited() || rest_.begun() ? robot_side_.Stand()
                                                : robot_side_.Control(sensed_));
  if (passed_) passed_->Add(sample_.p_WB.head<2>(), sample_.command.dwelling);
  recorder_.OnControl(sample_, robot_side_.estimate());
  if (sight_) sight_->OnControl(sensed_, sample_);
  encounters_.OnBlow(blows_.Take());
  encounters_.OnControl(sample_, robot_side_.estimate(),
                        navigator_->free() ? nullptr : &robot_side_.path());

  std::optional<Outcome> ended;
  if (!rest_.begun() && robot_side_.done()) rest_.Begin(sample_.t_s);
  if (rest_.begun() && navigator_->leads() == Navigator::Leads::kNowhere)
    ended = Outcome::kNotPlanned;
  else if (IsEnoughCovered() || HasComeToRest())
    ended = Outcome::kSuccess;
  if (const Supervisor* supervisor = robot_side_.supervisor())
    if (const auto over = HandedOver(*supervisor)) ended = over;
  if (!rest_.begun() && IsLate()) ended = Outcome::kTimeout;
  if (observer_ && !observer_->OnControl(View())) ended = Outcome::kInterrupted;

  if (!ended && interventions_.HasCome(sample_.t_s)) {     // after sensing: a bump was where it lay
    if (sample_.battery_v == 0) return Outcome::kFailure;  // cut off while it waited
    recorder_.OnIntervention(interventions_.SetDown(plant_, robot_side_), agents_.detectors);
    rest_.Drop();
    encounters_.Lift();
    blows_.Lift();
    Look();
    robot_side_.Helped(sample_.X_WB(), EpisodeStream(spec_, "estimator"), sample_.t_s);
    Act(robot_side_.actuation());
    StartDetectors();
  }
  return ended;
}

// A robot that asks for help is helped as after a failure. One that has stopped for good has done
// so once it has been at rest for a while, its motors cut: what happens until then is judged.
std::optional<Outcome> EpisodeLoop::HandedOver(const Supervisor& supervisor) {
  if (supervisor.asks_for_help() && !interventions_.awaited() &&
      !interventions_.Call(robot_side_.path(), sample_))
    return Outcome::kAborted;
  if (!IsAtRest(supervisor)) moved_s_ = sample_.t_s;
  return HasRested() ? std::optional(Outcome::kAborted) : std::nullopt;
}

bool EpisodeLoop::IsAtRest(const Supervisor& supervisor) const {
  constexpr double kAtRest_mps = 0.005, kAtRest_radps = 0.01;
  return supervisor.cuts_all() && sample_.v_WB_W.norm() < kAtRest_mps &&
         std::abs(sample_.V_WB_B.wz_radps) < kAtRest_radps;
}

// Whether the next Control() would end it, as far as it can be said before who commands the robot
// says what is next.
bool EpisodeLoop::IsOver() const {
  if (IsEnoughCovered()) return true;
  if (rest_.begun()) return HasComeToRest();
  if (IsLate()) return true;
  if (const Supervisor* supervisor = robot_side_.supervisor())
    return IsAtRest(*supervisor) && HasRested();
  return !interventions_.awaited() && robot_side_.WouldBeDone(sample_.t_s);
}

// It said that it was at its end, and stands; or has had the time for it.
bool EpisodeLoop::HasComeToRest() const { return rest_.begun() && rest_.IsOver(sample_.t_s); }

// Of a plan, where that ends; of a mission that leads by lines, where the last one ends. An unknown
// floor has no such place.
Arrival EpisodeLoop::HowItArrived() const {
  Arrival how;
  how.believed = rest_.begun();
  how.most_off_m = spec_.episode.arrival_m;
  if (!online_) {
    how.end_W = (LeadsItself(spec_) ? navigator_->path() : navigator_->plan()).back().p_W;
    how.off_m = (sample_.p_WB.head<2>() - how.end_W).norm();
  }
  how.at_rest = rest_.HasRested(sample_.t_s);
  how.speed_mps = sample_.v_WB_W.norm();
  how.turn_radps = std::abs(sample_.V_WB_B.wz_radps);
  if (passed_) {
    how.left_m = passed_->left_m();
    how.plan_m = plan_m_;
    how.tasks_missed = passed_->tasks_missed();
    how.first_missed_W = passed_->first_missed_W();
  }
  return how;
}

// One step of the plant, and what is to be said of it.
std::optional<Outcome> EpisodeLoop::Step() {
  const bool good = plant_.Step();
  Look();
  if (!good) return Outcome::kError;
  if (std::exchange(carried_, sample_.carried) != sample_.carried) {
    recorder_.OnCarried(agents_.detectors);
    encounters_.Lift();
    blows_.Lift();
    StartDetectors();  // nothing that it did brought it there
  }
  if (navigator_->free()) {
    sample_.progress_m = recorder_.driven_m();  // wherever it went
  } else {
    sample_.off_track_W =
        OffTrack(robot_side_.path(), sample_.command.segment, sample_.p_WB.head<2>());
    sample_.cross_track_m = sample_.off_track_W.norm();
    sample_.progress_m = progress_.Update(robot_side_.path(), robot_side_.paths(),
                                          sample_.command.segment, sample_.p_WB.head<2>());
  }
  met_.Update(sample_);
  recorder_.OnStep(sample_);
  blows_.OnStep(sample_);
  aftermath_.OnStep(sample_.t_s, sample_.progress_m);
  if (rest_.begun()) rest_.Add(sample_);

  if (interventions_.awaited()) return std::nullopt;  // that it does not get on is known
  if (aftermath_.watched())                           // it has failed: nothing more is judged
    return aftermath_.HasEnded(sample_.t_s) ? std::optional(Outcome::kFailure) : std::nullopt;
  return Detect() ? Failed() : std::nullopt;
}

// Something did, just now.
std::optional<Outcome> EpisodeLoop::Failed() {
  if (spec_.episode.on_failure == "ignore") return std::nullopt;
  if (spec_.episode.on_failure == "watch") {
    aftermath_.OnFailure(sample_.t_s);
    encounters_.OnBlow(blows_.Take());
    encounters_.Watch();
    return std::nullopt;
  }
  if (interventions_.Call(robot_side_.path(), sample_)) return std::nullopt;
  return Outcome::kFailure;
}

// What became of a robot that failed, by what ended its drive: the watch, or its plan's end. Where
// the time limit or somebody else did, nobody knows.
Encounter::After EpisodeLoop::After(Outcome ended) const {
  constexpr double kUpright_rad = 45 * kPi / 180;
  if (ended == Outcome::kAborted) return Encounter::After::kNeedsHelp;  // it gave up
  if (ended != Outcome::kFailure && ended != Outcome::kSuccess) return Encounter::After::kUnseen;
  // One that goes by its wheels' turns may take itself to be at its end.
  const bool recovered = (ended == Outcome::kSuccess || aftermath_.Gains(sample_.t_s)) &&
                         sample_.tilt_rad < kUpright_rad && encounters_.HasLeftFailure();
  return recovered ? Encounter::After::kRecovered : Encounter::After::kNeedsHelp;
}

void EpisodeLoop::Act(const Actuation& actuation) {
  plant_.Apply(actuation);
  sample_.command = robot_side_.command();
  sample_.command.hinges = actuation.hinges;
  sample_.cross_track_half_width_m = HalfWidth(robot_side_.clearance(), robot_side_.path(),
                                               sample_.command.segment, sample_.p_WB.head<2>());
}

void EpisodeLoop::StartDetectors() {
  const EpisodeContext context{world_.site.map, robot_, world_.physics.timestep_s};
  met_.Start(context);
  for (auto& [name, detector] : agents_.detectors) detector->Start(context);
}

// Where the time ran out, and what held the robot last.
Timeout EpisodeLoop::Unfinished() const {
  constexpr double kRecall_s = 10;  // what was met longer ago does not keep it
  return {sample_.t_s, sample_.X_WB(), met_.Recall(sample_.t_s - kRecall_s)};
}

// True when one of them fired; all see every sample.
bool EpisodeLoop::Detect() {
  bool failed = false;
  for (auto& [name, detector] : agents_.detectors) {
    if (!detector->Update(sample_)) continue;
    recorder_.OnEvent(detector->event());
    encounters_.OnEvent(detector->event());
    failed = true;
  }
  return failed;
}

namespace {

PhysicsPlant MakePlant(const ScenarioSpec& spec, const World& world, Agents& agents,
                       const Scene& scene) {
  return PhysicsPlant(scene, world.site.map, world.robot.spec, agents.sensors, world.faults,
                      1.0 / spec.episode.control_hz,
                      [&spec](const std::string& name) { return EpisodeStream(spec, name); });
}

}  // namespace

struct SteppedEpisode::Parts {
  Parts(const Scenario& s, Agents given, const Scene& scene, const PlanResult& plan,
        std::unique_ptr<Navigator> navigator)
      : agents(std::move(given)),
        plant(MakePlant(s.spec, s.world, agents, scene)),
        episode(s.spec, s.world, agents, plant, &plant.simulation(), plan, nullptr,
                std::move(navigator)) {
    episode.Begin();
  }
  Agents agents;
  PhysicsPlant plant;
  EpisodeLoop episode;
};

SteppedEpisode::SteppedEpisode(const Scenario& scenario, Agents agents, const Scene& scene,
                               const PlanResult& plan, std::unique_ptr<Navigator> navigator)
    : parts_(std::make_unique<Parts>(scenario, std::move(agents), scene, plan,
                                     std::move(navigator))) {}
SteppedEpisode::~SteppedEpisode() = default;
std::optional<Outcome> SteppedEpisode::Advance() { return parts_->episode.AdvanceToEnd(); }
EpisodeView SteppedEpisode::view() { return parts_->episode.View(); }
const std::vector<Event>& SteppedEpisode::events() const {
  return parts_->episode.recorder().events();
}
const CoverageMeter& SteppedEpisode::swept() const { return parts_->episode.recorder().swept(); }
const SweepArea& SteppedEpisode::area() const { return parts_->episode.area(); }
const RobotSide& SteppedEpisode::robot() const { return parts_->episode.robot(); }
EpisodeRecord SteppedEpisode::Finish(Outcome outcome) {
  EpisodeRecord record = parts_->episode.Finish(outcome);
  if (outcome != Outcome::kError) parts_->episode.PerceiveEnd();
  return record;
}

EpisodeRecord RunEpisode(const Scenario& s, Agents& agents, const Scene& scene,
                         const PlanResult& plan, EpisodeObserver* observer) {
  PhysicsPlant plant = MakePlant(s.spec, s.world, agents, scene);
  return RunEpisode(s, agents, plant, &plant.simulation(), plan, observer);
}

EpisodeRecord RunEpisode(const Scenario& s, Agents& agents, Plant& plant, Simulation* simulation,
                         const PlanResult& plan, EpisodeObserver* observer) {
  return EpisodeLoop(s.spec, s.world, agents, plant, simulation, plan, observer).Run();
}

}  // namespace floorproof
