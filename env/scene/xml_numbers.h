// SPDX-License-Identifier: Apache-2.0
// Numbers in the text of a robot's XML that are not finite, or whose squares are not.
//
// MuJoCo takes NaN for "not stated": `mass="nan"` becomes the default, so the compiled model does
// not show it. An axis of 1e300, whose length overflows, becomes another axis.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "env/scene/xml_tags.h"

namespace floorproof {

// Throws InputError naming file, line, element and attribute of the first number of MJCF or URDF
// that is NaN, infinite, too large for a double (1e999), or beyond 1e150. Names, references, files
// and texts may be spelled like such a number, and a URDF's joint may have infinite effort and
// velocity. Of a URDF, elements outside of links, joints and materials are not read. `elements` are
// those of `text`.
void RefuseBadNumbers(const std::vector<XmlElement>& elements, std::string_view text,
                      const std::string& file);

}  // namespace floorproof
