#!/usr/bin/python3
"""Curvature of glyphs and fair outlines of a UFO, for type designers.

keyline_ufo.py curvature FONT.ufo [GLYPH…] [-o COMBS.svg]
    tells every joint of the glyphs that is not smooth in direction or curvature, and draws combs.
keyline_ufo.py fair FONT.ufo [GLYPH…] -o FAIRED.ufo [--tolerance UNITS]
    makes each run between corners the calmest curve within the tolerance, curvature running through every node.
    Corners, straight lines and extrema stay where they are; extrema get nodes with handles along the axis.

Needs python3-ufolib2 and python3-keyline. Open contours and components are left alone.
"""

import argparse
import math
import sys
import tempfile
from pathlib import Path

import keyline
import ufoLib2
from fontTools.misc.bezierTools import splitCubicAtT
from fontTools.pens.recordingPen import RecordingPen
from fontTools.ufoLib import UFOReader
from fontTools.ufoLib.errors import UFOLibError
from fontTools.ufoLib.glifLib import readGlyphFromString

SMOOTH = math.radians(3)  # a turn of the handles below this was not meant: a unit of a handle of 20
JUMP = 0.1  # of curvature, as a share of the larger



def outlines_of(glyph):
    """Each closed contour with its number, as cubics."""
    closed = [(number, cubics_of(contour)) for number, contour in enumerate(glyph.contours) if not contour.open]
    return [(number, outline) for number, outline in closed if outline]


def cubics_of(contour):
    """Of a straight line the handles lie on its ends."""
    pen = RecordingPen()
    contour.draw(pen)
    made, start = [], None
    for verb, points in pen.value:
        if start is None:  # TrueType: without a point on the curve it begins midway between two off it
            start = at = points[0] if verb == "moveTo" else _middle(points[-2], points[0])
        if verb == "lineTo":
            at = _line(made, at, points[0])
        elif verb == "curveTo":
            made.append([at, *points])
            at = points[-1]
        elif verb == "qCurveTo":
            at = _quadratics(made, at, [start if p is None else p for p in points])
    _line(made, at, start)
    return made


def _line(contour, a, b):
    if a != b:
        contour.append([a, a, b, b])
    return b


def _middle(p, q):
    return ((p[0] + q[0]) / 2, (p[1] + q[1]) / 2)


def _quadratics(contour, at, points):
    """TrueType's run of off-curve points, raised to cubics."""
    offs = points[:-1]
    ends = [_middle(p, q) for p, q in zip(offs, offs[1:])] + [points[-1]]
    for off, end in zip(offs, ends):
        handles = [tuple(e + 2 / 3 * (o - e) for e, o in zip(edge, off)) for edge in (at, end)]
        contour.append([at, *handles, end])
        at = end
    return at if offs else _line(contour, at, points[-1])


def cubics_of_curve(curve, tolerance):
    """A curve as Keyline writes a glyph: cubics of its curvature at both ends, nodes at extrema."""
    with tempfile.TemporaryDirectory() as folder:
        file = Path(folder) / "a.glif"
        keyline.document.write(file, curves=[{"name": "a", "curve": curve}], tolerance=tolerance)
        drawn = ufoLib2.objects.Glyph("a")
        readGlyphFromString(file.read_text(encoding="utf-8"), drawn, drawn.getPointPen())
    made = []
    pen = RecordingPen()
    drawn.draw(pen)
    for verb, points in pen.value:
        if verb == "lineTo":
            _line(made, at, points[0])
        elif verb == "curveTo":
            made.append([at, *points])
        at = points[-1] if points else at
    return made


def is_line(cubic):
    return cubic[0] == cubic[1] and cubic[2] == cubic[3]


def directions(cubic):
    """Where it starts to and arrives from, as angles."""
    there = [p for p in cubic if p != cubic[0]]
    back = [p for p in reversed(cubic) if p != cubic[3]]
    start, end = there[0], back[0]
    return (
        math.atan2(start[1] - cubic[0][1], start[0] - cubic[0][0]),
        math.atan2(cubic[3][1] - end[1], cubic[3][0] - end[0]),
    )


def turn(before, after):
    """At the joint of two cubics, in radians."""
    angle = directions(after)[0] - directions(before)[1]
    return math.atan2(math.sin(angle), math.cos(angle))


def curvatures(cubic):
    """At its start and its end."""

    def at(p, q, r):
        edge = (q[0] - p[0], q[1] - p[1])
        length = math.hypot(*edge)
        cross = edge[0] * (r[1] - q[1]) - edge[1] * (r[0] - q[0])
        return 2 / 3 * cross / length**3 if length else 0.0

    return at(*cubic[:3]), -at(*cubic[:0:-1])


# ---- fair outlines ----------------------------------------------------------------------------


def turning_places(a, b, c, d):
    """Where a cubic Bézier's coordinate has an extremum, away from its ends."""
    p, q, r = b - a, c - b, d - c
    square, half = p - 2 * q + r, q - p
    if abs(square) < 1e-9 * (abs(p) + abs(q) + abs(r)):
        roots = [-p / (2 * half)] if half else []
    else:
        inside = half * half - square * p
        roots = [(-half + sign * math.sqrt(inside)) / square for sign in (1, -1)] if inside > 0 else []
    return [t for t in roots if 1e-3 < t < 1 - 1e-3]


