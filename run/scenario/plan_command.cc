// SPDX-License-Identifier: Apache-2.0
#include "run/scenario/plan_command.h"

#include <fmt/format.h>

#include <algorithm>
#include <system_error>

#include "base/file_output.h"
#include "base/input_file.h"
#include "base/json_schema.h"
#include "base/params.h"
#include "base/printable.h"
#include "base/run_program.h"
#include "run/scenario/scenario_parts.h"
#include "run/scenario/trust.h"

namespace floorproof {
namespace {

namespace fs = std::filesystem;

constexpr std::uintmax_t kMaxProgramBytes = 32u << 20;

std::vector<std::string> ReadWords(const ConfigNode& node) {
  if (!node.IsList() || node.items.empty())
    throw InputError(node.mark, "plan.command", node.scalar,
                     "must be a list of words, the program first: [./cover.py, --fast]");
  std::vector<std::string> words;
  for (const ConfigNode& item : node.items) {
    words.push_back(AsString(item, "plan.command"));
    if (words.back().find('\0') != std::string::npos)
      throw InputError(item.mark, "plan.command", words.back(), "must hold no null character");
  }
  if (words.front().empty())
    throw InputError(node.mark, "plan.command", "\"\"", "must begin with a program");
  return words;
}

void VisitKeys(ParamVisitor& v, PlanCommand& command) {
  v("timeout_s", command.timeout_s, {0, 1e6, true}, "wall time that the program has (s)");
  v("uses_seed", command.uses_seed, "each episode asks for a plan of its own");
}

}  // namespace

std::string Typed(const std::vector<std::string>& words) {
  std::string line;
  for (const std::string& word : words) {
    const bool plain =
        !word.empty() && word.find_first_of(" \t\n'\"\\$&|;<>()*?#`") == std::string::npos;
    line += (line.empty() ? "" : " ") + (plain ? word : "'" + word + "'");
  }
  return Printable(line);
}

PlanCommand ReadPlanCommand(const ConfigNode& plan, const fs::path& folder,
                            const InputFiles& files) {
  const ConfigNode& written = *plan.Find("command");
  for (const char* other : {"planner", "file"})
    if (const ConfigNode* beside = plan.Find(other))
      throw InputError(beside->mark, std::string("plan.") + other, beside->scalar,
                       "stands beside plan.command: a plan is made by a planner, read from a file "
                       "or asked of a program; take one of them away");
  PlanCommand command;
  command.mark = written.mark;
  command.words = ReadWords(written);
  command.folder = folder;
  if (const ConfigNode* works_in = plan.Find("folder"))
    command.folder = PathIn(folder, *works_in, "plan.folder");
  ReadParams(plan, "plan.", [&](ParamVisitor& v) { VisitKeys(v, command); },
             {"command", "folder", "made"});
  for (const std::string& word : command.words) {
    const bool absolute = fs::path(word).is_absolute(), program = &word == &command.words.front();
    // Interpreters are not the scenario's.
    if (word.empty() || (program && (absolute || word.find('/') == std::string::npos))) continue;
    const fs::path file = command.folder / word;
    if (!files.WhyUnreadable(file, kMaxProgramBytes).empty()) continue;
    if (absolute) files.MarkAbsolute(file);
    files.Read(file, kMaxProgramBytes);  // as it is now
    command.files.push_back(file);
    if (command.name.empty()) command.name = Printable(file.filename().string());
  }
  if (command.name.empty())
    command.name = Printable(fs::path(command.words.front()).filename().string());
  return command;
}

ConfigNode PlanCommandSchema() {
  PlanCommand usual;
  return MapSchema()
      .Key("command", ListSchema(TextSchema(), 1), "the program, and its arguments")
      .Require("command")
      .Key("folder", TextSchema("."), "that it works in (default: this file's)")
      .Params([&](ParamVisitor& v) { VisitKeys(v, usual); })
      .Key("made", TextSchema("."), "the plan.csv that it made once: no program is run")
      .Node();
}

ConfigNode WritePlanCommand(const PlanCommand& command, const fs::path& folder,
                            const fs::path& made) {
  const auto from_there = [&](const fs::path& path) {
    const auto absolute = [](const fs::path& p) { return fs::absolute(p.empty() ? "." : p); };
    return fs::relative(absolute(path), absolute(folder));
  };
  const auto text = [](const fs::path& path) { return ConfigNode::Scalar(path.string(), true); };
  ConfigNode node = ConfigNode::Map();
  ConfigNode& words = node.Add("command", ConfigNode::List());
  for (const std::string& word : command.words)
    words.items.push_back(ConfigNode::Scalar(word, true));
  node.Add("folder", text(from_there(command.folder) / ""));
  PlanCommand keys = command;
  WriteParams([&](ParamVisitor& v) { VisitKeys(v, keys); }, node);
  if (!made.empty()) node.Add("made", text(from_there(made)));
  return node;
}

void CheckProgram(const PlanCommand& command, const InputFiles& files) {
  RefuseUntrusted(command, files);
  const std::string& program = command.words.front();
  std::error_code ignored;
  if (const fs::path& folder = command.folder;
      !folder.empty() && !fs::is_directory(folder, ignored))
    throw InputError(command.mark, "plan.folder", folder.string(), "no such folder");
  const std::string why =
      WhyNoProgram(program, fs::absolute(command.folder.empty() ? "." : command.folder));
  if (!why.empty()) throw InputError(command.mark, "plan.command", program, why);
  for (const fs::path& file : command.files)
    if (const std::string now = Sha256OfFile(file); now != files.Sha256(file))
      throw InputError(command.mark, "plan.command", file.string(),
                       "the file has changed since it was read: SHA-256 " + now);
}

std::string ProgramLine(const PlanCommand& command) {
  const SourceMark& mark = command.mark;
  const bool in_file = mark.line > 0 && !mark.file.starts_with(kSet);
  const std::string where = in_file ? fmt::format("{}:{}", mark.file, mark.line) : mark.file;
  return fmt::format("runs a program that {} names: {}", Printable(where), Typed(command.words));
}

}  // namespace floorproof
