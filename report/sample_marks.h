// SPDX-License-Identifier: Apache-2.0
// How the places of an audit are marked: on all pictures alike.
#pragma once

#include <string>
#include <vector>

#include "env/core/sample_place.h"

namespace floorproof {

// For HeatMapOptions::series: whether a picture shows places of a kind or not, the others keep
// their marks.
std::vector<std::string> SampleSeries();
// By the most telling reason for which the place was chosen, or that it is out of reach.
std::string SampleSeriesOf(const SamplePlace& place);

}  // namespace floorproof
