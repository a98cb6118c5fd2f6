// SPDX-License-Identifier: Apache-2.0
#include "env/scene/measured_block.h"

#include <algorithm>

#include "base/error.h"
#include "base/file_output.h"
#include "env/scene/engine_files.h"
#include "env/scene/measured_names.h"

namespace floorproof {
namespace {

constexpr std::string_view kBegin =
    "<!-- Measured by floorproof robot, which replaces all up to the end of what was measured. -->";
constexpr std::string_view kEnd = "<!-- End of what was measured. -->";
constexpr std::string_view kNone = std::string_view();

bool IsSpace(char c) { return c == ' ' || c == '\t' || c == '\r' || c == '\n'; }

// The block's lines, from the first one's indent to behind the last one's break.
struct Place {
  std::size_t begin = 0, end = 0;
};
Place FindBlock(std::string_view text) {
  const std::size_t begin = text.find(kBegin);
  if (begin == kNone.npos) return {};
  std::size_t end = text.find(kEnd, begin);
  if (end == kNone.npos) return {};
  end += kEnd.size();
  if (const std::size_t line = text.find('\n', end); line != kNone.npos) {
    const std::string_view rest = text.substr(end, line - end);
    if (std::ranges::all_of(rest, IsSpace)) end = line + 1;
  }
  std::size_t from = begin;
  while (from > 0 && (text[from - 1] == ' ' || text[from - 1] == '\t')) --from;
  if (from > 0 && text[from - 1] != '\n') from = begin;
  return {from, end};
}

// The text with spaces in place of each comment's characters: places stay the same.
std::string BlankComments(std::string_view text) {
  std::string out(text);
  for (std::size_t at = out.find("<!--"); at != out.npos; at = out.find("<!--", at)) {
    const std::size_t end = std::min(out.size(), out.find("-->", at + 4) + 3);
    std::fill(out.begin() + static_cast<std::ptrdiff_t>(at),
              out.begin() + static_cast<std::ptrdiff_t>(end < at ? out.size() : end), ' ');
  }
  return out;
}

// Runs of space as one, none beside the brackets of an element.
std::string Squeezed(std::string_view text) {
  std::string out;
  for (const char c : text) {
    if (!IsSpace(c)) {
      if (c == '<' || c == '>')
        while (!out.empty() && out.back() == ' ') out.pop_back();
      out += c;
    } else if (!out.empty() && out.back() != ' ' && out.back() != '>' && out.back() != '<') {
      out += ' ';
    }
  }
  return out;
}

// Where a new block goes: before the end of the first <custom>, else before the root's end.
std::size_t PlaceForBlock(const std::string& bare, bool& own_element) {
  const std::size_t custom = bare.find("</custom>");
  own_element = custom == bare.npos;
  return own_element ? bare.rfind("</mujoco>") : custom;
}

}  // namespace

std::string WithoutMeasured(std::string_view text) {
  const Place place = FindBlock(text);
  return std::string(text.substr(0, place.begin)) + std::string(text.substr(place.end));
}

std::string WithMeasured(std::string_view text, std::string_view elements,
                         const std::filesystem::path& file) {
  const Place old = FindBlock(text);
  std::string rest = WithoutMeasured(text);
  for (const std::string& mark :
       {std::string(kBegin), std::string(kEnd), '"' + std::string(kMeasuredBy) + '"'})
    if (rest.find(mark) != rest.npos)
      throw InputError({file.string(), 0}, std::string(kMeasuredBy), "",
                       "stands outside of one block between its two comments: delete all lines of "
                       "what was measured, then measure again");
  std::size_t at = old.begin;
  bool own_element = text.substr(old.begin, old.end - old.begin).find("<custom>") != kNone.npos;
  if (old.end == 0) {
    at = PlaceForBlock(BlankComments(rest), own_element);
    if (at == rest.npos)
      throw InputError({file.string(), 0}, "custom", "",
                       "the text ends no <custom> and no <mujoco>: nowhere to write what was "
                       "measured");
  }
  // Before a line of its own where there is one, and a little deeper than that.
  std::size_t line = at;
  while (line > 0 && (rest[line - 1] == ' ' || rest[line - 1] == '\t')) --line;
  const bool begins_line = line == 0 || rest[line - 1] == '\n';
  if (begins_line) at = line;
  const std::size_t next = std::min(rest.find_first_not_of(" \t", at), rest.size());
  const std::string indent = begins_line ? rest.substr(at, next - at) + "  " : "";
  const std::string line_break = text.find("\r\n") != text.npos ? "\r\n" : "\n";
  std::string block;
  const auto add = [&](std::string_view written) {
    block += indent + std::string(written) + line_break;
  };
  add(kBegin);
  if (own_element) add("<custom>");
  for (std::size_t from = 0; from < elements.size();) {
    const std::size_t end = std::min(elements.find('\n', from), elements.size());
    add(elements.substr(from, end - from));
    from = end + 1;
  }
  if (own_element) add("</custom>");
  add(kEnd);
  return rest.insert(at, block);
}

std::string ModelHash(std::span<const std::filesystem::path> files, const InputFiles& read) {
  std::string what;
  for (const std::filesystem::path& file : files) {
    const std::string& bytes = read.Read(file, EngineFiles::kMaxBytes);
    what +=
        what.empty() ? Sha256(Squeezed(BlankComments(WithoutMeasured(bytes)))) : read.Sha256(file);
    what += '\n';
  }
  return Sha256(what);
}

}  // namespace floorproof
