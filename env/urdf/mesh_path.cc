// SPDX-License-Identifier: Apache-2.0
#include "env/urdf/mesh_path.h"

#include <algorithm>
#include <cctype>
#include <vector>

#include "base/input_file.h"
#include "base/printable.h"
#include "env/scene/engine_files.h"

namespace floorproof {
namespace {

namespace fs = std::filesystem;

// Where the URI may be meant, best first; relative ones in the URDF's folder.
std::vector<fs::path> Candidates(const std::string& uri) {
  for (const char* scheme : {"package://", "model://"}) {
    const std::string_view prefix = scheme;
    if (!uri.starts_with(prefix)) continue;
    const std::string whole = uri.substr(prefix.size());
    const std::size_t slash = whole.find('/');
    if (slash == std::string::npos) return {whole};
    return {whole.substr(slash + 1), whole};
  }
  constexpr std::string_view kFile = "file://";
  if (uri.starts_with(kFile)) return {uri.substr(kFile.size())};
  return {uri};
}

std::string Extension(const fs::path& file) {
  std::string extension = file.extension().string();
  std::ranges::transform(extension, extension.begin(),
                         [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return extension;
}

}  // namespace

MeshPlace FindMesh(const std::string& uri, const fs::path& urdf, const SourceMark& mark,
                   const InputFiles& files) {
  const fs::path folder = ResolvedPath(fs::absolute(urdf).parent_path());
  MeshPlace place;
  for (const fs::path& candidate : Candidates(uri)) {
    const fs::path file = (folder / candidate).lexically_normal();
    if (const std::string why = EngineFiles::WhyOutOfReach(folder, file); !why.empty())
      throw InputError(mark, "mesh", uri, why);
    if (std::error_code error; !fs::exists(file, error)) continue;
    place.extension = Extension(file);
    constexpr std::string_view kReadable[] = {".stl", ".obj", ".msh", ".dae"};
    if (std::ranges::find(kReadable, place.extension) == std::end(kReadable)) {
      const std::string name = Printable(file.filename().string());
      place.why =
          "has an unsupported format (supported: .stl, .obj, .dae; to convert it: `assimp export " +
          name + " " + Printable(file.stem().string()) + ".stl`)";
      return place;
    }
    if (const std::string why = files.WhyUnreadable(file, EngineFiles::kMaxBytes); !why.empty())
      throw InputError(mark, "mesh", uri, why);
    place.file = file;
    place.is_collada = place.extension == ".dae";
    if (place.is_collada) place.extension = ".obj";
    return place;
  }
  place.why =
      "is not there below " + folder.filename().string() +
      "/, the folder of the robot's file (a package's URDF belongs in the package's folder)";
  return place;
}

}  // namespace floorproof
