// SPDX-License-Identifier: Apache-2.0
// A paired comparison as the report shows it.
#pragma once

#include "report/page.h"
#include "run/campaign/campaign_comparison.h"

namespace floorproof {

ReportPair ShownPair(const Comparison& comparison);

}  // namespace floorproof
