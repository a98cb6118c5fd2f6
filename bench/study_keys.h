// SPDX-License-Identifier: Apache-2.0
// KEY=VALUE arguments of a study, as a file would hold them.
#pragma once

#include <string>

#include "base/config.h"

namespace floorproof {

inline ConfigNode KeysOfArguments(int argc, char** argv) {
  std::string text;
  for (int i = 1; i < argc; ++i) {
    std::string line = argv[i];
    if (const auto at = line.find('='); at != std::string::npos) line.replace(at, 1, ": ");
    text += line + "\n";
  }
  return ParseYaml(text, "command line");
}

}  // namespace floorproof
