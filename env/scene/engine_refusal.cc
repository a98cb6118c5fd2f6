// SPDX-License-Identifier: Apache-2.0
#include "env/scene/engine_refusal.h"

#include <charconv>
#include <string>

#include "base/printable.h"

namespace floorproof {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kSpace = " \t\r\n";

// The number in "Line number=3", as the XML parser writes it, or in "line 3" at a message's end,
// which is removed.
int TakeLine(std::string& message) {
  const std::size_t last = message.find_last_not_of(kSpace);
  message.resize(last == message.npos ? 0 : last + 1);
  std::size_t at = message.rfind("line ");
  const bool ends =
      at != message.npos && message.find_first_not_of("0123456789", at + 5) == message.npos;
  if (!ends) at = message.rfind("Line number=");
  if (at == message.npos) return 0;
  int line = 0;
  const std::size_t digits = at + (ends ? 5 : 12);
  std::from_chars(message.data() + digits, message.data() + message.size(), line);
  if (ends) message.resize(message.find_last_not_of(", \n", at - 1) + 1);
  return line;
}

// The XML parser names the element at which it gave up. What cannot be parsed may be any file, with
// a secret there.
void DropElement(std::string& message) {
  constexpr std::string_view kLine = "Line number=";
  const std::size_t at = message.find(kLine);
  if (at == message.npos) return;
  const std::size_t from = message.find_first_not_of("0123456789", at + kLine.size());
  if (from == message.npos) return;
  message.erase(from, message.find('\'', from) - from);
}

std::string WithoutFolder(std::string message, const fs::path& file) {
  std::error_code error;
  const std::string folder = fs::weakly_canonical(fs::absolute(file).parent_path(), error) / "";
  if (error || folder.size() < 2) return message;
  for (std::size_t at = message.find(folder); at != message.npos; at = message.find(folder, at))
    message.erase(at, folder.size());
  return message;
}

// Quoted values and single words, which may be a file's content, cut to a bounded length.
std::string Shortened(std::string_view message) {
  constexpr std::size_t kMost = 60;
  std::string out;
  while (!message.empty()) {
    const bool quoted = message.front() == '\'';
    const std::size_t end = quoted ? message.find('\'', 1) : message.find_first_of(" \n");
    out += CutEnd(message.substr(0, end), kMost);
    if (end == message.npos) break;
    out += quoted ? '\'' : ' ';
    message.remove_prefix(end + 1);
  }
  return out;
}

}  // namespace

InputError EngineRefusal(const fs::path& file, std::string_view rule, std::string_view message) {
  std::string text(message);
  DropElement(text);
  const int line = TakeLine(text);
  text = Shortened(WithoutFolder(std::move(text), file));
  return {{file.string(), line}, "", "", std::string(rule) + ": " + text};
}

}  // namespace floorproof
