// SPDX-License-Identifier: Apache-2.0
// `drive: cells`: a planner of unknown floors drives an ideal robot from cell to cell.
#pragma once

#include "run/episode/episode.h"

namespace floorproof {

struct Scenario;

// The scenario's online planner over the site's cells, on which a cell is free where it touches
// nothing that the robot must keep off. The robot takes its cruise speed for each step, and turns
// in no time. Nothing can fail; the outcome is kNotPlanned where there is nowhere to go at first.
EpisodeRecord DriveCells(const Scenario& scenario, EpisodeObserver* observer = nullptr);

}  // namespace floorproof
