// SPDX-License-Identifier: Apache-2.0
#include <floorproof/version.h>

#include <cstdio>
#include <nlohmann/json.hpp>

#include "apps/command.h"
#include "base/json_schema.h"
#include "env/map/site_keys.h"
#include "run/campaign/campaign_gate.h"
#include "run/episode/records.h"
#include "run/scenario/scenario_schema.h"

namespace floorproof {
namespace {

using Json = nlohmann::ordered_json;

Json ToJson(const ConfigNode& node) {
  Json json;
  switch (node.kind) {
    case ConfigNode::Kind::kNull:
      break;
    case ConfigNode::Kind::kScalar:
      return node.quoted ? Json(node.scalar) : Json::parse(node.scalar);
    case ConfigNode::Kind::kList:
      json = Json::array();
      for (const ConfigNode& item : node.items) json.push_back(ToJson(item));
      break;
    case ConfigNode::Kind::kMap:
      json = Json::object();
      for (const auto& [key, value] : node.entries) json[key] = ToJson(value);
      break;
  }
  return json;
}

ConfigNode SchemaOf(const std::string& kind) {
  if (kind == "site") return SiteSchema();
  GateParams gate;
  return ScenarioSchema(MapSchema().Params([&](ParamVisitor& v) { gate.Visit(v); }).Node());
}

}  // namespace

void AddSchema(CommandLine& line, const Globals&, int&) {
  auto kind = std::make_shared<std::string>();
  Subcommand command = line.Add(
      "schema", "Print the JSON Schema of site or scenario files, by which editors complete keys");
  command.OneOf("KIND", *kind, "Of which files", {"scenario", "site"}, Subcommand::Need::kRequired);
  command.OnRun([kind] {
    Json schema = {{"$schema", "http://json-schema.org/draft-07/schema#"},
                   {"$comment", "floorproof " FLOORPROOF_VERSION " schema " + *kind}};
    schema.update(ToJson(SchemaOf(*kind)));
    std::printf("%s\n", JsonText(schema).c_str());
  });
}

}  // namespace floorproof
