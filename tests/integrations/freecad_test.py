"""The workbench of integrations/freecad in freecadcmd: every object made, changed, recomputed, saved and opened.

Run by an ordinary Python it starts freecadcmd with itself, and is skipped where that is not installed.
"""

import json
import math
import os
import shutil
import subprocess
import sys
import tempfile

SKIPPED = 77
if "FreeCAD" not in sys.modules:
    if not shutil.which("freecadcmd"):
        print("skipped: freecadcmd is not installed (Debian: freecad)")
        sys.exit(SKIPPED)
    with tempfile.TemporaryDirectory() as home:
        given = {"KEYLINE_WORKBENCH": os.path.abspath(sys.argv[1]), "HOME": home, "KEYLINE_WORK": home}
        given["PYTHONPATH"] = os.path.abspath(os.environ["PYTHONPATH"])
        command = ["freecadcmd", os.path.abspath(__file__)]
        done = subprocess.run(command, env=os.environ | given, capture_output=True, text=True, stdin=subprocess.DEVNULL)
    print(done.stdout[-6000:], done.stderr[-3000:])
    sys.exit(0 if "every test passed" in done.stdout else 1)

sys.path.insert(0, os.path.join(os.environ["KEYLINE_WORKBENCH"], "Keyline"))
import FreeCAD  # noqa: E402
import Part  # noqa: E402

import keyline_objects  # noqa: E402

ROOT = os.path.dirname(os.path.dirname(os.environ["KEYLINE_WORKBENCH"]))
TILTED = FreeCAD.Placement(FreeCAD.Vector(5, -3, 7), FreeCAD.Rotation(FreeCAD.Vector(1, 2, 3), 40))


def V(*xyz):
    return FreeCAD.Vector(*xyz)


def sketch(document, points):
    """A sketch in a tilted plane with lines through the points."""
    made = document.addObject("Sketcher::SketchObject", "Sketch")
    made.Placement = TILTED
    for (ax, ay), (bx, by) in zip(points, points[1:]):
        made.addGeometry(Part.LineSegment(V(ax, ay, 0), V(bx, by, 0)))
    document.recompute()
    return made


def shape(document, part):
    made = document.addObject("Part::Feature", "Given")
    made.Shape = part
    document.recompute()
    return made


def kind(document, name, *sources, **values):
    made = keyline_objects.make(name, *sources, document=document)
    for key, value in values.items():
        setattr(made, key, value)
    document.recompute()
    assert "Invalid" not in made.State, f"{name}: {made.State}"
    return made


def local(point):
    p = TILTED.inverse().multVec(point)
    assert abs(p.z) < 1e-6
    return p


def curvature_at(edge, share):
    """With its rate per length, by derivatives of FreeCAD's own."""
    t = edge.FirstParameter + share * (edge.LastParameter - edge.FirstParameter)
    d1, d2, d3 = (edge.Curve.getDN(t, n) for n in (1, 2, 3))
    cross = d1.cross(d2)
    k = cross.Length / d1.Length**3
    rate = (cross.dot(d1.cross(d3)) / cross.Length / d1.Length**3 - 3 * k * d1.dot(d2) / d1.Length**2) if k else 0
    return k, rate / d1.Length


def test_curve_from_sketch(document):
    given = sketch(document, [(0, 0), (20, 0), (30, 15)])
    made = kind(document, "Curve", given)
    first, last = made.Shape.OrderedEdges[0], made.Shape.OrderedEdges[-1]
    assert local(first.valueAt(first.FirstParameter)).Length < 1e-6
    assert (local(last.valueAt(last.LastParameter)) - V(30, 15, 0)).Length < 1e-6
    along = TILTED.Rotation.multVec(V(1, 0, 0))
    assert first.tangentAt(first.FirstParameter).getAngle(along) < 1e-6
    clothoid = made.Shape.Length
    made.Slope = 2.0
    document.recompute()
    assert abs(made.Shape.Length - clothoid) > 1e-3
    given.movePoint(1, 2, V(40, 15, 0), False)
    document.recompute()
    end = made.Shape.OrderedEdges[-1]
    assert (local(end.valueAt(end.LastParameter)) - V(40, 15, 0)).Length < 1e-6


