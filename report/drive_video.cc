// SPDX-License-Identifier: Apache-2.0
#include "report/drive_video.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <nlohmann/json.hpp>

#include "base/file_output.h"
#include "base/quantity.h"
#include "render/cell_film.h"
#include "report/drawing_progress.h"
#include "report/pictures.h"
#include "report/safety_timeline.h"
#include "report/swept_again.h"
#include "run/scenario/scenario.h"

namespace floorproof {
namespace {

// A film of a failure alone: what led to it, and what came of it.
void KeepToFailures(const EpisodeRecord& record, const std::vector<FailureMode>& modes,
                    FilmOptions& options) {
  constexpr int kWidth = 640;
  constexpr double kFps = 15;
  if (options.quality == RenderQuality::kDraft && options.width > kWidth) {
    options.height = std::max(64, options.height * kWidth / options.width) & ~1;
    options.width = kWidth;
  }
  if (options.quality == RenderQuality::kDraft) options.pace.fps = std::min(options.pace.fps, kFps);
  options.pace.before_s = 5;
  options.pace.after_s = 2;
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

// The film's size and pace.
ReelOptions AsWritten(const VideoParams& video, const std::filesystem::path& stills) {
  ReelOptions options;
  options.width = video.width & ~1;
  options.height = video.height & ~1;
  options.pace.fps = video.fps;
  options.pace.speed_up = video.speed_up.value_or(0);
  options.pace.max_frames = video.max_frames;
  options.stills = stills;
  return options;
}

// video.json, by which the page shows a moment in the film and finds it there; and what is said.
std::string Filmed(const FilmResult& film, const std::filesystem::path& mp4) {
  nlohmann::ordered_json times = nlohmann::ordered_json::array();
  for (const double t_s : film.t_s) times.push_back(std::round(1e3 * t_s) / 1e3);
  WriteFileWhole(
      std::filesystem::path(mp4).replace_extension(".json"),
      nlohmann::ordered_json({{"fps", film.fps}, {"t_s", std::move(times)}}).dump() + "\n");
  return fmt::format("{}, {}, drawn in {}, encoded in {}", mp4.string(),
                     CountText(film.frames, "frame"), TimeText(film.render_s),
                     TimeText(film.encode_s));
}

// Geoms of the robot that are no part of a wheel or caster, nor turn with one.
std::vector<int> ShellOf(const Scene& scene) {
  const mjModel* m = scene.model.get();
  const auto is_wheel = [&](int geom) {
    return scene.roles[static_cast<std::size_t>(geom)].kind == GeomRole::Kind::kWheel;
  };
  std::vector<bool> turns(static_cast<std::size_t>(m->nbody));
  for (int body = 1; body < m->nbody; ++body) {  // parents come first
    if (body == scene.base_body) continue;
    bool wheel = turns[static_cast<std::size_t>(m->body_parentid[body])];
    for (int g = 0; g < m->body_geomnum[body]; ++g)
      wheel = wheel || is_wheel(m->body_geomadr[body] + g);
    turns[static_cast<std::size_t>(body)] = wheel;
  }
  std::vector<int> shell;
  for (int geom = 0; geom < m->ngeom; ++geom) {
    const int body = m->geom_bodyid[geom];
    if (m->body_rootid[body] == m->body_rootid[scene.base_body] && !is_wheel(geom) &&
        !turns[static_cast<std::size_t>(body)])
      shell.push_back(geom);
  }
  return shell;
}

// What a film of the drive is made from; it refers to what it is made with.
struct DriveScript {
  DriveScript(const Scenario& s, const Scene& scene, const PlanResult& plan,
              const EpisodeRecord& record, const Recording& recording);
  Scene whole;  // with all walls, near and far, where `scene` has not
  FilmScript film;
};

DriveScript::DriveScript(const Scenario& s, const Scene& scene, const PlanResult& plan,
                         const EpisodeRecord& record, const Recording& recording) {
  const HazardMap& map = s.world.site.map;
  if (scene.pool.num > 0)
    whole =
        BuildScene(s.world.site.map, s.world.robot, s.world.physics, s.world.start, WallSet::kAll);
  film.model = whole.model ? whole.model.get() : scene.model.get();
  film.base_body = scene.base_body;
  film.recording = &recording;
  film.events = record.events;
  film.map = &map;
  film.title = PictureTitle(s.world);
  film.shell = ShellOf(whole.model ? whole : scene);
  film.plan = &plan.path;
  film.senses = s.spec.video.scan;
  const double w = map.frame.width * map.frame.cell_m, h = map.frame.height * map.frame.cell_m;
  Vec2 low = map.frame.X_WG.p(), high = low;
  for (const Vec2& corner : {Vec2(w, 0), Vec2(0, h), Vec2(w, h)}) {
    low = low.cwiseMin(map.frame.X_WG * corner);
    high = high.cwiseMax(map.frame.X_WG * corner);
  }
  film.set = {low, high, s.world.robot.spec.circumscribed_radius_m};
  for (const Intervention& help : record.interventions)
    film.notices.push_back({help.t_s,
                            {Banner::Tone::kWarning, "HELPED   set down by a person",
                             fmt::format("at the waypoint x {:.2f} m, y {:.2f} m;  t {:.1f} s",
                                         help.to_W.x(), help.to_W.y(), help.t_s)}});
  if (record.events.empty() || !record.interventions.empty()) film.closing = ClosingBanner(record);
  if (s.spec.safety) film.timeline = SafetyTimeline(s, record);
  if (s.spec.plan_by == PlanBy::kOnline) {
    film.window_m = s.spec.online.radius_m;
    film.swept_again = SweptAgainPatches(record, s.world.robot.spec);
  }
}

FilmOptions OptionsOf(const Scenario& s, const std::filesystem::path& stills) {
  FilmOptions options;
  static_cast<ReelOptions&>(options) = AsWritten(s.spec.video, stills);
  options.camera = s.spec.video.camera;
  if (s.spec.video.quality == "draft") options.quality = RenderQuality::kDraft;
  return options;
}

}  // namespace

std::string WriteVideo(const Scenario& s, const Scene& scene, const PlanResult& plan,
                       const EpisodeRecord& record, const Recording& recording,
                       const std::vector<FailureMode>& only_around,
                       const std::filesystem::path& folder, const Console& console) {
  const DriveScript script(s, scene, plan, record, recording);
  FilmOptions options = OptionsOf(s, folder);
  if (!only_around.empty()) {
    if (s.spec.video.quality == "auto") options.quality = RenderQuality::kDraft;
    KeepToFailures(record, only_around, options);
  }
  DrawingProgress progress(console, "filming, frames");
  options.on_frame = [&](int done, int all) { progress.Show(done, all); };
  const std::filesystem::path mp4 = folder / "video.mp4";
  return Filmed(WriteFilm(script.film, options, mp4), mp4);
}

std::vector<Image> DrivePictures(const Scenario& s, const Scene& scene, const PlanResult& plan,
                                 const EpisodeRecord& record, const Recording& recording,
                                 std::span<const double> t_s, int width, int height,
                                 const std::string& camera) {
  const DriveScript script(s, scene, plan, record, recording);
  FilmOptions options = OptionsOf(s, {});
  options.width = width;
  options.height = height;
  options.camera = camera;
  return FilmPictures(script.film, options, t_s);
}

LivePicture::LivePicture(const Scenario& s, const Scene& scene, const PlanResult& plan,
                         const Recording& recording, int beams, int width, int height,
                         const std::string& camera, RenderQuality quality) {
  auto script = std::make_shared<DriveScript>(s, scene, plan, EpisodeRecord{}, recording);
  script->film.beams = beams;
  script->film.closing.reset();  // it has not ended
  script->film.timeline.reset();
  FilmOptions options = OptionsOf(s, {});
  options.width = width;
  options.height = height;
  options.camera = camera;
  options.quality = quality;
  draw_ = [script, film = std::make_shared<LiveFilm>(script->film, options)](
              std::span<const Event> events) -> const Image& {
    script->film.events = events;
    return film->Draw();
  };
}

std::string WriteCellVideo(const Scenario& s, const EpisodeRecord& record,
                           const std::filesystem::path& folder, const Console& console) {
  CellFilmScript script;
  script.map = &s.world.site.map;
  script.in_reach = &record.sweepable;
  script.visits = &record.passes;
  script.known = record.known ? &*record.known : nullptr;
  script.window_m = s.spec.online.radius_m;
  script.title = PictureTitle(s.world) + ", " + s.spec.planner_name;
  script.closing = ClosingBanner(record);
  for (const TraceRow& row : record.trace)
    script.steps.push_back({row.t_s,
                            {row.x_m, row.y_m},
                            static_cast<double>(row.coverage),
                            static_cast<double>(row.revisited)});
  ReelOptions options = AsWritten(s.spec.video, folder);
  DrawingProgress progress(console, "filming, frames");
  options.on_frame = [&](int done, int all) { progress.Show(done, all); };
  const std::filesystem::path mp4 = folder / "video.mp4";
  return Filmed(WriteCellFilm(script, options, mp4), mp4);
}

}  // namespace floorproof
