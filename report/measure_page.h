// SPDX-License-Identifier: Apache-2.0
// A measurement's page: how a robot fails at each kind of hazard, how large one may be, what its
// failures depend on, what that came to in whole plans, and what experts' tables say of it.
#pragma once

#include <filesystem>
#include <string>

#include "report/written_report.h"

namespace floorproof {

// Whether the folder is one of `measure` that has fitted rates.
bool HoldsMeasurement(const std::filesystem::path& folder);

// Reads campaign.sqlite, summary.json, risk_model.json, fmea_measured.yaml and
// scenario.resolved.yaml, and writes report.html. `named`: the folder as the commands on the page
// name it. Throws InputError where a file is missing, damaged, or not of the same encounters as the
// others; DiskError.
WrittenReport WriteMeasureReport(const std::filesystem::path& folder, const std::string& named);

}  // namespace floorproof
