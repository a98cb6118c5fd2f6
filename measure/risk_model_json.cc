// SPDX-License-Identifier: Apache-2.0
#include "measure/risk_model_json.h"

#include <algorithm>
#include <nlohmann/json.hpp>

namespace floorproof {
namespace {

using Json = nlohmann::ordered_json;

Json JsonOf(const RateAxis& axis) {
  Json json;
  json["name"] = axis.name;
  json["of"] = axis.of_hazard ? "hazard" : "approach";
  json["lower"] = axis.lower;
  json["upper"] = axis.upper;
  if (axis.period > 0) json["period"] = axis.period;
  json["knots"] = axis.knots;
  json["functions"] = axis.functions;
  return json;
}

void Add(const LinearPredictor& of, Json& json) {
  json["events"] = of.events;
  json["blocks"] = Json::array();
  for (const RateBlock& block : of.blocks) {
    Json numbers = Json::array();
    for (const RateFactor& factor : block.factors)
      for (const std::size_t number : {factor.axis, factor.first, factor.count})
        numbers.push_back(number);
    json["blocks"].push_back(std::move(numbers));
  }
  json["coefficients"] = of.coefficients;
  json["members"] = of.members;
}

Json JsonOf(const KindRates& kind) {
  Json json;
  json["type"] = kind.type;
  json["passage"] = Name(kind.passage);
  json["manner"] = Name(kind.manner);
  json["per"] = kind.per_metre ? "metre" : "encounter";
  json["encounters"] = kind.encounters;
  json["cleared"] = kind.cleared;
  json["censored"] = kind.censored;
  json["way_m"] = kind.way_m;
  json["theta"] = kind.theta;
  json["axes"] = Json::array();
  for (const RateAxis& axis : kind.axes) json["axes"].push_back(JsonOf(axis));
  Add(kind.any, json["any"]);
  json["splits"] = Json::array();
  for (const ModeSplit& split : kind.splits) {
    Json each;
    each["mode"] = Name(split.mode);
    Add(split.of, each);
    json["splits"].push_back(std::move(each));
  }
  return json;
}

// Maps and lists of such over several lines, lists of scalars in one.
void Write(const Json& json, const std::string& indent, std::string& text) {
  if (!json.is_structured() || json.empty() ||
      (json.is_array() && std::none_of(json.begin(), json.end(),
                                       [](const Json& item) { return item.is_structured(); }))) {
    text += json.dump();
    return;
  }
  const std::string inner = indent + " ";
  text += json.is_array() ? "[" : "{";
  bool first = true;
  for (const auto& [key, value] : json.items()) {
    text += (first ? "\n" : ",\n") + inner;
    first = false;
    if (json.is_object()) text += Json(key).dump() + ": ";
    Write(value, inner, text);
  }
  text += "\n" + indent + (json.is_array() ? "]" : "}");
}

}  // namespace

std::string RiskModelJson(const RiskModel& model) {
  Json json;
  json["risk_model"] = kRiskModelVersion;
  Json& robot = json["robot"];
  robot["name"] = model.robot.name;
  robot["drive"] = model.robot.drive;
  robot["mass_kg"] = model.robot.mass_kg;
  robot["clearance_m"] = model.robot.clearance_m;
  robot["model"] = model.robot.model;
  json["mirrored"] = model.mirrored;
  json["encounters"] = model.encounters;
  const CarryOver& carried = model.carry_over;
  if (carried.plans > 0)
    json["plans"] = {{"intercept", carried.intercept}, {"slope", carried.slope},
                     {"plans", carried.plans},         {"drives", carried.drives},
                     {"expected", carried.expected},   {"failed", carried.failed}};
  json["kinds"] = Json::array();
  for (const KindRates& kind : model.kinds) json["kinds"].push_back(JsonOf(kind));
  json["unmeasured"] = Json::array();
  for (const UnmeasuredKind& kind : model.unmeasured) {
    Json each;
    each["type"] = kind.type;
    each["passage"] = Name(kind.passage);
    each["why"] = kind.why;
    json["unmeasured"].push_back(std::move(each));
  }
  std::string text;
  Write(json, "", text);
  return text + "\n";
}

}  // namespace floorproof
