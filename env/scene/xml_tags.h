// SPDX-License-Identifier: Apache-2.0
// The tags of an XML text, where they stand in it: enough to say on which line something is wrong,
// and to change or blank a part before another reader takes it. It checks no syntax: the reader
// that comes after it does.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace floorproof {

struct XmlAttribute {
  std::string_view name, value;  // as written, entities and all
  std::size_t begin = 0;         // of the value in the text
};

struct XmlElement {
  std::string_view name;
  std::vector<XmlAttribute> attributes;
  std::size_t begin = 0, end = 0;  // of the whole element, its tags included
  int parent = -1;                 // index; -1: none
  int line = 0;
  bool closed = false;

  // Of the attribute; empty where there is none.
  std::string_view Value(std::string_view attribute) const;
};

// In the order of their first tags. Comments, declarations and CDATA are passed over. The views
// are into `text`. An element that is never closed ends with the text.
std::vector<XmlElement> XmlElements(std::string_view text);

// An attribute's value with its entities (`&lt;`, `&#110;`, `&#x6e;`) decoded. All other text is
// kept.
std::string DecodeXml(std::string_view written);

// The line, from 1 on, of a place in the text.
int LineAt(std::string_view text, std::size_t at);

}  // namespace floorproof
