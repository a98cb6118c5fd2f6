// SPDX-License-Identifier: Apache-2.0
// Coverage with the least probability of failure, by what was measured of the robot (RiskModel).
//
// A plan fails with 1 - mean over drawn conditions of exp(-sum of the rates of all that it meets)
// (survival.h). No walk can be searched by that directly: what a crossing costs depends on the
// others. So walks are searched by the sum of expected rates, and what comes out is ranked by the
// probability itself. The sum bounds it, by Jensen's inequality: mean exp(-sum) >= exp(-mean sum).
//
// Candidates: the plans of all planners that cover floors and promise what is asked for; walks from
// cell to cell by expected rates (cell_rates.h), once with the fewest crossings and once by the sum
// alone; the best of these with either side leading over terrain; and, region by region of terrain
// from the costliest on, walks that keep off it. Each meets its hazards at the speeds of the least
// rate. Of those that cover `min_coverage` of what the most covering one does the best is taken:
// the fewest crossings of which nothing was measured, then the least probability, then the least
// length.
//
// Not done: turning a robot that is not held by the map's axes; another place for each crossing
// than the walks choose.
#include <algorithm>
#include <cmath>

#include "planners/lines/turned_plan.h"
#include "planners/risk/cell_rates.h"
#include "planners/risk/passage_speeds.h"
#include "planners/risk/rate_walk.h"
#include "planners/risk/risk_meter.h"

namespace floorproof {
namespace {

struct Candidate {
  PlanResult plan;
  PathSurvival survival;  // as it is driven: with the turns that the robot needs
  double coverage = 0;    // of the free cells that can be reached
  double length_m = 0;
  int missed_cells = 0;
};

bool Better(const Candidate& a, const Candidate& b) {
  constexpr double kSame = 1e-6, kSame_m = 1e-6;
  if (a.survival.unmeasured != b.survival.unmeasured)
    return a.survival.unmeasured < b.survival.unmeasured;
  const double more = a.survival.p_failure() - b.survival.p_failure();
  return std::abs(more) > kSame ? more < 0 : a.length_m < b.length_m - kSame_m;
}

// The risk's terrain as connected regions, by cell; -1: no terrain.
Grid<int> TerrainRegions(const RiskGrid& grid, int& regions) {
  Grid<int> of(grid.contents.width, grid.contents.height);
  std::ranges::fill(of.cells, -1);
  const Grid<std::uint8_t> terrain = CellsThat(grid, &RiskCell::terrain);
  regions = 0;
  for (std::size_t i = 0; i < of.cells.size(); ++i) {
    if (!terrain.cells[i] || of.cells[i] >= 0) continue;
    const Grid<std::int32_t> steps = StepsFrom(terrain, CellAt(of, i));
    for (std::size_t k = 0; k < of.cells.size(); ++k)
      if (steps.cells[k] >= 0) of.cells[k] = regions;
    ++regions;
  }
  return of;
}

class Search {
 public:
  Search(const PlanRequest& request, double min_coverage, double effort)
      : request_(request),
        rates_(request),
        cell_rates_(CellRates(request, rates_)),
        min_coverage_(min_coverage),
        effort_(effort) {}

  PlanResult Walk(RateWalk::Options options, const RiskMap* risk = nullptr) const {
    options.effort = effort_;
    PlanRequest request = request_;
    if (risk != nullptr) request.risk = risk;
    return RateWalk(cell_rates_, options).Plan(request);
  }

  void Consider(PlanResult plan) {
    if (plan.status != PlanStatus::kSuccess) return;
    Candidate candidate;
    plan.path = AtBestSpeeds(plan.path, request_, rates_);
    PlanResult driven = plan;
    FitTurns(request_, driven);
    if (driven.status != PlanStatus::kSuccess) return;
    candidate.survival = rates_.Of(driven.path);
    candidate.coverage = MeasureRisk(*request_.risk, driven.path).coverage;
    candidate.length_m = Length(driven.path);
    candidate.plan = std::move(plan);
    candidates_.push_back(std::move(candidate));
  }

  // Nothing can be saved but free floor: as of the first, covering all, and driven as it is.
  bool MeetsNothing() const {
    return request_.robot.turn_radius_m == 0 && !candidates_.empty() &&
           candidates_.front().survival.passages.empty();
  }

  void ConsiderOtherPlanners() {
    for (const PluginEntry<Planner>& entry : Planners()) {
      const std::unique_ptr<Planner> planner = entry.make();
      const PlannerPromises promises = planner->promises();
      if (promises.covers == PlannerPromises::Covers::kNothing || promises.needs_model ||
          promises.needs_goal || promises.uses_seed || promises.visits_places ||
          (request_.goal && !promises.ends_at_goal))
        continue;
      Consider(planner->Plan(request_));
    }
  }

  // Nothing where there is no candidate.
  const Candidate* Best() const {
    double most = 0;
    for (const Candidate& candidate : candidates_) most = std::max(most, candidate.coverage);
    const Candidate* best = nullptr;
    for (const Candidate& candidate : candidates_)
      if (candidate.coverage >= min_coverage_ * most - 1e-9)
        if (best == nullptr || Better(candidate, *best)) best = &candidate;
    return best;
  }

