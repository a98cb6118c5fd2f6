// SPDX-License-Identifier: Apache-2.0
#include "run/scenario/trust.h"

#include <sys/stat.h>
#include <unistd.h>

#include "base/input_file.h"
#include "env/scene/models_folder.h"
#include "run/scenario/plan_command.h"
#include "run/scenario/scenario_parts.h"

namespace floorproof {
namespace {

namespace fs = std::filesystem;

fs::path FolderOf(const fs::path& file) { return ResolvedPath(fs::absolute(file).parent_path()); }

// Another user's `.git` above a folder, in /tmp say, must not widen what is read.
bool IsWorkingTreeOf(const struct stat& scenario, const fs::path& folder) {
  struct stat git {};
  return lstat((folder / ".git").c_str(), &git) == 0 && git.st_uid == scenario.st_uid;
}

}  // namespace

fs::path ProjectFolder(const fs::path& file) {
  const fs::path own = FolderOf(file);
  struct stat scenario {};
  if (stat(file.c_str(), &scenario) != 0) scenario.st_uid = geteuid();  // it is yet to be written
  for (fs::path folder = own;; folder = folder.parent_path()) {
    if (IsWorkingTreeOf(scenario, folder)) return folder;
    if (folder == folder.parent_path()) return own;
  }
}

void ConfineScenario(const fs::path& file, const InputFiles& files) {
  const fs::path models = ModelsFolder();
  if (LiesBelow(ResolvedPath(models), FolderOf(file))) return;
  // The settings of results have copies of their inputs beside them.
  const bool recorded = file.filename() == "scenario.resolved.yaml";
  files.Confine(recorded ? FolderOf(file) : ProjectFolder(file), "scenario");
  files.Allow(file);
  files.Allow(models);
}

void ConfineMap(const fs::path& file, const InputFiles& files) {
  files.Confine(ProjectFolder(file), "map");
  files.Allow(file);
  files.Allow(fs::absolute(file).parent_path());
}

void AllowTyped(const std::string& key, const ConfigNode& value, const fs::path& folder,
                const InputFiles& files) {
  for (const auto& [name, part] : value.entries) AllowTyped(key + "." + name, part, folder, files);
  if (!value.IsScalar() || !NamesFile(key, value.scalar)) return;
  const fs::path named = folder / value.scalar;
  const bool has_parts = key.starts_with("robot") || key.starts_with("site");
  files.Allow(has_parts ? fs::absolute(named).parent_path() : named);
}

void RefuseUntrusted(const PlanCommand& program, const InputFiles& files) {
  if (!files.confined() || program.mark.file.starts_with(kSet)) return;
  throw InputError(program.mark, "plan.command", Typed(program.words),
                   "is a program that the scenario names: --trust runs it");
}

}  // namespace floorproof
