# SPDX-License-Identifier: Apache-2.0
"""Fields of distances beside scikit-image's MCP_Geometric, on the same floors in one run.

    python3 bench/peer_mcp.py BENCH_DISTANCE_FIELD [MAP.pgm ...]

MCP_Geometric steps to 8 neighbours, so that its distances are up to 8 % too long; it also passes
between cells that touch at a corner. Printed: milliseconds a field of one core, the medians, how
many times as many the peer takes, and how much longer its paths are on the average.
Needs numpy and scikit-image.
"""

import pathlib
import statistics
import subprocess
import sys
import tempfile
import time

import numpy
from skimage.graph import MCP_Geometric


def main():
    with tempfile.TemporaryDirectory() as folder:
        table = subprocess.run(
            [*sys.argv[1:], "--fields", "0", "--write", folder],
            check=True, capture_output=True, text=True).stdout
        ours = {row.split()[0]: row.split() for row in table.splitlines()[1:]}
        print(f"{'floor':22} {'ours_ms':>8} {'peer_ms':>8} {'ratio':>7} {'longer':>7}")
        for name, row in ours.items():
            path = pathlib.Path(folder) / name
            data = path.with_suffix(".pgm").read_bytes().split(b"\n", 3)
            width, height = map(int, data[1].split())
            free = numpy.frombuffer(data[3], numpy.uint8).reshape(height, width)
            lines = path.with_suffix(".txt").read_text().split("\n")
            sums = []
            seconds = []
            for line in lines[:5]:
                ix, iy = map(int, line.split()[:2])
                peer = MCP_Geometric(numpy.where(free, 1.0, -1.0), fully_connected=True)
                begin = time.thread_time()
                costs, _ = peer.find_costs([(iy, ix)])
                seconds.append(time.thread_time() - begin)
                sums.append(costs[numpy.isfinite(costs)].sum() / float(line.split()[2]))
            peer_ms = 1e3 * statistics.median(seconds)
            our_ms = float(row[6])
            print(f"{name:22} {our_ms:8.1f} {peer_ms:8.1f} {peer_ms / our_ms:7.1f} "
                  f"{statistics.mean(sums) - 1:7.2%}", flush=True)


if __name__ == "__main__":
    main()
