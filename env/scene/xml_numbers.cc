// SPDX-License-Identifier: Apache-2.0
#include "env/scene/xml_numbers.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "base/error.h"
#include "env/scene/part_name.h"

namespace floorproof {
namespace {

constexpr std::string_view kSpace = " \t\r\n\v\f";
constexpr std::string_view kNotFinite = "must be a finite number",
                           kTooLarge = "must be at most 1e150, so that its square is finite";

// Attributes of MJCF and URDF whose value is free text. All others hold numbers or keywords; no
// keyword is spelled like a number.
constexpr std::string_view kTexts[] = {
    "actuator", "assetdir",     "body",      "body1",   "body2",      "camera",    "childclass",
    "class",    "content_type", "cranksite", "file",    "fileback",   "filedown",  "filefront",
    "fileleft", "filename",     "fileright", "fileup",  "flex",       "geom",      "geom1",
    "geom2",    "hfield",       "instance",  "joint",   "joint1",     "joint2",    "jointinparent",
    "key",      "link",         "material",  "mesh",    "meshdir",    "model",     "name",
    "node",     "objname",      "plugin",    "prefix",  "refname",    "refsite",   "sep",
    "sidesite", "site",         "site1",     "site2",   "slidersite", "subtree1",  "subtree2",
    "target",   "tendon",       "tendon1",   "tendon2", "texture",    "texturedir"};

bool IsText(const XmlElement& element, std::string_view attribute) {
  // Colours and sizes of drawings: `joint` is a colour there.
  if (element.name == "rgba" || element.name == "scale") return false;
  if (element.name == "text" && attribute == "data") return true;
  if (element.name == "config" && attribute == "value") return true;  // of a plugin
  return std::ranges::find(kTexts, attribute) != std::end(kTexts);
}

// A URDF's joint may have no limit; what that means for a wheel's motor is reported (env/urdf).
bool MayBeInfinite(const XmlElement& element, std::string_view attribute) {
  return element.name == "limit" && (attribute == "effort" || attribute == "velocity");
}

// The first number of the value that nothing can be computed with, and why.
struct BadNumber {
  std::string number;
  std::string_view rule;  // empty: there is none
};
BadNumber FirstBad(const std::string& value, bool may_be_infinite) {
  for (std::size_t at = value.find_first_not_of(kSpace); at != value.npos;) {
    const std::size_t end = std::min(value.find_first_of(kSpace, at), value.size());
    std::string token = value.substr(at, end - at);
    char* rest = nullptr;
    const double number = std::strtod(token.c_str(), &rest);
    const bool unlimited = may_be_infinite && number > 0;
    if (*rest != '\0' || unlimited || std::isfinite(number * number)) {
      at = value.find_first_not_of(kSpace, end);
      continue;
    }
    return {std::move(token), std::isfinite(number) ? kTooLarge : kNotFinite};
  }
  return {};
}

// By element: whether a reader of URDF takes numbers from it.
std::vector<char> ReadOfUrdf(const std::vector<XmlElement>& elements) {
  std::vector<char> read(elements.size(), 0);
  for (std::size_t i = 1; i < elements.size(); ++i) {
    const int parent = elements[i].parent;
    const std::string_view name = elements[i].name;
    read[i] = parent == 0 ? name == "link" || name == "joint" || name == "material"
                          : parent > 0 && read[static_cast<std::size_t>(parent)];
  }
  return read;
}

}  // namespace

void RefuseBadNumbers(const std::vector<XmlElement>& elements, std::string_view text,
                      const std::string& file) {
  if (elements.empty()) return;
  const std::vector<char> read =
      elements[0].name == "robot" ? ReadOfUrdf(elements) : std::vector<char>(elements.size(), 1);
  for (std::size_t i = 0; i < elements.size(); ++i) {
    if (read[i] == 0) continue;
    for (const XmlAttribute& attribute : elements[i].attributes) {
      if (IsText(elements[i], attribute.name)) continue;
      const BadNumber bad =
          FirstBad(DecodeXml(attribute.value), MayBeInfinite(elements[i], attribute.name));
      if (bad.rule.empty()) continue;
      throw InputError(
          {file, LineAt(text, attribute.begin)},
          PartName(elements[i].name, DecodeXml(elements[i].Value("name")), attribute.name),
          bad.number, bad.rule);
    }
  }
}

}  // namespace floorproof
