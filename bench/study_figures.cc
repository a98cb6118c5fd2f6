// SPDX-License-Identifier: Apache-2.0
#include "bench/study_figures.h"

#include <fmt/format.h>

#include <set>
#include <vector>

#include "measure/judge_predictions.h"
#include "render/chart.h"

namespace floorproof {
namespace {

std::set<std::string> Predictors(std::span<const DrivenPlan> plans) {
  std::set<std::string> names;
  for (const DrivenPlan& plan : plans)
    for (const auto& [name, p] : plan.predicted) names.insert(name);
  return names;
}

std::vector<JudgedPlan> JudgedOf(std::span<const DrivenPlan> plans, const std::string& predictor) {
  std::vector<JudgedPlan> judged;
  for (const DrivenPlan& plan : plans)
    judged.push_back({plan.site, {plan.predicted.at(predictor), plan.k, plan.n}});
  return judged;
}

std::string Text(const std::optional<double>& value) {
  return value ? fmt::format("{:.3f}", *value) : "-";
}

std::string FigureTable(std::span<const DrivenPlan> plans, const std::string& predictor) {
  const PredictionJudgement judged = JudgePredictions(JudgedOf(plans, predictor));
  std::string text = fmt::format(
      "\n## {}\n\n{} sites, {} plans, {} drives, {} failed\n\n| figure | seen | 95 % | if right | "
      "95 % "
      "|\n|---|---|---|---|---|\n",
      predictor, judged.sites, judged.plans, judged.drives, judged.failures);
  for (const auto& [name, figure] : kPredictionFigures)
    text += fmt::format("| {} | {} | {} to {} | {} | {} to {} |\n", name,
                        Text(judged.seen.value.*figure), Text(judged.seen.lower.*figure),
                        Text(judged.seen.upper.*figure), Text(judged.right.value.*figure),
                        Text(judged.right.lower.*figure), Text(judged.right.upper.*figure));
  return text;
}

std::string WonTable(std::span<const DrivenPlan> plans) {
  std::string text = fmt::format(
      "\n## Sites on which {} have the better log score\n\n| than | better | worse | of sites | "
      "share, "
      "95 % |\n|---|---|---|---|---|\n",
      kModelPredictor);
  const std::vector<JudgedPlan> ours = JudgedOf(plans, kModelPredictor);
  for (const std::string& predictor : Predictors(plans)) {
    if (predictor == kModelPredictor) continue;
    const SitesWon won = CompareBySite(ours, JudgedOf(plans, predictor));
    text += fmt::format("| {} | {} | {} | {} | {:.2f} to {:.2f} |\n", predictor, won.a, won.b,
                        won.sites, won.share_of_a.lower, won.share_of_a.upper);
  }
  return text;
}

// Drives ended by something: as predicted, and as seen.
struct Ended {
  double predicted = 0;
  int seen = 0;
};

std::string EndedTable(const char* by, const std::map<std::string, Ended>& rows) {
  std::string text = fmt::format("\n| {} | drives predicted to end | seen |\n|---|---|---|\n", by);
  for (const auto& [name, ended] : rows)
    text += fmt::format("| {} | {:.1f} | {} |\n", name, ended.predicted, ended.seen);
  return text;
}

}  // namespace

std::string StudyFigures(std::span<const DrivenPlan> plans) {
  std::string text;
  for (const std::string& predictor : Predictors(plans)) text += FigureTable(plans, predictor);
  text += WonTable(plans);
  std::map<std::string, Ended> modes, kinds, planners;
  for (const DrivenPlan& plan : plans) {
    for (const auto& [name, p] : plan.predicted_modes) modes[name].predicted += plan.n * p;
    for (const auto& [name, p] : plan.predicted_kinds) kinds[name].predicted += plan.n * p;
    for (const auto& [name, k] : plan.modes) modes[name].seen += k;
    for (const auto& [name, k] : plan.kinds) kinds[name].seen += k;
    planners[plan.planner].predicted += plan.n * plan.predicted.at(kModelPredictor);
    planners[plan.planner].seen += plan.k;
  }
  text += "\n## What ends drives\n";
  return text + EndedTable("failure", modes) + EndedTable("meeting", kinds) +
         EndedTable("planner", planners);
}

void WriteReliabilityDiagram(std::span<const DrivenPlan> plans, const std::filesystem::path& png) {
  const ChartStyle right{
      .colour = {150, 150, 150}, .stroke = ChartStyle::Stroke::kDashed, .marks = false};
  const ChartStyle bounds{
      .colour = {90, 140, 200}, .stroke = ChartStyle::Stroke::kSolid, .marks = false};
  const ChartStyle seen{.colour = {20, 60, 130}, .stroke = ChartStyle::Stroke::kNone};
  Chart chart;
  chart.title = "Predicted and seen failures";
  for (const std::string& predictor : Predictors(plans)) {
    ChartPanel panel;
    panel.title = predictor;
    panel.subtitle = "share of drives that failed";
    panel.x_label = "predicted probability of failure";
    panel.x_ticks = {0, 0.2, 0.4, 0.6, 0.8, 1};
    panel.y_end = 1;
    panel.series.push_back({.style = right, .points = {{0, 0}, {1, 1}}});
    ChartSeries points;
    points.style = seen;
    for (const ReliabilityPoint& point : ReliabilityPoints(JudgedOf(plans, predictor))) {
      const double share = static_cast<double>(point.k) / point.n;
      panel.series.push_back(
          {.style = bounds,
           .points = {{point.predicted, point.share.lower}, {point.predicted, point.share.upper}}});
      points.points.push_back({point.predicted, share});
    }
    panel.series.push_back(std::move(points));
    chart.panels.push_back(std::move(panel));
  }
  chart.legend = {{{"drives in a tenth of predictions", seen},
                   {"exact 95 % interval", bounds},
                   {"right", right}}};
  WriteChart(chart, png);
}

}  // namespace floorproof
