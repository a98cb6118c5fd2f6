// SPDX-License-Identifier: Apache-2.0
// From a coefficient of restitution to MuJoCo's contact parameters.
//
// MuJoCo has no coefficient of restitution. With a constant impedance its contact is a spring and a
// damper in units of acceleration, so the mass cancels: while they touch, a = -(2 / T) v - r / (T
// zeta)^2 for solref = (T, zeta), and never a pull. In closed form such a contact gives back, after
// a free impact, what Schwager & Poeschel 2007 ("Coefficient of restitution and linear-dashpot
// model revisited", eq. 17-20) derive. The engine goes through the contact in steps of a few
// milliseconds, which changes the result: `implicitfast` evaluates spring and damper at the
// beginning of a step, `discrete` at its end, an extra damping of about (pi / 2) h / (T zeta) in ln
// e. The damping ratio is therefore found by bisection with the same steps, averaged over where in
// a step the impact falls. Where `discrete` damps more than e allows, the contact is made softer,
// up to a bound: the liveliest is 0.74 at 4 ms steps, 0.85 at 2 ms and 0.91 at 1 ms.
//
// Assumes a free impact: a body that is pressed on meanwhile comes back slower, because contacts
// last pi T zeta, 30 ms, and up to 60 ms where they are softer. A single impact differs from the
// mean, depending on where in a step it falls; the law `restitution` states by how much.
#pragma once

namespace floorproof {

struct ContactSoftness {
  double time_constant_s = 0, damping_ratio = 0;  // MuJoCo's solref
};

// How the engine steps.
struct ContactWalk {
  double timestep_s = 0.004;
  bool implicit = true;  // `discrete`
};

// For a coefficient of restitution in [0, 1]. 0 gives the deadest contact possible here, 0.02; a
// value above the liveliest possible contact gives that contact.
ContactSoftness SoftnessFor(double restitution, const ContactWalk& walk);

// The coefficient that a contact has: the mean over where in the step the impact falls.
double ReboundOf(const ContactSoftness& softness, const ContactWalk& walk);

}  // namespace floorproof
