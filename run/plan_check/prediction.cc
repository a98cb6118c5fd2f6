// SPDX-License-Identifier: Apache-2.0
// The meetings of a plan are found once (ExpectedEncounters). A condition is what an episode draws:
// friction, mass and clearance are put into the meetings as they are; anything else that is drawn
// may move hazards or the plan, so the scenario is read and planned again.
#include "run/plan_check/prediction.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <memory>
#include <optional>
#include <span>

#include "base/params.h"
#include "base/quantity.h"
#include "env/core/failure_text.h"
#include "env/core/passages.h"
#include "env/core/ramp_ends.h"
#include "planners/risk/model_rates.h"
#include "run/episode/make_plan.h"
#include "run/episode/plain_draws.h"
#include "run/episode/plan_inputs.h"
#include "run/plan_check/driven_over.h"
#include "run/plan_check/expected_encounters.h"
#include "run/scenario/floors.h"
#include "run/scenario/scenario_file.h"

namespace floorproof {
namespace {

class Predictor {
 public:
  Predictor(const ScenarioFile& file, const Variant& variant) : file_(file), variant_(variant) {}

  void Read(std::uint64_t episode) {
    scenario_.emplace(file_.Read(episode, variant_));
    Scenario& s = *scenario_;
    if (!s.spec.risk_model)
      throw InputError({s.spec.file.string(), 0}, "risk.model", "",
                       "is missing: rates that were measured of " + s.spec.robot_name +
                           " are needed to predict by (floorproof measure, an hour, then --model "
                           "risk_model.json)");
    if (s.spec.plan_by == PlanBy::kOnline || LeadsItself(s.spec))
      throw InputError({s.spec.file.string(), 0}, "plan", s.spec.planner_name,
                       "is made on the way: nothing can be predicted of a plan that is not there");
    RefuseProgram(s);
    if (!rates_) {
      model_ = s.spec.risk_model;
      rates_.emplace(*model_);
    }
    if (std::string inputs = PlanInputs(s); inputs != inputs_) {
      plan_ = MakePlan(s);
      inputs_ = std::move(inputs);
    }
    if (plan_.status != PlanStatus::kSuccess)
      throw InputError({s.spec.file.string(), 0}, "plan", "",
                       "there is none (" + std::string(Name(plan_.status)) + "): " + plan_.message);
    expected_ = ExpectedEncounters(s, plan_);
    if (conditions_.empty()) left_out_ = LeftOut(s);
    const HazardMap floor = TrueFloor(s.world);
    FindLooseRamps(floor);
    FindOtherFloors(floor, s);
    if (conditions_.empty())
      first_floor_ = OutlinesOf(floor);
    else
      floors_differ_ = floors_differ_ || OutlinesOf(floor) != first_floor_;
  }

  // The meetings as this episode has them, which draws nothing that moves them.
  void Redraw(std::uint64_t episode) {
    for (const auto& [key, value] : file_.DrawnOf(episode))
      if (const PlainDraw* plain = FindPlainDraw(key))
        for (Encounter& encounter : expected_)
          encounter.at.*plain->of_meeting = AsDouble(value, key);
  }

  void AddCondition() {
    std::map<std::string, int> times;          // a hazard is met
    std::map<std::string, std::size_t> first;  // of its meetings of a kind
    std::vector<PlannedMeeting> condition;
    std::map<std::pair<std::string, Passage>, int> unmeasured;
    for (const Encounter& encounter : expected_) {
      const std::string of = encounter.type + " " + encounter.hazard;
      const std::size_t number = NumberOf(encounter, of + " " + std::to_string(times[of]++));
      const RateEvaluator* rates = rates_->Find(encounter.type, encounter.passage, encounter.at);
      if (rates == nullptr) {
        ++unmeasured[{encounter.type, encounter.passage}];
        continue;
      }
      if (!far_beyond_) far_beyond_ = FindFarBeyond(rates->kind(), encounter, number);
      const std::string like = of + " " + TextOf(rates->kind());
      const std::size_t alike =
          rates->kind().per_metre ? number : first.emplace(like, number).first->second;
      condition.push_back(
          {rates, encounter.size, encounter.at, AmountOf(encounter), number, alike});
    }
    for (const auto& [kind, meetings] : unmeasured) AddUnmeasured(kind, meetings);
    conditions_.push_back(std::move(condition));
  }

