// SPDX-License-Identifier: Apache-2.0
// The meetings of a plan are found once (ExpectedEncounters). A condition is what an episode draws:
// friction, mass and clearance are put into the meetings as they are; anything else that is drawn
// may move hazards or the plan, so the scenario is read and planned again.
#include "run/plan_check/prediction.h"

#include <algorithm>
#include <map>
#include <memory>
#include <optional>
#include <span>

#include "base/params.h"
#include "planners/risk/model_rates.h"
#include "run/episode/make_plan.h"
#include "run/episode/plain_draws.h"
#include "run/episode/plan_inputs.h"
#include "run/plan_check/expected_encounters.h"

namespace floorproof {
namespace {

class Predictor {
 public:
  Predictor(const ScenarioFile& file, const Variant& variant) : file_(file), variant_(variant) {}

  void Read(std::uint64_t episode) {
    scenario_.emplace(file_.Read(episode, variant_));
    Scenario& s = *scenario_;
    if (!s.risk_model)
      throw InputError({s.file.string(), 0}, "risk.model", "",
                       "is missing: measured rates are needed to predict by (floorproof measure, "
                       "then risk: {model: risk_model.json})");
    if (s.online || LeadsItself(s))
      throw InputError({s.file.string(), 0}, "plan", s.planner_name,
                       "is made on the way: nothing can be predicted of a plan that is not there");
    RefuseProgram(s);
    if (!rates_) {
      model_ = s.risk_model;
      rates_.emplace(*model_);
    }
    if (std::string inputs = PlanInputs(s); inputs != inputs_) {
      plan_ = MakePlan(s);
      inputs_ = std::move(inputs);
    }
    if (plan_.status != PlanStatus::kSuccess)
      throw InputError({s.file.string(), 0}, "plan", "",
                       "there is none (" + std::string(Name(plan_.status)) + "): " + plan_.message);
    expected_ = ExpectedEncounters(s, plan_);
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
    for (const Encounter& encounter : expected_) {
      const std::string of = encounter.type + " " + encounter.hazard;
      const std::size_t number = NumberOf(encounter, of + " " + std::to_string(times[of]++));
      const RateEvaluator* rates = RatesOf(encounter);
      if (rates == nullptr) continue;
      const std::string like = of + " " + TextOf(rates->kind());
      const std::size_t alike =
          rates->kind().per_metre ? number : first.emplace(like, number).first->second;
      condition.push_back(
          {rates, encounter.size, encounter.at, AmountOf(encounter), number, alike});
      if (conditions_.size() % kLookBeyondEvery == 0) LookBeyond(rates->kind(), encounter);
    }
    conditions_.push_back(std::move(condition));
    first_ = false;
  }

  Prediction Finish(PlanResult plan) {
    Prediction out;
    out.plan = std::move(plan);
    out.conditions = static_cast<int>(conditions_.size());
    out.survival = PredictSurvival(conditions_, meetings_.size(), *model_);
    out.meetings = std::move(meetings_);
    for (std::size_t i = 0; i < out.meetings.size(); ++i)
      out.meetings[i].probability = out.survival.by_meeting[i];
    for (const auto& [at, share] : beyond_) out.beyond.push_back({at.first, at.second, share});
    for (auto& [kind, unmeasured] : unmeasured_) out.unmeasured.push_back(std::move(unmeasured));
    return out;
  }

  const PlanResult& plan() const { return plan_; }

 private:
  static constexpr std::size_t kLookBeyondEvery = 16;  // conditions: it takes longer than rates do

  void LookBeyond(const KindRates& kind, const Encounter& encounter) {
    Covariates covariates(kind.axes, model_->mirrored, encounter.size);
    const std::span<const double> x = covariates.Of(encounter.at);
    for (std::size_t a = 0; a < x.size(); ++a) {
      constexpr double kNear = 0.02;  // of the range: as good as within
      const double share = floorproof::Beyond(kind.axes[a], x[a]);
      if (share <= kNear) continue;
      double& most = beyond_[{kind.type, kind.axes[a].name}];
      most = std::max(most, share);
    }
  }

  std::size_t NumberOf(const Encounter& encounter, const std::string& name) {
    const auto [at, is_new] = numbers_.emplace(name, meetings_.size());
    if (is_new) meetings_.push_back({encounter, 0});
    return at->second;
  }

  const RateEvaluator* RatesOf(const Encounter& encounter) {
    if (const RateEvaluator* rates = rates_->Find(encounter.type, encounter.passage, encounter.at))
      return rates;
    Prediction::Unmeasured& kind = unmeasured_[{encounter.type, encounter.passage}];
    if (kind.type.empty()) {
      kind = {encounter.type, encounter.passage, 0, "it was not driven"};
      for (const UnmeasuredKind& known : model_->unmeasured)
        if (known.type == encounter.type && known.passage == encounter.passage)
          kind.why = known.why;
    }
    if (first_) ++kind.meetings;
    return nullptr;
  }

  const ScenarioFile& file_;
  const Variant& variant_;
  std::optional<Scenario> scenario_;
  std::shared_ptr<const RiskModel> model_;
  std::optional<ModelRates> rates_;
  std::string inputs_;
  PlanResult plan_;
  std::vector<Encounter> expected_;
  bool first_ = true;
  std::vector<std::vector<PlannedMeeting>> conditions_;
  std::vector<PredictedMeeting> meetings_;
  std::map<std::string, std::size_t> numbers_;
  std::map<std::pair<std::string, std::string>, double> beyond_;  // by type and axis
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
