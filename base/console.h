// SPDX-License-Identifier: Apache-2.0
// Lines for people.
#pragma once

#include <cstdio>
#include <functional>
#include <string>

#include "base/text_table.h"

namespace floorproof {

struct Console {
  bool json = false;   // stdout is the result's: lines go to stderr
  bool quiet = false;  // nothing is said
  // Takes each line in place of stdout and stderr, where there is one, quiet or not.
  std::function<void(const std::string&)> listener = {};

  // One line, whatever the names in it hold.
  void Say(const std::string& line) const;
  // Fitted to the terminal, and in colours where it shows them; to who listens 80 columns wide and
  // without.
  void Say(const TextTable& table) const;
  // A row of a FactTable.
  void SayFact(const std::string& name, const std::string& text) const;

 private:
  std::FILE* Out() const { return json ? stderr : stdout; }
  void SayPrintable(const std::string& line) const;
};

}  // namespace floorproof
