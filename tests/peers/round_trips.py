#!/usr/bin/env python3
"""round_trips.py KEYLINE [SVG…]: svg -> dxf -> step -> iges -> svg, what is left of a drawing.

For every SVG of ../shared/data (or those named): the curves, closed ones and names before and after,
the size in millimetres, and the largest distance between each curve and what became of it, in both
directions, as polygons that hold the ends of all pieces. The last SVG is read as it is drawn, without
the exact curves that it carries too. A path that ends where it began counts as closed: STEP and IGES
have no other mark of it. Where they are installed, what others see stands beside: Inkscape in the
first and the last file (shapes and the size of what is drawn, line widths and all), FreeCAD in the
STEP file (things, closed ones, size).

Exit status 1 where a curve is lost or made, a closed one opened, the size off by more than the
tolerance or a curve further off than the conversions tell in sum; 77 without NumPy.
"""
import json
import re
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

try:
    import numpy as np
except ImportError as missing:
    print(f"{missing}: skipped; ./dev setup peers installs it")
    sys.exit(77)
import freecad_peer

TOLERANCE = 1e-2  # mm, of each of the four conversions
SAG = 1e-3  # mm: polygons stray from their curves too, each at most half as much
CHAIN = ("dxf", "step", "iges", "svg")
MILLIMETRES = {"mm": 1, "cm": 10, "m": 1000, "in": 25.4, "ft": 304.8, "pt": 25.4 / 72,
               "px": 25.4 / 96, "": 1}
BETWEEN = 25  # places of a Bezier or of a span, at first
PLACES = 401  # of a curve whose distance is looked at


def keyline(program, *words):
    done = subprocess.run([program, *map(str, words)], capture_output=True, text=True)
    if done.returncode != 0:
        raise RuntimeError(done.stderr.strip())
    return done.stdout


def close_places(places_at, low, high, sag):
    """Places between two parameters, so many that the polygon through them strays by no more."""
    count = BETWEEN
    while True:
        finer = places_at(np.linspace(low, high, 2 * count - 1))
        off = finer[1::2] - 0.5 * (finer[:-1:2] + finer[2::2])
        if count > 3000 or np.sqrt((off**2).sum(axis=1)).max() <= sag:
            return finer
        count *= 2


def bezier_places(control, weights, t):
    """De Casteljau's, in homogeneous coordinates."""
    w = np.ones(len(control)) if weights is None else np.array(weights)
    p = np.column_stack([np.array(control) * w[:, None], w])[None] * np.ones((len(t), 1, 1))
    while p.shape[1] > 1:
        p = (1 - t)[:, None, None] * p[:, :-1] + t[:, None, None] * p[:, 1:]
    return p[:, 0, :2] / p[:, 0, 2:]


def bspline_places(curve, sag):
    """De Boor's, at places between all knots, knots included."""
    n, knots = curve["degree"], np.array(curve["knots"])
    w = np.array(curve.get("weights") or np.ones(len(curve["points"])))
    control = np.column_stack([np.array(curve["points"]) * w[:, None], w])
    spans = [k for k in range(n, len(control)) if knots[k + 1] > knots[k]]

    def at(k, parameters):
        places = []
        for t in parameters:
            d = control[k - n:k + 1].copy()
            for r in range(1, n + 1):
                for j in range(n, r - 1, -1):
                    low, high = knots[j + k - n], knots[j + 1 + k - r]
                    a = (t - low) / (high - low)
                    d[j] = (1 - a) * d[j - 1] + a * d[j]
            places.append(d[n, :2] / d[n, 2])
        return np.array(places)

    return np.concatenate([close_places(lambda t, k=k: at(k, t), knots[k], knots[k + 1], sag)
                           for k in spans])


