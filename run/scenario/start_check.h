// SPDX-License-Identifier: Apache-2.0
// What robot or map do not allow sensors and estimators, known before anything is planned.
#pragma once

#include "run/scenario/scenario.h"

namespace floorproof {

// Starts the scenario's sensors on a bare floor, and its estimator where the robot will stand; an
// episode starts them anew. Throws what they refuse as an InputError that says where the key is
// written in `root`.
void CheckStarts(const ConfigNode& root, Scenario& s);

}  // namespace floorproof
