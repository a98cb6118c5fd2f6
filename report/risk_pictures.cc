// SPDX-License-Identifier: Apache-2.0
#include "report/risk_pictures.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/quantity.h"
#include "render/chart.h"
#include "render/heatmap.h"
#include "report/audit_pictures.h"
#include "report/drive_marks.h"
#include "report/pictures.h"
#include "run/episode/make_plan.h"
#include "run/scenario/scenario_file.h"

namespace floorproof {
namespace {

constexpr Rgb kCells = {196, 201, 208};
constexpr std::array<Rgb, 5> kPlans = {
    {{0, 114, 178}, {213, 94, 0}, {0, 158, 115}, {204, 121, 167}, {86, 180, 233}}};

// A value for each of the risk's cells, by its index.
template <class Value>
HeatValues OnRiskCells(const RiskMap& risk, Value value) {
  HeatValues heat{risk.grid.frame, Grid<float>(risk.rf.width, risk.rf.height, HeatValues::kNone)};
  for (std::size_t i = 0; i < heat.values.cells.size(); ++i)
    heat.values.cells[i] = value(i, risk.grid.contents.cells[i]);
  return heat;
}

// What the picture is of; without a plan it says so.
std::string Title(const World& world, const PlanResult& plan, const std::string& what) {
  const std::string title = PictureTitle(world) + ": ";
  if (plan.status == PlanStatus::kOnline) return title + "drive";
  return plan.status == PlanStatus::kSuccess
             ? title + what
             : fmt::format("{}no plan ({})", title, Name(plan.status));
}

void WritePlanOverClasses(const Scenario& s, const PlanResult& plan, const EpisodeRecord* record,
                          const std::filesystem::path& png) {
  HeatMapOptions options;
  options.title = Title(s.world, plan, record == nullptr ? "plan" : "plan and drive");
  options.plan = &plan.path;
  if (record != nullptr) ShowDrive(*record, Way::kShown, options);
  if (!AsksForRisk(s.spec)) {  // whose cells are as wide as the robot, and no hazards
    WriteHeatMap(s.world.site.map, nullptr, options, png);
    return;
  }
  for (const auto c : {HazardClass::kBlindObject, HazardClass::kGlass, HazardClass::kLevelChange,
                       HazardClass::kTerrain})
    options.categories.push_back(CellsOf(c));
  const HeatValues classes = OnRiskCells(*plan.risk, [&](std::size_t, const RiskCell& cell) {
    return cell.hazard ? static_cast<float>(*cell.hazard) : HeatValues::kNone;
  });
  if (std::ranges::any_of(classes.values.cells, [](float v) { return std::isfinite(v); }))
    options.quantity = "cells with hazards";
  WriteHeatMap(s.world.site.map, &classes, options, png);
}

void WriteRiskMap(const World& world, const PlanResult& plan, const EpisodeRecord* record,
                  const std::filesystem::path& png) {
  HeatMapOptions options;
  if (record != nullptr) ShowDrive(*record, Way::kHidden, options);
  const auto [least, most] = std::ranges::minmax(plan.risk->rf.cells);
  options.title = PictureTitle(world) + ": risk";
  if (least > 0) options.title += fmt::format(", highest / lowest {:.2f}", most / least);
  options.quantity = "risk factor (RF)";
  options.colour_map = ColourMap::kInferno;
  const HeatValues rf = OnRiskCells(*plan.risk, [&](std::size_t i, const RiskCell& cell) {
    return cell.outer_wall() ? HeatValues::kNone : static_cast<float>(plan.risk->rf.cells[i]);
  });
  WriteHeatMap(world.site.map, &rf, options, png);
}

void WritePlanVisits(const World& world, const PlanResult& plan, const RiskOfPath& risk,
                     const EpisodeRecord* record, const std::filesystem::path& png) {
  HeatMapOptions options;
  if (record != nullptr) ShowDrive(*record, Way::kHidden, options);
  options.title = Title(world, plan, fmt::format("{} visits of {} cells", risk.visits, risk.cells));
  options.quantity = "visits by the plan";
  options.unit = "count";
  options.whole_numbers = true;
  options.numbers = true;
  options.low = 0;
  options.plan = &plan.path;
  // A path from elsewhere may touch cells that count as solid.
  const HeatValues visits = OnRiskCells(*plan.risk, [&](std::size_t i, const RiskCell& cell) {
    const int n = risk.visits_of.cells[i];
    return cell.solid && n == 0 ? HeatValues::kNone : static_cast<float>(n);
  });
  WriteHeatMap(world.site.map, &visits, options, png);
}

std::string Figures(const RiskOfPath& risk) {
  return fmt::format("CRF {:.1f}, {} visits of {} cells, hazard-free {:.1f} %, {}",
                     risk.cumulative_risk, risk.visits, risk.cells, 100 * risk.coverage,
                     CountText(risk.terrain_crossings, "terrain crossing"));
}

std::string Against(const RiskOfPath& first, const RiskOfPath& risk) {
  if (&risk == &first || first.cumulative_risk <= 0) return "";
  return fmt::format(" (CRF {:+.1f} %)", 100 * (risk.cumulative_risk / first.cumulative_risk - 1));
}

// What the ranges span, and the decimals that tell their ends apart. Where RF is the same all over,
// all cells are in the first range.
struct Spans {
  explicit Spans(const std::vector<RiskOfPath::Range>& of) {
    if (of.empty()) return;
    low = of.front().low;
    if (!(of.back().high > low)) return;
    count = of.size();
    width = (of.back().high - low) / static_cast<double>(count);
    decimals = std::max(0, 1 - static_cast<int>(std::floor(std::log10(width))));
  }
  double low = 0, width = 0.2;
  std::size_t count = 1;
  int decimals = 3;
};

bool SameFloor(const RiskOfPath& a, const RiskOfPath& b) {
  return std::ranges::equal(a.ranges, b.ranges, [](const auto& x, const auto& y) {
    return x.low == y.low && x.high == y.high && x.cells == y.cells;
  });
}

}  // namespace

RiskOfPlan MeasurePlan(const ScenarioSpec& spec, const PlanResult& plan) {
  return {spec.planner_name.empty() ? spec.plan_file.filename().string() : spec.planner_name,
          MeasureRisk(*plan.risk, plan.path)};
}

std::vector<RiskOfPlan> PlansBeside(const std::vector<std::string>& files,
                                    const std::vector<Override>& overrides, const RiskOfPlan& first,
                                    Trust trust, const Console& console) {
  std::vector<RiskOfPlan> plans;
  for (const std::string& file : files) {
    const Scenario scenario = ReadScenario(file, overrides, trust);
    if (const std::string line = ProgramAnnounced(scenario); !line.empty()) console.Say(line);
    const PlanResult plan = MakePlan(scenario);
    if (plan.status != PlanStatus::kSuccess)
      throw InputError({file, 0}, "", "", "has no plan: " + plan.message);
    plans.push_back(MeasurePlan(scenario.spec, plan));
    if (plans.back().label == first.label) plans.back().label += " of " + scenario.spec.name;
    if (!SameFloor(first.risk, plans.back().risk))
      throw InputError(
          {file, 0}, "", "",
          "has another floor, robot or risk: its plan cannot stand beside the first's");
  }
  return plans;
}

void WritePlanPictures(const Scenario& s, const PlanResult& plan,
                       const std::filesystem::path& folder, std::span<const RiskOfPlan> beside,
                       const EpisodeRecord* record) {
  WritePlanOverClasses(s, plan, record, folder / "heatmap_plan.png");
  if (!plan.samples.empty())
    WriteSamples(PictureTitle(s.world), s.world.site.map, plan, folder / "heatmap_samples.png");
  if (!plan.convergence_m.empty())
    WriteConvergence(PictureTitle(s.world), plan, folder / "plot_convergence.png");
  if (!AsksForRisk(s.spec) && beside.empty()) return;
  std::vector<RiskOfPlan> plans = {MeasurePlan(s.spec, plan)};
  WriteRiskMap(s.world, plan, record, folder / "heatmap_risk.png");
  WritePlanVisits(s.world, plan, plans.front().risk, record, folder / "heatmap_plan_visits.png");
  plans.insert(plans.end(), beside.begin(), beside.end());
  WriteRiskPlot(Title(s.world, plan, "visits by risk"), plans, folder / "plot_risk.png");
}

void WriteRiskPlot(const std::string& title, std::span<const RiskOfPlan> plans,
                   const std::filesystem::path& png) {
  const Spans spans(plans.front().risk.ranges);
  const double bar = 0.84 * spans.width / static_cast<double>(plans.size() + 1);
  const bool alone = plans.size() == 1;
  ChartPanel panel;
  panel.title = alone ? Figures(plans.front().risk) : "Compared with " + plans.front().label;
  panel.subtitle =
      "visits of cells of that risk, and how many such cells there are; CRF: RF summed over visits";
  panel.x_label =
      spans.count > 1 ? "risk factor (RF), in ten equal ranges" : "risk factor (RF), of all cells";
  panel.x_decimals = spans.decimals;
  panel.whole_numbers = true;
  for (std::size_t r = 0; r < spans.count + (spans.count > 1); ++r)
    panel.x_ticks.push_back(spans.low + spans.width * static_cast<double>(r));

  Chart chart;
  chart.title = title;
  chart.plot_width_px = 1000;
  const auto add = [&](const Rgb& colour, const std::string& label, const auto& count) {
    ChartSeries series;
    series.style.colour = colour;
    series.style.bar = bar;
    series.values = true;
    const auto nth = static_cast<double>(panel.series.size());
    const double aside = bar * (nth - 0.5 * static_cast<double>(plans.size()));
    const double middle = spans.count > 1 ? 0.5 : 0;
    for (std::size_t r = 0; r < spans.count; ++r)
      series.points.push_back(
          {spans.low + spans.width * (static_cast<double>(r) + middle) + aside, count(r), false});
    chart.legend.push_back({{label, series.style}});
    panel.series.push_back(std::move(series));
  };
  const auto& ranges = plans.front().risk.ranges;
  add(kCells, "each cell visited once",
      [&](std::size_t r) { return r < ranges.size() ? 1.0 * ranges[r].cells : 0.0; });
  for (std::size_t p = 0; p < plans.size(); ++p) {
    const RiskOfPath& risk = plans[p].risk;
    add(kPlans[p % kPlans.size()],
        alone ? "visits: " + plans[p].label
              : plans[p].label + ": " + Figures(risk) + Against(plans.front().risk, risk),
        [&](std::size_t r) { return r < risk.ranges.size() ? 1.0 * risk.ranges[r].visits : 0.0; });
  }
  chart.panels.push_back(std::move(panel));
  WriteChart(chart, png);
}

}  // namespace floorproof