  Prediction Finish(PlanResult plan) {
    Prediction out;
    out.plan = std::move(plan);
    out.conditions = static_cast<int>(conditions_.size());
    out.survival = PredictSurvival(conditions_, meetings_.size(), *model_);
    out.meetings = std::move(meetings_);
    for (std::size_t i = 0; i < out.meetings.size(); ++i) {
      out.meetings[i].probability = out.survival.by_meeting[i];
      out.meetings[i].beyond = out.survival.beyond[i].share;
      if (out.meetings[i].beyond > kNear) LookBeyond(i, out.survival.beyond[i].condition);
    }
    for (auto& [at, beyond] : beyond_) out.beyond.push_back(std::move(beyond));
    out.left_out = std::move(left_out_);
    for (const auto& [id, text] : unknown_) out.left_out.push_back(text);
    out.floors_differ = floors_differ_;
    out.far_beyond = std::move(far_beyond_);
    out.held_against_plans = model_->carry_over.plans;
    for (auto& [kind, unmeasured] : unmeasured_) out.unmeasured.push_back(std::move(unmeasured));
    if (!out.unmeasured.empty() || !unknown_.empty() || out.far_beyond) KnowNothing(out);
    return out;
  }

  const PlanResult& plan() const { return plan_; }

 private:
  static constexpr double kNear = 0.02;  // of the measured range: as good as within

  // The rates of ramps were measured on ramps that lead to a floor. Those of any condition, each as
  // the first one has it.
  void FindLooseRamps(const HazardMap& floor) {
    for (const Hazard& hazard : floor.hazards) {
      const auto end = FindLooseRampEnd(floor, hazard);
      if (end && std::ranges::find(expected_, hazard.id, &Encounter::hazard) != expected_.end())
        unknown_.emplace(hazard.id, fmt::format("the end of ramp {}, {} {} the floor beyond",
                                                hazard.id, LengthText(std::abs(end->off_m)),
                                                end->off_m > 0 ? "above" : "below"));
    }
  }

  // Seen from a raised or a sunk floor on which the robot starts, the others have no keys by which
  // a meeting could be rated.
  void FindOtherFloors(const HazardMap& floor, const Scenario& s) {
    if (std::ranges::all_of(floor.hazards, IsOfTheSite)) return;  // the walk over the plan is long
    for (const DrivenOver& over : FindDrivenOver(s.world, plan_))
      if (const Hazard& hazard = floor.hazards[over.hazard]; !IsOfTheSite(hazard))
        unknown_.emplace(hazard.id,
                         fmt::format("the edge of {}, crossed {}", ObstaclePhrase(floor, hazard.id),
                                     CountText(over.times, "time")));
  }

  static std::vector<std::pair<std::string, std::vector<Polygon>>> OutlinesOf(
      const HazardMap& floor) {
    std::vector<std::pair<std::string, std::vector<Polygon>>> outlines;
    for (const Hazard& hazard : floor.hazards) outlines.emplace_back(hazard.id, hazard.footprint);
    return outlines;
  }

  static std::vector<std::string> LeftOut(const Scenario& s) {
    std::vector<std::string> left_out;
    if (s.spec.estimator.name != "truth")
      left_out.push_back("how wrong " + s.spec.estimator.name +
                         " is about the robot's place: it is taken to know it");
    const std::optional<double> own_v =
        ReadRobot(s.spec.robot_file, {}, Blocks::kLocked, s.files).spec.battery.voltage_v;
    if (const std::optional<double>& v = s.world.robot.spec.battery.voltage_v;
        v && own_v && *v != *own_v)
      left_out.push_back(fmt::format("a battery of {} V: the rates were measured at {} V",
                                     NumberText(*v), NumberText(*own_v)));
    if (!s.world.faults.empty()) left_out.push_back("what breaks (`faults`)");
    if (s.spec.safety) left_out.push_back("what its supervision does (`safety`)");
    return left_out;
  }

