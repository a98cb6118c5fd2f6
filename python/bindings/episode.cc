// SPDX-License-Identifier: Apache-2.0
// Episodes: driven, looked on, recorded.

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

#include "base/interrupt.h"
#include "python/bindings/arrays.h"
#include "python/bindings/describe.h"
#include "python/bindings/drawing.h"
#include "python/bindings/host.h"
#include "python/bindings/modules.h"
#include "report/drive_and_film.h"
#include "report/progress.h"
#include "report/run_page.h"
#include "run/episode/encounter_table.h"
#include "run/episode/execute.h"
#include "run/episode/records.h"
#include "run/scenario/scenario.h"

namespace floorproof {
namespace {

namespace fs = std::filesystem;
using namespace nb::literals;

const Console kQuiet{.quiet = true};

// What one control period looks like from Python.
struct View {
  Lent<const EpisodeView> lent;
};

// Looks on for Python: asks for Ctrl-C, tells how far it is, keeps states for pictures.
class Observer final : public EpisodeObserver {
 public:
  // `progress`: called with the share of the plan that is driven, the simulated time and the
  // coverage, ten times a second at most. `each`: called in every `every`-th control period.
  Observer(const Scenario& scenario, nb::object progress, nb::object each, int every, bool record)
      : scenario_(scenario),
        progress_(std::move(progress)),
        each_(std::move(each)),
        every_(every),
        record_(record) {}

  void OnScene(const Scene& scene) override {
    if (!record_) return;
    recording_.emplace(static_cast<int>(scene.model->nq));
    recorder_.emplace(kQuiet, scenario_.world.robot.spec, scenario_.spec.episode.control_hz,
                      &*recording_);
  }

  bool OnControl(const EpisodeView& now) override {
    if (recorder_) recorder_->OnControl(now);
    if (!each_.is_none() && count_++ % every_ == 0)
      InPython("the observer",
               [&] { Lend<View>(now, [&](const nb::object& view) { Ask(each_, view); }); });
    fraction_ = std::min(now.plan_fraction, 1.0);
    t_s_ = now.sample.t_s;
    coverage_ = now.coverage;
    constexpr auto kOften = std::chrono::milliseconds(100);
    const auto wall = std::chrono::steady_clock::now();
    if (wall - told_ >= kOften) {
      told_ = wall;
      Tell();
    }
    return !Interrupted();
  }

  // How far it is.
  void Tell() {
    if (progress_.is_none()) return;
    InPython("the progress callback", [&] { Ask(progress_, fraction_, t_s_, coverage_); });
  }

  std::optional<Recording>& recording() { return recording_; }

