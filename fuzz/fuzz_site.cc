// SPDX-License-Identifier: Apache-2.0
// A site file. One that is read must survive being resolved: written, read and resolved once more,
// it is the same text.
#include "env/map/site.h"
#include "fuzz/read_or_refuse.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace floorproof;
  const auto file = Save("site.yaml", View(data, size));
  bool read = false;
  std::string once;
  ReadOrRefuse([&] {
    ReadSiteFile(file);
    read = true;
  });
  if (!read) return 0;
  once = WriteYaml(ResolveSite(ReadYamlFile(file), Folder(), Folder()));
  try {
    const ConfigNode node = ParseYaml(once, "resolved");
    ReadSite(node, Folder());
    if (WriteYaml(ResolveSite(node, Folder(), Folder())) != once)
      Finding("resolved twice it differs:\n" + once);
  } catch (const InputError& e) {
    Finding(std::string("its resolved form is refused: ") + e.what() + "\n" + once);
  }
  return 0;
}
