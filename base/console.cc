// SPDX-License-Identifier: Apache-2.0
#include "base/console.h"

#include "base/printable.h"
#include "base/terminal.h"

namespace floorproof {

void Console::Say(const std::string& line) const { SayPrintable(PrintableLine(line)); }

void Console::Say(const TextTable& table) const {
  const int fd = listener ? -1 : fileno(Out());
  for (const std::string& line : table.Lines(TerminalWidth(fd), HasColours(fd))) SayPrintable(line);
}

void Console::SayFact(const std::string& name, const std::string& text) const {
  FactTable table;
  table.Add({name, text});
  Say(table);
}

void Console::SayPrintable(const std::string& line) const {
  if (listener) listener(line);
  if (quiet || listener) return;
  std::fprintf(Out(), "%s\n", line.c_str());
  std::fflush(Out());
}

}  // namespace floorproof
