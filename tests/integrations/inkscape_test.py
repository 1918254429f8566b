"""The extensions of integrations/inkscape: each on a drawing, as Inkscape runs them, and within Inkscape."""

import math
import os
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

SKIPPED = 77
EXTENSIONS = Path("/usr/share/inkscape/extensions")
FOLDER = Path(sys.argv[1]).resolve()
BENT = [(5 * i, 120 + 0.005 * (5 * i - 60) ** 2 + 0.25 * (-1) ** i) for i in range(25)]
RING = [(220 + 30 * math.cos(math.pi * i / 20), 40 + 30 * math.sin(math.pi * i / 20)) for i in range(40)]


def smooth(points):
    """A path through the points whose handles are parallel to the chord of the neighbours."""
    slopes = [((c[0] - a[0]) / 6, (c[1] - a[1]) / 6) for a, c in zip(points[:1] + points, points[1:] + points[-1:])]
    parts = [
        f"C {a[0] + s[0]} {a[1] + s[1]} {b[0] - t[0]} {b[1] - t[1]} {b[0]} {b[1]}"
        for a, b, s, t in zip(points, points[1:], slopes, slopes[1:])
    ]
    return f"M {points[0][0]} {points[0][1]} " + " ".join(parts)


def straight(points):
    return "M " + " L ".join(f"{x} {y}" for x, y in points)


DRAWING = """<svg xmlns="http://www.w3.org/2000/svg" width="300mm" height="200mm" viewBox="0 0 300 200">
<g transform="translate(10 10) scale(1.5)" style="fill:none;stroke:#000">
<path id="bent" d="M 20 60 L 80 60 L 110 100"/>
<path id="first" d="M 0 0 C 10 30 50 40 80 20"/>
<path id="second" d="M 120 10 C 140 0 150 0 170 10"/>
<path id="wavy" d="{wavy}"/>
<path id="lines" d="{lines}"/>
<path id="ring" d="{ring} Z"/>
<path id="quarter" d="M 200 100 A 50 50 0 0 1 250 150"/>
<path id="half" style="stroke-dasharray:2 1" d="M 0 150 A 25 25 0 0 1 25 175"/>
<path id="parts" d="M 0 0 C 5 5 10 5 15 0 M 10 30 C 30 40 50 40 80 20"/>
<path id="far" d="M 20000.1234 60 L 20080.4321 60 L 20110 100"/>
<text id="words" x="10" y="100">words</text>
<use id="clone" href="#bent"/>
<ellipse id="turned" cx="70" cy="30" rx="18" ry="9" transform="rotate(26 70 30)"/>
<path id="dot" d="M 3 3"/>
<path id="flat" transform="scale(1 0)" d="M 0 0 C 1 1 2 1 3 0"/>
<g id="both" style="stroke-width:3"><path id="left" d="M 0 0 C 9 9 20 9 30 0"/><path id="right" d="M 50 0 C 60 9 70 9 80 0"/></g>
</g></svg>""".format(wavy=smooth(BENT), lines=straight(BENT), ring=straight(RING))

if not (EXTENSIONS / "inkex").is_dir():
    print("skipped: Inkscape's extensions (inkex) are not installed")
    sys.exit(SKIPPED)
sys.path.insert(0, str(EXTENSIONS))
import inkex  # noqa: E402

PACKAGE = Path(os.environ["PYTHONPATH"]).resolve()
ENVIRONMENT = os.environ | {"PYTHONPATH": f"{PACKAGE}:{EXTENSIONS}", "PYTHONWARNINGS": "ignore"}

KNOWN = {e.get("id") for e in inkex.load_svg(DRAWING).getroot().iter()} - {None}
SCALE, SHIFT = 1.5, 10  # of the group above


def called(name, work, *arguments):
    drawing, made = work / "drawing.svg", work / f"{name}.svg"
    drawing.write_text(DRAWING)
    command = [sys.executable, "-B", FOLDER / f"keyline_{name}.py", *arguments, f"--output={made}", drawing]
    return subprocess.run(command, env=ENVIRONMENT, capture_output=True, text=True), made


def run(name, work, *arguments):
    done, made = called(name, work, *arguments)
    assert done.returncode == 0, f"{name}: {done.stderr}"
    return inkex.load_svg(str(made)).getroot()


def refused(name, work, *arguments):
    """What is said where nothing is written."""
    done, made = called(name, work, *arguments)
    assert not made.exists() and "Traceback" not in done.stderr, done.stderr
    return done.stderr


def nodes(element):
    """The cubics of a path in the coordinates of the group."""
    (subpath,) = inkex.CubicSuperPath(element.path)
    return [[a[1], a[2], b[0], b[1]] for a, b in zip(subpath, subpath[1:])]


