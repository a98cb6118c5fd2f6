// SPDX-License-Identifier: Apache-2.0
// How often a kind of meeting fails by one of its covariates, drawn as SVG: counted, with
// intervals, and as the rates have it.
#pragma once

#include <string>
#include <string_view>

#include "base/key_name.h"
#include "measure/kind_findings.h"

namespace floorproof {

// "step height", "speed"; of an approach as docs/results.md has its columns.
std::string AxisTitle(std::string_view type, const AxisFinding& axis);

// The unit in which a covariate is told.
KeyScale AxisScale(const AxisFinding& axis);

// `reach`: the rate at its top; `name`: of what is met, for who cannot see it.
std::string RateChart(std::string_view type, const AxisFinding& axis, double reach,
                      const std::string& name);

}  // namespace floorproof
