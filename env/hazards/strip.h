// SPDX-License-Identifier: Apache-2.0
// A polyline with a width.
#pragma once

#include <string_view>
#include <vector>

#include "env/geometry/polygon.h"

namespace floorproof {

// The quadrilaterals that a strip of this width covers, one per segment, counter-clockwise: from
// the segment's right start over its right end to its left end. Ends are square. At bends,
// neighbours meet on the bisector (mitred); strips of several widths along one line share their
// bisectors. Throws InputError when a bend is sharper than 150 degrees or too tight for the width;
// `width_key` names the width in the message.
std::vector<Polygon> StripAlong(const std::vector<Vec2>& line, double width_m,
                                std::string_view width_key);

}  // namespace floorproof
