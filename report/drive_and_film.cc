// SPDX-License-Identifier: Apache-2.0
#include "report/drive_and_film.h"

#include <fmt/format.h>

#include <chrono>
#include <mutex>
#include <optional>
#include <utility>

#include "base/file_output.h"
#include "base/interrupt.h"
#include "base/result_folder.h"
#include "media/drawing_lock.h"
#include "report/drive_table.h"
#include "report/drive_video.h"
#include "report/pictures.h"
#include "report/progress.h"
#include "report/risk_pictures.h"
#include "run/episode/execute.h"
#include "run/episode/records.h"
#include "run/episode/replay_track.h"
#include "run/plan_check/plan_check.h"
#include "run/plan_check/sharp_corners.h"
#include "run/scenario/scenario.h"
#include "run/scenario/warnings.h"

namespace floorproof {
namespace {

using Clock = std::chrono::steady_clock;

double Since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

// Says how far a drive is, writes the plan's files when there is a plan, and records what a film
// needs.
class Witness : public EpisodeObserver {
 public:
  Witness(const Scenario& s, ResultFolder& folder, const DriveOptions& options,
          const Console& console)
      : s_(s),
        folder_(folder),
        options_(options),
        console_(console),
        replay_(s.spec.episode.control_hz, this) {}

  // What an interruption's line says from now on.
  void There(const std::string& what) const {
    SayWhenInterrupted((options_.finished.empty() ? "" : options_.finished + " finished; ") +
                       folder_.path().string() +
                       (options_.write_records ? what : " has its records as before"));
  }

  Execution Watch() {
    Execution out = Execute(s_, &replay_);
    if (progress_) progress_->EndLine();
    drive_s_ = Since(begin_);
    return out;
  }

  void OnPlan(const PlanResult& plan) override {
    if (options_.observer) options_.observer->OnPlan(plan);
    const double plan_s = Since(begin_);
    if (options_.write_records) {
      folder_.Begin();
      There(" may lack some of the plan's files");
      RemoveEpisodeFiles(folder_);  // of an earlier run: they are not this plan's
      WritePlanFiles(s_, plan, folder_.path());
      There(" holds the plan; nothing was driven");
    }
    if (!options_.only_around.empty()) return;
    if (plan.status == PlanStatus::kOnline) {
      console_.Say(plan.message);
      return;
    }
    if (plan.status != PlanStatus::kSuccess) {
      console_.Say(fmt::format("no plan ({}): {}", Name(plan.status), plan.message));
      return;
    }
    console_.Say(fmt::format("{}, in {:.2f} s", PlannedText(plan), plan_s));
    if (!plan.message.empty()) console_.Say(plan.message);
    if (const std::string line = UnheldDwellLine(s_.world, plan); !line.empty()) console_.Say(line);
    // A planner keeps clear of what it knows; a file or a program may lead anywhere.
    if (IsPlanned(s_.spec)) return;
    const PlanClearance clearance = CheckClearance(s_.world, plan);
    if (const std::string conflicts = ConflictsLine(clearance); !conflicts.empty())
      console_.Say(conflicts + ", see `floorproof plan`");
    const int sharp = CountSharpCorners(plan.path, s_.world.robot.spec);
    if (const std::string line = SharpCornersLine(s_.world.robot.spec, sharp); !line.empty())
      console_.Say(line);
    for (const std::string& line : CrossingLines(s_.world, clearance)) console_.Say(line);
  }

  void OnScene(const Scene& scene) override {
    if (options_.observer) options_.observer->OnScene(scene);
    recording_.emplace(static_cast<int>(scene.model->nq));
    Begin(options_.video ? &*recording_ : nullptr);
  }

  bool OnControl(const EpisodeView& now) override {
    if (!progress_) Begin(nullptr);  // there is no scene
    const bool goes_on = options_.observer == nullptr || options_.observer->OnControl(now);
    return progress_->OnControl(now) && goes_on;
  }

