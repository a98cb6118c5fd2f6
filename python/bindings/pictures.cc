// SPDX-License-Identifier: Apache-2.0
// Pictures of scenes, plans and drives; pages of campaigns.
#include "report/pictures.h"

#include <array>
#include <nlohmann/json.hpp>

#include "base/console.h"
#include "python/bindings/drawing.h"
#include "python/bindings/host.h"
#include "python/bindings/modules.h"
#include "report/drive_video.h"
#include "report/folder_report.h"
#include "report/risk_pictures.h"
#include "report/save_plan.h"
#include "run/episode/records.h"
#include "run/scenario/scenario.h"

namespace floorproof {
namespace {

namespace fs = std::filesystem;
using namespace nb::literals;

const Console kQuiet{.quiet = true};

// At times that ascend.
nb::list Frames(const Driven& d, const std::vector<double>& t_s, int width, int height,
                const std::string& camera) {
  if (!d.scene || !d.recording || d.recording->size() == 0)
    throw InputError(
        "there are no states to draw: the episode was not driven through physics, or "
        "not recorded");
  nb::list out;
  for (Image& image : DrawAlone([&] {
         return DrivePictures(*d.scenario, *d.scene, d.plan, d.record, *d.recording, t_s, width,
                              height, camera);
       }))
    out.append(ImageArray(std::move(image)));
  return out;
}

// The robot at its start, nothing driven yet.
nb::ndarray<nb::numpy, std::uint8_t> StartFrame(const Scenario& s, int width, int height,
                                                const std::string& camera) {
  return ImageArray(DrawAlone([&] {
    const Scene scene =
        BuildScene(s.world.site.map, s.world.robot, s.world.physics, s.world.start, WallSet::kAll);
    Recording recording(static_cast<int>(scene.model->nq));
    recording.Add(0, scene.model->qpos0, {s.world.start.x_m, s.world.start.y_m, 0}, 0, -1);
    const std::array at_s = {0.0};
    return DrivePictures(s, scene, {}, {}, recording, at_s, width, height, camera).front();
  }));
}

bool SavePlanFiles(const Planned& p, const fs::path& folder) {
  return DrawAlone([&] {
    ResultFolder out(folder, EpisodeResults(), InputsOf(*p.scenario));
    SavePlan(*p.scenario, p.plan, out);
    return true;
  });
}

bool SaveMaps(const Driven& d, const fs::path& folder) {
  return DrawAlone([&] {
    WriteHeatMaps(*d.scenario, d.plan, d.record, folder, kQuiet);
    return true;
  });
}

fs::path WriteReport(const fs::path& folder) {
  return DrawAlone([&] { return WriteFolderReport(folder, folder.string(), kQuiet).page; });
}

}  // namespace

void BindPictures(nb::module_& m) {
  m.def("frames", &Frames, "episode"_a, "t_s"_a, "width"_a, "height"_a, "camera"_a);
  m.def("start_frame", &StartFrame, "scenario"_a, "width"_a, "height"_a, "camera"_a);
  m.def("save_plan", &SavePlanFiles, "plan"_a, "folder"_a);
  m.def("save_maps", &SaveMaps, "episode"_a, "folder"_a);
  m.def("write_report", &WriteReport, "folder"_a);
}

}  // namespace floorproof
