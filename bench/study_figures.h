// SPDX-License-Identifier: Apache-2.0
// What a study of predictions has shown, as a page and a chart.
#pragma once

#include <filesystem>
#include <map>
#include <span>
#include <string>

namespace floorproof {

struct DrivenPlan {
  int site = 0;
  std::string planner;
  int k = 0, n = 0;                         // failed, driven
  std::map<std::string, double> predicted;  // P(failure) by predictor; kModelPredictor is ours
  // By failure mode, and by kind of meeting, the probability that it ends a drive, as the model
  // predicts; and how many drives it ended.
  std::map<std::string, double> predicted_modes, predicted_kinds;
  std::map<std::string, int> modes, kinds;
};
inline constexpr const char* kModelPredictor = "measured rates";

// Tables in Markdown: the figures of each predictor with their intervals and what right predictions
// would show; how many sites the model wins; failures predicted and seen, by mode, kind, planner.
std::string StudyFigures(std::span<const DrivenPlan> plans);

// A panel a predictor.
void WriteReliabilityDiagram(std::span<const DrivenPlan> plans, const std::filesystem::path& png);

}  // namespace floorproof
