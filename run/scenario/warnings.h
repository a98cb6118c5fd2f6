// SPDX-License-Identifier: Apache-2.0
// What is read as written but may not be meant.
#pragma once

#include <string>
#include <vector>

namespace floorproof {

struct Scenario;

// One line each: the site's own, measured limits that are of another robot or floor, restitution
// that the time step cannot give, and which files are read that lie neither in the scenario's
// folder nor among the bundled models.
std::vector<std::string> Warnings(const Scenario& scenario);

}  // namespace floorproof
