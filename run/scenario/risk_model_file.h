// SPDX-License-Identifier: Apache-2.0
// A risk model as a file (risk_model.json; docs/risk-model.md has its keys).
#pragma once

#include <filesystem>
#include <memory>

#include "base/input_files.h"
#include "planners/risk/rate_model.h"

namespace floorproof {

// Throws InputError naming file, line, key, value and rule: another version, a missing or unknown
// key, a number out of range, functions, blocks or coefficients whose numbers do not fit together,
// a kind that stands there twice, no kind at all.
// What is read is kept: the same bytes are read once.
std::shared_ptr<const RiskModel> ReadRiskModel(const std::filesystem::path& file,
                                               const InputFiles& files = {});

}  // namespace floorproof
