// SPDX-License-Identifier: Apache-2.0
// How bounce_back depends on restitution, speed and mass: each robot is driven head-on into a pane.
#pragma once

#include <span>
#include <string>
#include <vector>

namespace floorproof {

struct BounceRow {
  std::string robot;
  double restitution = 0;    // of the pane
  double speed_mps = 0;      // commanded, before and after
  double mass_kg = 0;        // all masses scaled to this total
  double closing_mps = 0;    // of the body just before it touches
  double rebound_mps = 0;    // fastest it then moves away, until it comes back; 0: it does not
  bool bounce_back = false;  // the detector's word, with its defaults
};

// Every bundled robot; restitution 0-0.7, 0.1-0.4 m/s, half, whole and twice the mass. Runs on
// `jobs` threads; the order of the rows does not depend on which finishes first.
std::vector<BounceRow> BounceChart(int jobs);

// robot,restitution,speed_mps,mass_kg,closing_mps,rebound_mps,bounce_back
std::string BounceCsv(std::span<const BounceRow> rows);

}  // namespace floorproof
