// SPDX-License-Identifier: Apache-2.0
#include "run/scenario/scenario.h"

namespace floorproof {

namespace fs = std::filesystem;

std::string ProgramAnnounced(const Scenario& s) {
  const PlanCommand* program = ProgramToAsk(s.spec);
  if (program == nullptr) return "";
  CheckProgram(*program, s.files);
  return ProgramLine(*program);
}

void RefuseProgram(const Scenario& s) {
  if (const PlanCommand* program = ProgramToAsk(s.spec))
    throw InputError(program->mark, "plan.command", program->words.front(),
                     "made no plan: there is nothing to drive again, and a replay runs no program");
}

std::vector<fs::path> FilesRead(const Scenario& s) {
  std::vector<fs::path> files = s.world.site.files_read;
  if (!s.spec.site_file.empty()) files.insert(files.begin(), s.spec.site_file);
  files.push_back(s.spec.robot_file);
  if (!s.world.robot.files.empty())
    files.insert(files.end(), s.world.robot.files.begin() + 1, s.world.robot.files.end());
  files.push_back(s.spec.fmea_file);
  if (!s.spec.risk_model_file.empty()) files.push_back(s.spec.risk_model_file);
  if (s.spec.plan_command)
    files.insert(files.end(), s.spec.plan_command->files.begin(), s.spec.plan_command->files.end());
  if (!s.spec.plan_file.empty()) files.push_back(s.spec.plan_file);
  if (!s.spec.places_file.empty()) files.push_back(s.spec.places_file);
  if (!s.spec.mission_file.empty()) files.push_back(s.spec.mission_file);
  return files;
}

std::vector<fs::path> InputsOf(const Scenario& s) {
  std::vector<fs::path> files = FilesRead(s);
  files.push_back(s.spec.file);
  return files;
}

}  // namespace floorproof
