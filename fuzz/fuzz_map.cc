// SPDX-License-Identifier: Apache-2.0
// A ROS map: its yaml, a line "%%image", then the bytes of the image, which the yaml may name
// `image`.
#include "env/map/ros_map.h"
#include "fuzz/read_or_refuse.h"
#include "tests/media/png_maker.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace floorproof;
  constexpr std::string_view kCut = "%%image\n";
  const std::string_view bytes = View(data, size);
  const std::size_t cut = bytes.find(kCut);
  if (cut == std::string_view::npos) return -1;
  // Of a PNG no change would come past the checksums.
  Save("image", WithRightChecksums(std::string(bytes.substr(cut + kCut.size()))));
  const auto file = Save("map.yaml", bytes.substr(0, cut));
  ReadOrRefuse([&] { ReadRosMap(file); });
  return 0;
}
