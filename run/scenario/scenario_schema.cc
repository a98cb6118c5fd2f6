// SPDX-License-Identifier: Apache-2.0
#include "run/scenario/scenario_schema.h"

#include <functional>
#include <utility>

#include "base/json_schema.h"
#include "base/name_param.h"
#include "controllers/estimator.h"
#include "controllers/mapper.h"
#include "controllers/tracker.h"
#include "env/failures/detector.h"
#include "env/map/site_keys.h"
#include "run/scenario/matrix.h"
#include "run/scenario/named_plugin.h"
#include "run/scenario/scenario_parts.h"
#include "run/scenario/written_faults.h"
#include "run/scenario/written_safety.h"

namespace floorproof {
namespace {

template <class Params>
ConfigNode Group(Params params) {
  return OrNull(MapSchema().Params([&](ParamVisitor& v) { params.Visit(v); }).Node());
}

// The name of what comes with the program, or a path with this ending.
ConfigNode BundledOrPath(std::string_view bundled, const std::string& ending) {
  return AnyOf({ChoiceSchema({std::string(bundled)}), TextSchema("\\" + ending + "$")});
}

ConfigNode Robot() {
  std::vector<std::string> names, helps;
  for (const RobotEntry& robot : Robots()) {
    names.emplace_back(robot.name);
    helps.emplace_back(robot.help);
  }
  const ConfigNode bundled = ChoiceSchema(names, helps), path = TextSchema("\\.xml$");
  RobotChanges changes;
  return AnyOf({bundled, path,
                MapSchema()
                    .Key("name", AnyOf({bundled, path}), "a bundled robot, or an .xml file")
                    .Require("name")
                    .Params([&](ParamVisitor& v) { changes.Visit(v); })
                    .Node()});
}

// A place that the site says, too.
ConfigNode Place(const std::function<void(ParamVisitor&)>& visit) {
  return OrNull(MapSchema().Params(visit, MapSchema::Defaults::kElsewhere).Node());
}

// A planner's name or its keys, a file, or a program.
ConfigNode Plan() {
  std::vector<NamedSchema> planners = PluginSchemas(Planners());
  const ConfigNode path = TextSchema(".");
  for (NamedSchema& planner : planners)
    if (MakePlugin(Planners(), planner.name, "planner")->promises().visits_places) {
      ConfigNode& samples = planner.keys.At("samples");
      samples =
          AnyOf({std::move(samples),
                 MapSchema().Key("file", path, "your own places, x_m,y_m").Require("file").Node()});
    }
  for (NamedSchema& online : PluginSchemas(OnlinePlanners())) planners.push_back(std::move(online));
  return AnyOf({NamedPluginSchema("planner", "its name", planners, Unnamed::kFirst),
                MapSchema().Key("file", path, "a plan of your own (.csv)").Require("file").Node(),
                PlanCommandSchema()});
}

ConfigNode Risk() {
  RiskParams risk;
  return OrNull(MapSchema()
                    .Key("tables", BundledOrPath(kBundledTables, ".yaml"), "FMEA tables")
                    .Key("model", TextSchema(), "a file of the robot's measured rates, or none")
                    .Params([&](ParamVisitor& v) { risk.Visit(v); })
                    .Node());
}

// Where a campaign's variants or draws may name site and robot, the scenario itself need not.
ConfigNode NamesItself() {
  return ParseYaml(
      "{if: {not: {anyOf: [{required: ['matrix']}, {required: ['randomise']}]}}, "
      "then: {required: ['site', 'robot']}}",
      "");
}

}  // namespace

ConfigNode ScenarioSchema(ConfigNode gate) {
  EpisodeParams episode;
  Mapper mapper;
  Pose2 start;
  Vec2 goal = Vec2::Zero();
  double yaw_deg = 0;
  MapSchema map;
  map.Key("scenario", ConstSchema("1"), "the format's version")
      .Require("scenario")
      .Key("name", NameSchema(), "in results and on pictures (default: the file's stem)")
      .Key("site", AnyOf({TextSchema("."), SiteSchema()}), "a site file, or the site itself")
      .Key("robot", Robot(), "a bundled robot, an .xml file, or either with what is changed of it")
      .Key("start", Place([&](ParamVisitor& v) { VisitStart(v, start, yaw_deg); }),
           "where the robot starts (default: the site's)")
      .Key("goal", Place([&](ParamVisitor& v) { VisitGoal(v, goal); }),
           "where it is to end (default: the site's)")
      .Key("plan", Plan(), "a planner, {file: plan.csv}, or {command: [a program]}")
      .Key("risk", Risk(), "how the risk factor is computed")
      .Key("controller",
           NamedPluginSchema("name", "its name", PluginSchemas(Trackers()), Unnamed::kAny),
           "what follows the path (default: by the robot's drive)")
      .Key("estimator",
           NamedPluginSchema("name", "its name", PluginSchemas(Estimators()), Unnamed::kFirst),
           "how the robot knows where it is")
      .Key("sensors", OrNull(PluginMapSchema(PluginSchemas(Sensors()))),
           "each with its keys (default: those that are needed)")
      .Key("mapper", OrNull(MapSchema().Params(mapper).Node()), "draws a map of what was sensed")
      .Key("react", Group(RecoveryParams()), "what the robot does when it meets something")
      .Key("safety", SafetySchema(), "supervision of the drive; {}: all as it is by default")
      .Key("mission",
           AnyOf({BundledOrPath(kBundledMission, ".yaml"), MapSchema().Node(), NoneSchema()}),
           "the task tree that a supervised robot executes")
      .Key("faults", FaultsSchema(), "what breaks while the robot drives")
      .Key("dirt", DirtSchema(), "what lies on the floor, and how samples of it are taken")
      .Key("failures", OrNull(PluginMapSchema(PluginSchemas(Detectors()))),
           "each detector with its thresholds")
      .Params([&](ParamVisitor& v) { episode.Visit(v); })
      .Key("physics", Group(PhysicsParams()), "MuJoCo's step and integrator")
      .Key("battery", Group(Battery()), "what feeds motors and computers")
      .Key("video", Group(VideoParams()), "of `--video`")
      .Key("randomise", RandomiseSchema(),
           "key: distribution, drawn anew in each episode; what is drawn wins")
      .Key("sampling", SamplingSchema(), "how `randomise` draws")
      .Key("matrix", MatrixSchema(), "key: list of values, a variant of the campaign each")
      .Key("gate", AnyOf({std::move(gate), NoneSchema()}), "what a campaign must prove")
      .Key("files", AnyKeysSchema(TextSchema()),
           "written by the program: each file that was read, with its SHA-256");
  ConfigNode scenario = map.Node();
  for (auto& [key, value] : NamesItself().entries) scenario.Add(key, std::move(value));
  return scenario;
}

}  // namespace floorproof
