// SPDX-License-Identifier: Apache-2.0
// Scenarios and their sites: read, checked, resolved, planned.
#include <algorithm>
#include <nlohmann/json.hpp>

#include "base/file_output.h"
#include "base/interrupt.h"
#include "env/map/site.h"
#include "env/scene/models_folder.h"
#include "env/scene/robot_model.h"
#include "python/bindings/arrays.h"
#include "python/bindings/describe.h"
#include "python/bindings/host.h"
#include "python/bindings/modules.h"
#include "run/episode/make_plan.h"
#include "run/episode/plan_inputs.h"
#include "run/episode/records.h"
#include "run/plan_check/plan_check.h"
#include "run/plan_check/prediction.h"
#include "run/scenario/resolved_scenario.h"
#include "run/scenario/scenario_file.h"
#include "run/scenario/warnings.h"

namespace floorproof {
namespace {

namespace fs = std::filesystem;
using namespace nb::literals;
using Json = nlohmann::ordered_json;

using Pairs = std::vector<std::pair<std::string, std::string>>;
// File, whether it is trusted, text (None: the file's), overrides, inputs.
using Packed = std::tuple<fs::path, bool, std::optional<std::string>, Pairs,
                          std::vector<std::pair<std::string, nb::bytes>>>;

std::shared_ptr<ScenarioFile> Unpack(const Packed& packed) {
  const auto& [file, trusted, text, overrides, inputs] = packed;
  PackedScenario plain{file, trusted ? Trust::kFull : Trust::kNone, text, {}, {}};
  for (const auto& [key, value] : overrides) plain.overrides.push_back({key, value});
  for (const auto& [name, bytes] : inputs)
    plain.inputs.emplace_back(name, std::string(bytes.c_str(), bytes.size()));
  return std::make_shared<ScenarioFile>(ScenarioFile::Unpack(plain));
}

Packed Pack(const ScenarioFile& file) {
  const PackedScenario plain = file.Pack();
  Packed packed{plain.file, plain.trust == Trust::kFull, plain.text, {}, {}};
  for (const Override& o : plain.overrides) std::get<3>(packed).emplace_back(o.key_path, o.value);
  for (const auto& [name, bytes] : plain.inputs)
    std::get<4>(packed).emplace_back(name, nb::bytes(bytes.data(), bytes.size()));
  return packed;
}

const Variant& VariantNamed(const ScenarioFile& file, const std::optional<std::string>& name) {
  static const Variant none;
  if (!name) return none;
  const auto at = std::ranges::find(file.variants(), *name, &Variant::name);
  if (at != file.variants().end()) return *at;
  std::vector<std::string> names;
  for (const Variant& variant : file.variants()) names.push_back(variant.name);
  throw InputError({file.file().string(), 0}, "variant", *name,
                   "unknown" + DidYouMeanOneOf(*name, names));
}

// --- sites ---

// With the step of a robot that is to drive there, if there is one.
nb::dict SiteDict(const HazardMap& map, std::optional<double> step_m = {}) {
  nb::dict out;
  out["name"] = map.name;
  out["frame"] = FrameDict(map.frame);
  out["occupancy"] = GridArray<std::uint8_t>(map.occupancy);
  out["hazards"] = HazardList(map, step_m);
  out["floor_friction"] = map.floor_friction;
  out["start"] = map.start ? nb::object(PoseTuple(*map.start)) : nb::object(nb::none());
  out["goal"] =
      map.goal ? nb::object(nb::make_tuple(map.goal->x(), map.goal->y())) : nb::object(nb::none());
  return out;
}

// A site by itself: `text` None: the file's.
nb::dict ReadSiteAlone(const fs::path& file, const std::optional<std::string>& text) {
  const InputFiles files;
  const ConfigNode node =
      text ? ParseYaml(*text, file.string()) : ReadYamlFile(file, files, "site");
  const ConfigNode site = GeneratedSite(node, 0, 0);
  return SiteDict(ReadSite(site, file.parent_path(), files).map);
}

std::vector<std::string> SensorsOf(const Scenario& s) { return SensorNames(s.spec); }

// --- plans ---

std::shared_ptr<Planned> PlanOf(const std::shared_ptr<Scenario>& scenario) {
  return WithoutGil([&] {
    WarnOfProgram(*scenario);
    return std::make_shared<Planned>(Planned{scenario, MakePlan(*scenario)});
  });
}

std::string CheckText(const Planned& p) {
  return WithoutGil(
      [&] { return JsonText(PlanCheckJson(p.scenario->world, CheckPlan(*p.scenario, p.plan))); });
}

// predict.json's content.
std::string PredictionText(const ScenarioFile& file, const std::optional<std::string>& variant,
                           int draws) {
  const Variant& of = VariantNamed(file, variant);
  return WithoutGil([&] {
    const auto ask = [](int) {
      if (Interrupted()) throw Interruption();
    };
    const Prediction prediction = Predict(file, of, draws, ask);
    const Scenario s = file.Read(file.episode(), of);
    return JsonText(PredictionJson(s, prediction, PlanJson(s, prediction.plan)));
  });
}

}  // namespace

void BindScenario(nb::module_& m) {
  m.def("set_models_folder", &SetModelsFolder, "folder"_a);
  m.def("models_folder", &ModelsFolder);
  m.def("read_site", &ReadSiteAlone, "file"_a, "text"_a.none());
  m.def("versions", [] { return VersionsJson().dump(); });

  nb::class_<ScenarioFile>(m, "ScenarioFile")
      .def_static("unpack", &Unpack, "packed"_a)
      .def("pack", &Pack)
      .def_prop_ro("file", [](const ScenarioFile& f) { return f.file(); })
      .def_prop_ro("name", &ScenarioFile::name)
      .def_prop_ro("seed", &ScenarioFile::seed)
      .def_prop_ro("episode", &ScenarioFile::episode)
      .def_prop_ro("draws_differ", &ScenarioFile::draws_differ)
      .def_prop_ro("variants",
                   [](const ScenarioFile& f) {
                     std::vector<std::string> names;
                     for (const Variant& variant : f.variants()) names.push_back(variant.name);
                     return names;
                   })
      .def(
          "read",
          [](const ScenarioFile& f, std::optional<std::uint64_t> episode,
             const std::optional<std::string>& variant) {
            return std::make_shared<Scenario>(f.Read(episode, VariantNamed(f, variant)));
          },
          "episode"_a.none(), "variant"_a.none())
      .def("predict", &PredictionText, "variant"_a.none(), "draws"_a);

  nb::class_<Scenario>(m, "Scenario")
      .def_prop_ro("name", [](const Scenario& s) { return s.spec.name; })
      .def_prop_ro("robot_name", [](const Scenario& s) { return s.spec.robot_name; })
      .def_prop_ro("planner", [](const Scenario& s) { return s.spec.planner_name; })
      .def_prop_ro("tracker", [](const Scenario& s) { return s.spec.tracker.name; })
      .def_prop_ro("start", [](const Scenario& s) { return PoseTuple(s.world.start); })
      .def_prop_ro("control_hz", [](const Scenario& s) { return s.spec.episode.control_hz; })
      .def_prop_ro("seed", [](const Scenario& s) { return s.spec.episode.seed; })
      .def_prop_ro("min_coverage", [](const Scenario& s) { return s.spec.episode.min_coverage; })
      .def_prop_ro(
          "site",
          [](const Scenario& s) { return SiteDict(s.world.site.map, s.world.robot.spec.step_m); })
      .def_prop_ro("robot", [](const Scenario& s) { return RobotDict(s.world.robot.spec); })
      .def_prop_ro("sensors", &SensorsOf)
      .def_prop_ro("drawn", [](const Scenario& s) { return DrawnJson(s.spec.drawn).dump(); })
      .def("warnings", [](const Scenario& s) { return Warnings(s); })
      .def(
          "resolved",
          [](const Scenario& s, const fs::path& folder) { return ResolvedScenario(s, folder); },
          "folder"_a)
      .def_prop_ro("plan_inputs", &PlanInputs)
      .def("refuse_program", [](const Scenario& s) { RefuseProgram(s); })
      .def("make_plan", [](const std::shared_ptr<Scenario>& s) { return PlanOf(s); });

  nb::class_<Planned>(m, "Plan")
      .def_prop_ro("status", [](const Planned& p) { return Name(p.plan.status); })
      .def_prop_ro("message", [](const Planned& p) { return p.plan.message; })
      .def_prop_ro(
          "path", [](const Planned& p) { return PathArray(p.plan.path); }, nb::rv_policy::automatic)
      .def_prop_ro("shapes",
                   [](const Planned& p) {
                     std::vector<std::string> shapes;
                     for (const Waypoint& w : p.plan.path) shapes.push_back(w.shape);
                     return shapes;
                   })
      .def_prop_ro("json", [](const Planned& p) { return JsonText(PlanJson(*p.scenario, p.plan)); })
      .def("check", &CheckText)
      .def_prop_ro(
          "risk", [](const Planned& p) { return GridArray<double>(p.plan.risk->rf); },
          nb::rv_policy::automatic)
      .def_prop_ro("risk_frame",
                   [](const Planned& p) { return FrameDict(p.plan.risk->grid.frame); })
      .def_prop_ro("scenario", [](const Planned& p) { return p.scenario; });
}

}  // namespace floorproof
