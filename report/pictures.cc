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
#include "report/drawing_progress.h"
#include "report/drive_marks.h"
#include "report/error_plot.h"
#include "report/risk_pictures.h"
#include "run/scenario/floors.h"

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
void WriteKnownMap(const Scenario& s, const EpisodeRecord& record,
                   const std::filesystem::path& png) {
  const KnownMap& known = *record.known;
  const KnownAgainstTruth seen =
      Compare(known, TrueFloor(s), s.robot.spec.step_m, 2 * known.frame.cell_m);
  HeatMapOptions options;
  options.title = fmt::format("{}: known {:.1f} %, of it wrong {:.1f} %", PictureTitle(s),
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
  HazardMap bare = s.site.map;  // the walls shown are those that were sensed
  std::ranges::fill(bare.occupancy.cells, CellState::kFree);
  WriteHeatMap(bare, &heat, options, png);
}

void WriteVisits(const Scenario& s, const EpisodeRecord& record, const std::filesystem::path& png) {
  HeatMapOptions options;
  options.title = PictureTitle(s) + ": visits";
  options.quantity = "passes of the tool";
  options.unit = "count";
  options.whole_numbers = true;
  options.low = 0;
  ShowDrive(record, Way::kHidden, options);
  const HeatValues heat =
      OverSweepable(record, [](std::uint8_t passes) { return static_cast<float>(passes); });
  WriteHeatMap(s.site.map, &heat, options, png);
}

void WriteCoverage(const Scenario& s, const EpisodeRecord& record,
                   const std::filesystem::path& png) {
  HeatMapOptions options;
  options.title =
      fmt::format("{}: coverage {:.1f} %", PictureTitle(s), 100 * record.metrics.coverage);
  // Apart for eyes that see red and green alike, too.
  options.categories = {{"can be swept, was not", {236, 176, 70}}, {"swept", {112, 168, 196}}};
  ShowDrive(record, Way::kHidden, options);
  const HeatValues heat =
      OverSweepable(record, [](std::uint8_t passes) { return passes > 0 ? 1.0f : 0.0f; });
  WriteHeatMap(s.site.map, &heat, options, png);
}

// A quick film of a failure: what led to it, and what came of it.
void MakeDraft(const EpisodeRecord& record, const std::vector<FailureMode>& modes,
               FilmOptions& options) {
  constexpr int kWidth = 640;
  constexpr double kFps = 15;
  if (options.width > kWidth) {
    options.height = std::max(64, options.height * kWidth / options.width) & ~1;
    options.width = kWidth;
  }
  options.pace.fps = std::min(options.pace.fps, kFps);
  options.pace.before_s = 6;
  options.pace.after_s = 2;
  options.quality = RenderQuality::kDraft;
  for (const FailureMode mode : modes) {
    const auto first = std::ranges::find(record.events, mode, &Event::mode);
    if (first != record.events.end()) options.only_around_s.push_back(first->t_s);
  }
  std::ranges::sort(options.only_around_s);
}

// Where no single event says how it ended.
Banner ClosingBanner(const EpisodeRecord& record) {
  const std::string covered = fmt::format("covered {:.1f} %", 100 * record.metrics.coverage);
  if (record.outcome == Outcome::kSuccess)
    return {Banner::Tone::kSuccess, "SUCCESS", covered + " without a failure"};
  if (record.interventions.empty())
    return {Banner::Tone::kWarning, std::string(Name(record.outcome)), record.message};
  const std::size_t times = record.interventions.size();
  return {Banner::Tone::kFailure, fmt::format("FAILURE   helped {}", CountText(times, "time")),
          record.message.empty() ? covered : covered + ";  " + record.message};
}

}  // namespace

std::string PictureTitle(const Scenario& s) { return s.robot_name + " on " + s.site.map.name; }

void WriteHeatMaps(const Scenario& s, const PlanResult& plan, const EpisodeRecord& record,
                   const std::filesystem::path& folder, const Console& console) {
  const std::function<void()> pictures[] = {
      [&] { WritePlanPictures(s, plan, folder, {}, &record); },
      [&] { WriteVisits(s, record, folder / "heatmap_visits.png"); },
      [&] { WriteCoverage(s, record, folder / "heatmap_coverage.png"); },
      [&] {
        HeatMapOptions options;
        options.plan = &plan.path;
        ShowDrive(record, Way::kShown, options);
        WriteFailurePlaces(s.site.map, PictureTitle(s), std::move(options), nullptr,
                           folder / "heatmap_failures.png");
      },
      [&] {
        if (record.known) WriteKnownMap(s, record, folder / "heatmap_known.png");
      },
      [&] {
        if (s.online) WriteCellPicture(s, record, folder / "heatmap_cells.png");
      },
      [&] {
        if (s.online) WriteCoveragePlot(PictureTitle(s), record, folder / "plot_coverage.png");
      },
      [&] {  // an ideal robot has none
        if (s.episode.drive == "physics")
          WriteErrorPlot(PictureTitle(s), record, folder / "plot_errors.png");
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

std::string WriteVideo(const Scenario& s, const Scene& scene, const PlanResult& plan,
                       const EpisodeRecord& record, const Recording& recording,
                       const std::vector<FailureMode>& draft_around,
                       const std::filesystem::path& folder, const Console& console) {
  const HazardMap& map = s.site.map;
  // A film shows all walls, near and far.
  Scene whole;
  if (scene.pool.num > 0)
    whole = BuildScene(s.site.map, s.robot, s.physics, s.start, WallSet::kAll);
  FilmScript script;
  script.model = whole.model ? whole.model.get() : scene.model.get();
  script.base_body = scene.base_body;
  script.recording = &recording;
  script.events = record.events;
  script.map = &map;
  script.title = PictureTitle(s);
  script.plan = &plan.path;
  script.senses = s.video.scan;
  const double w = map.frame.width * map.frame.cell_m, h = map.frame.height * map.frame.cell_m;
  Vec2 low = map.frame.X_WG.p(), high = low;
  for (const Vec2& corner : {Vec2(w, 0), Vec2(0, h), Vec2(w, h)}) {
    low = low.cwiseMin(map.frame.X_WG * corner);
    high = high.cwiseMax(map.frame.X_WG * corner);
  }
  script.set = {low, high, s.robot.spec.circumscribed_radius_m};
  for (const Intervention& help : record.interventions)
    script.notices.push_back({help.t_s,
                              {Banner::Tone::kWarning, "HELPED   set down by a person",
                               fmt::format("at the waypoint x {:.2f} m, y {:.2f} m;  t {:.1f} s",
                                           help.to_W.x(), help.to_W.y(), help.t_s)}});
  if (record.events.empty() || !record.interventions.empty())
    script.closing = ClosingBanner(record);
  FilmOptions options;
  options.camera = s.video.camera;
  options.width = s.video.width & ~1;
  options.height = s.video.height & ~1;
  options.pace.fps = s.video.fps;
  options.pace.speed_up = s.video.speed_up.value_or(0);
  options.pace.max_frames = s.video.max_frames;
  options.stills = folder;
  if (!draft_around.empty()) MakeDraft(record, draft_around, options);
  DrawingProgress progress(console, "filming, frames");
  options.on_frame = [&](int done, int all) { progress.Show(done, all); };
  const FilmResult film = WriteFilm(script, options, folder / "video.mp4");
  return fmt::format("filmed: {} frames ({:.1f} s to draw, {:.1f} s to encode): {}", film.frames,
                     film.render_s, film.encode_s, (folder / "video.mp4").string());
}

}  // namespace floorproof
