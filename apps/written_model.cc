// SPDX-License-Identifier: Apache-2.0
#include "apps/written_model.h"

#include <fmt/format.h>

#include <string_view>

#include "base/file_output.h"
#include "base/input_file.h"
#include "env/scene/engine_files.h"
#include "env/scene/measured_block.h"

namespace floorproof {
namespace {

namespace fs = std::filesystem;

// What was made of a URDF begins with a line that names the rest by its hash: as long as that is
// true, it is nobody else's.
std::string Mark(std::string_view rest) {
  return fmt::format("<!-- Written by floorproof robot, which may replace it unchanged: {} -->\n",
                     Sha256(rest));
}

struct ModelText {
  bool marked = false;
  std::string rest;  // without the mark
};
ModelText ReadModelText(const fs::path& file) {
  const std::string text = ReadInputFile(file, EngineFiles::kMaxBytes);
  const std::size_t line = text.find('\n');
  const std::size_t end = line == std::string::npos ? 0 : line + 1;
  if (text.substr(0, end) != Mark(std::string_view(text).substr(end))) return {false, text};
  return {true, text.substr(end)};
}

bool IsThere(const fs::path& file) {
  std::error_code ignored;
  return fs::exists(fs::symlink_status(file, ignored));
}

// A plain file that can be read, by its own name.
bool IsReadable(const fs::path& file) {
  std::error_code ignored;
  return WhyUnreadable(file, EngineFiles::kMaxBytes).empty() && !fs::is_symlink(file, ignored);
}

[[noreturn]] void RefuseToReplaceIt(const fs::path& file, std::string_view what) {
  throw InputError({file.string(), 0}, "", "",
                   fmt::format("is there already, {}: --out names another file", what));
}

void Write(const fs::path& file, const ModelText& text) {
  if (file.has_parent_path()) MakeFolder(file.parent_path());
  WriteFileWhole(file, (text.marked ? Mark(text.rest) : "") + text.rest);
}

}  // namespace

bool WriteConverted(const fs::path& out, const std::string& mjcf) {
  if (IsThere(out)) {
    constexpr std::string_view kChanged = "changed or not written by `robot`";
    if (!IsReadable(out)) RefuseToReplaceIt(out, kChanged);
    const ModelText old = ReadModelText(out);
    if (!old.marked) RefuseToReplaceIt(out, kChanged);
    const std::string bare = WithoutMeasured(old.rest);
    if (bare == mjcf) return false;
    Write(out, {true, mjcf});
    return bare != old.rest;
  }
  Write(out, {true, mjcf});
  return false;
}

fs::path PlaceForLimits(const std::vector<fs::path>& robot_files, const fs::path& out) {
  const fs::path& file = robot_files.front();
  std::error_code ignored;
  const fs::path target =
      out.empty() || fs::equivalent(out, file, ignored) ? fs::canonical(file) : out;
  const ModelText text = ReadModelText(file);
  WithMeasured(text.rest, "", file);
  if (target == out) {
    const fs::path folder = fs::weakly_canonical(fs::absolute(out).parent_path(), ignored);
    if (robot_files.size() > 1 && folder != fs::canonical(file).parent_path())
      throw InputError(
          {"--out", 0}, "", out.string(),
          "must lie in the folder of " + file.string() + ", which names other files beside it");
    if (IsThere(out) && (!IsReadable(out) ||
                         WithoutMeasured(ReadModelText(out).rest) != WithoutMeasured(text.rest)))
      RefuseToReplaceIt(out, "and is another model than " + file.string());
  }
  if (target.has_parent_path()) MakeFolder(target.parent_path());
  fs::remove(MakePartFile(target), ignored);  // before minutes of work are lost
  return target;
}

void WriteLimits(const fs::path& file, const fs::path& target, const std::string& elements) {
  ModelText text = ReadModelText(file);
  text.rest = WithMeasured(text.rest, elements, file);
  Write(target, text);
}

}  // namespace floorproof
