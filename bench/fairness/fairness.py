#!/usr/bin/env python3
"""fairness.py PROGRAM [STAGE…] [NAME…]: how fair the answers of `fair` are on measured profiles.

A stage is one of plain, noise, half, band, sweep (see README.md beside this folder); without one,
plain. NAME picks the profiles whose name holds it. A row per answer, then a summary: waves, energy
and jolt beside the smoothest quintic spline within the same tolerance of the same points. Where the
profiles are absent it says so and exits 0.
"""

import math
import sys
import zlib
from concurrent.futures import ThreadPoolExecutor

import numpy as np

import band
import comb
import profiles
import rival

NOISES = (0.5, 1.0, 2.0)  # times that of the points, added
STEPS = 40                # of the tolerance in a sweep,
WIDEST = 30               # from one standard deviation of the points to so many
RISE = 1.05               # of the energy between two tolerances: what is let pass
MOST_FALL = 1e6           # times: energies of steps of curvature are no number to print
WORKERS = 2


class Row:
    """An answer beside its rival."""

    def __init__(self, name, points, result):
        chain = profiles.chain_of(result)
        self.name, self.result, self.chain = name, result, chain
        graphs = [comb.graph_of_chain(chain)]
        self.ours = comb.figures(*graphs[0])
        spline = rival.smoothest(points, chain["closed"], result["tolerance"])
        self.spline = spline
        theirs = comb.figures(spline.length, spline.curvature) if spline else None
        if spline:
            graphs.append((spline.length, spline.curvature))
        self.low_bends = [comb.low_bends(*graph, chain["closed"], result["tolerance"])
                          for graph in graphs]
        self.theirs = theirs
        self.energy = self.ours[1] / theirs[1] if theirs and theirs[1] > 0 else math.nan
        self.jolt = self.ours[2] / theirs[2] if theirs and theirs[2] > 0 else math.nan

    def text(self):
        r = self.result
        waves = self.theirs[0] if self.theirs else "-"
        within = "" if r["within_tolerance"] else "  BEYOND THE TOLERANCE"
        return (f"{self.name:34} waves {self.ours[0]:3} for {waves:3}  energy {self.energy:8.3g}  "
                f"jolt {self.jolt:6.3f}  pieces {len(r['pieces']):3}  "
                f"rms/noise {r['deviation']['rms'] / max(r['noise'], 1e-300):5.2f}  "
                f"{r['seconds']:5.1f} s{within}")


def quantile(values, share):
    known = sorted(v for v in values if not math.isnan(v))
    return known[min(len(known) - 1, int(share * len(known)))] if known else math.nan


def summary(title, rows):
    if not rows:
        print(f"{title}: none")
        return
    energy, jolt = [r.energy for r in rows], [r.jolt for r in rows]
    beside = [r for r in rows if r.theirs]
    print(f"{title}: {len(rows)} chains, {sum(r.result['within_tolerance'] for r in rows)} within "
          f"the tolerance; more waves in {sum(r.ours[0] > r.theirs[0] for r in beside)}; "
          f"energy {quantile(energy, .5):.3g}, 95 % {quantile(energy, .95):.3g}, "
          f"most {quantile(energy, 1):.3g}; jolt {quantile(jolt, .5):.3g}, "
          f"95 % {quantile(jolt, .95):.3g}, most {quantile(jolt, 1):.3g}; "
          f"bends to the other side lower than the tolerance "
          f"{sum(r.low_bends[0] for r in beside)} for {sum(r.low_bends[1] for r in beside)}; "
          f"pieces {quantile([len(r.result['pieces']) for r in rows], .5):.0f}; seconds "
          f"{quantile([r.result['seconds'] for r in rows], .5):.2f}, "
          f"most {quantile([r.result['seconds'] for r in rows], 1):.1f}", flush=True)


def answers(program, jobs):
    """Rows of (name, points, options), in order; parted or refused ones are told and left out."""
    rows = []
    with ThreadPoolExecutor(WORKERS) as pool:
        found = pool.map(lambda job: profiles.fair(program, job[1], **job[2]), jobs)
        for (name, points, _), result in zip(jobs, found):
            if result is None:
                print(f"{name:34} refused", flush=True)
            elif profiles.chain_of(result) is None:
                kept = "within" if result["within_tolerance"] else "BEYOND"
                print(f"{name:34} parted at corners, {kept} the tolerance", flush=True)
            else:
                rows.append(Row(name, points, result))
                print(rows[-1].text(), flush=True)
    return rows


def plain(program, wanted):
    rows = answers(program, [(name, points, {}) for name, points in wanted])
    summary("plain", rows)
    return rows


def noisy(name, points, result, times):
    """The same points with so much of their own noise added; the same for every run."""
    random = np.random.default_rng(zlib.crc32(name.encode()))
    return (np.array(points) + random.normal(0, times * result["noise"], np.shape(points))).tolist()


def kept_joints(before, after, points):
    """Joints of an answer and how many have one of another's within the points' spacing."""
    theirs = profiles.joints_of(after)
    near = [min((math.dist(j, t) for t in theirs), default=math.inf)
            <= profiles.spacing_at(points, j) for j in profiles.joints_of(before)]
    return sum(near), len(near)