def with_extrema(run):
    """The run with a node wherever its direction is along an axis inside a cubic."""
    parts = []
    for cubic in run:
        places = sorted(t for axis in (0, 1) for t in turning_places(*(p[axis] for p in cubic)))
        parts += [list(part) for part in splitCubicAtT(*cubic, *places)] if places else [list(cubic)]
    return parts


def runs_of(contour):
    """Straight lines, and cubics between corners and lines; whether one run is the whole contour."""
    held = [is_line(a) or is_line(b) or abs(turn(a, b)) > SMOOTH for a, b in zip(contour[-1:] + contour, contour)]
    if True not in held:
        return [contour], True
    first = held.index(True)
    runs = []
    for cubic, mark in zip(contour[first:] + contour[:first], held[first:] + held[:first]):
        runs += [[]] if mark else []
        runs[-1].append(cubic)
    return runs, False


def extrema(run, axis, closed):
    """Places in a run with a node at each extremum: (index of the node, whether largest) of those inside."""
    ways = [cubic[3][axis] - cubic[0][axis] for cubic in run]
    joints = [(i, (ways[i - 1], ways[i])) for i in range(0 if closed else 1, len(run))]
    return [(i, before > 0) for i, (before, after) in joints if before * after < 0]


def put_extrema(run, old, axis, closed):
    """Moves a coordinate of the run's nodes so that its extrema are the old run's; False where they differ."""
    places, wanted = (extrema(r, axis, closed) for r in (run, old))
    if [largest for _, largest in places] != [largest for _, largest in wanted]:
        return False
    marks = [(i, run[i][0][axis], old[j][0][axis]) for (i, _), (j, _) in zip(places, wanted)]
    if closed:
        marks = marks + [(marks[0][0] + len(run), *marks[0][1:])] if marks else []
    else:
        marks = [(0, run[0][0][axis], old[0][0][axis]), *marks, (len(run), run[-1][3][axis], old[-1][3][axis])]
    for (i, low, low_to), (j, high, high_to) in zip(marks, marks[1:]):
        scale = (high_to - low_to) / (high - low) if high != low else 1
        for cubic in (run[k % len(run)] for k in range(i, j)):
            for n, point in enumerate(cubic):
                moved = list(point)
                moved[axis] = low_to + (point[axis] - low) * scale
                cubic[n] = tuple(moved)
    for i, _ in places:  # handles there along the axis
        for cubic, node, handle in ((run[i - 1], 3, 2), (run[i], 0, 1)):
            moved = list(cubic[handle])
            moved[axis] = cubic[node][axis]
            cubic[handle] = tuple(moved)
    return True


def from_extremum(run, like=None):
    """A closed run begun at its first extremum of the second coordinate, or at the one nearest to another run's."""
    places = [i for i, _ in extrema(run, 1, True)]
    if not places:
        return run
    first = min(places, key=lambda i: math.dist(run[i][0], like[0][0])) if like else places[0]
    return run[first:] + run[:first]


def faired(run, tolerance, closed):
    """The run as cubics of the calmest chain within the tolerance, its extrema where they were; None: no such."""
    path = {"type": "path", "curves": [{"type": "bezier", "points": c} for c in run], "closed": closed}
    request = {"curve": path, "tolerance": tolerance / 2}
    if not closed:
        request["clamp"] = {"start": "G1", "end": "G1"}
    answer = keyline.perform("fair", request)
    old = with_extrema(run)
    new = [list(cubic) for cubic in cubics_of_curve(answer["curve"], tolerance / 10)]
    if closed:
        old = from_extremum(old)
        new = from_extremum(new, old)
    if not answer["within_tolerance"] or not all(put_extrema(new, old, axis, closed) for axis in (0, 1)):
        return None
    return new


def fair_contour(contour, tolerance):
    """The contour's cubics faired (itself where no run is), and how many runs are left as they were."""
    runs, closed = runs_of(contour)
    made = [None if is_line(run[0]) else faired(run, tolerance, closed) for run in runs]
    left = sum(new is None and not is_line(run[0]) for new, run in zip(made, runs))
    return [cubic for new, run in zip(made, runs) for cubic in new or run] if any(made) else contour, left


def drawn(cubics):
    """The cubics as a contour of a glyph."""
    glyph = ufoLib2.objects.Glyph("a")
    pen = glyph.getPen()
    pen.moveTo(rounded(cubics[0][0]))
    for cubic in cubics:
        places = [rounded(p) for p in cubic]
        pen.lineTo(places[3]) if is_line(cubic) else pen.curveTo(*places[1:])
    pen.closePath()
    return glyph.contours[0]


def rounded(point):
    """To 1e-4 units: extrema on whole units are whole again, and curvature of short cubics does not suffer."""
    return tuple(round(v, 4) + 0.0 for v in point)