def test_spline_from_sketch(document):
    points = [(0, 0), (10, 9), (24, 12), (40, 7)]
    made = kind(document, "Curve", sketch(document, points))
    for x, y in points:
        assert made.Shape.distToShape(Part.Vertex(TILTED.multVec(V(x, y, 0))))[0] < 2e-3


def test_fair(document):
    """An arc of radius 100 whose points lie 0.05 to either side."""
    radius = [100 + 0.05 * (-1) ** i for i in range(40)]
    points = [(r * math.cos(i / 30), r * math.sin(i / 30)) for i, r in enumerate(radius)]
    given = shape(document, Part.makePolygon([TILTED.multVec(V(x, y, 0)) for x, y in points]))
    made = kind(document, "Fair", given, Tolerance=0.2)
    assert made.WithinTolerance and made.Waves == 0
    for x, y in points:
        assert made.Shape.distToShape(Part.Vertex(TILTED.multVec(V(x, y, 0))))[0] < 0.2 + 1e-3
    middles = [curvature_at(edge, 0.5)[0] for edge in made.Shape.Edges]
    assert all(abs(k - 0.01) < 0.001 for k in middles), middles
    given.Shape = given.Shape.copy().translate(V(0, 0, 30))
    document.recompute()
    assert made.Shape.distToShape(given.Shape)[0] < 0.2


def test_blend(document):
    """From an arc of radius 10 into a line: direction, curvature and its rate as their order says."""
    arc = shape(document, Part.makeCircle(10, V(0, 0, 0), V(0, 0, 1), -90, 0))
    line = shape(document, Part.makeLine(V(2, 25, 0), V(-10, 35, 0)))
    for order, curved, rated in (("G1", False, False), ("G2", True, False), ("G3", True, True)):
        made = kind(document, "Blend", arc, line, Order=order, FitTolerance=1e-6)
        first, last = made.Shape.OrderedEdges[0], made.Shape.OrderedEdges[-1]
        assert (first.valueAt(first.FirstParameter) - V(10, 0, 0)).Length < 1e-6
        assert first.tangentAt(first.FirstParameter).getAngle(V(0, 1, 0)) < 1e-5
        assert (last.valueAt(last.LastParameter) - V(2, 25, 0)).Length < 1e-6
        k, rate = curvature_at(first, 0)
        assert not curved or abs(k - 0.1) < 2e-3, (order, k)
        assert not rated or abs(rate) < 2e-3, (order, rate)


def test_comb(document):
    """Of an arc of radius 50: every tooth is scale / 50, away from the centre."""
    arc = shape(document, Part.makeCircle(50, V(0, 0, 0), V(0, 0, 1), 0, 90))
    made = kind(document, "Comb", arc, Scale=500.0, Teeth=20)
    assert abs(made.LargestCurvature - 0.02) < 1e-6
    teeth = [e for e in made.Shape.Edges if abs(e.Length - 10) < 1e-3]
    assert len(teeth) >= 20
    for tooth in teeth:
        assert sorted(round(v.Point.Length, 3) for v in tooth.Vertexes) == [50, 60]


def test_zebra(document):
    """Of half a cylinder seen across its axis: stripes along the axis, on the face, dark as often as light."""
    rim = Part.BSplineCurve()
    rim.interpolate([V(20 * math.cos(a), 0, 20 * math.sin(a)) for a in [math.pi * i / 24 for i in range(25)]])
    face = shape(document, rim.toShape().extrude(V(0, 60, 0)))
    made = kind(document, "Zebra", face, Stripes=6.0, View=V(0, 0, 1), Grid=61)
    share = made.Mesh.Area / face.Shape.Area / 2  # on either side
    assert 0.35 < share < 0.65, share
    for point in made.Mesh.Points[::97]:
        assert face.Shape.distToShape(Part.Vertex(point.Vector))[0] < 0.2
    before = made.Mesh.CountFacets
    made.Stripes = 12.0
    document.recompute()
    assert made.Mesh.CountFacets != before


