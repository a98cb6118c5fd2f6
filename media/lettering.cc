// SPDX-License-Identifier: Apache-2.0
#include "media/lettering.h"

#include <string>

#include "base/error.h"
#include "media/codecs.h"

namespace floorproof {

std::optional<Lettering> DrawLettering(std::string_view utf8, double cap_px, bool bold) {
  CodecText drawn{};
  void* handle = nullptr;
  char error[kCodecErrorSize] = "";
  if (Codecs().draw_text(std::string(utf8).c_str(), cap_px, bold ? 1 : 0, &drawn, &handle, error) !=
      0)
    throw InternalError(std::string("cannot draw text: ") + error);
  if (handle == nullptr) return std::nullopt;
  Lettering out;
  out.coverage.width = drawn.coverage.width;
  out.coverage.height = drawn.coverage.height;
  out.coverage.channels = 1;
  const auto* pixels = static_cast<const std::uint8_t*>(drawn.coverage.data);
  out.coverage.data.assign(pixels, pixels + static_cast<std::size_t>(drawn.coverage.width) *
                                                static_cast<std::size_t>(drawn.coverage.height));
  out.base = drawn.base;
  out.advance_px = drawn.advance_px;
  Codecs().release_text(handle);
  return out;
}

}  // namespace floorproof
