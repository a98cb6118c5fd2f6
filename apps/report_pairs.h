// SPDX-License-Identifier: Apache-2.0
// A paired comparison as the report shows it.
#pragma once

#include "env/run/campaign_comparison.h"
#include "render/report.h"

namespace floorproof {

ReportPair ShownPair(const Comparison& comparison);

}  // namespace floorproof