  // Walks that keep off what costs the best plan most, one region of terrain more at a time.
  void ConsiderLeavingOut(const RateWalk::Options& options) {
    constexpr std::size_t kMostTries = 12;
    int count = 0;
    const Grid<int> regions = TerrainRegions(request_.risk->grid, count);
    const Candidate* best = Best();
    if (best == nullptr || count == 0) return;
    const RiskOfPath visits = MeasureRisk(*request_.risk, best->plan.path);
    std::vector<std::pair<double, int>> costs;
    for (int r = 0; r < count; ++r) costs.emplace_back(0, r);
    for (std::size_t i = 0; i < regions.cells.size(); ++i)
      if (regions.cells[i] >= 0)
        costs[static_cast<std::size_t>(regions.cells[i])].first -=
            visits.visits_of.cells[i] * cell_rates_.cells[i];
    std::ranges::sort(costs);
    RiskMap closed = *request_.risk;
    for (std::size_t k = 0; k < std::min(kMostTries, costs.size()); ++k) {
      if (costs[k].first == 0) break;
      RiskMap tried = closed;
      for (std::size_t i = 0; i < regions.cells.size(); ++i)
        if (regions.cells[i] == costs[k].second) tried.grid.contents.cells[i].solid = true;
      const std::size_t before = candidates_.size();
      Consider(Walk(options, &tried));
      if (candidates_.size() > before && Best() == &candidates_.back()) closed = std::move(tried);
    }
  }

  std::size_t candidates() const { return candidates_.size(); }

 private:
  const PlanRequest& request_;
  PathRates rates_;
  Grid<double> cell_rates_;
  double min_coverage_, effort_;
  std::vector<Candidate> candidates_;
};

class SurvivalCoverage final : public Planner {
 public:
  void Visit(ParamVisitor& visit) override {
    visit("min_coverage", min_coverage_, Between(0, 1),
          "share of the most that can be covered below which nothing more is left out");
    visit("unreachable_share", unreachable_share_, Between(0, 1),
          "of the free cells that may be out of reach; with more of them the floor has fallen "
          "apart");
    visit("effort", effort_, Between(0, 100),
          "of each search for a walk; 1: half a second for 40,000 cells");
  }

  PlannerPromises promises() const override {
    return {.covers = PlannerPromises::Covers::kCells,
            .least_coverage = 0.8,
            .needs_risk = true,
            .needs_model = true,
            .ends_at_goal = true};
  }

  PlanResult Plan(const PlanRequest& request) const override {
    PlanResult refused;
    refused.clear = request.robot.clear;
    refused.tool = request.robot.tool;
    refused.tool_width_m = request.robot.tool_width_m;
    if (request.risk == nullptr || request.model == nullptr) {
      refused.message = request.risk == nullptr
                            ? "the floor's risk is not known"
                            : "the robot's rates of failure were not measured: the key risk.model "
                              "(floorproof measure)";
      return refused;
    }
    Search search(request, min_coverage_, effort_);
    RateWalk::Options options{.unreachable_share = unreachable_share_};
    PlanResult first = search.Walk(options);
    if (first.status != PlanStatus::kSuccess) return first;
    const std::string unreachable = first.message;
    const auto figures = first.figures;
    search.Consider(std::move(first));
    if (!search.MeetsNothing()) ConsiderAll(request, search);
    const Candidate* best = search.Best();
    if (best == nullptr) {
      refused.message = "the robot cannot turn into any of the plans that cover this floor";
      return refused;
    }
    return Stated(*best, request, unreachable, figures, search.candidates());
  }

 private:
  using Figures = std::vector<std::pair<std::string, double>>;

  void ConsiderAll(const PlanRequest& request, Search& search) const {
    search.ConsiderOtherPlanners();
    RateWalk::Options options{.unreachable_share = unreachable_share_};
    for (const bool fewest : {true, false})
      for (const TerrainLead lead :
           {TerrainLead::kAny, TerrainLead::kForward, TerrainLead::kSideways}) {
        options.fewest_crossings = fewest;
        options.lead = lead;
        const bool turns = HoldsYaw(request.robot);
        if ((fewest && lead == TerrainLead::kAny) || (!turns && lead != TerrainLead::kAny))
          continue;
        search.Consider(search.Walk(options));
      }
    options = {.unreachable_share = 1};
    search.ConsiderLeavingOut(options);
  }

  PlanResult Stated(const Candidate& best, const PlanRequest& request,
                    const std::string& unreachable, const Figures& of_cells,
                    std::size_t candidates) const {
    PlanResult result = best.plan;
    const RiskGrid& grid = request.risk->grid;
    const RiskOfPath visits = MeasureRisk(*request.risk, result.path);
    const Grid<std::int32_t> steps =
        StepsFrom(CellsThat(grid, &RiskCell::drivable), grid.frame.ToCell(request.start.p()));
    int free = 0;
    result.left_out_cells = 0;
    for (std::size_t i = 0; i < steps.cells.size(); ++i) {
      if (!grid.contents.cells[i].free() || steps.cells[i] < 0) continue;
      ++free;
      result.left_out_cells += visits.visits_of.cells[i] == 0;
    }
    result.message = unreachable;
    if (result.left_out_cells > 0)
      result.message += (result.message.empty() ? "" : "; ") +
                        ("left out for their risk: " + std::to_string(result.left_out_cells)) +
                        " of " + std::to_string(free) + " free cells";
    const Probability& none = best.survival.survival.no_failure;
    result.figures = of_cells;
    result.figures.insert(result.figures.end(),
                          {{"p_failure", 1 - none.value},
                           {"p_failure_lower", 1 - none.upper},
                           {"p_failure_upper", 1 - none.lower},
                           {"cell_coverage", best.coverage},
                           {"crossings", best.survival.crossings},
                           {"unmeasured_crossings", best.survival.unmeasured},
                           {"beyond_measured", best.survival.survival.farthest_beyond()},
                           {"candidates", static_cast<double>(candidates)}});
    return result;
  }

  double min_coverage_ = 1, unreachable_share_ = 0.05, effort_ = 1;
};

}  // namespace

FP_DEFINE_PLUGIN(Planner, SurvivalCoverage)

}  // namespace floorproof
