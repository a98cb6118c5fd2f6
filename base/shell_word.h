// SPDX-License-Identifier: Apache-2.0
// Text in commands that people paste into a shell.
#pragma once

#include <string>

namespace floorproof {

// As a shell takes it for one word: quoted where it must be.
std::string ShellWord(const std::string& text);

}  // namespace floorproof
