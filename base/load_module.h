// SPDX-License-Identifier: Apache-2.0
// Parts of the program that are loaded at first use, so that it starts in milliseconds: those whose
// libraries bring hundreds of others.
#pragma once

#include <string>

#include "base/error.h"

namespace floorproof {

// The address of `symbol` in the shared library of that file name, which lies beside the program or
// beside the shared library that this code was linked into (a Python package, say). It is never
// unloaded: OpenCV's libraries keep threads and tables that must not be unmapped. Throws
// InternalError "cannot load WHAT: why" when it is in neither place, or has no such symbol.
void* LoadModule(const char* file, const char* symbol, const std::string& what);

// The module's table of functions, which `symbol` is called for. Throws InternalError as above, and
// where the table is of another version than the program's.
template <class Table>
const Table& LoadTable(const char* file, const char* symbol, const std::string& what) {
  using Entry = const Table* (*)();
  const Table* table = reinterpret_cast<Entry>(LoadModule(file, symbol, what))();
  if (table == nullptr || table->version != Table::kVersion)
    throw InternalError("cannot load " + what + ": " + file + " is of another version");
  return *table;
}

}  // namespace floorproof