def new_of(root):
    return [e for e in root.iter("{http://www.w3.org/2000/svg}path") if e.get("id") not in KNOWN]


def near(a, b, within=1e-3):
    return math.dist(a, b) < within


def along(a, b, c, d):
    """Whether a to b has the direction of c to d."""
    cross = (b[0] - a[0]) * (d[1] - c[1]) - (b[1] - a[1]) * (d[0] - c[0])
    dot = (b[0] - a[0]) * (d[0] - c[0]) + (b[1] - a[1]) * (d[1] - c[1])
    return dot > 0 and abs(math.atan2(cross, dot)) < 1e-3


def point(cubic, t):
    u = 1 - t
    w = (u**3, 3 * u * u * t, 3 * u * t * t, t**3)
    return tuple(sum(wi * p[i] for wi, p in zip(w, cubic)) for i in (0, 1))


def test_segment(work):
    (made,) = new_of(run("segment", work, "--id=bent", "--alpha=-1"))
    cubics = nodes(made)
    assert near(cubics[0][0], (20, 60)) and near(cubics[-1][3], (110, 100))
    assert along(cubics[0][0], cubics[0][1], (20, 60), (80, 60))
    assert along(cubics[-1][2], cubics[-1][3], (80, 60), (110, 100))


def test_places_far_away_keep_their_digits(work):
    """Six of them were written: joints of cubics 0.05 off at 20,000, their directions by as many radians."""
    (made,) = new_of(run("segment", work, "--id=far", "--tolerance=0.001"))
    cubics = nodes(made)
    assert near(cubics[0][0], (20000.1234, 60), 1e-6) and len(cubics) > 1
    for a, b in zip(cubics, cubics[1:]):
        cross = (a[3][0] - a[2][0]) * (b[1][1] - b[0][1]) - (a[3][1] - a[2][1]) * (b[1][0] - b[0][0])
        assert abs(cross) < 1e-6 * math.dist(a[2], a[3]) * math.dist(b[0], b[1])


def test_blend(work):
    (made,) = new_of(run("blend", work, "--id=first", "--id=second", "--order=G2"))
    cubics = nodes(made)
    assert near(cubics[0][0], (80, 20)) and near(cubics[-1][3], (120, 10))
    assert along(cubics[0][0], cubics[0][1], (50, 40), (80, 20))
    assert along(cubics[-1][2], cubics[-1][3], (120, 10), (140, 0))


def turns(cubics):
    """How often the direction changes the sense it turns in, along points of the cubics."""
    line = [point(c, i / 20) for c in cubics for i in range(20)] + [cubics[-1][3]]
    edges = [(b[0] - a[0], b[1] - a[1]) for a, b in zip(line, line[1:])]
    senses = [a[0] * b[1] - a[1] * b[0] for a, b in zip(edges, edges[1:])]
    return sum(a * b < 0 for a, b in zip(senses, senses[1:]))


def test_fair(work):
    """A parabola's arc whose nodes lie off it by 0.25, to either side: smooth, and as straight lines."""
    for name in ("wavy", "lines"):
        before = nodes(inkex.load_svg(DRAWING).getroot().getElementById(name))
        root = run("fair", work, f"--id={name}", "--tolerance=0.9")
        after = nodes(root.getElementById(name))
        assert new_of(root) == []
        fine = [point(c, i / 200) for c in after for i in range(201)]
        step = max(math.dist(p, q) for p, q in zip(fine, fine[1:]))
        worst = max(min(math.dist(c[0], q) for q in fine) for c in before)
        assert worst < 0.9 / SCALE + step, worst  # 0.9 of the drawing, in the group
        assert turns(before) > 15 and turns(after) == 0, (turns(before), turns(after))


def test_closed_paths_stay_closed(work):
    outline = run("fair", work, "--id=ring", "--tolerance=0.5").getElementById("ring").path
    assert outline[-1].letter == "Z" and len(outline) > 4
    for node in list(outline.end_points)[:-1]:
        assert abs(math.dist((node.x, node.y), (220, 40)) - 30) < 0.5 / SCALE


def test_comb(work):
    """Of a circle: all teeth as long as asked, pointing away from the centre."""
    teeth, tips = new_of(run("comb", work, "--id=quarter", "--height=0.2", "--teeth=20"))
    length = 0.2 * 50 * math.pi / 2
    numbers = [(c.x, c.y) for c in teeth.path]
    for foot, tip in zip(numbers[::2], numbers[1::2]):
        assert abs(math.dist(foot, tip) - length) < 0.05, (foot, tip)
        assert abs(math.dist(tip, (200, 150)) - 50 - length) < 0.1
    assert 20 <= len(numbers) // 2 <= 45 and len(tips.path) >= 20


