#!/usr/bin/env python3
"""counts.py KEYLINE [FILE…]: do others find as many curves, surfaces and contours in a file?

Reads every SVG, DXF, STEP, IGES, font and mesh file of ../shared/data (or those named) with
`KEYLINE convert` and with an independent reader, and prints a row of a Markdown table for each: what
Keyline reads, what the other reads, and which it is. SVG is counted by Inkscape, STEP and IGES by
OCCT's DRAW and FreeCAD, fonts (every glyph) by fontTools; what a DXF or a mesh holds is counted in
its text here, by a few lines that share nothing with Keyline. Exit status 1 where numbers differ.
"""

import json
import re
import struct
import subprocess
import sys
import tempfile
import xml.etree.ElementTree as ElementTree
from collections import Counter
from pathlib import Path

import draw_peer
import freecad_peer
import inkscape_peer
import plain_svg

DATA = Path(__file__).resolve().parents[3] / "shared/data"
# Where numbers differ for a reason: file and reader.
REASONS = {
    ("circle_radius_le_0.dxf", "its text"): "circles of radius 0 and -1",
    ("recover01.dxf", "its text"): "18 lines without extent are skipped",
    ("crash-30d6d0f7c529b3b66b4131700b7a4580cd7082df.ply", "its text"): "its header is broken: refused",
    ("elements-via-ENTITY-reference-3.svg", "Inkscape"): "Inkscape expands no entities",
    ("invalid-data-in-L.svg", "Inkscape"): "SVG asks to draw a path up to its mistake",
    ("missing-coordinate-in-L.svg", "Inkscape"): "SVG asks to draw a path up to its mistake",
    ("not-UTF-8-encoding.svg", "Inkscape"): "14 are outlines of a text",
    ("zeroed-matrix.svg", "Inkscape"): "a shape scaled to nothing is not drawn",
}
LINK = "{http://www.w3.org/1999/xlink}href"
DEFINITIONS = ("defs", "clipPath", "mask", "symbol", "pattern", "marker")


def keyline(program, file, *options):
    """The document Keyline reads; the line that says why where it reads none."""
    run = subprocess.run([program, "convert", file, "--json", "--quiet", *options],
                         capture_output=True, text=True, stdin=subprocess.DEVNULL)
    return json.loads(run.stdout) if run.returncode == 0 else run.stderr.strip()


def counted(document):
    """Number of curves and of surfaces."""
    if isinstance(document, str):
        return 0, 0
    if "type" in document:
        return (0, 1) if document["type"].endswith("surface") else (1, 0)
    return len(document.get("curves", [])), len(document.get("surfaces", []))


def shown(curves, surfaces):
    parts = [f"{n} {what}{'' if n == 1 else 's'}"
             for n, what in ((curves, "curve"), (surfaces, "surface")) if n]
    return ", ".join(parts) or "nothing"


def svg_runs(root):
    """Runs with extent of everything drawn, of an SVG as Inkscape saves it, `use` followed."""
    named = {e.get("id"): e for e in root.iter()}

    def count(element, open_elements, shown_by_use=False):
        tag = element.tag.split("}")[-1] if isinstance(element.tag, str) else "defs"
        if element in open_elements or tag in DEFINITIONS and not shown_by_use:
            return 0
        if tag == "path":
            return len(plain_svg.subpaths(element.get("d") or ""))
        inner = [*open_elements, element]
        if tag == "use":
            target = named.get((element.get("href") or element.get(LINK) or "")[1:])
            return 0 if target is None else count(target, inner, True)
        return sum(count(child, inner) for child in element)

    return count(root, [])


def inkscape(file):
    with tempfile.TemporaryDirectory() as folder:
        out = Path(folder) / "out.svg"
        # Moved there and back, every path is written by Inkscape's own geometry.
        move = "transform-translate:100,0;transform-translate:-100,0"
        actions = f"select-all:all;object-to-path;{move};export-filename:{out};export-do"
        subprocess.run(["inkscape", file, f"--actions={actions}"], capture_output=True, timeout=300)
        if not out.exists():
            return 0, 0
        return svg_runs(ElementTree.fromstring(out.read_text())), 0


DRAW_SCRIPT = """
pload MODELING XDE DATAEXCHANGE
catch {{{read}}} message
foreach s [directory a*] {{
  if {{![string match "* is a shape *" [whatis $s]]}} {{ continue }}
  puts "SHAPE [whatis $s] [nbshapes $s]"
}}
exit
"""


def draw(file):
    """Faces, and edges where there is no face: the files hold either."""
    read = "igesbrep {} a *" if file.suffix == ".iges" else "stepread {} a *"
    text = draw_peer.run(DRAW_SCRIPT.format(read=read.format(file)))
    faces = sum(int(n) for n in re.findall(r"FACE +: (\d+)", text))
    edges = sum(int(n) for n in re.findall(r"EDGE +: (\d+)", text))
    return (0, faces) if faces else (edges, 0)


def freecad(file):
    return freecad_peer.counts(file)


def dxf_groups(file):
    lines = file.read_bytes().decode("latin-1").splitlines()
    return list(zip((code.strip() for code in lines[::2]), lines[1::2]))


CURVES_OF_DXF = ("LINE", "ARC", "CIRCLE", "ELLIPSE", "LWPOLYLINE", "POLYLINE", "SPLINE")


