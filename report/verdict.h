// SPDX-License-Identifier: Apache-2.0
// A campaign's verdict: what the page and the terminal begin with.
#pragma once

#include <string>
#include <string_view>

#include "report/page.h"

namespace floorproof {

struct Scenario;

// "htetro, risk_coverage plan, staircase hall": what drove, by which plan, where. Of several
// variants what they have in common; empty where that is nothing.
std::string SubjectOf(const Scenario& scenario, const std::vector<Variant>& variants);

// What is judged: the gate's metric, else any_failure, but not_success if only this tells the
// variants apart.
std::string_view JudgedMetric(const CampaignSummary& summary);

// The verdict in a sentence: the subject, the rate with its interval, the gate.
std::string VerdictText(const Report& report);

// The same as a box in HTML, coloured also without a gate, with what else is to be known.
std::string VerdictBox(const Report& report);

}  // namespace floorproof
