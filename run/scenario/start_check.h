// SPDX-License-Identifier: Apache-2.0
// Finds out, before anything is planned, whether robot and map allow the scenario's sensors and its
// estimator.
#pragma once

#include "base/config.h"

namespace floorproof {

struct Scenario;

// Starts the scenario's sensors on a bare floor, and its estimator where the robot will stand. (An
// episode starts them again.) Throws what they refuse, as an InputError that says where the key is
// written in `root`.
void CheckStarts(const ConfigNode& root, const Scenario& s);

}  // namespace floorproof