def dxf(file):
    """Curves in the section ENTITIES, blocks put in for their inserts."""
    section, owner, blocks, groups = "", "ENTITIES", {"ENTITIES": []}, dxf_groups(file)
    for i, (code, text) in enumerate(groups):
        if (code, text) == ("0", "EOF"):
            break
        if code != "0":
            continue
        name = next((t for c, t in groups[i + 1 : i + 30] if c == "2"), "")
        if text == "SECTION":
            section, owner = name, "ENTITIES"
        elif text == "BLOCK":
            owner = name
            blocks[owner] = []
        elif section in ("ENTITIES", "BLOCKS"):
            blocks[owner].append((text, name))

    def total(block):
        parts = blocks.get(block, [])
        own = Counter(kind for kind, _ in parts if kind in CURVES_OF_DXF)
        return sum((total(name) for kind, name in parts if kind == "INSERT"), own)

    return sum(total("ENTITIES").values()), 0


def fonttools(file):
    """Contours of every glyph, by name."""
    from fontTools.pens.recordingPen import DecomposingRecordingPen
    from fontTools.ttLib import TTFont

    glyphs = TTFont(file).getGlyphSet()
    contours = {}
    for name in glyphs.keys():
        pen = DecomposingRecordingPen(glyphs)
        glyphs[name].draw(pen)
        runs = re.split("closePath|endPath", " ".join(verb for verb, _ in pen.value))
        contours[name] = sum("To " in run.strip().removeprefix("moveTo") + " " for run in runs)
    return contours


def font_row(program, file):
    theirs, wrong, ours = fonttools(file), [], 0
    for name, count in theirs.items():
        found = counted(keyline(program, file, "--glyphs", "/" + name))[0]
        ours += found
        if found != count:
            wrong.append(f"{name}: {found} for {count}")
    whole = f"{len(theirs)} glyphs, {ours} contours"
    return whole, f"{len(theirs)} glyphs, {sum(theirs.values())} contours", wrong


def obj_counts(text):
    vertices, triangles = 0, 0
    for line in re.sub(r"\\\r?\n", " ", text).splitlines():
        words = line.split()
        if words[:1] == ["v"]:
            vertices += 1
        if words[:1] == ["f"] and len(words) > 3:
            numbers = [int(re.match(r"-?\d+", w).group()) for w in words[1:]]
            if all(0 < abs(n) <= vertices for n in numbers):
                triangles += len(words) - 3
    return vertices, triangles


def stl_counts(data):
    count = struct.unpack_from("<I", data, 80)[0] if len(data) >= 84 else 0
    if len(data) == 84 + 50 * count and count:
        facets = [struct.unpack_from("<9f", data, 84 + 50 * i + 12) for i in range(count)]
        corners = {f[k : k + 3] for f in facets for k in (0, 3, 6)}
        return len(corners), count
    rows = re.findall(rb"vertex\s+(\S+)\s+(\S+)\s+(\S+)", data)
    return len({tuple(map(float, row)) for row in rows}), len(rows) // 3


def ply_counts(data):
    """Of the header: the triangles of a quadrangle are two, of a file with faces of one size."""
    header = data.split(b"end_header")[0].decode("latin-1")
    stated = dict(re.findall(r"element (\w+) (\d+)", header))
    return int(stated.get("vertex", 0)), int(stated.get("face", 0))


def mesh(file):
    data = file.read_bytes()
    if file.suffix == ".obj":
        wide = data[:2] in (b"\xff\xfe", b"\xfe\xff")
        return obj_counts(data.decode("utf-16" if wide else "latin-1"))
    return stl_counts(data) if file.suffix == ".stl" else ply_counts(data)


def mesh_row(program, file):
    said = keyline(program, file)
    found = re.search(r"of (\d+) points and (\d+) triangles", str(said))
    ours = tuple(map(int, found.groups())) if found else said
    theirs = mesh(file)
    text = "{} vertices, {} triangles"
    return (text.format(*ours) if found else "nothing", text.format(*theirs),
            [] if ours == theirs else ["differs"])


def curve_row(program, file, reader):
    ours, theirs = counted(keyline(program, file)), reader(file)
    return shown(*ours), shown(*theirs), [] if ours == theirs else ["differs"]


# Suffix: readers, each with the name to print.
READERS = {".svg": [("Inkscape", inkscape)], ".dxf": [("its text", dxf)],
           ".step": [("DRAW", draw), ("FreeCAD", freecad)]}
for suffix in (".stp", ".p21", ".iges", ".igs"):
    READERS[suffix] = READERS[".step"]


def rows(program, file):
    suffix = file.suffix.lower()
    if suffix in (".ttf", ".otf"):
        yield "fontTools", font_row(program, file)
    elif suffix in (".obj", ".stl", ".ply"):
        yield "its text", mesh_row(program, file)
    for name, reader in READERS.get(suffix, []):
        yield name, curve_row(program, file, reader)


def main():
    program, files = sys.argv[1], [Path(f).resolve() for f in sys.argv[2:]]
    if not files:
        files = sorted(p for p in DATA.rglob("*") if p.is_file() and
                       p.suffix.lower() in {*READERS, ".ttf", ".otf", ".obj", ".stl", ".ply"})
    status = 0
    print("| file | Keyline | another reader | which | why they differ |\n|---|---|---|---|---|")
    for file in files:
        for which, (ours, theirs, wrong) in rows(program, file):
            reason = REASONS.get((file.name, which)) if wrong else ""
            status |= bool(wrong) and reason is None
            why = "; ".join(wrong[:5]) if reason is None else reason
            print(f"| `{file.name}` | {ours} | {theirs} | {which} | {why} |", flush=True)
    return status


if __name__ == "__main__":
    sys.exit(main())
