// SPDX-License-Identifier: Apache-2.0
// The measured FMEA tables as the text of fmea_measured.yaml (docs/risk-model.md has its keys).
#pragma once

#include <string>

#include "measure/measured_fmea.h"

namespace floorproof {

std::string MeasuredFmeaYaml(const MeasuredFmea& fmea, const std::string& robot,
                             const std::vector<std::string>& sensors);

}  // namespace floorproof
