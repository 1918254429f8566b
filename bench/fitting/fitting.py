#!/usr/bin/env python3
"""fitting.py PROGRAM [--seconds S] [NAME…]: splines with free knots beside FITPACK and differential
evolution, a row per series whose name holds a NAME (all unless given).

Series are those of ../shared/data/3_fitting and the test functions its FREE_KNOT_TEST_FUNCTIONS.md
names, with noise of a fixed seed. Ours is `fit.spline` at its defaults, order 4. FITPACK is at its
best over 400 values of its smoothing. Differential evolution (scipy, population 10 n, best1bin) is
given S seconds of the processor (60) for the places of n knots, n ours and two on either side: it
need not look for their number. Without the data it says so and exits 0.
"""

import json
import subprocess
import sys
import time
import warnings
from pathlib import Path

import numpy as np

import peers

DATA = Path(__file__).resolve().parents[3] / "shared/data/3_fitting"


def decimals(text):
    """Step of the last decimal place there is among the numbers."""
    places = max(len(t.partition(".")[2]) for t in text)
    return 10.0 ** -places


def measured():
    for path in sorted(DATA.glob("*.csv")):
        rows = [line.split(",") for line in path.read_text().split()[1:]]
        x, y = (np.array([float(row[i]) for row in rows]) for i in (0, 1))
        yield path.stem, x, y, decimals([row[1] for row in rows])


def blocks(t):
    at = (0.1, 0.13, 0.15, 0.23, 0.25, 0.4, 0.44, 0.65, 0.76, 0.78, 0.81)
    height = (4, -5, 3, -4, 5, -4.2, 2.1, 4.3, -3.1, 2.1, -4.2)
    return sum(h * (1 + np.sign(t - a)) / 2 for a, h in zip(at, height))


def functions():
    """Name, f, its interval, deviation its values are scaled to (0: as they are), noise."""
    return (
        ("cliff", lambda t: 90 / (1 + np.exp(-100 * (t - 0.4))), (0, 1), 0, 1),
        ("big spike", lambda t: 100 / np.exp(np.abs(10 * t - 5)) + (10 * t - 5) ** 5 / 500, (0, 1), 0, 1),
        ("discontinuity", lambda t: np.where(t < 0.6, 1 / (0.01 + (t - 0.3) ** 2),
                                             1 / (0.015 + (t - 0.65) ** 2)), (0, 1), 0, 1),
        ("smooth peak", lambda t: np.sin(t) + 2 * np.exp(-30 * t * t), (-2, 2), 0, 0.3),
        ("HeaviSine", lambda t: 4 * np.sin(4 * np.pi * t) - np.sign(t - 0.3) - np.sign(0.72 - t),
         (0, 1), 7, 1),
        ("blocks", blocks, (0, 1), 7, 1),
        ("Doppler", lambda t: np.sin(20 / (t + 0.3)), (0, 1), 0, 0.1),
    )


def made():
    for seed, (name, f, (low, high), deviation, noise) in enumerate(functions(), 1):
        x = np.linspace(low, high, 201)
        y = f(x)
        if deviation:
            y = deviation * y / y.std()
        yield name, x, y + noise * np.random.default_rng(seed).normal(size=201), 0.0


def ours(program, x, y):
    request = {"op": "fit.spline", "x": x.tolist(), "y": y.tolist()}
    start = time.monotonic()
    answer = subprocess.run([program, "batch", "--quiet"], input=json.dumps(request), text=True,
                            stdout=subprocess.PIPE, check=True).stdout
    result = json.loads(answer)["result"]
    return result["bic"], len(result["knots"]), time.monotonic() - start, result["report"]["rounding"]


def main():
    arguments = sys.argv[1:]
    program, names, seconds = arguments[0], [], 60.0
    rest = iter(arguments[1:])
    for a in rest:
        if a == "--seconds":
            seconds = float(next(rest))
        else:
            names.append(a)
    if not DATA.is_dir():
        print(f"fitting: {DATA} is not there; the test functions alone", file=sys.stderr)
    warnings.simplefilter("ignore")
    print("| series | N | Keyline | knots | seconds | FITPACK | knots | evolution | knots |")
    print("|---|---|---|---|---|---|---|---|---|")
    behind = []
    for name, x, y, rounding in (*measured(), *made()):
        if names and not any(n in name for n in names):
            continue
        bic, knots, took, found = ours(program, x, y)
        series = peers.Series(x, y, found if found else rounding)
        smooth, smooth_knots = peers.fitpack(series)
        evolved, evolved_knots, ended = peers.evolution(series, range(knots - 2, knots + 3), seconds)
        print(f"| {name} | {len(x)} | {bic:.2f} | {knots} | {took:.1f} | {smooth:.2f} | "
              f"{smooth_knots} | {evolved:.2f}{'' if ended else ' *'} | {evolved_knots} |", flush=True)
        if bic > min(smooth, evolved) + 0.01:
            behind.append(name)
    print("\n* stopped by its time. " +
          (f"Keyline is behind in: {', '.join(behind)}" if behind else "Keyline is behind in none."))


if __name__ == "__main__":
    main()
