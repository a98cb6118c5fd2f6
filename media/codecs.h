// SPDX-License-Identifier: Apache-2.0
// Loads the codec module at first use.
#pragma once

#include "media/codec_api.h"

namespace floorproof {

// The module's functions. Looked for beside the executable, then beside this library; throws
// InternalError naming both when it cannot be loaded.
const CodecApi& Codecs();

}  // namespace floorproof
