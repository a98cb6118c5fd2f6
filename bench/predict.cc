// SPDX-License-Identifier: Apache-2.0
// What a prediction costs beside planning: a hall of 38 m x 29 m with 120 hazards, which BELUGA
// covers in about 3,600 m; 256 drawn conditions. Seconds of one core.
//   bench_predict MODEL      MODEL: BELUGA's risk_model.json
#include <fmt/format.h>

#include <string>
#include <vector>

#include "base/streams.h"
#include "bench/cpu_time.h"
#include "run/episode/make_plan.h"
#include "run/plan_check/prediction.h"
#include "run/scenario/scenario_file.h"

namespace floorproof {
namespace {

std::string Hall(const std::string& model) {
  constexpr int kWidth = 76, kHeight = 58, kHazards = 120, kLong = 3;
  std::vector<std::string> rows(kHeight, "#" + std::string(kWidth - 2, '.') + "#");
  rows.front() = rows.back() = std::string(kWidth, '#');
  Stream random(0, 0, "bench_predict");
  for (int i = 0; i < kHazards; ++i) {
    const std::size_t x = 5 + random.Below(kWidth - 13), y = 5 + random.Below(kHeight - 10);
    for (std::size_t k = 0; k < kLong; ++k) rows[y][x + k] = "=gr"[i % 3];
  }
  std::string text =
      "scenario: 1\nsite:\n  site: 1\n  name: hall\n  grid:\n    cell_m: 0.5\n    rows: |\n";
  for (const std::string& row : rows) text += "      " + row + "\n";
  return text +
         "  floor: {friction: 0.6}\n  start: {x_m: 1.2, y_m: 1.2, yaw_deg: 0}\nrobot: "
         "beluga\nrisk: {model: \"" +
         model +
         "\"}\nplan: {planner: boustrophedon}\nrandomise:\n  site.floor.friction: {uniform: [0.35, "
         "0.9]}\n  robot.mass_kg: {uniform: [11, 13]}\n";
}

void Main(const std::string& model) {
  constexpr int kDraws = 256;
  const ScenarioFile file = ScenarioFile::FromText(Hall(model), "bench_predict.yaml", {});
  const Variant& variant = file.variants().front();
  const Scenario scenario = file.Read(0, variant);  // the model is kept: it is read once
  const double begin_s = CpuSeconds();
  const PlanResult plan = MakePlan(scenario);
  const double plan_s = CpuSeconds() - begin_s;
  const Prediction prediction = Predict(file, variant, kDraws);
  const double predict_s = CpuSeconds() - begin_s - 2 * plan_s;
  fmt::print("{:.0f} m, {} meetings, {} conditions: {:.2f} s beside {:.2f} s of planning, {:.2f}\n",
             Length(plan.path), prediction.meetings.size(), prediction.conditions, predict_s,
             plan_s, predict_s / plan_s);
}

}  // namespace
}  // namespace floorproof

int main(int argc, char** argv) {
  if (argc != 2) return fmt::print(stderr, "bench_predict MODEL\n"), 2;
  try {
    floorproof::Main(argv[1]);
  } catch (const floorproof::InputError& error) {
    fmt::print(stderr, "bench_predict: {}\n", error.what());
    return 2;
  }
}
