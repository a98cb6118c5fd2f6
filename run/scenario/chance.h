// SPDX-License-Identifier: Apache-2.0
// What chance there is in a scenario: whether its episodes can differ at all.
#pragma once

namespace floorproof {

class ScenarioFile;
struct Scenario;

// Whether anything may come out otherwise in another episode of this scenario, which was read from
// `file` without an episode: something that `randomise` draws, a floor or a plan of its own, or a
// sensor's or an estimator's stream. False: all episodes are one. True promises nothing: what
// differs may have no effect.
bool EpisodesCanDiffer(const ScenarioFile& file, const Scenario& scenario);

// Whether they can where all that `randomise` draws is the same.
bool NoiseCanDiffer(const Scenario& scenario);

// What to write so that they do, in a clause.
inline constexpr const char* kHowToDiffer =
    "draw what nobody knows exactly, as in `randomise: {site.floor.friction: {uniform: [0.6, "
    "1.0]}}`";

}  // namespace floorproof
