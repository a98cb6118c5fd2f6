// SPDX-License-Identifier: Apache-2.0
// From a coefficient of restitution to MuJoCo's contact parameters.
//
// MuJoCo has no coefficient of restitution. With a constant impedance its contact is a spring and
// damper in units of acceleration, so that the mass cancels: while they touch,
// a = -(2 / T) v - r / (T zeta)^2 for solref = (T, zeta), and never a pull. Such a contact gives
// back, of a free impact, what Schwager & Poeschel 2007 ("Coefficient of restitution and
// linear-dashpot model revisited", eq. 17-20) give in closed form. The engine walks it in steps of
// a few milliseconds, which takes some of it: the damping ratio is therefore found by bisection on
// the walk itself, averaged over where within a step the impact falls.
//
// Assumes a free impact: a body that is pressed on meanwhile comes back slower, as contacts last
// some 30 ms here (pi T zeta, T zeta = 10 ms up to critical damping). A single impact strays from
// the mean with its place in the step, the more so the larger the step; the law `restitution`
// states by how much.
#pragma once

namespace floorproof {

struct ContactSoftness {
  double time_constant_s = 0, damping_ratio = 0;  // MuJoCo's solref
};

// For a coefficient of restitution in [0, 1] at this physics step, s. 0 is as dead as contacts get
// here: 0.02. 1 is taken as 0.99.
ContactSoftness SoftnessFor(double restitution, double timestep_s);

// The coefficient that a contact of this damping ratio has, in steps of this length: the mean over
// where in the step the impact falls.
double ReboundOf(double damping_ratio, double timestep_s);

}  // namespace floorproof