 private:
  const Scenario& scenario_;
  nb::object progress_, each_;
  int every_;
  bool record_;
  long count_ = 0;
  double fraction_ = 0, t_s_ = 0, coverage_ = 0;
  std::chrono::steady_clock::time_point told_{};
  std::optional<Recording> recording_;
  std::optional<ProgressObserver> recorder_;
};

// A plan can be driven where it was made, or where all that it rests on is the same.
void RequireOwn(const Scenario& s, const Planned& planned) {
  const Scenario& of = *planned.scenario;
  const auto refuse = [&](const std::string& what) {
    throw InputError({s.spec.file.string(), 0}, "plan", "", "is of another scenario: its " + what);
  };
  const GridFrame &a = s.world.site.map.frame, &b = of.world.site.map.frame;
  if (a.width != b.width || a.height != b.height || a.cell_m != b.cell_m ||
      a.X_WG.x_m != b.X_WG.x_m || a.X_WG.y_m != b.X_WG.y_m || a.X_WG.yaw_rad != b.X_WG.yaw_rad)
    refuse("map lies elsewhere");
  if (s.spec.robot_file != of.spec.robot_file)
    refuse("robot is " + of.spec.robot_name + ", not " + s.spec.robot_name);
  if (s.spec.episode.drive != of.spec.episode.drive)
    refuse("drive is " + of.spec.episode.drive + ", not " + s.spec.episode.drive);
  if (planned.plan.status == PlanStatus::kOnline && s.spec.planner_name != of.spec.planner_name)
    refuse("planner, " + of.spec.planner_name + ", plans on the way");
  if (s.spec.plan_by == PlanBy::kOnline && planned.plan.status != PlanStatus::kOnline)
    refuse("plan was made beforehand, and " + s.spec.planner_name + " plans on the way");
}

// With `planned`, that plan is driven; else one is made.
std::shared_ptr<Driven> Run(const std::shared_ptr<Scenario>& scenario,
                            const std::shared_ptr<Planned>& planned, nb::object progress,
                            nb::object each, int every, bool record) {
  if (planned) RequireOwn(*scenario, *planned);
  Observer observer(*scenario, std::move(progress), std::move(each), std::max(1, every), record);
  auto driven = WithoutGil([&] {
    auto out = std::make_shared<Driven>();
    out->scenario = scenario;
    if (!planned) WarnOfProgram(*scenario);
    out->plan = planned ? planned->plan : MakePlan(*scenario);
    out->record = ExecutePlan(*scenario, out->plan, out->scene, &observer);
    if (out->record.outcome == Outcome::kInterrupted) throw Interruption();
    return out;
  });
  observer.Tell();
  driven->recording = std::move(observer.recording());
  return driven;
}

// As `floorproof run` does it: the same files, the same bytes. `say` takes its lines.
std::shared_ptr<Driven> RunInto(const std::shared_ptr<Scenario>& scenario, const fs::path& folder,
                                bool video, nb::object say, nb::object progress) {
  Observer observer(*scenario, std::move(progress), nb::none(), 1, true);
  Console console{.quiet = true};
  console.listener = [&say](const std::string& line) {
    if (!say.is_none()) InPython("say", [&] { Ask(say, line); });
  };
  auto made = WithoutGil([&] {
    WarnOfProgram(*scenario);
    DriveResult result =
        DriveAndFilm(*scenario, folder, {.video = video, .observer = &observer}, console);
    if (result.not_written) std::rethrow_exception(result.not_written);
    if (result.record.steps > 0) WriteRunReport(folder, folder.string());
    auto out = std::make_shared<Driven>();
    out->scenario = scenario;
    out->plan = std::move(result.plan);
    out->record = std::move(result.record);
    out->scene = std::move(result.scene);
    return out;
  });
  observer.Tell();
  made->recording = std::move(observer.recording());
  return made;
}

// --- records ---

nb::object Column(const Driven& d, const TraceColumn& column) {
  const std::vector<TraceRow>& trace = d.record.trace;
  if (const auto* text = std::get_if<TraceColumn::Text>(&column.member)) {
    nb::list out;
    for (const TraceRow& row : trace) {
      const std::string_view word = (*text)(row, d.scenario->world.robot.spec);
      out.append(nb::str(word.data(), word.size()));
    }
    return out;
  }
  std::vector<double> values;
  values.reserve(trace.size());
  for (const TraceRow& row : trace)
    values.push_back(std::visit(
        [&](const auto& member) -> double {
          using Member = std::decay_t<decltype(member)>;
          if constexpr (std::is_same_v<Member, TraceColumn::Text>)
            return 0;
          else if constexpr (std::is_same_v<Member, float TraceRow::*>)
            return static_cast<double>(row.*member);
          else
            return row.*(member.value);
        },
        column.member));
  return nb::cast(ArrayOf(std::move(values), {trace.size()}));
}

nb::dict Trace(const Driven& d) {
  nb::dict out;
  for (const TraceColumn& column : kTraceColumns)
    out[nb::str(column.name.data(), column.name.size())] = Column(d, column);
  return out;
}

// Rows of the table `encounter`: `size` is JSON.
nb::list Encounters(const Driven& d) {
  nb::list rows;
  for (const Encounter& encounter : d.record.encounters) {
    nb::dict row;
    const std::vector<EncounterValue> values = EncounterValues(encounter);
    for (std::size_t i = 0; i < values.size(); ++i) {
      const std::string_view name = EncounterColumns()[i].name;
      row[nb::str(name.data(), name.size())] = nb::cast(values[i]);
    }
    rows.append(row);
  }
  return rows;
}

nb::dict Maps(const Driven& d) {
  nb::dict out;
  const EpisodeRecord& record = d.record;
  if (record.passes.width > 0) {
    out["frame"] = FrameDict(record.passes_frame);
    out["passes"] = GridArray<std::uint8_t>(record.passes);
    out["sweepable"] = MaskArray(record.sweepable);
  }
  if (record.known) {
    out["known_frame"] = FrameDict(record.known->frame);
    out["known"] = KnownArray(*record.known);
  }
  return out;
}

nb::object Qpos(const Driven& d) {
  if (!d.recording) return nb::none();
  const Recording& r = *d.recording;
  std::vector<double> values;
  for (std::size_t i = 0; i < r.size(); ++i)
    values.insert(values.end(), r.qpos(i), r.qpos(i) + r.nq());
  return nb::cast(ArrayOf(std::move(values), {r.size(), static_cast<std::size_t>(r.nq())}));
}

// --- a control period ---

nb::object Scan(const View& v) {
  const LidarScan& scan = v.lent->sensed.scan;
  if (scan.angle_rad.empty()) return nb::none();
  nb::dict out;
  out["t_s"] = scan.t_s;
  out["fresh"] = scan.fresh;
  out["least_m"] = scan.least_m;
  out["most_m"] = scan.most_m;
  out["mount"] = nb::make_tuple(scan.X_BL.x_m, scan.X_BL.y_m, scan.X_BL.yaw_rad, scan.height_m);
  out["angle_rad"] = ArrayOf(scan.angle_rad, {scan.angle_rad.size()});
  out["range_m"] = ArrayOf(scan.range_m, {scan.range_m.size()});
  return out;
}

}  // namespace

void BindEpisode(nb::module_& m) {
  m.def("run", &Run, "scenario"_a, "plan"_a.none(), "progress"_a.none(), "each"_a.none(), "every"_a,
        "record"_a);
  m.def("run_into", &RunInto, "scenario"_a, "folder"_a, "video"_a, "say"_a.none(),
        "progress"_a.none());
  m.def("trace_columns", [] {
    std::vector<std::pair<std::string, std::string>> columns;
    for (const TraceColumn& column : kTraceColumns) columns.emplace_back(column.name, column.unit);
    return columns;
  });
  m.def("encounter_columns", [] {
    std::vector<std::pair<std::string, bool>> columns;
    for (const EncounterColumn& column : EncounterColumns())
      columns.emplace_back(column.name, column.is_text);
    return columns;
  });

  nb::class_<View>(m, "View")
      .def_prop_ro("t_s", [](const View& v) { return v.lent->sample.t_s; })
      .def_prop_ro("pose", [](const View& v) { return PoseTuple(v.lent->sample.X_WB()); })
      .def_prop_ro("estimate", [](const View& v) { return PoseTuple(v.lent->estimate.X_WB); })
      .def_prop_ro("attitude",
                   [](const View& v) {
                     const Sample& s = v.lent->sample;
                     return nb::make_tuple(s.p_WB.z(), s.roll_rad, s.pitch_rad);
                   })
      .def_prop_ro("coverage", [](const View& v) { return v.lent->coverage; })
      .def_prop_ro("scan", &Scan);

  nb::class_<Driven>(m, "Episode")
      .def_prop_ro("scenario", [](const Driven& d) { return d.scenario; })
      .def_prop_ro("plan",
                   [](const Driven& d) {
                     return std::make_shared<Planned>(Planned{d.scenario, d.plan});
                   })
      .def_prop_ro("outcome", [](const Driven& d) { return Name(d.record.outcome); })
      .def_prop_ro("message", [](const Driven& d) { return d.record.message; })
      .def_prop_ro("result",
                   [](const Driven& d) { return JsonText(ResultJson(*d.scenario, d.record)); })
      .def_prop_ro("trace", &Trace)
      .def_prop_ro("encounters", &Encounters)
      .def_prop_ro("maps", &Maps)
      .def_prop_ro("qpos", &Qpos);
}

}  // namespace floorproof
