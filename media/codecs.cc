// SPDX-License-Identifier: Apache-2.0
#include "media/codecs.h"

#include <string>

#include "base/error.h"
#include "base/load_module.h"

namespace floorproof {
namespace {

const CodecApi* Load() {
  const std::string what = "the image and video codecs";
  using Entry = const CodecApi* (*)();
  const auto entry = reinterpret_cast<Entry>(LoadModule(kCodecModule, kCodecSymbol, what));
  const CodecApi* api = entry();
  if (api == nullptr || api->version != kCodecApiVersion)
    throw InternalError("cannot load " + what + ": " + kCodecModule + " is of another version");
  return api;
}

}  // namespace

const CodecApi& Codecs() {
  static const CodecApi* api = Load();  // a failed load is tried again at the next call
  return *api;
}

}  // namespace floorproof
