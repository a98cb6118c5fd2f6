// SPDX-License-Identifier: Apache-2.0
// The program, for main() and for tests that run it in a process of their own making.
#pragma once

namespace floorproof {

// Reads the command line, runs the command and returns the exit status. Errors are printed here.
int RunFloorproof(int argc, char** argv);

}  // namespace floorproof
