// SPDX-License-Identifier: Apache-2.0
// Parts of the program that are loaded at first use, so that it starts in milliseconds: those whose
// libraries bring hundreds of others.
#pragma once

#include <string>

namespace floorproof {

// The address of `symbol` in the shared library of that file name, which lies beside the program or
// beside the shared library that this code was linked into (a Python package, say). It is never
// unloaded: OpenCV's libraries keep threads and tables that must not be unmapped. Throws
// InternalError "cannot load WHAT: why" when it is in neither place, or has no such symbol.
void* LoadModule(const char* file, const char* symbol, const std::string& what);

}  // namespace floorproof
