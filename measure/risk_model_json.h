// SPDX-License-Identifier: Apache-2.0
// A risk model as the text of risk_model.json (docs/risk-model.md has its keys).
#pragma once

#include <string>

#include "planners/risk/rate_model.h"

namespace floorproof {

// ReadRiskModel (run/scenario/risk_model_file.h) gives the same model again, number by number.
std::string RiskModelJson(const RiskModel& model);

}  // namespace floorproof
