"""The script of integrations/ufo on a font made here: an o whose handles are off, a corner, a straight line."""

import math
import subprocess
import sys
import tempfile
from pathlib import Path

SKIPPED = 77
try:
    import ufoLib2
    from fontTools.pens.recordingPen import RecordingPen
except ImportError as missing:
    print(f"skipped: {missing} (Debian: python3-ufolib2)")
    sys.exit(SKIPPED)
SCRIPT = Path(sys.argv[1]) / "keyline_ufo.py"
ROUND = 0.5522847498 * 250  # handles of a quarter circle of radius 250


def font(work):
    """An o of radius 250 about (300, 250) whose handles are up to 10 % too long or short, and a d with a corner."""
    made = ufoLib2.Font()
    made.info.unitsPerEm = 1000
    factors = iter((1.1, 0.95, 1.07, 1.0, 0.92, 1.08, 0.94, 0.98))
    nodes = [(300, 0), (550, 250), (300, 500), (50, 250)]
    ways = [(1, 0), (0, 1), (-1, 0), (0, -1)]
    pen = made.newGlyph("o").getPen()
    made["o"].width = 600
    pen.moveTo(nodes[0])
    for i in range(4):
        a, b, out, back = nodes[i], nodes[(i + 1) % 4], ways[i], ways[(i + 1) % 4]
        first, second = next(factors) * ROUND, next(factors) * ROUND
        pen.curveTo((a[0] + first * out[0], a[1] + first * out[1]), (b[0] - second * back[0], b[1] - second * back[1]), b)
    pen.closePath()
    pen = made.newGlyph("d").getPen()
    made["d"].width = 500
    pen.moveTo((0, 0))
    pen.curveTo((150, 0), (300, 120), (300, 260))
    pen.curveTo((300, 400), (150, 500), (0, 500))
    pen.lineTo((0, 0))
    pen.closePath()
    pen = made.newGlyph("bare").getPen()  # TrueType's, without a point on the curve
    pen.qCurveTo((550, 0), (550, 500), (50, 500), (50, 0), None)
    pen.closePath()
    pen = made.newGlyph("stroke").getPen()
    pen.moveTo((0, 0))
    pen.curveTo((100, 200), (200, 200), (300, 0))
    pen.endPath()
    made["d"].draw(pen)
    pen = made.newGlyph("l").getPen()
    pen.moveTo((50, 0))
    for place in ((150, 0), (150, 700), (50, 700)):
        pen.lineTo(place)
    pen.closePath()
    made["l"].contours[0].points[2].name = "corner"
    made.newGlyph("composed").getPen().addComponent("o", (1, 0, 0, 1, 0, 0))
    made.save(work / "trial.ufo")


def run(*arguments):
    done = subprocess.run([sys.executable, "-B", SCRIPT, *map(str, arguments)], capture_output=True, text=True)
    assert done.returncode == 0 and not done.stderr, done.stderr
    return done.stdout


def cubics(glyph):
    pen = RecordingPen()
    glyph.draw(pen)
    made, at = [], None
    for verb, points in pen.value:
        if verb == "curveTo":
            made.append([at, *points])
        at = points[-1] if points else at
    return made


def curvature(p, q, r):
    edge = (q[0] - p[0], q[1] - p[1])
    return 2 / 3 * (edge[0] * (r[1] - q[1]) - edge[1] * (r[0] - q[0])) / math.hypot(*edge) ** 3


def jumps(outline):
    """Largest relative jump of curvature at the nodes of a closed outline."""
    worst = 0
    for a, b in zip(outline[-1:] + outline, outline):
        before, after = -curvature(*a[:0:-1]), curvature(*b[:3])
        worst = max(worst, abs(after - before) / max(abs(before), abs(after)))
    return worst


def at(cubic, t):
    u = 1 - t
    return [u**3 * a + 3 * u * u * t * b + 3 * u * t * t * c + t**3 * d for a, b, c, d in zip(*cubic)]


