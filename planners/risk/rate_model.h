// SPDX-License-Identifier: Apache-2.0
// How often each failure happens to one robot, a meeting with a hazard or a metre of floor, as was
// measured: the risk model. Plain numbers; docs/risk-model.md has the formulas and the file.
//
// Competing risks (Prentice et al., Biometrics 34 (1978) 541): a meeting with covariates x fails
// with rate Lambda(x), is cleared with probability exp(-Lambda), and fails first in mode m with
// lambda_m / Lambda (1 - exp(-Lambda)). Lambda is of all failures together; each mode has a share:
//   Lambda = log(1 + exp(eta_0)): logistic regression of whether a meeting fails
//   lambda_m = Lambda times m's share. Modes are split off one after the other (continuation
//   ratios;
//     Fienberg, The Analysis of Cross-Classified Categorical Data (1980), section 6.6): of what is
//     left, the k-th takes 1 / (1 + exp(-eta_k)), and the last mode all.
//   eta = intercept + sum of smooth functions of one covariate
//       + sum of products of such functions of several
// So a mode that is hardly ever seen is as rare on mild meetings as failures are there. Above 1
// Lambda grows linearly: one lucky robot far beyond a limit does not bend the whole model.
#pragma once

#include <array>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "env/core/encounter.h"
#include "planners/risk/carry_over.h"

