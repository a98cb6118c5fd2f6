// SPDX-License-Identifier: Apache-2.0
#include "env/scene/xml_tags.h"

#include <algorithm>
#include <charconv>
#include <cstdint>
#include <utility>

namespace floorproof {
namespace {

constexpr std::string_view kSpace = " \t\r\n";

class TagReader {
 public:
  explicit TagReader(std::string_view text) : text_(text) {}

  std::vector<XmlElement> Read() {
    while ((at_ = text_.find('<', at_)) != std::string_view::npos) {
      const std::string_view rest = text_.substr(at_);
      if (rest.starts_with("<!--"))
        Pass("-->");
      else if (rest.starts_with("<![CDATA["))
        Pass("]]>");
      else if (rest.starts_with("<?") || rest.starts_with("<!"))
        Pass(">");
      else if (rest.starts_with("</"))
        Close();
      else
        Open();
    }
    for (const int index : open_) out_[static_cast<std::size_t>(index)].end = text_.size();
    return std::move(out_);
  }

 private:
  void Pass(std::string_view end) {
    const std::size_t found = text_.find(end, at_);
    at_ = found == std::string_view::npos ? text_.size() : found + end.size();
  }

  void Close() {
    const std::size_t begin = at_;
    Pass(">");
    std::string_view name = text_.substr(begin + 2, at_ - begin - 3);
    name = name.substr(0, name.find_first_of(kSpace));
    // What closes without having been opened is the next reader's affair.
    const auto opened = std::find_if(open_.rbegin(), open_.rend(), [&](int index) {
      return out_[static_cast<std::size_t>(index)].name == name;
    });
    if (opened == open_.rend()) return;
    out_[static_cast<std::size_t>(*opened)].closed = true;
    for (auto inner = open_.rbegin(); inner != std::next(opened); ++inner)
      out_[static_cast<std::size_t>(*inner)].end = at_;
    open_.erase(std::prev(opened.base()), open_.end());
  }

  void Open() {
    XmlElement element;
    element.begin = at_++;
    line_ += static_cast<int>(std::count(text_.begin() + static_cast<std::ptrdiff_t>(counted_),
                                         text_.begin() + static_cast<std::ptrdiff_t>(element.begin),
                                         '\n'));
    counted_ = element.begin;
    element.line = line_;
    element.parent = open_.empty() ? -1 : open_.back();
    element.name = Word();
    while (at_ < text_.size() && text_[at_] != '>') {
      if (text_[at_] == '/') element.closed = true;
      if (text_[at_] == '/' || kSpace.find(text_[at_]) != std::string_view::npos)
        ++at_;
      else
        Attribute(element);
    }
    at_ = std::min(at_ + 1, text_.size());
    element.end = at_;
    const bool closed = element.closed;
    out_.push_back(std::move(element));
    if (!closed) open_.push_back(static_cast<int>(out_.size()) - 1);
  }

  // Up to what ends a name; one letter at least.
  std::string_view Word() {
    const std::size_t begin = at_;
    at_ = std::min(text_.find_first_of(" \t\r\n=/>", at_), text_.size());
    if (at_ == begin && at_ < text_.size()) ++at_;
    return text_.substr(begin, at_ - begin);
  }

  void Attribute(XmlElement& element) {
    const std::string_view name = Word();
    at_ = std::min(text_.find_first_not_of(kSpace, at_), text_.size());
    if (at_ == text_.size() || text_[at_] != '=') return;
    at_ = std::min(text_.find_first_not_of(kSpace, at_ + 1), text_.size());
    if (at_ == text_.size() || (text_[at_] != '"' && text_[at_] != '\'')) return;
    const char quote = text_[at_];
    const std::size_t begin = at_ + 1, end = std::min(text_.find(quote, begin), text_.size());
    element.attributes.push_back({name, text_.substr(begin, end - begin), begin});
    at_ = std::min(end + 1, text_.size());
  }

  std::string_view text_;
  std::size_t at_ = 0, counted_ = 0;
  int line_ = 1;
  std::vector<XmlElement> out_;
  std::vector<int> open_;
};

void AppendUtf8(std::uint32_t code, std::string& out) {
  const auto add = [&](std::uint32_t byte) { out += static_cast<char>(byte); };
  const auto tail = [&](int shift) { add(0x80 | (code >> shift & 0x3f)); };
  if (code < 0x80) {
    add(code);
  } else if (code < 0x800) {
    add(0xc0 | code >> 6), tail(0);
  } else if (code < 0x10000) {
    add(0xe0 | code >> 12), tail(6), tail(0);
  } else {
    add(0xf0 | code >> 18), tail(12), tail(6), tail(0);
  }
}

// Appends what the entity at the text's begin means; returns its length, 0 where there is none.
std::size_t DecodeEntity(std::string_view text, std::string& out) {
  static constexpr std::pair<std::string_view, char> kNamed[] = {
      {"&lt;", '<'}, {"&gt;", '>'}, {"&quot;", '"'}, {"&apos;", '\''}, {"&amp;", '&'}};
  for (const auto& [entity, character] : kNamed)
    if (text.starts_with(entity)) {
      out += character;
      return entity.size();
    }
  if (!text.starts_with("&#")) return 0;
  const bool hex = text.starts_with("&#x");
  const char* const last = text.data() + text.size();
  std::uint32_t code = 0;
  const auto [end, error] = std::from_chars(text.data() + (hex ? 3 : 2), last, code, hex ? 16 : 10);
  if (error != std::errc() || end == last || *end != ';' || code > 0x10ffff) return 0;
  AppendUtf8(code, out);
  return static_cast<std::size_t>(end - text.data()) + 1;
}

}  // namespace

std::string_view XmlElement::Value(std::string_view attribute) const {
  for (const XmlAttribute& a : attributes)
    if (a.name == attribute) return a.value;
  return {};
}

std::vector<XmlElement> XmlElements(std::string_view text) { return TagReader(text).Read(); }

std::string DecodeXml(std::string_view written) {
  std::string out;
  while (!written.empty()) {
    std::size_t taken = DecodeEntity(written, out);
    if (taken == 0) {
      taken = 1;
      out += written.front();
    }
    written.remove_prefix(taken);
  }
  return out;
}

int LineAt(std::string_view text, std::size_t at) {
  return 1 + static_cast<int>(std::ranges::count(text.substr(0, at), '\n'));
}

}  // namespace floorproof
