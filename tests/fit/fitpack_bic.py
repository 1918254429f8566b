#!/usr/bin/env python3
"""fitpack_bic.py FILE.csv[:ROUNDING]…: best BIC of FITPACK's splrep (scipy) over a fine grid of its
smoothing s, for the table of docs/design/ga-knots.md. Files hold x,y after one header line; the
criterion, its floor (the data's rounding, after the colon) and its limit 2n + m <= N are those of
keyline::fit.
"""

import sys
import warnings

import numpy as np
from scipy.interpolate import splev, splrep


def best_bic(x, y, rounding, k=3, grid=400):
    """(BIC, knots, s). FITPACK wants increasing x: repeats are averaged with their weight."""
    count = len(x)
    unique, where = np.unique(x, return_inverse=True)
    repeats = np.bincount(where)
    mean = np.bincount(where, y) / repeats
    total = np.sum((y - y.mean()) ** 2)
    best = (np.inf, 0, 0.0)
    for s in np.geomspace(1e-8 * total, total, grid):
        tck = splrep(unique, mean, w=np.sqrt(repeats), k=k, s=s)
        n = len(tck[0]) - 2 * (k + 1)
        if n > 0 and 2 * n + k + 1 > count:
            continue
        squares = max(np.sum((y - splev(x, tck)) ** 2), count * rounding**2 / 12)
        best = min(best, (count * np.log(squares) + np.log(count) * (2 * n + k + 1), n, s))
    return best


def main():
    warnings.simplefilter("ignore")
    for argument in sys.argv[1:]:
        name, _, rounding = argument.partition(":")
        data = np.genfromtxt(name, delimiter=",", skip_header=1)
        bic, n, s = best_bic(data[:, 0], data[:, 1], float(rounding or 0))
        print(f"{name}: BIC {bic:.2f}, {n} knots, s = {s:.4g}")


if __name__ == "__main__":
    main()