def fair(font, names, tolerance):
    """Fairs the glyphs in place, and leaves contours as they are of which nothing is faired; a line for each."""
    for name in names:
        contours = font[name].contours
        nodes, after, left = 0, 0, 0
        for number, outline in outlines_of(font[name]):
            made, unfaired = fair_contour(outline, tolerance)
            if made is not outline:
                contours[number] = drawn(made)
            nodes, after, left = nodes + len(outline), after + len(made), left + unfaired
        told = [f"{nodes} nodes, {after} after"] if nodes else ["no closed outline of its own"]
        told += [f"{left} runs left as they were"] if left else []
        opened = sum(contour.open for contour in contours)
        told += [f"{opened} open contours left as they were"] if opened else []
        print(f"{name}: {', '.join(told)}")


# ---- curvature --------------------------------------------------------------------------------


def joints(contour):
    """What is not smooth where it seems meant to be: (place, turn in degrees, curvature before, after)."""
    for a, b in zip(contour[-1:] + contour, contour):
        if abs(turn(a, b)) < SMOOTH and not (is_line(a) and is_line(b)):
            before = 0.0 if is_line(a) else curvatures(a)[1]
            after = 0.0 if is_line(b) else curvatures(b)[0]
            yield b[0], math.degrees(turn(a, b)), before, after


def tell(font, names):
    for name in names:
        for number, contour in outlines_of(font[name]):
            for (x, y), kink, before, after in joints(contour):
                jump = abs(after - before) / max(abs(before), abs(after), 1e-12)
                if abs(kink) > 0.1 or jump > JUMP:
                    print(f"{name} contour {number} at {x:g} {y:g}: turns by {kink:.2f} degrees, "
                          f"curvature {before:.3g} to {after:.3g} per unit")


def combs(font, names):
    """A drawing of the outlines with their combs, a glyph after the other; teeth at most a quarter of the em."""
    shown = [(name, contour, comb_of(contour)) for name in names for _, contour in outlines_of(font[name])]
    largest = max((abs(k) for _, _, comb in shown for k in comb["curvature"]), default=0)
    scale = font.info.unitsPerEm / 4 / (largest or 1)
    lines, offset, last = [], 0, None
    for name, contour, comb in shown:
        if last not in (None, name):
            offset += font[last].width + font.info.unitsPerEm / 4
        last = name
        outline = f"M {contour[0][0][0]} {contour[0][0][1]} " + " ".join(
            "C " + " ".join(f"{x} {y}" for x, y in cubic[1:]) for cubic in contour
        )
        tips = [
            (x - scale * k * nx, y - scale * k * ny)
            for (x, y), (nx, ny), k in zip(comb["points"], comb["normals"], comb["curvature"])
        ]
        teeth = " ".join(f"M {p[0]:.2f} {p[1]:.2f} L {q[0]:.2f} {q[1]:.2f}" for p, q in zip(comb["points"], tips))
        lines.append(
            f'<g transform="translate({offset} 0)"><path d="{teeth}" stroke="#2b8cbe" stroke-width="1"/>'
            f'<path d="{outline} Z" stroke="#000" stroke-width="3"/></g>'
        )
    em = font.info.unitsPerEm
    width = offset + (font[last].width if last else 0) + em
    head = f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="{-em / 2} {-1.25 * em} {width} {2 * em}">'
    return "\n".join([head, '<g transform="scale(1 -1)" fill="none">', *lines, "</g>", "</svg>", ""])


def comb_of(contour):
    path = {"type": "path", "curves": [{"type": "bezier", "points": c} for c in contour]}
    return keyline.perform("curve.show", {"curve": path, "comb": {"samples": 60 * len(contour)}})["comb"]


def written_over(output):
    """Ends where saving would replace a file or folder that is no font."""
    try:
        if Path(output).exists():
            UFOReader(output).close()
    except UFOLibError:
        sys.exit(f"{output} is there and is no UFO: name another")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("work", choices=("curvature", "fair"))
    parser.add_argument("font")
    parser.add_argument("glyphs", nargs="*", help="all that have outlines where none is named")
    parser.add_argument("-o", "--output", help="the drawing, or the font that is written")
    parser.add_argument("--tolerance", type=float, default=2, help="in units of the font (2)")
    asked = parser.parse_args()
    font = ufoLib2.Font.open(asked.font, lazy=False)
    unknown = [name for name in asked.glyphs if name not in font]
    if unknown:
        sys.exit(f"{asked.font} has no glyph {', '.join(unknown)}")
    names = asked.glyphs or sorted(glyph.name for glyph in font if glyph.contours)
    if asked.work == "curvature":
        tell(font, names)
        if asked.output:
            with open(asked.output, "w", encoding="utf-8") as file:
                file.write(combs(font, names))
    elif not asked.output:
        sys.exit("fair needs -o FAIRED.ufo")
    else:
        written_over(asked.output)
        fair(font, names, asked.tolerance)
        font.save(asked.output, overwrite=True)


if __name__ == "__main__":
    try:
        main()
    except keyline.Error as error:
        sys.exit(f"{error.message}\n{error.hint}" if error.hint else error.message)
    except (OSError, UFOLibError) as error:
        sys.exit(str(error))
