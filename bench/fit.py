#!/usr/bin/env python3
"""Peer of fit_bench.cpp: FITPACK through scipy, weighted least squares with the same knots."""

import json
import sys
import timeit

try:
    import numpy as np
    from scipy import interpolate
except ImportError as missing:
    print(f"bench: {missing}; ./dev setup bench installs it", file=sys.stderr)
    sys.exit(77)

KNOTS = np.arange(1, 21) / 21
FULL = np.concatenate([np.zeros(4), KNOTS, np.ones(4)])


def seconds_of(work):
    timer = timeit.Timer(work)
    runs, _ = timer.autorange()
    return min(timer.repeat(3, runs)) / runs


def main():
    for count in (49, 1000, 10000):
        t = np.linspace(0, 1, count)
        x, y = 1200 * t, 100 * np.sin(3 * t) + 8 * np.cos(11 * t)
        peers = (
            ("least_squares_function", "scipy splrep", lambda: interpolate.splrep(t, y, t=KNOTS)),
            ("least_squares_curve", "scipy splprep",
             lambda: interpolate.splprep([x, y], u=t, t=FULL, task=-1)),
        )
        for name, peer, work in peers:
            row = {"name": f"{name}/{count}", "peer": peer, "seconds": seconds_of(work)}
            print(json.dumps(row), flush=True)


if __name__ == "__main__":
    main()
