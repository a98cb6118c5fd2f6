# SPDX-License-Identifier: Apache-2.0
"""Control periods a second through env.step, observation made, against the same loop in C++ without
one (bench_stepped_episode): the same scenario, lidar included, the same twist, in turns; the ratio
of processor times is what counts.

    PYTHONPATH=python python3 bench/gym_steps.py BENCH_STEPPED_EPISODE [SCENARIO] [ROUNDS] [PERIODS]
"""
import statistics
import subprocess
import sys
import time
import warnings

import gymnasium
import numpy as np

import floorproof
import floorproof.gym  # noqa: F401

TWIST = np.array([0.15, 1.0], np.float32)  # a circle of 0.15 m
KEYS = {"sensors.lidar": {}, "time_limit_s": 100000}


def in_python(env, periods: int):
    env.reset(options={"episode": 0})
    begin_s = time.process_time()
    for _ in range(periods):
        *_, terminated, truncated, info = env.step(TWIST)
        assert not terminated and not truncated, info
    return time.process_time() - begin_s, info["truth"]


def in_cpp(program: str, file: str, periods: int):
    keys = ["sensors.lidar={}", "time_limit_s=100000"]
    said = subprocess.run([program, file, str(periods), *map(str, TWIST.tolist()), *keys], check=True,
                          capture_output=True, text=True).stdout.split()
    return float(said[0]), [float(said[1]), float(said[2])]


def main() -> None:
    program = sys.argv[1]
    file = sys.argv[2] if len(sys.argv) > 2 else str(
        floorproof.models_folder() / "scenarios" / "demo_beluga.yaml")
    rounds = int(sys.argv[3]) if len(sys.argv) > 3 else 31
    periods = int(sys.argv[4]) if len(sys.argv) > 4 else 600
    warnings.simplefilter("ignore")
    scenario = floorproof.load(file, KEYS)
    env = gymnasium.make("Floorproof-v0", scenario=scenario, reference=None)
    ratios, python_hz, cpp_hz = [], [], []
    for _ in range(rounds):
        python_s, there = in_python(env, periods)
        cpp_s, same = in_cpp(program, file, periods)
        assert list(there[:2]) == same, (there, same)
        ratios.append(cpp_s / python_s)
        python_hz.append(periods / python_s)
        cpp_hz.append(periods / cpp_s)
    print(f"{scenario.name} at {scenario.control_hz} Hz: env.step {statistics.median(python_hz):.0f} "
          f"steps/s, C++ {statistics.median(cpp_hz):.0f} steps/s, ratio "
          f"{statistics.median(ratios):.3f} ({min(ratios):.3f} to {max(ratios):.3f})")


if __name__ == "__main__":
    main()
