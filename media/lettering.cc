// SPDX-License-Identifier: Apache-2.0
#include "media/lettering.h"

#include <string>

#include "base/error.h"
#include "base/load_module.h"
#include "media/letters_api.h"
#include "media/module_call.h"

namespace floorproof {

std::optional<Lettering> DrawLettering(std::string_view utf8, double cap_px, bool bold) {
  static const LettersApi& letters =
      LoadTable<LettersApi>(kLettersModule, kLettersSymbol, "what draws letters");
  LettersApi::Drawn drawn{};
  void* raw = nullptr;
  char error[kModuleErrorSize] = "";
  if (letters.draw(std::string(utf8).c_str(), cap_px, bold ? 1 : 0, &drawn, &raw, error) != 0)
    throw InternalError(std::string("cannot draw text: ") + error);
  if (raw == nullptr) return std::nullopt;
  const ModuleHandle handle(raw, letters.release);
  Lettering out;
  out.coverage.width = drawn.width;
  out.coverage.height = drawn.height;
  out.coverage.channels = 1;
  out.coverage.data.assign(drawn.coverage,
                           drawn.coverage + static_cast<std::size_t>(drawn.width) *
                                                static_cast<std::size_t>(drawn.height));
  out.base = drawn.base;
  out.advance_px = drawn.advance_px;
  return out;
}

}  // namespace floorproof
