// SPDX-License-Identifier: Apache-2.0
#include "env/scene/robot_mjcf.h"

#include <algorithm>
#include <cstdlib>
#include <map>
#include <string_view>

#include "base/error.h"
#include "base/input_file.h"
#include "base/params.h"
#include "base/try_in_child.h"
#include "env/scene/engine_refusal.h"
#include "env/scene/model_numbers.h"
#include "env/scene/models_folder.h"
#include "env/scene/robot_model.h"
#include "env/scene/xml_numbers.h"

namespace floorproof {
namespace {

namespace fs = std::filesystem;

constexpr int kMaxPixels = 8192;  // of a picture's side that the engine draws, or a height field's

// The file's own name in the folder that the system finds: `link/..` is where the link leads.
fs::path Whole(const fs::path& file) {
  std::error_code error;
  const fs::path folder = fs::weakly_canonical(fs::absolute(file).parent_path(), error);
  return error ? fs::absolute(file).lexically_normal() : folder / file.filename();
}

bool IsBundled(const fs::path& path) {
  return std::ranges::any_of(Robots(), [&](const RobotEntry& robot) {
    return Whole(ModelsFolder() / robot.file) == path;
  });
}

// Of the one attribute that is this; 0: there is none (in an include, or spelled otherwise), or
// several.
int LineOf(const std::string& text, const std::string& value) {
  std::size_t found = std::string::npos;
  for (const char quote : {'"', '\''}) {
    const std::string attribute = quote + value + quote;
    const std::size_t at = text.find(attribute);
    if (at == std::string::npos) continue;
    if (found != std::string::npos || text.find(attribute, at + 1) != std::string::npos) return 0;
    found = at;
  }
  if (found == std::string::npos) return 0;
  return LineAt(text, found);
}

// The first file out of the model's reach that the engine's message names, in quotes.
std::optional<std::pair<std::string, std::string>> OutOfReach(const fs::path& model,
                                                              std::string_view message) {
  const fs::path folder = ResolvedPath(Whole(model).parent_path());
  for (std::size_t open = message.find('\''); open != message.npos;) {
    const std::size_t close = message.find('\'', open + 1);
    if (close == message.npos) break;
    const std::string name(message.substr(open + 1, close - open - 1));
    if (std::string why = EngineFiles::WhyOutOfReach(folder, folder / name); !why.empty())
      return {{name, std::move(why)}};
    open = message.find('\'', close + 1);
  }
  return std::nullopt;
}

// A file that the engine may not have is reported first, the engine's own message otherwise.
[[noreturn]] void Refuse(const fs::path& file, const ParsedMjcf& parsed, const InputFiles& files,
                         std::string_view message, std::string_view rule) {
  auto refused = parsed.engine_files.Refused();
  if (!refused) refused = OutOfReach(file, message);
  if (!refused) throw EngineRefusal(file, rule, message);
  const auto& [name, why] = *refused;
  const int line = LineOf(files.Read(file, EngineFiles::kMaxBytes), name);
  throw InputError({file.string(), line}, "file", name, why);
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

bool IsXml(const std::string& bytes) {
  const std::size_t at = bytes.find_first_not_of(" \t\r\n\xEF\xBB\xBF");
  return at != std::string::npos && bytes[at] == '<';
}

// Whether an attribute of the text is this path, with or without a slash at its end.
bool IsAttribute(const std::string& text, const std::string& path) {
  const auto is_quote = [&](std::size_t at) {
    return at < text.size() && (text[at] == '"' || text[at] == '\'');
  };
  for (std::size_t at = text.find(path); at != std::string::npos; at = text.find(path, at + 1)) {
    const std::size_t end = at + path.size();
    if (at > 0 && is_quote(at - 1) && (is_quote(end) || (text[end] == '/' && is_quote(end + 1))))
      return true;
  }
  return false;
}

// Files that the model names by an absolute path, or an asset's folder by one, stay where they are
// when a record of it moves. By the texts: the engine makes some relative paths of an include
// absolute.
std::vector<fs::path> Absolutes(const std::vector<fs::path>& opened, const InputFiles& files) {
  std::vector<const std::string*> texts;
  for (const fs::path& file : opened)
    if (const std::string& bytes = files.Read(file, EngineFiles::kMaxBytes); IsXml(bytes))
      texts.push_back(&bytes);
  const auto is_written = [&](const fs::path& path) {
    return std::ranges::any_of(
        texts, [&](const std::string* text) { return IsAttribute(*text, path.string()); });
  };
  std::vector<fs::path> absolutes;
  for (const fs::path& file : opened) {
    bool absolute = is_written(file);
    if (!IsXml(files.Read(file, EngineFiles::kMaxBytes)))  // includes know no folder of their own
      for (fs::path part = file.parent_path(); part.has_relative_path(); part = part.parent_path())
        absolute = absolute || is_written(part);
    if (absolute) absolutes.push_back(file);
  }
  return absolutes;
}

// Checks every XML file opened so far: the robot file and its includes.
void RefuseBadNumbersOf(const ParsedMjcf& parsed, const fs::path& file, const fs::path& path,
                        const InputFiles& files) {
  for (const fs::path& one : parsed.engine_files.Opened()) {
    const std::string& text = files.Read(one, EngineFiles::kMaxBytes);
    if (IsXml(text)) RefuseBadNumbers(XmlElements(text), text, (one == path ? file : one).string());
  }
}

ParsedMjcf Parse(const fs::path& file, const fs::path& path, const InputFiles& files) {
  ParsedMjcf out;
  out.engine_files = EngineFiles(files, path);
  char error[1000] = "";
  out.spec.reset(mj_parseXML(path.c_str(), out.engine_files.vfs(), error, sizeof error));
  if (!out.engine_files.Refused()) RefuseBadNumbersOf(out, file, path, files);
  if (!out.spec || out.engine_files.Refused())
    Refuse(file, out, files, error, "is not MJCF that MuJoCo reads");
  CheckSizes(file, out.spec.get());
  // Meshes and pictures are opened by the compiler alone.
  const SpecPtr copy(mj_copySpec(out.spec.get()));
  const ModelPtr model(mj_compile(copy.get(), out.engine_files.vfs()));
  if (!model || out.engine_files.Refused())
    Refuse(file, out, files, mjs_getError(copy.get()), "does not compile");
  RefuseWrongNumbers(model.get(), copy.get(), file.string());
  const std::vector<fs::path> opened = out.engine_files.Opened();
  out.absolutes = Absolutes(opened, files);
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
  if (answer.starts_with(kRefused)) throw InputError(answer.substr(1));
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
  const fs::path path = Whole(file);
  files.Read(file, EngineFiles::kMaxBytes);  // what cannot be read says so itself
  const auto same = [&](const auto& part) {
    if (!files.WhyUnreadable(part.first, EngineFiles::kMaxBytes).empty()) return false;
    files.Read(part.first, EngineFiles::kMaxBytes);
    return files.Sha256(part.first) == part.second;
  };
  // Parsing takes 20 ms and a copy 0.3 ms, and a campaign reads its robot in every episode.
  auto known = parsed.find(path);
  if (known == parsed.end() || !std::ranges::all_of(known->second.hashes, same)) {
    if (!IsBundled(path) || files.HasStandIn(path)) Try(file, path, files, use);
    known = parsed.insert_or_assign(path, Parse(file, path, files)).first;
  }
  for (const fs::path& part : known->second.absolutes) files.MarkAbsolute(part);
  return known->second;
}

}  // namespace floorproof