def test_combs_stand_on_one_scale(work):
    """Of circles of radius 50 and 25: teeth of one length and of twice that, none of them dashed."""
    made = new_of(run("comb", work, "--id=quarter", "--id=half", "--height=0.1", "--teeth=20"))
    lengths = []
    for teeth in made[::2]:
        (x0, y0), (x1, y1) = [(c.x, c.y) for c in teeth.path][:2]
        lengths.append(math.dist((x0, y0), (x1, y1)))
    assert abs(lengths[1] / lengths[0] - 2) < 1e-3, lengths
    assert all(e.style["stroke-dasharray"] == "none" for e in made)


def test_straight_lines_have_no_comb(work):
    assert "straight" in refused("comb", work, "--id=bent")


def test_paths_of_a_group_stay_in_it(work):
    group = run("fair", work, "--id=both").getElementById("both")
    assert [e.get("id") for e in group] == ["left", "right"] and group.style["stroke-width"] == "3"


def test_an_ellipse_whose_arc_closes_within_rounding(work):
    """The four arcs end at 1e-14 beside the start: that is no edge."""
    made = run("fair", work, "--id=turned").getElementById("turned").path
    assert made[-1].letter == "Z" and len(made) > 4


def test_blend_leaves_the_last_part_of_a_path(work):
    (made,) = new_of(run("blend", work, "--id=parts", "--id=second"))
    assert near(nodes(made)[0][0], (80, 20))


def test_what_has_no_path_is_named(work):
    """A text faired was an empty path, an image its frame: now both stay as they are."""
    for name, words in (("words", "Object to Path"), ("clone", "Unlink"), ("dot", "without length"), ("flat", "flat")):
        told = refused("fair", work, f"--id={name}")
        assert name in told and words in told, told
    assert "Select a path" in refused("fair", work)
    assert "two paths: the selection holds 3" in refused("blend", work, "--id=bent", "--id=first", "--id=second")
    assert "ring is closed" in refused("blend", work, "--id=ring", "--id=second")
    assert "bent: " in refused("segment", work, "--id=bent", "--alpha=2000")


def test_failures_are_messages(work):
    drawing = work / "drawing.svg"
    drawing.write_text(DRAWING)
    command = [sys.executable, "-B", FOLDER / "keyline_segment.py", "--id=first", drawing]
    told = subprocess.run(command, env=ENVIRONMENT, capture_output=True, text=True).stderr
    assert "needs three nodes" in told and "Traceback" not in told, told
    without = ENVIRONMENT | {"PYTHONPATH": str(EXTENSIONS)}
    told = subprocess.run(command, env=without, capture_output=True, text=True).stderr
    assert "Traceback" not in told, told


def test_within_inkscape(work):
    """The menu's own way; Inkscape 1.2 knows actions of extensions only where it has a display."""
    if not os.environ.get("KEYLINE_FULL"):
        print("not tried within Inkscape: KEYLINE_FULL is not set")
        return
    if not shutil.which("inkscape") or not shutil.which("xvfb-run"):
        print("not tried within Inkscape: inkscape or xvfb-run is not installed")
        return
    profile = work / "profile"
    shutil.copytree(FOLDER, profile / "extensions" / "keyline")  # as the package has it
    (work / "drawing.svg").write_text(DRAWING)
    chosen = {"comb": ["quarter"], "segment": ["bent"], "blend": ["first", "second"], "fair": ["wavy"]}
    actions = ";".join(f"select-clear;select-by-id:{','.join(ids)};keyline.{n}.noprefs" for n, ids in chosen.items())
    actions += f";export-filename:{work / 'all.svg'};export-plain-svg:true;export-do"
    command = ["xvfb-run", "-a", "inkscape", "--with-gui", "--batch-process", f"--actions={actions}", work / "drawing.svg"]
    environment = os.environ | {"INKSCAPE_PROFILE_DIR": str(profile), "PYTHONPATH": str(PACKAGE)}
    subprocess.run(command, env=environment, capture_output=True, timeout=120, check=True)
    made = len(new_of(inkex.load_svg(str(work / "all.svg")).getroot()))
    assert made == 4, f"Inkscape holds {made} new paths"  # two of the comb, a segment, a blend


for name, test in [(n, t) for n, t in list(globals().items()) if n.startswith("test_")]:
    with tempfile.TemporaryDirectory() as folder:
        test(Path(folder))
    print("passed", name)