  // What of a meeting lies beyond, where it does so most.
  void LookBeyond(std::size_t number, std::size_t condition) {
    for (const PlannedMeeting& meeting : conditions_[condition]) {
      if (meeting.number != number) continue;
      const KindRates& kind = meeting.rates->kind();
      Covariates covariates(kind.axes, model_->mirrored, meeting.size);
      const std::span<const double> x = covariates.Of(meeting.at);
      for (std::size_t a = 0; a < x.size(); ++a) {
        const double share = floorproof::Beyond(kind.axes[a], x[a]);
        if (share <= kNear) continue;
        Prediction::Beyond& most = beyond_[{kind.type, kind.axes[a].name}];
        if (share > most.share) most = {kind.type, kind.axes[a].name, share, number};
      }
    }
  }

  std::optional<Prediction::FarBeyond> FindFarBeyond(const KindRates& kind, const Encounter& met,
                                                     std::size_t number) const {
    Covariates covariates(kind.axes, model_->mirrored, met.size);
    const std::span<const double> x = covariates.Of(met.at);
    for (std::size_t a = 0; a < x.size(); ++a) {
      const RateAxis& axis = kind.axes[a];
      // A meeting that is longer or turns more counts as several (TimesMeasured). The size of
      // a thing hardly matters to a robot that passes it.
      if (axis.name == "over_m" || axis.name == "turn_rad" ||
          (axis.of_hazard && kind.passage == Passage::kBeside))
        continue;
      if (IsFarBeyond(axis, x[a]))
        return Prediction::FarBeyond{kind.type, axis.name, x[a], axis.lower, axis.upper, number};
    }
    return std::nullopt;
  }

  // Nothing is known, so the interval of the failure probability ends at 1.
  static void KnowNothing(Prediction& out) {
    out.survival.no_failure.lower = 0;
    for (Probability& mode : out.survival.first) mode.upper = 1;
  }

  std::size_t NumberOf(const Encounter& encounter, const std::string& name) {
    const auto [at, is_new] = numbers_.emplace(name, meetings_.size());
    if (is_new) meetings_.push_back({encounter, 0});
    return at->second;
  }

  // Of a condition; said is the most.
  void AddUnmeasured(const std::pair<std::string, Passage>& what, int meetings) {
    Prediction::Unmeasured& kind = unmeasured_[what];
    if (kind.type.empty()) {
      kind = {what.first, what.second, 0, "it was not driven"};
      for (const UnmeasuredKind& known : model_->unmeasured)
        if (known.type == what.first && known.passage == what.second) kind.why = known.why;
    }
    kind.meetings = std::max(kind.meetings, meetings);
  }

  const ScenarioFile& file_;
  const Variant& variant_;
  std::optional<Scenario> scenario_;
  std::shared_ptr<const RiskModel> model_;
  std::optional<ModelRates> rates_;
  std::string inputs_;
  PlanResult plan_;
  std::vector<Encounter> expected_;
  std::vector<std::string> left_out_;
  std::map<std::string, std::string> unknown_;  // by id: met, and no rates are known of it
  std::vector<std::pair<std::string, std::vector<Polygon>>> first_floor_;
  bool floors_differ_ = false;
  std::optional<Prediction::FarBeyond> far_beyond_;  // the first one
  std::vector<std::vector<PlannedMeeting>> conditions_;
  std::vector<PredictedMeeting> meetings_;
  std::map<std::string, std::size_t> numbers_;
  std::map<std::pair<std::string, std::string>, Prediction::Beyond> beyond_;  // by type and axis
  std::map<std::pair<std::string, Passage>, Prediction::Unmeasured> unmeasured_;
};

}  // namespace

Prediction Predict(const ScenarioFile& file, const Variant& variant, int draws,
                   const std::function<void(int)>& progress) {
  const std::uint64_t begin = file.episode();
  const auto conditions = static_cast<std::uint64_t>(file.draws_differ() ? draws : 1);
  bool plain = true;
  for (const auto& [key, value] : file.DrawnOf(begin))
    plain = plain && FindPlainDraw(key) != nullptr;
  Predictor predictor(file, variant);
  std::optional<PlanResult> first;
  for (std::uint64_t i = 0; i < conditions; ++i) {
    if (i == 0 || !plain)
      predictor.Read(begin + i);
    else
      predictor.Redraw(begin + i);
    if (i == 0) first = predictor.plan();
    predictor.AddCondition();
    if (progress) progress(static_cast<int>(i) + 1);
  }
  return predictor.Finish(std::move(*first));
}

}  // namespace floorproof
