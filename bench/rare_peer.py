# SPDX-License-Identifier: Apache-2.0
"""Subset simulation by OpenTURNS on the problems of tests/stats/reliability_problems.h, repeated: how
far its estimates spread, how often its 95 % interval holds the truth, what it takes. Beside it stands
what `slow_stats_test` says of our own search.

    pip install openturns && python bench/rare_peer.py [--repeats 100] [--draws 1500]
"""
import argparse
import statistics

import openturns as ot

ot.Log.Show(ot.Log.NONE)

PROBLEMS = {  # name: coordinates, g (failure where g <= 0), probability
    "R-S": (2, "(7 + u0) - (2 + u1)", 2.0347600872e-4),
    "four branches": (2, "min(min(3 + 0.1*(u0-u1)^2 - (u0+u1)/sqrt(2), 3 + 0.1*(u0-u1)^2 + (u0+u1)/sqrt(2)),"
                         "min(u0 - u1 + 7/sqrt(2), u1 - u0 + 7/sqrt(2)))", 2.2228e-3),
    "RP22": (2, "2.5 - (u0+u1)/sqrt(2) + 0.1*(u0-u1)^2", 4.2073e-3),
    "RP25": (2, "max(u0^2 - 8*u1 + 16, -16*u0 + u1 + 32)", 4.1444e-5),
    "RP28": (2, "(78064 + 11710*u0)*(0.0104 + 0.00156*u1) - 146.14", 1.4533e-7),
    "RP31": (2, "2 - u1 + 256*u0^4", 3.2267e-3),
    "RP53": (2, "sin(5*(1.5+u0)/2) + 2 - ((1.5+u0)^2 + 4)*((2.5+u1) - 1)/20", 3.1320e-2),
    "RP57": (2, "min(max(-u0^2 + u1^3 + 3, 2 - u0 - 8*u1), (u0+3)^2 + (u1+3)^2 - 4)", 2.8239e-2),
    "RP75": (2, "3 - u0*u1", 9.8193e-3),
    "RP89": (2, "min(-u0^2 - u1 + 8, -u0/5 - u1 + 6)", 5.4713e-3),
    "RP107": (10, "5*sqrt(10) - (u0+u1+u2+u3+u4+u5+u6+u7+u8+u9)", 2.8665e-7),
    "RP111": (2, "12.5 - abs(u0*u1)", 8.0351e-7),
}


def search(dimensions, text, draws, seed):
    """An estimate, its 95 % interval, and how often g was evaluated."""
    ot.RandomGenerator.SetSeed(seed)
    names = [f"u{i}" for i in range(dimensions)]
    g = ot.MemoizeFunction(ot.SymbolicFunction(names, [text]))
    g.disableCache()
    vector = ot.CompositeRandomVector(g, ot.RandomVector(ot.Normal(dimensions)))
    algorithm = ot.SubsetSampling(ot.ThresholdEvent(vector, ot.LessOrEqual(), 0.0))
    algorithm.setMaximumOuterSampling(draws)
    algorithm.setMaximumCoefficientOfVariation(0)
    algorithm.setBlockSize(1)
    algorithm.run()
    result = algorithm.getResult()
    p, half = result.getProbabilityEstimate(), result.getConfidenceLength(0.95) / 2
    return p, p - half, p + half, g.getEvaluationCallsNumber()


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--repeats", type=int, default=100)
    parser.add_argument("--draws", type=int, default=1500, help="a level")
    arguments = parser.parse_args()
    for name, (dimensions, text, truth) in PROBLEMS.items():
        found = [search(dimensions, text, arguments.draws, seed) for seed in range(arguments.repeats)]
        ratios = [p / truth for p, *_ in found]
        held = sum(low <= truth <= high for _, low, high, _ in found)
        print(f"{name:14} {truth:.3e}: mean {statistics.mean(ratios):.3f} of it, coefficient of variation "
              f"{statistics.stdev(ratios):.3f}, interval holds it in {100 * held / len(found):.1f} %, "
              f"{statistics.mean(n for *_, n in found):.0f} evaluations", flush=True)


if __name__ == "__main__":
    main()