def test_fair(work):
    run("fair", work / "trial.ufo", "-o", work / "faired.ufo", "--tolerance", "6")
    before = cubics(ufoLib2.Font.open(work / "trial.ufo")["o"])
    after = cubics(ufoLib2.Font.open(work / "faired.ufo")["o"])
    assert jumps(before) > 0.2 > 0.1 > jumps(after), (jumps(before), jumps(after))
    fine = [at(c, i / 50) for c in after for i in range(51)]
    old = [at(c, i / 50) for c in before for i in range(51)]
    assert max(min(math.dist(p, q) for q in fine) for p in old) < 6 + 4  # and half a step between points
    for axis, (least, most) in enumerate(((50, 550), (0, 500))):
        places = [p[axis] for p in fine]
        assert abs(min(places) - least) < 1e-6 and abs(max(places) - most) < 1e-6, (min(places), max(places))
    nodes = {tuple(c[0]) for c in after}
    assert {y for _, y in nodes} >= {0, 500} and {x for x, _ in nodes} >= {50, 550}


def test_corners_and_lines_stay(work):
    made = ufoLib2.Font.open(work / "faired.ufo")["d"]
    assert {(p.x, p.y) for p in made.contours[0] if p.segmentType} >= {(0, 0), (0, 500)}
    assert any(p.segmentType == "line" for p in made.contours[0])
    assert abs(max(at(c, i / 50)[0] for c in cubics(made) for i in range(51)) - 300) < 1e-6


def test_curvature(work):
    told = run("curvature", work / "trial.ufo", "o", "-o", work / "combs.svg")
    assert len([line for line in told.splitlines() if line.startswith("o contour 0 at")]) == 4, told
    assert run("curvature", work / "faired.ufo", "o") == ""
    assert (work / "combs.svg").read_text().count("<path") == 2


def test_open_contours_and_straight_ones_stay(work):
    """A font loses no contour, no name of a point; what is left alone is said."""
    told = run("fair", work / "trial.ufo", "stroke", "l", "composed", "-o", work / "left.ufo")
    assert "stroke: 3 nodes" in told and "1 open contours left as they were" in told, told
    assert "composed: no closed outline of its own" in told, told
    before, after = (ufoLib2.Font.open(work / name) for name in ("trial.ufo", "left.ufo"))
    assert after["stroke"].contours[0] == before["stroke"].contours[0] and len(after["stroke"].contours) == 2
    assert after["l"].contours == before["l"].contours and after["composed"].components == before["composed"].components


def test_an_outline_without_a_point_on_it(work):
    """Four quadratics begin midway between the points off the curve: they touch the middles of the square's sides."""
    run("fair", work / "trial.ufo", "bare", "-o", work / "bare.ufo")
    fine = [at(c, i / 50) for c in cubics(ufoLib2.Font.open(work / "bare.ufo")["bare"]) for i in range(51)]
    for place in ((300, 0), (550, 250), (300, 500), (50, 250)):
        assert min(math.dist(place, p) for p in fine) < 2 + 6  # the tolerance, and half a step between points


def test_straight_glyphs_have_no_comb(work):
    run("curvature", work / "trial.ufo", "l", "-o", work / "l.svg")
    assert (work / "l.svg").read_text().count("<path") == 2


def refused(*arguments):
    done = subprocess.run([sys.executable, "-B", SCRIPT, *map(str, arguments)], capture_output=True, text=True)
    assert done.returncode == 1 and "Traceback" not in done.stderr, done.stderr
    return done.stderr


def test_what_is_not_there_is_said(work):
    assert "has no glyph q" in refused("fair", work / "trial.ufo", "q", "-o", "x")
    assert "No such file" in refused("curvature", work / "trial.ufo", "l", "-o", work / "none" / "l.svg")


def test_what_is_no_font_is_not_replaced(work):
    (work / "letters").mkdir()
    (work / "letters" / "dear.txt").write_text("Dear")
    (work / "notes.txt").write_text("notes")
    for place in ("letters", "notes.txt"):
        assert "is no UFO" in refused("fair", work / "trial.ufo", "l", "-o", work / place)
    assert (work / "letters" / "dear.txt").exists() and (work / "notes.txt").read_text() == "notes"


with tempfile.TemporaryDirectory() as folder:
    font(Path(folder))
    for name, test in [(n, t) for n, t in list(globals().items()) if n.startswith("test_")]:
        test(Path(folder))
        print("passed", name)
