// SPDX-License-Identifier: Apache-2.0
#include "report/drive_and_film.h"

#include <fmt/format.h>

#include <chrono>
#include <optional>

#include "base/file_output.h"
#include "base/interrupt.h"
#include "report/pictures.h"
#include "report/progress.h"
#include "report/risk_pictures.h"
#include "run/episode/records.h"
#include "run/scenario/warnings.h"

namespace floorproof {
namespace {

double Since(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

std::string Verdict(const EpisodeRecord& record) {
  const Metrics& m = record.metrics;
  std::string line = fmt::format(
      "{}: covered {:.1f} % in {:.0f} s over {:.1f} m, off the path by {:.0f} mm at most, {:.3g} "
      "kJ",
      Name(record.outcome), 100 * m.coverage, m.duration_s, m.path_length_m,
      1000 * m.max_cross_track_m, m.energy_j / 1000);
  if (const std::size_t times = record.interventions.size(); times > 0)
    line += fmt::format(", helped {} time{}", times, times == 1 ? "" : "s");
  if (!record.message.empty()) line += " (" + record.message + ")";
  return line;
}

std::string EventLine(const Event& e) {
  return fmt::format("  {}{} at {:.1f} s, x {:.2f} y {:.2f} m{}: {:.3g} against {:.3g}, effect {}",
                     Name(e.mode), e.kind.empty() ? "" : " (" + e.kind + ")", e.t_s, e.x_m, e.y_m,
                     e.hazard.empty() ? "" : ", " + e.hazard, e.value, e.threshold, e.effect);
}

}  // namespace

DriveResult DriveAndFilm(Scenario& s, const std::filesystem::path& folder,
                         const DriveOptions& options, const Console& console) {
  const auto there = [&](const std::string& what) {
    SayWhenInterrupted((options.finished.empty() ? "" : options.finished + " finished; ") +
                       (options.write_records ? folder.string() + what
                                              : folder.string() + " has its records as before"));
  };
  DriveResult result;
  there(" is as before");
  for (const std::string& line : Warnings(s)) console.Say(line);
  const auto plan_start = std::chrono::steady_clock::now();
  result.plan = MakePlan(s);
  const double plan_s = Since(plan_start);
  if (options.write_records) {
    MakeFolder(folder);
    there(" may lack some of the plan's files");
    RemoveEpisodeFiles(folder);  // of an earlier run: they are not this plan's
    WritePlanFiles(s, result.plan, folder);
    there(" holds the plan; nothing was driven");
  }
  if (result.plan.status != PlanStatus::kSuccess) {
    console.Say(fmt::format("no plan ({}): {}", Name(result.plan.status), result.plan.message));
    result.record.outcome = Outcome::kNotPlanned;
    result.record.message = result.plan.message;
    if (options.write_records) WriteEpisodeFiles(s, result.record, folder);
    return result;
  }
  console.Say(fmt::format("planned: {} waypoints, {:.1f} m, {} turns, in {:.2f} s",
                          result.plan.path.size(), Length(result.plan.path),
                          CountTurns(result.plan.path), plan_s));
  if (!result.plan.message.empty()) console.Say(result.plan.message);
  if (s.episode.drive == "none") {
    result.record.outcome = Outcome::kSuccess;
    if (options.write_records) WritePlanPictures(s, result.plan, folder);
    return result;
  }

  const Scene scene = BuildScene(s.site.map, s.robot, s.physics, s.start);
  Recording recording(static_cast<int>(scene.model->nq));
  const auto drive_start = std::chrono::steady_clock::now();
  std::optional<ProgressObserver> observer;  // holds interrupts until the records are written
  observer.emplace(console, s.robot.spec, s.episode.control_hz,
                   options.video ? &recording : nullptr);
  result.record = RunEpisode(s, scene, result.plan, &*observer);
  observer->EndLine();
  if (result.record.outcome == Outcome::kInterrupted) {
    if (options.write_records) WriteEpisodeFiles(s, result.record, folder);
    there(fmt::format(" holds the plan and the trace of the {:.0f} s driven",
                      result.record.metrics.duration_s));
    EndInterrupted();
  }
  const double drive_s = Since(drive_start);
  console.Say(Verdict(result.record));
  for (const auto& event : result.record.events) console.Say(EventLine(event));
  console.Say(fmt::format("drove {:.0f}x faster than real time ({:.1f} s)",
                          result.record.metrics.duration_s / drive_s, drive_s));
  try {
    if (options.write_records) {
      WriteEpisodeFiles(s, result.record, folder);
      there(" holds plan, trace and result; pictures may be missing");
    }
    observer.reset();
    if (options.write_records) WriteHeatMaps(s, result.plan, result.record, folder);
    there(options.video ? " holds all but, perhaps, the film" : " is whole");
    if (options.video)
      console.Say(WriteVideo(s, scene, result.plan, result.record, recording, folder));
    there(" is whole");
  } catch (...) {
    result.not_written = std::current_exception();
  }
  return result;
}

}  // namespace floorproof
