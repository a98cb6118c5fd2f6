// SPDX-License-Identifier: Apache-2.0
#include "report/pictures.h"

#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <iterator>
#include <utility>

#include "base/quantity.h"
#include "report/cell_picture.h"
#include "report/coverage_plot.h"
#include "report/dirt_pictures.h"
#include "report/drawing_progress.h"
#include "report/drive_marks.h"
#include "report/error_plot.h"
#include "report/risk_pictures.h"
#include "report/safety_timeline.h"
#include "run/scenario/floors.h"
#include "run/scenario/scenario.h"

namespace floorproof {
namespace {

HeatValues OverSweepable(const EpisodeRecord& record, float (*value)(std::uint8_t passes)) {
  HeatValues heat{record.passes_frame,
                  Grid<float>(record.passes.width, record.passes.height, HeatValues::kNone)};
  for (std::size_t i = 0; i < heat.values.cells.size(); ++i)
    if (record.sweepable.cells[i]) heat.values.cells[i] = value(record.passes.cells[i]);
  return heat;
}

// What the robot's own map says, and where it is wrong: by more than a cell of its own or of the
// site, which walls are drawn to.
void WriteKnownMap(const World& world, const EpisodeRecord& record,
                   const std::filesystem::path& png) {
  const KnownMap& known = *record.known;
  const KnownAgainstTruth seen =
      Compare(known, TrueFloor(world), world.robot.spec.step_m, 2 * known.frame.cell_m);
  HeatMapOptions options;
  options.title = fmt::format("{}: known {:.1f} %, of it wrong {:.1f} %", PictureTitle(world),
                              100 * seen.known, 100 * seen.wrong);
  // In the order of KnownAgainstTruth::State.
  options.categories = {{"unknown", {176, 182, 190}},
                        {"known free", {232, 240, 246}},
                        {"known occupied", {38, 84, 124}},
                        {"wrong: taken for free", {214, 40, 57}},
                        {"wrong: taken for occupied", {247, 160, 40}}};
  for (const FloorMark& mark : known.marks)
    options.points.push_back(
        {mark.p_W, mark.kind == FloorMark::Kind::kDrop ? "drop sensed" : "bump sensed"});
  ShowDrive(record, Way::kHidden, options);
  HeatValues heat{known.frame, Grid<float>(seen.cells.width, seen.cells.height)};
  for (std::size_t i = 0; i < heat.values.cells.size(); ++i)
    heat.values.cells[i] = static_cast<float>(seen.cells.cells[i]);
  HazardMap bare = world.site.map;  // the walls shown are those that were sensed
  std::ranges::fill(bare.occupancy.cells, CellState::kFree);
  WriteHeatMap(bare, &heat, options, png);
}

void WriteVisits(const World& world, const EpisodeRecord& record,
                 const std::filesystem::path& png) {
  HeatMapOptions options;
  options.title = PictureTitle(world) + ": visits";
  options.quantity = "passes of the tool";
  options.unit = "count";
  options.whole_numbers = true;
  options.low = 0;
  ShowDrive(record, Way::kHidden, options);
  const HeatValues heat =
      OverSweepable(record, [](std::uint8_t passes) { return static_cast<float>(passes); });
  WriteHeatMap(world.site.map, &heat, options, png);
}

void WriteCoverage(const World& world, const EpisodeRecord& record,
                   const std::filesystem::path& png) {
  HeatMapOptions options;
  options.title =
      fmt::format("{}: coverage {:.1f} %", PictureTitle(world), 100 * record.metrics.coverage);
  // Apart for eyes that see red and green alike, too.
  options.categories = {{"can be swept, was not", {236, 176, 70}}, {"swept", {112, 168, 196}}};
  ShowDrive(record, Way::kHidden, options);
  const HeatValues heat =
      OverSweepable(record, [](std::uint8_t passes) { return passes > 0 ? 1.0f : 0.0f; });
  WriteHeatMap(world.site.map, &heat, options, png);
}

}  // namespace

std::string PictureTitle(const World& world) {
  return world.robot.spec.name + " on " + world.site.map.name;
}

void WriteHeatMaps(const Scenario& s, const PlanResult& plan, const EpisodeRecord& record,
                   const std::filesystem::path& folder, const Console& console) {
  const std::function<void()> pictures[] = {
      [&] { WritePlanPictures(s, plan, folder, {}, &record); },
      [&] { WriteVisits(s.world, record, folder / "heatmap_visits.png"); },
      [&] { WriteCoverage(s.world, record, folder / "heatmap_coverage.png"); },
      [&] {
        HeatMapOptions options;
        options.plan = &plan.path;
        ShowDrive(record, Way::kShown, options);
        WriteFailurePlaces(s.world.site.map, PictureTitle(s.world), std::move(options), nullptr,
                           folder / "heatmap_failures.png");
      },
      [&] {
        if (record.known) WriteKnownMap(s.world, record, folder / "heatmap_known.png");
      },
      [&] {
        if (s.spec.plan_by == PlanBy::kOnline)
          WriteCellPicture(s, record, folder / "heatmap_cells.png");
      },
      [&] {
        if (s.spec.plan_by == PlanBy::kOnline)
          WriteCoveragePlot(PictureTitle(s.world), record, folder / "plot_coverage.png");
      },
      [&] {
        if (record.audit) WriteDirt(s.world, plan, *record.audit, folder / "heatmap_dirt.png");
      },
      [&] {
        if (record.audit && !record.audit->samples.empty())
          WriteTapes(s.world, plan, *record.audit, folder / "plot_tapes.png");
      },
      [&] {
        if (s.spec.safety && record.steps > 0)
          WriteSafetyTimeline(s, record, folder / "plot_safety.png");
      },
      [&] {  // an ideal robot has none
        if (s.spec.episode.drive == "physics")
          WriteErrorPlot(PictureTitle(s.world), record, folder / "plot_errors.png");
      }};
  DrawingProgress progress(console, "drawing maps");
  int done = 0;
  for (const auto& draw : pictures) {
    progress.Show(done++, static_cast<int>(std::size(pictures)));
    draw();
  }
}

void WriteFailurePlaces(const HazardMap& map, const std::string& title, HeatMapOptions options,
                        const HeatValues* rates, const std::filesystem::path& png) {
  const std::size_t n = options.failures.size();
  options.title = fmt::format("{}: {}", title, CountText(n, "failure event"));
  if (rates != nullptr) {
    options.quantity = "episodes failing here";
    options.unit = "%";
    options.low = 0;
  }
  WriteHeatMap(map, rates, options, png);
}

}  // namespace floorproof
