// SPDX-License-Identifier: Apache-2.0
// How many runs without a failure demonstrate a reliability.
#pragma once

namespace floorproof {

// The least n for which n independent runs without a failure show, with this confidence, that a run
// passes with at least this probability: reliability^n <= 1 - confidence. 59 for 0.95 and 0.95.
// Then ClopperPearsonLower(n, n, confidence) is at least the reliability. Throws InputError unless
// both lie between 0 and 1, and where n would exceed a million.
int RunsToDemonstrate(double reliability, double confidence);

}  // namespace floorproof
