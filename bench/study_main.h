// SPDX-License-Identifier: Apache-2.0
// What studies are called with: KEY=VALUE arguments, as a file would hold them.
#pragma once

#include <fmt/format.h>

#include <string>

#include "base/error.h"
#include "base/interrupt.h"
#include "base/params.h"

namespace floorproof {

// Reads a Study, a Configurable, and runs it. Returns the exit status.
template <class Study, class Run>
int StudyMain(const char* name, int argc, char** argv, Run run) {
  CatchInterrupts();
  try {
    std::string text;
    for (int i = 1; i < argc; ++i) {
      std::string line = argv[i];
      if (const auto at = line.find('='); at != std::string::npos) line.replace(at, 1, ": ");
      text += line + "\n";
    }
    Study study;
    ReadParams(ParseYaml(text, "command line"), "", study);
    return run(study);
  } catch (const InputError& error) {
    fmt::print(stderr, "{}: {}\n", name, error.what());
    return 2;
  }
}

}  // namespace floorproof
