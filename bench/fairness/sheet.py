#!/usr/bin/env python3
"""sheet.py PROGRAM FILE.svg: combs before and after of measured profiles on one sheet.

A row per profile: the comb of the spline through the points, of the shortest chain within the same
tolerance, and of the calmest, which `fair` gives. Teeth of a row have one scale: the calmest chain's
longest is a sixth of the profile. Longer ones of the others are cut there and drawn red.
"""

import math
import sys
from concurrent.futures import ThreadPoolExecutor

import numpy as np
from scipy.interpolate import splev

import comb
import profiles

WANTED = ("naca2412", "e387", "hq17", "su-26m", "fx63145", "bot brahma", "bot sierranevada",
          "bot magallan", "bot oban", "bot jb", "bot johnniewalker", "bot caney", "hearts ced1",
          "hearts mat1", "hearts rom11", "hearts vince11", "mosquito shp1", "mosquito shp41",
          "nsfishes FBd", "olea 0001-cAglan_O10VD", "olea 0023", "trilo a1", "trilo c2", "Norisring")
COLUMNS = 2
PANEL, GAP, HEAD = 400, 8, 34
TEETH = 240
LONGEST = 1 / 6  # of the panel
CUT = 1.6        # of the longest: others' longer teeth are cut there


def walk(start, direction, length, curvature):
    """Points along a graph of curvature."""
    ds = np.diff(length)
    turn = direction + np.concatenate([[0], np.cumsum((curvature[1:] + curvature[:-1]) / 2 * ds)])
    middle = (turn[1:] + turn[:-1]) / 2
    x = start[0] + np.concatenate([[0], np.cumsum(np.cos(middle) * ds)])
    y = start[1] + np.concatenate([[0], np.cumsum(np.sin(middle) * ds)])
    return np.column_stack([x, y]), turn


def of_chain(chain):
    length, curvature = comb.graph_of_chain(chain, 500)
    points, turn = walk(chain["start"], chain["direction"], length, curvature)
    return length, curvature, points, turn


def of_spline(spline):
    """The spline through the points as the program gives it."""
    degree, knots = spline["degree"], np.array(spline["knots"])
    curve = (knots, list(np.array(spline["points"]).T), degree)
    t = np.linspace(knots[degree], knots[-degree - 1], 6001)
    points, (dx, dy), (ddx, ddy) = np.column_stack(splev(t, curve)), splev(t, curve, 1), splev(t, curve, 2)
    speed = np.hypot(dx, dy)
    length = np.concatenate([[0], np.cumsum(np.linalg.norm(np.diff(points, axis=0), axis=1))])
    return length, (dx * ddy - dy * ddx) / speed**3, points, np.arctan2(dy, dx)


def curves_of(result, what):
    value = result[what]
    return value["curves"] if value["type"] == "path" else [value]


def graphs(result, what):
    return [of_chain(c) if c["type"] == "log-aesthetic" else of_spline(c)
            for c in curves_of(result, what)]


def evenly(graph, total):
    """Teeth even in half of the length and half of the turning."""
    length, curvature, points, turn = graph
    bend = np.abs(curvature)
    turned = np.concatenate([[0], np.cumsum((bend[1:] + bend[:-1]) / 2 * np.diff(length))])
    share = length / length[-1] + turned / max(turned[-1], 1e-12)
    count = max(20, round(TEETH * length[-1] / total))
    at = np.interp(np.linspace(0, share[-1], count), share, length)
    return (np.interp(at, length, curvature), np.column_stack(
        [np.interp(at, length, points[:, i]) for i in (0, 1)]), np.interp(
            at, length, np.unwrap(turn)))


def number(value):
    return f"{value:.1f}".removesuffix(".0")


def path(points):
    """From the first on by steps, rounded so that errors do not add up."""
    at = np.round(points, 1)
    steps = " ".join(f"{number(x)} {number(y)}" for x, y in np.diff(at, axis=0))
    return f"M{number(at[0][0])} {number(at[0][1])}l{steps}"


