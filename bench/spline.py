#!/usr/bin/env python3
"""Peer of spline_bench.cpp: libspiro (Debian libspiro1), G2 knots, called through ctypes."""

import ctypes
import json
import math
import sys
import timeit


class Knot(ctypes.Structure):
    _fields_ = [("x", ctypes.c_double), ("y", ctypes.c_double), ("ty", ctypes.c_char)]


try:
    SPIRO = ctypes.CDLL("libspiro.so.1")
except OSError as missing:
    print(f"bench: {missing}; ./dev setup bench installs it", file=sys.stderr)
    sys.exit(77)
SPIRO.run_spiro.restype = ctypes.c_void_p
SPIRO.run_spiro.argtypes = [ctypes.c_void_p, ctypes.c_int]
SPIRO.free_spiro.argtypes = [ctypes.c_void_p]


def knots(count):
    """The same points as in spline_bench.cpp, as an open path of G2 knots."""
    path = (Knot * count)()
    for i in range(count):
        kind = b"{" if i == 0 else b"}" if i == count - 1 else b"c"
        path[i] = Knot(1.0 * i, 0.8 * math.sin(0.9 * i) + 0.2 * math.cos(2.3 * i), kind)
    return path


def solve(path):
    answer = SPIRO.run_spiro(path, len(path))
    if not answer:
        raise RuntimeError("libspiro found no curve")
    SPIRO.free_spiro(answer)


def main():
    for count in (10, 1000):
        path = knots(count)
        timer = timeit.Timer(lambda: solve(path))
        runs, _ = timer.autorange()
        seconds = min(timer.repeat(3, runs)) / runs
        row = {"name": f"clothoid_spline/{count}", "peer": "libspiro", "seconds": seconds}
        print(json.dumps(row), flush=True)


if __name__ == "__main__":
    main()
