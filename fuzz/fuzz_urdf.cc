// SPDX-License-Identifier: Apache-2.0
// A URDF of any bytes, as it is made ready for MuJoCo's importer, which reads it in a child process
// (env/urdf/urdf_mjcf.h). No mesh is found but below the file's folder.
#include <algorithm>

#include "env/urdf/urdf_text.h"
#include "fuzz/read_or_refuse.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace floorproof;
  const auto file = Save("my.urdf", View(data, size));
  static const auto mesh = Save("shell.obj", "v 0 0 0\n");
  ReadOrRefuse([&] {
    IsUrdf(file, {});
    const UrdfText text = PrepareUrdf(file, {});
    if (text.joints.size() > size) Finding("more joints than bytes");
    for (const UrdfMesh& found : text.meshes)
      if (found.file != mesh && found.file != file) Finding("a mesh of elsewhere: " + found.name);
  });
  return 0;
}