def test_value(document):
    """Of a cubic made by a matrix: rotation and scale are those it was made by ([Oya] 3.1)."""
    angle, scale = math.pi / 4, 1.05
    edge, poles = V(1, 2, 0), [V(0, 0, 0)]
    for _ in range(3):
        poles.append(poles[-1] + edge)
        edge = FreeCAD.Rotation(V(0, 0, 1), math.degrees(angle)).multVec(edge) * scale
    bezier = Part.BezierCurve()
    bezier.setPoles(poles)
    made = kind(document, "Value", shape(document, bezier.toShape()))
    assert made.Type == 3 and abs(abs(made.Alpha) - angle) < 1e-9 and abs(made.Scale - scale) < 1e-9
    assert made.AestheticValue > 0


def test_value_of_a_face(document):
    """A patch whose eight curves are all of type 5: 407 by the paper ([Oya] Eq. 10)."""
    with open(os.path.join(ROOT, "examples", "panel-c.json")) as file:
        (net,) = [value for value in walk(json.load(file)) if value.get("type") == "bezier-surface"]
    surface = Part.BezierSurface()
    for u, row in enumerate(net["points"]):
        for v, point in enumerate(row):
            if u == v == 0:
                surface.increase(len(net["points"]) - 1, len(row) - 1)
            surface.setPole(u + 1, v + 1, V(*point))
    made = kind(document, "Value", shape(document, surface.toShape()))
    assert abs(made.AestheticValue - 407) < 1, made.AestheticValue


def walk(value):
    if isinstance(value, dict):
        yield value
        value = list(value.values())
    if isinstance(value, list):
        for item in value:
            yield from walk(item)


def test_closed_wires_stay_closed(document):
    """A slot of two lines and two half circles: without a gap or a corner where it began."""
    ends = [Part.makeLine(V(0, 0, 0), V(20, 0, 0)), Part.makeLine(V(20, 10, 0), V(0, 10, 0))]
    turns = [Part.makeCircle(5, V(20, 5, 0), V(0, 0, 1), -90, 90), Part.makeCircle(5, V(0, 5, 0), V(0, 0, 1), 90, 270)]
    made = kind(document, "Fair", shape(document, Part.Wire([ends[0], turns[0], ends[1], turns[1]])))
    assert made.Shape.isClosed()
    first, last = made.Shape.OrderedEdges[0], made.Shape.OrderedEdges[-1]
    assert first.tangentAt(first.FirstParameter).getAngle(last.tangentAt(last.LastParameter)) < 1e-3


def test_in_a_part_that_lies_elsewhere(document):
    """The sketch's own place is within the part: the curve lies where the part shows it, or with it in the part."""
    part = document.addObject("App::Part", "Part")
    part.Placement = FreeCAD.Placement(V(100, 0, 0), FreeCAD.Rotation(V(1, 0, 0), 90))
    given = sketch(document, [(0, 0), (20, 0), (30, 15)])
    part.addObject(given)
    start = TILTED.multVec(V(0, 0, 0))
    made = kind(document, "Curve", given)
    assert made.Shape.distToShape(Part.Vertex(part.Placement.multVec(start)))[0] < 1e-6
    part.addObject(made)
    made.touch()
    document.recompute()
    assert made.Shape.distToShape(Part.Vertex(start))[0] < 1e-6


def test_a_link_counts_where_it_lies(document):
    link = document.addObject("App::Link", "Link")
    link.LinkedObject = shape(document, Part.makeCircle(10, V(0, 0, 0), V(0, 0, 1), 0, 90))
    link.Placement = FreeCAD.Placement(V(50, 0, 0), FreeCAD.Rotation())
    document.recompute()
    made = kind(document, "Comb", link, Scale=50.0)
    assert abs(made.Shape.BoundBox.XMax - 65) < 1e-3 and made.Shape.BoundBox.XMin > 49.9


def test_points(document):
    """Of a parabola in a tilted plane, as a point cloud."""
    import Points

    cloud, places = document.addObject("Points::Feature", "Cloud"), Points.Points()
    places.addPoints([TILTED.multVec(V(x, 0.01 * x * x, 0)) for x in range(31)])
    cloud.Points = places
    made = kind(document, "Fair", cloud, Tolerance=0.05)
    assert made.Report and abs(made.Shape.Length - 31.71) < 0.1  # 15 sqrt(1.36) + 25 asinh(0.6)
    for x in (0, 15, 30):
        assert made.Shape.distToShape(Part.Vertex(TILTED.multVec(V(x, 0.01 * x * x, 0))))[0] < 0.06