namespace floorproof {

inline constexpr int kRiskModelVersion = 3;
// Vectors drawn from the posterior of the coefficients, beside the best one.
inline constexpr std::size_t kRateMembers = 16;

using ModeNumbers = std::array<double, kNumFailureModes>;

// A covariate, and the functions of it that rates are made of: natural cubic splines through their
// values at the knots; where all of a period was measured, periodic ones.
struct RateAxis {
  std::string name;
  bool of_hazard = false;  // one of its keys, or kRise; else of Approach: a column, or kDerived
  double lower = 0, upper = 0;  // what was measured; as long as a period: all of it
  double period = 0;            // of an angle; 0: none
  std::vector<double> knots;    // ascending from lower to upper; none: it was always the same
  std::vector<std::vector<double>> functions;  // by function, by knot
};

// Axes that are made of two columns of Approach.
struct DerivedAxis {
  std::string_view name;
  double (*of)(const Approach&);
};
// Of what is passed: the gap, less what the robot is wrong about its place. Below 0 it may touch
// what it thinks that it passes.
inline constexpr std::string_view kSureGap = "sure_gap_m";
// Of a robot that drives every way: how far its body is turned from square on to the edge,
// whichever of its four sides is the nearest: 0, its wheels come to the edge together, to pi/4. Who
// crosses aslant with the body square on is another matter than who is turned.
inline constexpr std::string_view kAskew = "askew_rad";
double AskewOf(const Approach& at);
inline constexpr std::array<DerivedAxis, 2> kDerived = {{
    {kSureGap, [](const Approach& at) { return at.gap_m - at.estimate_error_m; }},
    {kAskew, AskewOf},
}};

// A size that kinds of hazard share which are passed: how far it rises over the floor or falls
// below it, whatever its key is called. 0: it lies flat.
inline constexpr std::string_view kRise = "rise_m";

// Some functions of one axis: `count` of them, from `first` on.
struct RateFactor {
  std::size_t axis = 0, first = 0, count = 0;
  bool operator==(const RateFactor&) const = default;
};
// One factor: these functions. Several: all products of one function of each, the last factor's
// function changing first.
struct RateBlock {
  std::vector<RateFactor> factors;
  bool operator==(const RateBlock&) const = default;
  bool IsProduct() const { return factors.size() > 1; }
  std::size_t size() const {
    std::size_t size = 1;
    for (const RateFactor& factor : factors) size *= factor.count;
    return size;
  }
};

// One eta (GLM's linear predictor).
struct LinearPredictor {
  int events = 0;  // how often what it is the odds of was measured
  std::vector<RateBlock> blocks;
  std::vector<double> coefficients;          // the intercept, then the blocks' in order
  std::vector<std::vector<double>> members;  // as many again, kRateMembers times
};

// A mode that is split off the failures which are left.
struct ModeSplit {
  FailureMode mode = FailureMode::kVeerOff;
  LinearPredictor of;
};

// Whether the plan turns the robot on its way over or past a hazard. A wheel that turns on an edge
// is another matter than one that rolls over it.
enum class Manner { kAny, kStraight, kTurning };
inline constexpr std::array<std::string_view, 3> kMannerNames = {"any", "straight", "turning"};
constexpr std::string_view Name(Manner manner) {
  return kMannerNames[static_cast<std::size_t>(manner)];
}
inline constexpr double kTurning_rad = 0.15;  // what turns by less goes straight
inline Manner MannerOf(const Approach& at) {
  return at.turn_rad < kTurning_rad ? Manner::kStraight : Manner::kTurning;
}

// The rates of meetings of one kind.
struct KindRates {
  std::string type;  // of hazard, or kWallBeside, kFreeFloor
  Passage passage = Passage::kOver;
  Manner manner = Manner::kAny;
  bool per_metre = false;  // rates are a metre of way, not a meeting: exposures
  int encounters = 0, cleared = 0, censored = 0;  // measured; the rest failed
  double way_m = 0;                               // in all of them
  // 1 to 100. How alike its meetings with one hazard in one drive end, beyond what covariates say:
  // a frailty, of a positive stable distribution, that they share (Hougaard, Biometrika 73 (1986)
  // 387). Their rates come to (sum of Lambda^theta)^(1/theta): 1, each by itself; many, as the
  // worst of them alone.
  double theta = 1;
  std::vector<RateAxis> axes;
  LinearPredictor any;  // failure
  // In the order in which they are split off. The mode that stands in none takes what is left.
  std::array<ModeSplit, kNumFailureModes - 1> splits;
};

// A kind that was met too rarely to say anything.
struct UnmeasuredKind {
  std::string type;
  Passage passage = Passage::kOver;
  std::string why;
};

struct MeasuredRobot {
  std::string name, drive;
  double mass_kg = 0, clearance_m = 0;  // its own; what was driven is an axis
  std::string model;                    // SHA-256 of its model (env/scene/measured_block.h)
};

struct RiskModel {
  MeasuredRobot robot;
  // The robot is its own mirror image, so a meeting and its mirror image have the same rates.
  bool mirrored = false;
  int encounters = 0;  // all of them
  std::vector<KindRates> kinds;
  std::vector<UnmeasuredKind> unmeasured;
  CarryOver carry_over;  // to whole plans
};

// Whether rates are a metre of it, not a meeting.
inline bool IsExposure(std::string_view type) { return type == kWallBeside || type == kFreeFloor; }
// What rates are multiplied by: of an exposure its metres; of a meeting 1, of one that was cut
// short half. Where another hazard's failure ends it, to leave it out would leave out what was
// being cleared.
double AmountOf(const Encounter& encounter);
// The mode that takes what the splits leave.
FailureMode LastMode(const KindRates& kind);
// Whether it is about such a meeting.
bool IsAbout(const KindRates& kind, std::string_view type, Passage passage, const Approach& at);
// "groove over", and its manner where that is not any.
std::string TextOf(const KindRates& kind);

// Of a meeting, the numbers that the axes are about.
class Covariates {
 public:
  // The hazard's keys. Throws InputError naming an axis that they do not state.
  Covariates(const std::vector<RateAxis>& axes, bool mirrored,
             const std::vector<std::pair<std::string, double>>& size);
  // By axis. The span returned stays valid until the next call.
  std::span<const double> Of(const Approach& at);

 private:
  bool mirrored_;
  std::vector<double> x_;
  std::vector<std::pair<std::size_t, double Approach::*>> of_approach_;
  std::vector<std::pair<std::size_t, double (*)(const Approach&)>> derived_;
  std::optional<std::pair<std::size_t, double>>
      across_;  // the axis rise_across of what is mirrored
};

// At least 0; beyond what was measured, by how much, as a share of what was (of an axis that was
// always the same: of its value).
double Beyond(const RateAxis& axis, double x);
// So far beyond that the fitted curve is worthless: by more than a quarter of the range; of sizes,
// friction, mass and clearance also by a factor of 1.5. Not of speeds, distances and errors of
// place, which may well be 0.
bool IsFarBeyond(const RateAxis& axis, double x);

double RateOf(double eta);  // log(1 + exp(eta))
double EtaOf(double rate);  // its inverse; rate > 0
double Total(const ModeNumbers& rates);
// By mode, the probability that it is what ends the meeting.
ModeNumbers FirstFailures(const ModeNumbers& rates);

}  // namespace floorproof
