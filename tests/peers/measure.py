#!/usr/bin/env python3
"""measure.py KEYLINE [PEER…]: how far is what other programs read from the exact curve?

Every peer is a module *_peer.py: version() (None where it is not installed) and read(FILE), which
gives plain_svg.Curve values in millimetres; READS lists formats, ROUNDING what the peer's own output
rounds to (mm), PLACED says whether it leaves the drawing where it is.

Writes one document of log-aesthetic chains with `KEYLINE convert` in every format and to several
tolerances, has every peer open it, and prints the largest distance, in both directions, between the
exact curves (evaluated by exact_curve.py, without Keyline) and what the peer read. Exit status 1
where one is above the tolerance, or a curve, an arc, a layer or a colour is lost; 77 where no peer
is installed.
"""

import importlib
import json
import subprocess
import sys
import tempfile
from pathlib import Path

try:
    import numpy as np

    from exact_curve import ExactCurve
except ImportError as missing:
    print(f"{missing}: skipped; ./dev setup peers installs it")
    sys.exit(77)

PEERS = ("rsvg", "poppler", "fonttools", "inkscape", "freecad", "draw")
TOLERANCES = (1e-2, 1e-3, 1e-4)


def chain(start, direction, *pieces):
    rows = [{"alpha": a, "length": s, "curvature": [k0, k1]} for a, s, k0, k1 in pieces]
    return {"type": "log-aesthetic", "start": start, "direction": direction, "closed": False,
            "pieces": rows}


# Millimetres: name, layer, colour, chain. Far enough apart to be told from each other.
CURVES = [
    ("roof", "body", "#0b5394", chain([10, 20], 0.3, (-1, 120, 0.002, 0.02), (0.5, 60, 0.02, 0.005))),
    ("s-shape", "body", "#0b5394", chain([10, 300], 0.1, (-1, 200, -0.012, 0.015))),
    ("spirals", "rhythm", "#cc0000", chain([200, 20], 1.2, (1, 90, 0.004, 0.05), (2, 70, 0.05, 0.01),
                                           (0, 80, 0.01, 0.03))),
    ("inflection", "rhythm", "#cc0000", chain([200, 300], 0.0, (-2, 150, 0.0, 0.02))),
    ("wheel", "arcs", "#38761d", chain([400, 20], 0.3, (0, 60, 0.02, 0.02))),
    ("sill", "arcs", "#38761d", chain([400, 300], 0.2, (-1, 100, 0.0, 0.0))),
]


def shortest_shift(exact, curves):
    """For programs that move the drawing: the boxes' lower left corners are laid on each other."""
    own = np.concatenate([np.column_stack([e.points.real, e.points.imag]) for e in exact])
    theirs = np.concatenate([c.points for c in curves])
    return own.min(axis=0) - theirs.min(axis=0)


def assigned(exact, curves):
    """The read curves of each exact one: that from which they are least far."""
    lists = [[] for _ in exact]
    for curve in curves:
        some = curve.points[:: max(1, len(curve.points) // 50)]
        lists[int(np.argmin([e.distances(some).max() for e in exact]))].append(curve)
    return lists


def deviation(exact, curves):
    there = max(exact.distances(c.points).max() for c in curves)
    back = np.min([exact.gaps(c.points) for c in curves], axis=0).max()
    return max(there, back)


def faults(name, layer, color, peer, extension, curves):
    found = []
    if extension == "svg" and peer.NAME == "Inkscape":
        for what, wanted, got in (("name", name, curves[0].name), ("layer", layer, curves[0].layer),
                                  ("colour", color, curves[0].color)):
            if wanted != got:
                found.append(f"{name}: {what} {got} in place of {wanted}")
    if extension != "svg" and name == "wheel" and {c.kind for c in curves} - {"", "Circle"}:
        found.append(f"the arc is read as {', '.join(c.kind for c in curves)}")
    return found


def measure(keyline, peer, extension, tolerance, folder):
    """Largest distance and a list of what is wrong."""
    rows = CURVES if extension != "glif" else CURVES[:1]
    curves = [{"name": n, "layer": l, "color": c, "curve": k} for n, l, c, k in rows]
    (folder / "exact.json").write_text(json.dumps({"unit": "mm", "curves": curves}))
    file = folder / f"drawing.{extension}"
    subprocess.run([keyline, "convert", folder / "exact.json", "-o", file, "--quiet", "--tolerance",
                    str(tolerance)], check=True)
    exact = [ExactCurve(k) for _, _, _, k in rows]
    read = peer.read(file)
    if not peer.PLACED or (peer.NAME, extension) == ("Inkscape", "dxf"):
        shift = shortest_shift(exact, read)
        for curve in read:
            curve.points = curve.points + shift
    wrong, worst = [], 0.0
    for row, e, own in zip(rows, exact, assigned(exact, read)):
        if not own:
            wrong.append(f"{row[0]} is missing")
            continue
        worst = max(worst, deviation(e, own))
        wrong += faults(*row[:3], peer, extension, own)
    if worst > tolerance + peer.ROUNDING.get(extension, 0):
        wrong.append("above the tolerance")
    return worst, wrong


def main():
    keyline, names = sys.argv[1], sys.argv[2:] or PEERS
    status = 77
    print(f"{'format':8}{'read by':20}" + "".join(f"{t:>12g}" for t in TOLERANCES) + "  mm")
    for name in names:
        peer = importlib.import_module(f"{name}_peer")
        version = peer.version()
        if not version:
            print(f"{peer.NAME} is not installed: skipped")
            continue
        status = max(0, status % 77)
        for extension in peer.READS:
            with tempfile.TemporaryDirectory() as folder:
                results = [measure(keyline, peer, extension, t, Path(folder)) for t in TOLERANCES]
            numbers = "".join(f"{worst:12.2e}" for worst, _ in results)
            print(f"{extension:8}{peer.NAME + ' ' + version:20}{numbers}", flush=True)
            for wrong in sorted({w for _, all_wrong in results for w in all_wrong}):
                print(f"    {wrong}")
                status = 1
    return status


if __name__ == "__main__":
    sys.exit(main())
