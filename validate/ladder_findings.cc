// SPDX-License-Identifier: Apache-2.0
#include "validate/ladder_findings.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace floorproof {
namespace {

constexpr double kFriction = 0.8;
constexpr double kDisagreement = 0.2;  // of two wheel models' limits that is worth a line
constexpr double kTrustedShare = 0.8;  // of a limit that a robot should be trusted with

const LadderRow* Find(std::span<const LadderRow> rows, const LadderCell& cell) {
  for (const LadderRow& row : rows)
    if (row.cell.robot == cell.robot && row.cell.wheels == cell.wheels &&
        row.cell.hazard == cell.hazard && row.cell.direction == cell.direction &&
        row.cell.speed_mps == cell.speed_mps && row.cell.friction == cell.friction &&
        row.cell.oblique_deg == cell.oblique_deg && row.cell.run_up_m == cell.run_up_m)
      return &row;
  return nullptr;
}

std::string Sentence(const WheelDisagreement& wheels) {
  const LadderCell& cell = wheels.ideal.cell;
  return fmt::format(
      "ideal wheels and rollers part by more than {:.0f} %: {} {} {} {} m/s, friction {}: {} and "
      "{} {}",
      100 * kDisagreement, cell.robot, cell.hazard, Name(cell.direction), cell.speed_mps,
      cell.friction, LimitText(wheels.ideal), LimitText(wheels.rollers),
      FindLadderHazard(cell.hazard).unit);
}

std::string StepSentence(const std::string& robot, double crossed_m) {
  const double model_m = ReadRobot(FindRobotFile(robot, {})).spec.step_m;
  return fmt::format(
      "{}: level changes up to {:.1f} mm are crossed every way at every speed on friction 0.8; its "
      "step_m is {:.1f} mm, {:.0f} % of the limit {:.1f} mm",
      robot, 1000 * crossed_m, 1000 * model_m, 100 * kTrustedShare,
      1000 * kTrustedShare * crossed_m);
}

}  // namespace

std::vector<CoverGap> CoverGaps(std::span<const LadderRow> rows) {
  std::vector<CoverGap> gaps;
  for (const LadderRow& forward : rows) {
    if (forward.cell.hazard != "cable_cover" || forward.cell.direction != Direction::kForward)
      continue;
    LadderCell aside = forward.cell;
    aside.direction = Direction::kSideways;
    const LadderRow* sideways = Find(rows, aside);
    if (sideways && !sideways->above_all && sideways->limit < forward.limit)
      gaps.push_back({forward.cell, sideways->limit, forward.limit});
  }
  return gaps;
}

std::string Sentence(const CoverGap& gap) {
  return fmt::format(
      "{}, wheels {}, {} m/s, friction {}: a 20 mm cable cover with flanks from {} to {} deg is "
      "crossed forward and holds the robot when met sideways",
      gap.cell.robot, gap.cell.wheels, gap.cell.speed_mps, gap.cell.friction, gap.from_deg,
      gap.to_deg);
}

std::vector<WheelDisagreement> WheelDisagreements(std::span<const LadderRow> rows, double share) {
  std::vector<WheelDisagreement> found;
  for (const LadderRow& rollers : rows) {
    if (rollers.cell.wheels != "rollers") continue;
    LadderCell cell = rollers.cell;
    cell.wheels = "ideal";
    const LadderRow* ideal = Find(rows, cell);
    if (ideal &&
        std::abs(ideal->limit - rollers.limit) > share * std::max(ideal->limit, rollers.limit))
      found.push_back({*ideal, rollers});
  }
  return found;
}

std::optional<double> TrustedStep(std::span<const LadderRow> rows, std::string_view robot) {
  std::optional<double> least_mm;
  for (const LadderRow& row : rows) {
    const LadderCell& cell = row.cell;
    if (cell.robot != robot || cell.friction != kFriction ||
        (cell.hazard != "step" && cell.hazard != "drop"))
      continue;
    least_mm = std::min(least_mm.value_or(row.limit), row.limit);
  }
  if (!least_mm) return {};
  return *least_mm / 1000;
}

std::vector<std::string> ObliqueFindings(std::span<const LadderRow> rows) {
  std::vector<std::string> sentences;
  const LadderCell* last = nullptr;
  for (const LadderRow& row : rows) {
    const LadderCell& cell = row.cell;
    if (last == nullptr || last->robot != cell.robot || last->hazard != cell.hazard ||
        last->direction != cell.direction)
      sentences.push_back(fmt::format("{} {} {}, {}:", cell.robot, cell.hazard,
                                      Name(cell.direction), FindLadderHazard(cell.hazard).unit));
    const bool afar = cell.run_up_m != LadderCell{}.run_up_m;
    sentences.back() += fmt::format(" {} at {} deg{}", LimitText(row), cell.oblique_deg,
                                    afar ? fmt::format(" from {} m away", cell.run_up_m) : "");
    last = &cell;
  }
  return sentences;
}

std::vector<std::string> Findings(std::span<const LadderRow> rows) {
  std::vector<std::string> sentences;
  for (const CoverGap& gap : CoverGaps(rows))
    if (gap.cell.friction == kFriction) sentences.push_back(Sentence(gap));
  for (const WheelDisagreement& wheels : WheelDisagreements(rows, kDisagreement))
    sentences.push_back(Sentence(wheels));
  for (const RobotEntry& robot : Robots())
    if (const auto crossed_m = TrustedStep(rows, robot.name))
      sentences.push_back(StepSentence(std::string(robot.name), *crossed_m));
  return sentences;
}

}  // namespace floorproof