  void SayVerdict(const PlanResult& plan, const EpisodeRecord& record) const {
    if (options_.only_around.empty()) console_.Say(DriveTable(s_, plan, record, drive_s_));
  }

  // The records are written: interrupts end the process again.
  void LetGo() { progress_.reset(); }
  const Recording& recording() const { return *recording_; }
  const ReplayObserver& replay() const { return replay_; }

 private:
  void Begin(Recording* recording) {
    progress_.emplace(console_, s_.world.robot.spec, s_.spec.episode.control_hz, recording);
    begin_ = Clock::now();
  }

  const Scenario& s_;
  ResultFolder& folder_;
  const DriveOptions& options_;
  const Console& console_;
  Clock::time_point begin_ = Clock::now();
  double drive_s_ = 0;
  ReplayObserver replay_;
  std::optional<Recording> recording_;
  std::optional<ProgressObserver> progress_;  // holds interrupts until the records are written
};

}  // namespace

DriveResult DriveAndFilm(const Scenario& s, const std::filesystem::path& folder,
                         const DriveOptions& options, const Console& console) {
  ResultFolder out(folder, options.write_records ? EpisodeResults() : FilmResults(), InputsOf(s));
  if (!options.write_records) out.Begin();
  Witness witness(s, out, options, console);
  witness.There(" is as before");
  if (options.only_around.empty())
    for (const std::string& line : Warnings(s)) console.Say(line);
  if (const std::string line = ProgramAnnounced(s); !line.empty()) console.Say(line);
  DriveResult result;
  Execution execution = witness.Watch();
  result.plan = std::move(execution.plan);
  result.record = std::move(execution.record);
  if (result.record.outcome == Outcome::kNotPlanned && options.write_records)
    WriteEpisodeFiles(s, result.plan, result.record, folder);
  if (!execution.scene && result.record.steps == 0) {  // nothing was driven
    if (result.record.outcome == Outcome::kSuccess && options.write_records) {
      const std::lock_guard alone(Drawing());
      WritePlanPictures(s, result.plan, folder);
    }
    return result;
  }
  if (result.record.outcome == Outcome::kInterrupted) {
    if (options.write_records) WriteEpisodeFiles(s, result.plan, result.record, folder);
    witness.There(fmt::format(" holds the plan and the trace of the {:.0f} s driven",
                              result.record.metrics.duration_s));
    throw Interruption();
  }
  std::string missing = "trace, result and pictures";
  auto say_verdict = [&, said = false]() mutable {
    if (!std::exchange(said, true)) witness.SayVerdict(result.plan, result.record);
  };
  try {
    if (options.write_records) {
      WriteEpisodeFiles(s, result.plan, result.record, folder);
      if (const std::string replay = witness.replay().Bytes(execution.scene, result.record);
          !replay.empty())
        WriteFileWhole(folder / "replay.bin", replay);
      out.RequireInPlace({"trace.csv", "result.json"});
      witness.There(" holds plan, trace and result; pictures may be missing");
    }
    missing = "pictures";
    say_verdict();  // what is said is on the disk
    witness.LetGo();
    const std::lock_guard alone(Drawing());
    if (options.write_records) WriteHeatMaps(s, result.plan, result.record, folder, console);
    witness.There(options.video ? " holds all but, perhaps, the film" : " is whole");
    missing = "the film";
    if (options.video)
      console.SayFact("Film", execution.scene ? WriteVideo(s, *execution.scene, result.plan,
                                                           result.record, witness.recording(),
                                                           options.only_around, folder, console)
                                              : WriteCellVideo(s, result.record, folder, console));
    witness.There(" is whole");
  } catch (const std::runtime_error& e) {
    say_verdict();
    result.not_written =
        std::make_exception_ptr(InternalError(std::string(e.what()) + "; missing: " + missing));
  } catch (...) {
    result.not_written = std::current_exception();
  }
  result.scene = std::move(execution.scene);
  return result;
}

}  // namespace floorproof
