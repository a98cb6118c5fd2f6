// SPDX-License-Identifier: Apache-2.0
#include "run/episode/ask_program.h"

#include <fmt/format.h>

#include <algorithm>
#include <sstream>
#include <vector>

#include "base/input_file.h"
#include "base/printable.h"
#include "base/run_program.h"
#include "run/episode/episode_stream.h"
#include "run/episode/plan_request_files.h"
#include "run/scenario/plan_file.h"
#include "run/scenario/scenario.h"

namespace floorproof {
namespace {

namespace fs = std::filesystem;

// Its last lines in one; empty where it said nothing. Tracebacks end with what went wrong.
std::string LastWords(const std::string& text) {
  constexpr std::size_t kLines = 3, kBytes = 400;
  std::vector<std::string> lines;
  std::istringstream in(text);
  for (std::string line; std::getline(in, line);) {
    const std::size_t begin = line.find_first_not_of(" \t\r");
    if (begin != std::string::npos)
      lines.push_back(line.substr(begin, line.find_last_not_of(" \t\r") + 1 - begin));
  }
  std::string words;
  const std::size_t from = lines.size() - std::min(lines.size(), kLines);
  for (std::size_t i = from; i < lines.size(); ++i) words += (i > from ? " / " : "") + lines[i];
  if (words.size() > kBytes) words = "..." + words.substr(words.size() - kBytes);
  return words.empty() ? "" : ": " + Printable(words);
}

// Where the files were is not the same twice.
std::string WithoutFolder(std::string text, const fs::path& folder) {
  const std::string prefix = (folder / "").string();
  for (std::size_t at = 0; (at = text.find(prefix, at)) != std::string::npos;)
    text.erase(at, prefix.size());
  return text;
}

// The body folds by hinges that the model has only if the plan was known when it was read.
std::string ShapeChange(const Path& path, const std::string& shape) {
  for (const Waypoint& w : path)
    if (!w.shape.empty() && w.shape != shape) return w.shape;
  return "";
}

}  // namespace

std::uint32_t ProgramSeed(const ScenarioSpec& spec, const PlanCommand& program) {
  if (program.uses_seed)
    return static_cast<std::uint32_t>(EpisodeStream(spec, "plan").Next() >> 32);
  return static_cast<std::uint32_t>(spec.episode.seed);
}

ProgramAnswer AskProgram(const Scenario& s, const PlanCommand& program,
                         const PlanRequest& request) {
  CheckProgram(program, s.files);
  ExchangeFolder exchange;
  const fs::path& folder = exchange.path();
  WritePlanRequest(request, ProgramSeed(s.spec, program), folder);
  ProgramCall call{program.words, fs::absolute(program.folder.empty() ? "." : program.folder),
                   program.timeout_s};
  call.words.push_back(folder.string());
  const ProgramOutcome outcome = exchange.Run(call);
  ProgramAnswer answer;
  const auto failed = [&](const std::string& why) {
    answer.path.clear();
    answer.failure =
        WithoutFolder(program.name + " " + why + LastWords(outcome.last_words), folder);
    return answer;
  };
  if (!outcome.in_time) return failed(outcome.failure + " (plan.timeout_s)");
  if (!outcome.failure.empty()) return failed(outcome.failure);
  const fs::path file = folder / "plan.csv";
  std::error_code ignored;
  if (!fs::exists(fs::symlink_status(file, ignored))) return failed("wrote no plan.csv");
  try {
    answer.path = ReadPlan(file, request.map.frame);
  } catch (const InputError& e) {
    return failed(std::string("gave a plan that cannot be driven: ") + e.what());
  }
  const std::string& shape = s.spec.robot_changes.shape;
  if (const std::string other = ShapeChange(answer.path, shape); !other.empty())
    return failed("gave a plan that changes the robot's shape (" + other +
                  "), which a file's plan alone can: save it, and name it by plan.file");
  return answer;
}

}  // namespace floorproof
