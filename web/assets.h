// SPDX-License-Identifier: Apache-2.0
// What a page needs in the browser, as texts that may stand inside it: none ends a script or style.
#pragma once

#include <string_view>

namespace floorproof {

std::string_view PageStyle();   // page.css
std::string_view PageScript();  // our own scripts, in one

// Libraries that it uses; empty where the program was built without them (FLOORPROOF_WEB=0).
std::string_view ThreeJs();    // three.js and its orbit controls: the replay
std::string_view EChartsJs();  // Apache ECharts: plots
std::string_view AgGridJs();   // AG Grid Community: tables

}  // namespace floorproof
