// SPDX-License-Identifier: Apache-2.0
#include "run/scenario/written_faults.h"

#include <algorithm>

#include "base/json_schema.h"

namespace floorproof {
namespace {

constexpr std::size_t kMaxFaults = 1000;

// Where the key is written that the line begins with; else where the entry is.
SourceMark MarkOfLine(const ConfigNode& entry, std::string_view line) {
  return MarkOf(entry, line.substr(0, line.find_first_of(" :")));
}

ScheduledFault ReadFault(const ConfigNode& node, const std::string& path,
                         const FaultContext& context, double step_s) {
  if (!node.IsMap())
    throw InputError(node.mark, path, "", "must be a map of keys: {type: ..., ...}");
  const std::string prefix = path + ".";
  const ConfigNode* type = node.Find("type");
  if (type == nullptr) throw InputError(node.mark, prefix + "type", "", "missing");
  ScheduledFault read;
  read.type = AsString(*type, prefix + "type");
  read.fault = MakePlugin(Faults(), read.type, prefix + "type", type->mark);
  ReadParams(node, prefix,
             [&](ParamVisitor& v) {
               read.fault->Visit(v);
               read.timing.Visit(v);
             },
             {"type", "id"});
  if (const ConfigNode* id = node.Find("id")) {
    read.id = AsString(*id, prefix + "id");
    const bool number = read.id.find_first_not_of("0123456789") == std::string::npos;
    if (number || read.id.size() > 64 || read.id.find('.') != std::string::npos)
      throw InputError(id->mark, prefix + "id", read.id,
                       "must be 1 to 64 characters without a dot, and not a number, which is a "
                       "place in the list");
  }
  if (const auto& duration_s = read.timing.duration_s; duration_s && *duration_s < step_s)
    throw InputError(MarkOf(node, "duration_s"), prefix + "duration_s", FormatDouble(*duration_s),
                     "must last a physics step, " + FormatDouble(step_s) + " s");
  if (const auto& period_s = read.timing.period_s) {
    const double duty = read.timing.duty;
    if (*period_s * duty < step_s || (duty < 1 && *period_s * (1 - duty) < step_s))
      throw InputError(MarkOf(node, "period_s"), prefix + "period_s", FormatDouble(*period_s),
                       "must leave a physics step, " + FormatDouble(step_s) +
                           " s, to the broken and to the sound share of it");
  }
  try {
    read.fault->Start(context);
  } catch (const InputError& e) {
    throw InputError(MarkOfLine(node, e.what()), "", "", prefix + e.what());
  }
  return read;
}

}  // namespace

std::vector<ScheduledFault> ReadFaults(const ConfigNode& node, const FaultContext& context,
                                       double step_s) {
  if (!node.IsList() || node.items.size() > kMaxFaults)
    throw InputError(
        node.mark, "faults", "",
        "must be a list of at most " + std::to_string(kMaxFaults) + " faults: [{type: ..., ...}]");
  std::vector<ScheduledFault> faults;
  for (std::size_t i = 0; i < node.items.size(); ++i) {
    faults.push_back(
        ReadFault(node.items[i], "faults[" + std::to_string(i) + "]", context, step_s));
    const std::string& id = faults.back().id;
    if (!id.empty() && std::ranges::count(faults, id, &ScheduledFault::id) > 1)
      throw InputError(node.items[i].mark, "faults[" + std::to_string(i) + "].id", id,
                       "two faults have this id");
  }
  return faults;
}

ConfigNode FaultsSchema() {
  std::vector<NamedSchema> types = PluginSchemas(Faults());
  FaultTiming timing;
  for (NamedSchema& type : types)
    type.keys.Params([&](ParamVisitor& v) { timing.Visit(v); })
        .Key("id", TextSchema("^(?=.*[^0-9])[^.]{1,64}$"),
             "by which draws and --set name it (default: its place in the list)");
  return OrNull(
      ListSchema(NamedMapSchema("type", "what breaks", types, Unnamed::kRefused), 0, kMaxFaults));
}

ConfigNode WriteFaults(std::span<const ScheduledFault> faults) {
  ConfigNode list = ConfigNode::List();
  for (const ScheduledFault& written : faults) {
    ConfigNode node = ConfigNode::Map();
    node.Add("type", ConfigNode::Scalar(written.type));
    if (!written.id.empty()) node.Add("id", ConfigNode::Scalar(written.id, true));
    WriteParams(*written.fault, node);
    list.items.push_back(WithParams(std::move(node), written.timing));
  }
  return list;
}

}  // namespace floorproof