def chain_places(chain):
    """Lines and arcs, which is all a drawing's chains are made of."""
    at, direction, places = complex(*chain["start"]), chain["direction"], []
    for piece in chain["pieces"]:
        bend = piece["curvature"][0]
        if bend != piece["curvature"][1]:
            raise RuntimeError("a chain of more than lines and arcs")
        s = np.linspace(0, piece["length"], 40 * BETWEEN)  # it may be a whole circle
        turn = np.exp(1j * direction)
        run = s if bend == 0 else (np.exp(1j * bend * s) - 1) / (1j * bend)
        places.append(at + turn * run)
        at, direction = places[-1][-1], direction + bend * piece["length"]
    z = np.concatenate(places)
    return np.column_stack([z.real, z.imag])


def places_of(curve, sag):
    kind = curve["type"]
    if kind == "path":
        return np.concatenate([places_of(c, sag) for c in curve["curves"]])
    if kind == "polyline":
        return np.array(curve["points"])
    if kind == "bezier":
        return close_places(lambda t: bezier_places(curve["points"], curve.get("weights"), t),
                            0, 1, sag)
    return bspline_places(curve, sag) if kind == "bspline" else chain_places(curve)


def polygons(program, file):
    """Every planar curve of a file in millimetres, and how many others there are."""
    listed = json.loads(keyline(program, "list", file, "--json"))
    read = json.loads(keyline(program, "document.read", file, "--json"))
    factor = MILLIMETRES[listed["unit"]]
    curves = []
    for thing, held in zip(listed["things"], read["curves"]):
        if thing["kind"] != "curve":
            continue
        curves.append({"name": thing["name"], "marked": thing["closed"],
                       "low": factor * np.array(thing["box"]["low"][:2]),
                       "high": factor * np.array(thing["box"]["high"][:2]),
                       "points": factor * places_of(held["curve"], 0.5 * SAG / factor)})
    for curve in curves:
        gap = np.sqrt(((curve["points"][0] - curve["points"][-1])**2).sum())
        curve["closed"] = curve["marked"] or gap <= 1e-9 * (1 + np.abs(curve["points"]).max())
    return curves, len(listed["things"]) - len(curves)


