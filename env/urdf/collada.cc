// SPDX-License-Identifier: Apache-2.0
#include "env/urdf/collada.h"

#include <assimp/config.h>
#include <assimp/postprocess.h>
#include <assimp/scene.h>
#include <fmt/format.h>

#include <assimp/IOSystem.hpp>
#include <assimp/Importer.hpp>
#include <iterator>

#include "base/error.h"
#include "base/printable.h"

namespace floorproof {
namespace {

// Denies Assimp access to all files; the importer reads only the given text.
class NoFiles : public Assimp::IOSystem {
 public:
  bool Exists(const char*) const override { return false; }
  char getOsSeparator() const override { return '/'; }
  Assimp::IOStream* Open(const char*, const char*) override { return nullptr; }
  void Close(Assimp::IOStream*) override {}
};

}  // namespace

std::string ObjOfCollada(const std::string& text) {
  Assimp::Importer importer;
  importer.SetIOHandler(new NoFiles);  // the importer deletes it
  importer.SetPropertyBool(AI_CONFIG_IMPORT_COLLADA_IGNORE_UP_DIRECTION, true);
  importer.SetPropertyInteger(AI_CONFIG_PP_SBP_REMOVE,
                              aiPrimitiveType_POINT | aiPrimitiveType_LINE);
  const aiScene* scene =
      importer.ReadFileFromMemory(text.data(), text.size(),
                                  aiProcess_Triangulate | aiProcess_PreTransformVertices |
                                      aiProcess_SortByPType | aiProcess_JoinIdenticalVertices,
                                  "dae");
  if (scene == nullptr)
    throw InputError("not a valid Collada mesh: " + Printable(importer.GetErrorString()));
  std::string obj;
  unsigned int first = 1;  // of a mesh's vertices; OBJ counts from 1
  for (unsigned int i = 0; i < scene->mNumMeshes; ++i) {
    const aiMesh& mesh = *scene->mMeshes[i];
    for (unsigned int v = 0; v < mesh.mNumVertices; ++v)
      fmt::format_to(std::back_inserter(obj), "v {} {} {}\n", mesh.mVertices[v].x,
                     mesh.mVertices[v].y, mesh.mVertices[v].z);
    for (unsigned int f = 0; f < mesh.mNumFaces; ++f) {
      if (mesh.mFaces[f].mNumIndices != 3) continue;  // a polygon without area
      const unsigned int* at = mesh.mFaces[f].mIndices;
      fmt::format_to(std::back_inserter(obj), "f {} {} {}\n", first + at[0], first + at[1],
                     first + at[2]);
    }
    first += mesh.mNumVertices;
  }
  if (obj.empty()) throw InputError("not a valid Collada mesh: it has no triangles");
  return obj;
}

}  // namespace floorproof
