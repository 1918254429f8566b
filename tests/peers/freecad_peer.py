"""What FreeCAD reads, without its window. Run inside freecadcmd this file samples what it is told to;
imported, it starts freecadcmd."""

import json
import os
import shutil
import subprocess
import tempfile
from pathlib import Path

NAME, READS, PLACED = "FreeCAD", ("step", "iges", "dxf", "svg"), True
ROUNDING = {}
COUNT = 1000


def version():
    if not shutil.which("freecadcmd"):
        return None
    text = subprocess.run(["dpkg-query", "-W", "-f", "${Version}", "freecad-python3"],
                          capture_output=True, text=True).stdout
    return text.split("+")[0]


def inside(task, file):
    """What a task of this file, run inside FreeCAD, says of the file."""
    with tempfile.TemporaryDirectory() as folder:
        out = Path(folder) / "answer.json"
        environment = dict(os.environ, KEYLINE_TASK=task, KEYLINE_IN=str(file), KEYLINE_OUT=str(out))
        subprocess.run(["freecadcmd", __file__], env=environment, stdin=subprocess.DEVNULL,
                       capture_output=True, timeout=600)
        return json.loads(out.read_text())


def counts(file):
    """Number of curves and of faces; edges of faces are no curves of their own."""
    return tuple(inside("count", file))


def extent(file):
    """Number of things (wires, and edges of none), of closed ones, and the size of all of them."""
    return inside("extent", file)


def read(file):
    import numpy as np
    from plain_svg import Curve

    rows = inside("sample", file)
    return [Curve(np.array(r["points"])[:, :2], r["name"], "", "", r["kind"]) for r in rows]


def shapes(file):
    """(name, shape) of everything in the file."""
    import FreeCAD
    import Part

    if file.endswith((".step", ".stp", ".p21", ".iges", ".igs")):
        shape = Part.Shape()
        shape.read(file)
        return [("", shape)]
    if file.endswith(".dxf"):
        import Import

        FreeCAD.newDocument("sheet")
        Import.readDXF(file)
    else:
        import importSVG

        importSVG.open(file)
    objects = FreeCAD.ActiveDocument.Objects
    return [(o.Label, o.Shape) for o in objects if hasattr(o, "Shape")]


def sample():
    rows = []
    for name, shape in shapes(os.environ["KEYLINE_IN"]):
        for edge in shape.Edges:
            a, b = edge.ParameterRange
            points = [edge.valueAt(a + (b - a) * i / (COUNT - 1)) for i in range(COUNT)]
            kind = type(edge.Curve).__name__
            rows.append({"name": name, "kind": kind, "points": [[p.x, p.y, p.z] for p in points]})
    return rows


def count():
    try:
        found = [shape for _, shape in shapes(os.environ["KEYLINE_IN"])]
    except Exception:  # Part.OCCError and others: it cannot be read
        return [0, 0]
    faces = sum(len(shape.Faces) for shape in found)
    bound = sum(len({e.hashCode() for f in shape.Faces for e in f.Edges}) for shape in found)
    return [sum(len(shape.Edges) for shape in found) - bound, faces]


def extent_inside():
    things, box = [], None
    for _, shape in shapes(os.environ["KEYLINE_IN"]):
        chained = {e.hashCode() for w in shape.Wires for e in w.Edges}
        things += shape.Wires + [e for e in shape.Edges if e.hashCode() not in chained]
        own = shape.BoundBox
        corners = [own.XMin, own.YMin, own.XMax, own.YMax]
        box = corners if box is None else [*map(min, box[:2], corners[:2]),
                                           *map(max, box[2:], corners[2:])]
    return [len(things), sum(t.isClosed() for t in things), box[2] - box[0], box[3] - box[1]]


if "KEYLINE_OUT" in os.environ:
    answer = {"sample": sample, "count": count, "extent": extent_inside}[os.environ["KEYLINE_TASK"]]()
    with open(os.environ["KEYLINE_OUT"], "w") as out_file:
        json.dump(answer, out_file)