def distance(points, polygon):
    """Largest distance of points from a polygon."""
    a, step = polygon[:-1], np.diff(polygon, axis=0)
    square = np.maximum((step**2).sum(axis=1), 1e-300)
    most = 0.0
    for p in points[:: max(1, len(points) // PLACES)]:
        t = np.clip(((p - a) * step).sum(axis=1) / square, 0, 1)
        most = max(most, float(np.sqrt((((a + t[:, None] * step) - p) ** 2).sum(axis=1).min())))
    return most


def apart(one, other):
    return max(distance(one["points"], other["points"]), distance(other["points"], one["points"]))


def paired(before, after):
    """What each curve became: that of the nearest box, of its name where several are as near. Layers
    are drawn one after the other, so the order may be another."""
    rest = list(after)
    pairs = []
    for curve in before:
        def cost(other, curve=curve):
            off = np.abs(np.concatenate([curve["low"] - other["low"], curve["high"] - other["high"]]))
            return round(off.max() / (2 * TOLERANCE)), curve["name"] != other["name"], off.max()
        if rest:
            pairs.append((curve, rest.pop(min(range(len(rest)), key=lambda i: cost(rest[i])))))
    return pairs


def size(curves):
    low = np.min([c["low"] for c in curves], axis=0)
    high = np.max([c["high"] for c in curves], axis=0)
    return high - low


def seen_by_inkscape(file):
    """Shapes with extent and the size of all of them in mm."""
    if not shutil.which("inkscape"):
        return None
    text = subprocess.run(["inkscape", "--query-all", file], capture_output=True, text=True).stdout
    rows = [r.split(",") for r in text.splitlines() if r.count(",") == 4]
    if not rows:
        return None
    whole = [float(x) * 25.4 / 96 for x in rows[0][3:]]
    shapes = [r for r in rows[1:] if r[0].startswith(("path", "layer")) and "-path" in r[0]
              or r[0].startswith("path")]
    return len(shapes), whole


def seen_by_freecad(file):
    """Things, closed ones and the size in mm."""
    return freecad_peer.extent(file) if shutil.which("freecadcmd") else None


def converted(program, file, folder):
    """The last file of the chain, and the sum of what the conversions tell."""
    sum_told = 0.0
    for step, extension in enumerate(CHAIN):
        target = folder / f"{step}.{extension}"
        unit = json.loads(keyline(program, "list", file, "--json"))["unit"]
        factor = MILLIMETRES[unit]
        done = subprocess.run([program, "convert", file, "-o", target, "--tolerance",
                               str(TOLERANCE / factor), "--json"], capture_output=True, text=True)
        if done.returncode != 0:
            raise RuntimeError(f"to {extension}: {done.stderr.strip().splitlines()[-1]}")
        sum_told += factor * json.loads(done.stdout)["written"][0]["deviation"]
        file = target
    return file, sum_told


def trip(program, svg):
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        before, _ = polygons(program, svg)
        last, deviation = converted(program, svg, folder)
        text = last.read_text()
        last.write_text(re.sub("<metadata>.*?</metadata>", "", text, flags=re.S))
        after, rest = polygons(program, last)
        faults = []
        if len(before) != len(after) or rest:
            faults.append(f"{len(after)} curves and {rest} others of {len(before)}")
        closed = [sum(c["closed"] for c in curves) for curves in (before, after)]
        if closed[0] != closed[1]:
            faults.append(f"{closed[1]} closed of {closed[0]}")
        pairs = paired(before, after)
        named = sum(a["name"] == b["name"] for a, b in pairs if a["name"])
        worst = max((apart(a, b) for a, b in pairs), default=0)
        sizes = [size(before), size(after)]
        off = float(np.abs(sizes[0] - sizes[1]).max())
        if off > 2 * TOLERANCE:
            faults.append(f"size off by {off:.3g} mm")
        if worst > deviation + SAG:
            faults.append(f"{worst:.3g} mm off, {deviation:.3g} told")
        seen = [*(seen_by_inkscape(f) for f in (svg, last)), seen_by_freecad(folder / "1.step")]
        return before, after, closed, named, sizes, worst, deviation, seen, faults


def main():
    program = sys.argv[1]
    here = Path(__file__).resolve().parents[2]
    files = [Path(f) for f in sys.argv[2:]] or sorted((here / "../shared/data").rglob("*.svg"))
    print("| file | curves | closed | names kept | size (mm) | size after | apart (mm) | printed (mm) "
          "| Inkscape before, after | FreeCAD, the STEP |")
    print("|---|---|---|---|---|---|---|---|---|---|")
    status = 0
    for svg in files:
        try:
            before, after, closed, named, sizes, worst, deviation, others, faults = trip(program, svg)
        except RuntimeError as why:
            print(f"| `{svg.name}` | {why} |", flush=True)
            status = 1
            continue
        seen = "; ".join(f"{i[0]}, {i[1][0]:.2f} x {i[1][1]:.2f}" if i else "-" for i in others[:2])
        cad = others[2]
        free = f"{cad[0]}, {cad[1]} closed, {cad[2]:.4f} x {cad[3]:.4f}" if cad else "-"
        names = sum(1 for c in before if c["name"])
        print(f"| `{svg.name}` | {len(before)} > {len(after)} | {closed[0]} > {closed[1]} | "
              f"{named} of {names} | {sizes[0][0]:.4f} x {sizes[0][1]:.4f} | "
              f"{sizes[1][0]:.4f} x {sizes[1][1]:.4f} | {worst:.2g} | {deviation:.2g} | {seen} | {free} |"
              + "".join(f" **{f}**" for f in faults), flush=True)
        status = status or int(bool(faults))
    return status


if __name__ == "__main__":
    sys.exit(main())