def test_the_selected_face_and_edge(document):
    box = shape(document, Part.makeBox(10, 20, 30))
    names = [f"Face{i + 1}" for i, face in enumerate(box.Shape.Faces) if abs(face.CenterOfMass.z - 30) < 1e-9]
    made = kind(document, "Zebra", (box, names), Grid=11)
    assert made.Mesh.CountFacets and all(abs(point.z - 30) < 0.1 for point in made.Mesh.Points)
    rounded = shape(document, Part.makeCylinder(10, 20))
    arcs = [f"Edge{i + 1}" for i, edge in enumerate(rounded.Shape.Edges) if isinstance(edge.Curve, Part.Circle)]
    assert abs(kind(document, "Comb", (rounded, arcs[:1])).LargestCurvature - 0.1) < 1e-6


def test_zebra_ends_where_the_face_is_trimmed(document):
    disk = shape(document, Part.Face(Part.Wire(Part.makeCircle(10))))
    made = kind(document, "Zebra", disk, Grid=41)
    assert made.Mesh.CountFacets and all(math.hypot(point.x, point.y) < 10.01 for point in made.Mesh.Points)


def test_zebra_of_rational_faces(document):
    """Stripes of a sphere, a cylinder, a cone and a torus lie on them, dark as often as light."""
    for part in (Part.makeSphere(10), Part.makeCylinder(10, 20), Part.makeCone(10, 4, 20), Part.makeTorus(20, 5)):
        given = shape(document, part)
        largest = max(range(len(part.Faces)), key=lambda i: part.Faces[i].Area)
        face = part.Faces[largest]
        made = kind(document, "Zebra", (given, [f"Face{largest + 1}"]), Stripes=6.0, View=V(1, 0, 0), Grid=101)
        share = made.Mesh.Area / face.Area / 2
        assert 0.4 < share < 0.6, share
        for point in made.Mesh.Points[::97]:
            assert face.distToShape(Part.Vertex(point.Vector))[0] < 0.002 * face.BoundBox.DiagonalLength


def test_saved_and_opened(document):
    given = sketch(document, [(0, 0), (20, 0), (30, 15)])
    kind(document, "Curve", given)
    path = os.path.join(os.environ["KEYLINE_WORK"], "saved.FCStd")
    document.saveAs(path)
    FreeCAD.closeDocument(document.Name)
    again = FreeCAD.openDocument(path)
    made = again.getObject("Curve")
    length = made.Shape.Length
    made.Slope = 1.5
    again.recompute()
    assert abs(made.Shape.Length - length) > 1e-4 and "Invalid" not in made.State
    FreeCAD.closeDocument(again.Name)


def test_what_cannot_be_is_said(document):
    """In words a designer knows: not those of Python's lists."""
    apart = Part.Compound([Part.makeLine(V(0, 0, 0), V(9, 0, 0)), Part.makeLine(V(0, 9, 0), V(9, 9, 0))])
    box = shape(document, Part.makeBox(1, 2, 3))
    circle = shape(document, Part.Wire(Part.makeCircle(10)))
    for name, sources, words in (
        ("Curve", [sketch(document, [(0, 0), (20, 0)])], "two straight lines"),
        ("Fair", [], "no source"),
        ("Fair", [shape(document, apart)], "2 wires"),
        ("Value", [shape(document, Part.makePolygon([V(0, 0, 0), V(9, 0, 0), V(9, 9, 0)]))], "2 edges"),
        ("Zebra", [box], "6 faces"),
        ("Blend", [circle, circle], "closed wire"),
    ):
        made = keyline_objects.make(name, *sources, document=document)
        document.recompute()
        assert "Invalid" in made.State and words in made.getStatusString(), (name, made.getStatusString())


failed = []
for name, test in [(n, t) for n, t in list(globals().items()) if n.startswith("test_")]:
    opened = FreeCAD.newDocument()
    opened_name = opened.Name
    try:
        test(opened)
        print("passed", name, flush=True)
    except Exception as error:  # noqa: BLE001 told below; freecadcmd itself would go on
        import traceback

        traceback.print_exc(file=sys.stdout)
        failed.append(name)
    if opened_name in FreeCAD.listDocuments():
        FreeCAD.closeDocument(opened_name)
print("failed: " + ", ".join(failed) if failed else "every test passed", flush=True)
os._exit(1 if failed else 0)
