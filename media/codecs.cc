// SPDX-License-Identifier: Apache-2.0
#include "media/codecs.h"

#include "base/load_module.h"

namespace floorproof {

const CodecApi& Codecs() {
  // A failed load is tried again at the next call.
  static const CodecApi& api =
      LoadTable<CodecApi>(kCodecModule, kCodecSymbol, "the image and video codecs");
  return api;
}

}  // namespace floorproof
