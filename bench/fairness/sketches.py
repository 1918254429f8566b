#!/usr/bin/env python3
"""The combs of traced lines beside those of the smoothest quintic spline (FITPACK) that lies as near to the
points measured in the ink.

usage: sketches.py KEYLINE FOLDER [NAME…] [-- OPTION…]   pictures and .scap below FOLDER whose name holds a NAME;
                                                         options go to `keyline sketch`

Lines that are at least 30 widths long and have no corner. A row per file: lines, quintics, waves in all of both,
lines with more waves than the spline, and in the median and the worst of lines our energy and jolt as shares of the
spline's. The worst lines by energy follow, with their names.
"""

import json
import pathlib
import subprocess
import sys

import numpy as np

from comb import figures
from rival import smoothest

LONG = 30     # widths
STEPS = 200   # per quintic
SHOWN = 10
KINDS = {".png", ".jpg", ".scap"}


class Quintics:
    """Places and curvature of a chain of Beziers, dense."""

    def __init__(self, curves):
        places, lengths, bends, start = [], [], [], 0.0
        t = np.linspace(0, 1, STEPS + 1)
        for curve in curves:
            net = np.array(curve["points"])
            at, d1, d2 = (bernstein(net, t), bernstein(derived(net), t),
                          bernstein(derived(derived(net)), t))
            speed = np.linalg.norm(d1, axis=1)
            bends.append((d1[:, 0] * d2[:, 1] - d1[:, 1] * d2[:, 0]) / speed**3)
            length = np.concatenate([[0], np.cumsum((speed[1:] + speed[:-1]) / 2 / STEPS)])
            lengths.append(start + length)
            start += length[-1]
            places.append(at)
        self.places, self.length = np.vstack(places), np.concatenate(lengths)
        self.curvature = np.concatenate(bends)

    def farthest(self, points):
        """Of the points from the chain, chords for arcs."""
        a, b = self.places[:-1], self.places[1:]
        edge = b - a
        square = np.maximum(np.sum(edge**2, axis=1), 1e-300)
        most = 0.0
        for p in points:
            share = np.clip(np.sum((p - a) * edge, axis=1) / square, 0, 1)
            most = max(most, np.min(np.linalg.norm(a + share[:, None] * edge - p, axis=1)))
        return most


def derived(net):
    return (len(net) - 1) * np.diff(net, axis=0)


def bernstein(net, t):
    """De Casteljau, all parameters at once."""
    rows = np.repeat(net[None, :, :], len(t), axis=0)
    while rows.shape[1] > 1:
        rows = rows[:, :-1] * (1 - t)[:, None, None] + rows[:, 1:] * t[:, None, None]
    return rows[:, 0]


def judged(stroke):
    """(ours, the spline's) figures of a line, or None for short ones, corners and where no spline is near."""
    curve = stroke["curve"]
    curves = curve["curves"] if "curves" in curve else [curve]
    chain = Quintics(curves)
    if stroke["corners"] or chain.length[-1] < LONG * stroke["width"]:
        return None
    points = np.array(stroke["points"])[:: max(1, len(stroke["points"]) // 600)]
    tolerance = max(chain.farthest(points), 0.01 * stroke["width"])
    spline = smoothest(points, stroke["closed"], tolerance)
    if spline is None:
        return None
    return figures(chain.length, chain.curvature), figures(spline.length, spline.curvature), len(curves)


def row(keyline, file, options):
    run = subprocess.run([keyline, "sketch", str(file), "--json", "--quiet", *options], capture_output=True, text=True)
    if run.returncode != 0:
        return f"| `{file.name}` | {run.stderr.strip()} |", []
    lines = []
    for number, stroke in enumerate(json.loads(run.stdout)["strokes"], 1):
        found = judged(stroke)
        if found:
            ours, other, quintics = found
            lines.append((ours, other, quintics, f"{file.name} stroke{number}"))
    if not lines:
        return f"| `{file.name}` | no line to judge |", []
    share = [[line[0][k] / max(line[1][k], 1e-9) for line in lines] for k in (1, 2)]
    more = sum(line[0][0] > line[1][0] for line in lines)
    text = (f"| `{file.name}` | {len(lines)} | {sum(line[2] for line in lines)} | {sum(line[0][0] for line in lines)} | "
            f"{sum(line[1][0] for line in lines)} | {more} | "
            + " | ".join(f"{np.median(s):.2f} | {max(s):.3g}" for s in share) + " |")
    return text, [(e, *line) for e, line in zip(share[0], lines)]


def main():
    words = sys.argv[1:]
    cut = words.index("--") if "--" in words else len(words)
    if cut < 2:
        sys.exit(__doc__)
    keyline, folder, *names = words[:cut]
    files = sorted(f for f in pathlib.Path(folder).rglob("*") if f.suffix in KINDS)
    print("| file | lines | quintics | waves | the spline's | lines of more | energy | worst | jolt | worst |")
    print("|---" * 10 + "|")
    worst = []
    for file in files:
        if not names or any(name in file.name for name in names):
            text, lines = row(keyline, file, words[cut + 1:])
            print(text, flush=True)
            worst += lines
    print()
    for energy, ours, other, _, name in sorted(worst, key=lambda w: -w[0])[:SHOWN]:
        print(f"{name}: waves {ours[0]} for {other[0]}, energy {energy:.3g} times, jolt {ours[2]:.2f} for {other[2]:.2f}")


if __name__ == "__main__":
    main()
