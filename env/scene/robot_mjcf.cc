// SPDX-License-Identifier: Apache-2.0
#include "env/scene/robot_mjcf.h"

#include <algorithm>
#include <cstdlib>
#include <map>
#include <string_view>

#include "base/error.h"
#include "base/params.h"
#include "base/try_in_child.h"
#include "env/scene/robot_model.h"

namespace floorproof {
namespace {

namespace fs = std::filesystem;

constexpr int kMaxPixels = 8192;  // of a picture's side that the engine draws, or a height field's

bool IsBundled(const fs::path& path) {
  return std::ranges::any_of(Robots(), [&](const RobotEntry& robot) {
    return fs::absolute(ModelsFolder() / robot.file).lexically_normal() == path;
  });
}

// What the engine opened and must not have goes before what the engine says of it.
[[noreturn]] void Refuse(const fs::path& file, const ParsedMjcf& parsed, const InputFiles& files,
                         std::string_view message, std::string_view rule) {
  if (const auto refused = parsed.engine_files.Refused()) {
    const std::string& text = files.Read(file, EngineFiles::kMaxBytes);
    const std::size_t at =
        text.find(refused->first);  // nowhere: in an include, or spelled otherwise
    const auto line =
        at == std::string::npos
            ? 0
            : 1 + std::count(text.begin(), text.begin() + static_cast<std::ptrdiff_t>(at), '\n');
    throw InputError({file.string(), static_cast<int>(line)}, "file", refused->first,
                     refused->second);
  }
  throw InputError({file.string(), 0}, "", message, rule);
}

template <class T>
void ForEach(mjSpec* spec, mjtObj type, T* (*as)(mjsElement*),
             const std::function<void(T*)>& visit) {
  for (mjsElement* e = mjs_firstElement(spec, type); e; e = mjs_nextElement(spec, e)) visit(as(e));
}

// By the numbers that the engine has read, before it makes what they ask for.
void CheckSizes(const fs::path& file, mjSpec* spec) {
  const auto check = [&](const char* key, int value, mjString* info) {
    if (value > kMaxPixels)
      throw InputError(
          {file.string(), 0}, key, std::to_string(value),
          "must be at most " + std::to_string(kMaxPixels) + " (" + mjs_getString(info) + ")");
  };
  ForEach<mjsTexture>(spec, mjOBJ_TEXTURE, mjs_asTexture, [&](mjsTexture* texture) {
    check("width", texture->width, texture->info);
    check("height", texture->height, texture->info);
  });
  ForEach<mjsHField>(spec, mjOBJ_HFIELD, mjs_asHField, [&](mjsHField* field) {
    check("nrow", field->nrow, field->info);
    check("ncol", field->ncol, field->info);
  });
}

// Files that the model names by an absolute path, or by its folder's, stay where they are when a
// record of it moves. By the texts: the engine makes some relative paths of an include absolute.
void MarkAbsolutes(const std::vector<fs::path>& opened, const InputFiles& files) {
  const auto is_written = [&](const std::string& path) {
    return std::ranges::any_of(opened, [&](const fs::path& text) {
      return text.extension() == ".xml" &&
             files.Read(text, EngineFiles::kMaxBytes).find('"' + path) != std::string::npos;
    });
  };
  for (const fs::path& file : opened)
    for (fs::path part = file; part.has_relative_path(); part = part.parent_path())
      if (is_written(part.string() + '"') || is_written(part.string() + "/\"")) {
        files.MarkAbsolute(file);
        break;
      }
}

ParsedMjcf Parse(const fs::path& file, const fs::path& path, const InputFiles& files) {
  ParsedMjcf out;
  out.engine_files = EngineFiles(files, path);
  char error[1000] = "";
  out.spec.reset(mj_parseXML(path.c_str(), out.engine_files.vfs(), error, sizeof error));
  if (!out.spec || out.engine_files.Refused())
    Refuse(file, out, files, error, "is not MJCF that MuJoCo reads");
  CheckSizes(file, out.spec.get());
  // Meshes and pictures are opened by the compiler alone.
  const SpecPtr copy(mj_copySpec(out.spec.get()));
  const ModelPtr model(mj_compile(copy.get(), out.engine_files.vfs()));
  if (!model || out.engine_files.Refused())
    Refuse(file, out, files, mjs_getError(copy.get()), "does not compile");
  const std::vector<fs::path> opened = out.engine_files.Opened();
  MarkAbsolutes(opened, files);
  for (const fs::path& one : opened) out.hashes.emplace_back(one, files.Sha256(one));
  return out;
}

// In the child: nullptr is what MuJoCo does not look for.
void* MallocOrEnd(std::size_t bytes) {
  constexpr std::size_t kAlignment = 64;  // as mju_malloc promises
  void* block = std::aligned_alloc(kAlignment, (bytes + kAlignment - 1) / kAlignment * kAlignment);
  if (block == nullptr) EndForWantOfMemory();
  return block;
}

// An answer of the child: kRefused and why, or pairs of a file and its hash. No path holds a 0.
constexpr char kRefused = 'r', kTaken = 't', kEnd = '\0';

std::string Answer(const fs::path& file, const fs::path& path, const InputFiles& files,
                   const std::function<void(const ParsedMjcf&)>& use) {
  mju_user_malloc = MallocOrEnd;
  try {
    const ParsedMjcf parsed = Parse(file, path, files);
    use(parsed);
    std::string answer(1, kTaken);
    for (const auto& [name, hash] : parsed.hashes) answer += name.string() + kEnd + hash + kEnd;
    return answer;
  } catch (const InputError& e) {
    return kRefused + std::string(e.what());
  } catch (const InternalError& e) {
    return kRefused + file.string() + ": cannot be simulated: " + e.what();
  }
}

// Throws InputError where the child refuses the model or does not survive it.
void Try(const fs::path& file, const fs::path& path, const InputFiles& files,
         const std::function<void(const ParsedMjcf&)>& use) {
  const TrialOutcome outcome = TryInChild([&] { return Answer(file, path, files, use); });
  if (!outcome.answer)
    throw InputError({file.string(), 0}, "", "",
                     "MuJoCo " + outcome.failure + " while it compiled this robot");
  const std::string& answer = *outcome.answer;
  if (answer.front() == kRefused) throw InputError(answer.substr(1));
  // The same bytes are read here.
  auto next = [&answer, at = std::size_t{1}]() mutable {
    const std::size_t begin = at, end = answer.find(kEnd, begin);
    at = end + 1;
    return answer.substr(begin, end - begin);
  };
  for (std::string name = next(); !name.empty(); name = next()) {
    files.Read(name, EngineFiles::kMaxBytes);
    if (files.Sha256(name) != next())
      throw InputError({name, 0}, "", "", "was written while it was read");
  }
}

}  // namespace

const ParsedMjcf& ReadMjcf(const fs::path& file, const InputFiles& files,
                           const std::function<void(const ParsedMjcf&)>& use) {
  static std::map<fs::path, ParsedMjcf> parsed;
  const fs::path path = fs::absolute(file).lexically_normal();
  const auto same = [&](const auto& known) { return files.Sha256(known.first) == known.second; };
  // Parsing takes 20 ms and a copy 0.3 ms, and a campaign reads its robot in every episode.
  if (const auto known = parsed.find(path);
      known != parsed.end() && std::ranges::all_of(known->second.hashes, same))
    return known->second;
  files.Read(file, EngineFiles::kMaxBytes);  // what cannot be read says so itself
  if (!IsBundled(path)) Try(file, path, files, use);
  return parsed.insert_or_assign(path, Parse(file, path, files)).first->second;
}

}  // namespace floorproof