class Panel:
    """Maps a profile into a square and draws combs on it."""

    def __init__(self, points, longest_curvature):
        low, high = points.min(axis=0), points.max(axis=0)
        self.middle = (low + high) / 2
        self.scale = PANEL * 0.6 / max(high - low)
        self.tooth = PANEL * LONGEST / longest_curvature

    def place(self, points):
        return (points - self.middle) * self.scale * [1, -1] + PANEL / 2

    def draw(self, graphs_of_one):
        total = sum(g[0][-1] for g in graphs_of_one)
        cut_teeth, plain, tips, lines = [], [], [], []
        for graph in graphs_of_one:
            bend, at, turn = evenly(graph, total)
            tall = bend * self.tooth
            cut = np.abs(tall) > CUT * PANEL * LONGEST
            tall = np.clip(tall, -CUT * PANEL * LONGEST, CUT * PANEL * LONGEST)
            foot = self.place(at)
            # teeth point away from the centre of curvature
            tip = foot + np.column_stack([np.sin(turn), np.cos(turn)]) * tall[:, None]
            for a, b, c in zip(foot, tip, cut):
                (cut_teeth if c else plain).append(path([a, b]))
            tips.append(path(tip))
            lines.append(path(foot))
        return (f'<path class="t" d="{"".join(plain)}"/><path class="c" d="{"".join(cut_teeth)}"/>'
                f'<path class="e" d="{"".join(tips)}"/><path class="l" d="{"".join(lines)}"/>')


def text(x, y, words, kind):
    return f'<text x="{x}" y="{y}" class="{kind}">{words}</text>'


def row(name, old, new):
    """Three panels side by side, with what was measured."""
    calm = graphs(new, "curve")
    bends = np.concatenate([evenly(g, sum(q[0][-1] for q in calm))[0] for g in calm])
    panel = Panel(np.vstack([g[2] for g in calm]), max(np.abs(bends).max(), 1e-300))
    shown = [("points' spline", graphs(new, "spline"), new["fairness"]["spline"], ""),
             ("shortest chain", graphs(old, "curve"), old["fairness"]["answer"],
              f", {len(old['pieces'])} pieces"),
             ("calmest chain", calm, new["fairness"]["answer"], f", {len(new['pieces'])} pieces")]
    parts = [text(4, 13, name, "n")]
    for i, (title, graph, figures, more) in enumerate(shown):
        parts.append(f'<g transform="translate({i * (PANEL + GAP)} {HEAD})">{panel.draw(graph)}</g>')
        parts.append(text(i * (PANEL + GAP) + 4, 29,
                          f"{title}: {figures['waves']} waves, energy {figures['energy']:.3g}, "
                          f"jolt {figures['jolt']:.2g}{more}", "f"))
    return "".join(parts)


def sheet(rows):
    width = (3 * (PANEL + GAP) + 2 * GAP) * COLUMNS
    lines = math.ceil(len(rows) / COLUMNS)
    style = ("text{font-family:sans-serif;fill:#222}.n{font-size:14px;font-weight:bold}"
             ".f{font-size:11px}path{fill:none}.t{stroke:#9db8d2;stroke-width:.6}"
             ".c{stroke:#d33;stroke-width:.8}.e{stroke:#0b5394;stroke-width:.9}"
             ".l{stroke:#000;stroke-width:1.1}")
    parts = [f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {width} '
             f'{lines * (PANEL + HEAD + GAP)}"><style>{style}</style>'
             '<rect width="100%" height="100%" fill="#fff"/>']
    for i, content in enumerate(rows):
        x = (i % COLUMNS) * width / COLUMNS
        y = (i // COLUMNS) * (PANEL + HEAD + GAP)
        parts.append(f'<g transform="translate({x:g} {y})">{content}</g>\n')
    return "".join(parts) + "</svg>\n"


def main():
    program, file = sys.argv[1:3]
    chosen = [next(((n, p) for n, p in profiles.all_profiles() if n.startswith(w)), None)
              for w in WANTED]
    chosen = [c for c in chosen if c]

    def both(job):
        new = profiles.fair(program, job[1])
        old = profiles.fair(program, job[1], criterion="fewest-pieces", tolerance=new["tolerance"],
                            noise=new["noise"])
        return job[0], old, new

    with ThreadPoolExecutor(2) as pool:
        answers = list(pool.map(both, chosen))
    with open(file, "w", encoding="utf-8") as out:
        out.write(sheet([row(*answer) for answer in answers]))


if __name__ == "__main__":
    main()