def by_chance(before, after, points):
    """The share of joints that would be so near if the other's stood anywhere."""
    length = before["length"]
    spacing = length / len(points)
    return 1 - math.exp(-2 * spacing * (len(after["pieces"]) - 1) / length)


def beside_plain(title, before, after, points):
    """How far joints move from the plain answers to those of other points."""
    plain_of = {row.name: row.result for row in before}
    kept = [kept_joints(plain_of[row.name], row.result, points[row.name]) for row in after]
    chance = [by_chance(plain_of[row.name], row.result, points[row.name]) for row in after]
    every = max(1, sum(count for _, count in kept))
    print(f"{title}: {sum(k for k, _ in kept) / every:.2f} of {every} joints moved by less than the "
          f"spacing of the points ({np.mean(chance or [0]):.2f} by chance)", flush=True)


def changed_points(program, wanted, stages):
    before = answers(program, [(name, points, {}) for name, points in wanted])
    summary("plain", before)
    points = dict(wanted)
    runs = []
    if "noise" in stages:
        runs += [(f"noise {times:g} added",
                  [(r.name, noisy(r.name, points[r.name], r.result, times), {}) for r in before])
                 for times in NOISES]
    if "half" in stages:
        runs.append(("every second point", [(r.name, points[r.name][::2], {}) for r in before]))
    for title, jobs in runs:
        print(f"\n{title}")
        after = answers(program, jobs)
        summary(title, after)
        beside_plain(title, before, after, points)


def physical_limit(program, wanted):
    rows = answers(program, [(name, points, {}) for name, points in wanted])
    over = []
    for row in rows:
        points = dict(wanted)[row.name]
        chain = (*comb.graph_of_chain(row.chain), row.chain["start"], row.chain["direction"])
        least = row.spline and band.least_energy(points, row.chain["closed"],
                                                 row.result["tolerance"], row.spline, chain)
        if not least:
            print(f"{row.name:34} no band optimum")
            continue
        _, energy, jolt = comb.figures(least.length, least.curvature)
        over.append((row.ours[1] / energy, row.ours[2] / jolt))
        print(f"{row.name:34} least energy {energy / row.theirs[1]:.3f} of the spline's, jolt "
              f"{jolt / row.theirs[2]:.3f}; ours is {over[-1][0]:.2f} and {over[-1][1]:.2f} times it",
              flush=True)
    print(f"band: {len(over)} of {len(rows)}; our energy over the least {quantile([e for e, _ in over], .5):.3g} "
          f"in the median, {quantile([e for e, _ in over], 1):.3g} at most; jolt "
          f"{quantile([j for _, j in over], .5):.3g}, {quantile([j for _, j in over], 1):.3g}")


def sweep(program, wanted):
    for name, points in wanted:
        first = profiles.fair(program, points)
        noise = first["noise"]
        tolerances = [noise * WIDEST ** (i / (STEPS - 1)) for i in range(STEPS)]
        with ThreadPoolExecutor(WORKERS) as pool:
            found = list(pool.map(
                lambda t: profiles.fair(program, points, tolerance=t, noise=noise), tolerances))
        told = [(t, r, comb.figures(*comb.graph_of_chain(profiles.chain_of(r))))
                for t, r in zip(tolerances, found) if r and profiles.chain_of(r)]
        print(f"{name}: noise {noise:.3g}; {len(told)} of {STEPS} are one chain")
        for t, r, (waves, energy, jolt) in told:
            print(f"  {t / noise:6.2f} sigma  waves {waves:3}  energy {energy:10.4g}  jolt {jolt:.3f}  "
                  f"pieces {len(r['pieces']):3}{'' if r['within_tolerance'] else '  BEYOND'}")
        rises = [(b[0] / noise, b[2][1] / a[2][1]) for a, b in zip(told, told[1:])
                 if b[2][1] > RISE * a[2][1]]
        waves = [b[0] / noise for a, b in zip(told, told[1:]) if b[2][0] > a[2][0]]
        text = ", ".join(f"{min(by, MOST_FALL):.3g} times at {at:.2g}" for at, by in rises)
        print(f"{name}: energy rises by more than 5 % in {len(rises)} of {len(told) - 1} steps "
              f"({text or 'none'}), waves in {len(waves)}", flush=True)


STAGES = ("plain", "noise", "half", "band", "sweep")


def main():
    program, words = sys.argv[1], sys.argv[2:]
    stages = [w for w in words if w in STAGES] or ["plain"]
    names = [w for w in words if w not in STAGES]
    try:
        wanted = profiles.all_profiles()
    except profiles.Absent as absent:
        print(f"bench: {absent}: the measured profiles are not part of this project; nothing to do",
              file=sys.stderr)
        return
    wanted = [(n, p) for n, p in wanted if not names or any(word in n for word in names)]
    if "noise" in stages or "half" in stages:
        changed_points(program, wanted, stages)
    elif "plain" in stages:
        plain(program, wanted)
    if "band" in stages:
        physical_limit(program, wanted)
    if "sweep" in stages:
        sweep(program, wanted)


if __name__ == "__main__":
    main()
