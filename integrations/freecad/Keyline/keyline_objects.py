"""Objects of a document that Keyline computes, each anew when what it is made from changes."""

import math

import FreeCAD
import Mesh
import Part

import keyline_shapes as ks

Vector = FreeCAD.Vector


class Computed:
    """What all have in common: properties made from a table, nothing kept but in the document."""

    properties = ()  # (type, name, what it says, value)

    def __init__(self, made):
        made.Proxy = self
        self.complete(made)

    def onDocumentRestored(self, made):
        self.complete(made)

    def complete(self, made):
        for kind, name, text, value in self.properties:
            if name not in made.PropertiesList:
                made.addProperty(kind, name, "Keyline", text)
                if value is not None:
                    setattr(made, name, value)

    def dumps(self):
        return None

    def loads(self, state):
        return None

    __getstate__, __setstate__ = dumps, loads


SOURCE = ("App::PropertyLinkSub", "Source", "what it is made from", None)
SLOPE = ("App::PropertyFloat", "Slope", "of the logarithmic curvature graph: -1 clothoid, 1 logarithmic spiral", -1.0)
FIT = ("App::PropertyLength", "FitTolerance", "how far the B-spline may lie off the exact curve", 0.001)
DEVIATION = ("App::PropertyLength", "Deviation", "how far it lies off at most", 0.0)


def nurbs(made):
    return {"tolerance": made.FitTolerance.Value}


class Curve(Computed):
    """Through the points of a sketch's lines: of three the handles of a segment, of more a spline."""

    properties = (SOURCE, SLOPE, FIT)

    def execute(self, made):
        given = ks.Given(made.Source, made)
        plane = ks.plane_of(given)
        points = ks.points_of(given, plane)
        if points is None or len(points) < 3:
            raise ValueError("the sketch needs two straight lines or more, end to end")
        closed = ks.closes(points[0], points[-1]) and len(points) > 3
        request = {"points": points[:-1] if closed else points, "alpha": made.Slope, "nurbs": nurbs(made)}
        if len(points) > 3:
            request["closed"] = closed
        answer = ks.perform("lac.spline" if len(points) > 3 else "lac.segment", request)
        made.Shape = ks.wire_of(answer["nurbs"], plane)


class Fair(Computed):
    """The calmest curve within the tolerance of a wire; the corners of a polyline are measured points."""

    properties = (
        SOURCE,
        ("App::PropertyLength", "Tolerance", "largest distance; 0: by the points, or 0.01 % of the length", 0.0),
        ("App::PropertyBool", "KeepCorners", "corners stay", True),
        FIT,
        DEVIATION,
        ("App::PropertyInteger", "Waves", "of curvature", 0),
        ("App::PropertyBool", "WithinTolerance", "whether it is met", False),
        ("App::PropertyStringList", "Report", "what was dropped, merged or guessed", []),
    )

    def execute(self, made):
        given = ks.Given(made.Source, made)
        plane = ks.plane_of(given)
        points = ks.points_of(given, plane)
        request = {"keep_corners": made.KeepCorners, "nurbs": nurbs(made)}
        request |= {"points": points} if points else {"curve": ks.curve_of(given, plane)}
        if points and given.points is None:
            request["closed"] = ks.closes(points[0], points[-1])
        if made.Tolerance.Value > 0:
            request["tolerance"] = made.Tolerance.Value
        answer = ks.perform("fair", request)
        made.Shape = ks.wire_of(answer["nurbs"], plane)
        made.Deviation = answer["deviation"]["max"]
        made.Waves = answer["fairness"]["answer"]["waves"]
        made.WithinTolerance = answer["within_tolerance"]
        made.Report = answer["report"]


class Blend(Computed):
    """From the end of one wire to the start of another."""

    properties = (
        ("App::PropertyLinkSub", "First", "the wire to leave at its end", None),
        ("App::PropertyLinkSub", "Second", "the wire to join at its start", None),
        ("App::PropertyEnumeration", "Order", "direction, curvature, its rate", ["G1", "G2", "G3"]),
        SLOPE,
        FIT,
    )

    def execute(self, made):
        both = [ks.Given(link, made) for link in (made.First, made.Second)]
        plane = ks.plane_of(*both)
        curves = [ks.curve_of(given, plane) for given in both]
        if any(curve["closed"] for curve in curves):
            raise ValueError("a closed wire has no end to join")
        request = {"curves": curves, "order": made.Order, "alpha": made.Slope, "nurbs": nurbs(made)}
        made.Shape = ks.wire_of(ks.perform("lac.blend", request)["nurbs"], plane)


class Comb(Computed):
    """Lines across a wire, as long as curvature is large; and the line along their tips."""

    properties = (
        SOURCE,
        ("App::PropertyFloat", "Scale", "length of a tooth per curvature; 0: the longest is a fifth of the wire", 0.0),
        ("App::PropertyInteger", "Teeth", "how many", 120),
        ("App::PropertyFloat", "LargestCurvature", "along the wire", 0.0),
    )

    def execute(self, made):
        given = ks.Given(made.Source, made)
        plane = ks.plane_of(given)
        request = {"curve": ks.curve_of(given, plane), "comb": {"samples": max(2, made.Teeth)}}
        comb = ks.perform("curve.show", request)["comb"]
        made.LargestCurvature = max(abs(k) for k in comb["curvature"])
        if made.LargestCurvature * comb["arc_length"][-1] < 1e-9:
            raise ValueError("the wire is straight: its comb is flat")
        scale = made.Scale or 0.2 * comb["arc_length"][-1] / made.LargestCurvature
        feet, tips = [], []
        for point, normal, k in zip(comb["points"], comb["normals"], comb["curvature"]):
            feet.append(plane.multVec(Vector(*point, 0)))
            tips.append(plane.multVec(Vector(point[0] - scale * k * normal[0], point[1] - scale * k * normal[1], 0)))
        teeth = [Part.makeLine(a, b) for a, b in zip(feet, tips) if (a - b).Length > 1e-7]
        made.Shape = Part.Compound(teeth + [Part.makePolygon(tips)])


class Zebra(Computed):
    """The dark stripes of light on a face, as a mesh on either side of it."""

    properties = (
        SOURCE,
        ("App::PropertyVector", "View", "direction to the eye; 0: the face's mean normal", Vector(0, 0, 0)),
        ("App::PropertyFloat", "Stripes", "dark and light pairs on a sphere", 12.0),
        ("App::PropertyInteger", "Grid", "points along each side", 101),
    )

    def execute(self, made):
        face = ks.face_of(ks.Given(made.Source, made))
        request = {
            "surface": ks.surface_of(face),
            "kind": "zebra",
            "grid": made.Grid,
            "stripe_count": made.Stripes,
            "points": True,
            "normals": True,
        }
        if made.View.Length > 0:
            request["view"] = list(made.View)
        field = ks.perform("surface.interrogate", request)
        leave_trimmed_away(field["values"], face)
        lift = 0.001 * face.BoundBox.DiagonalLength  # else the face would cover its chords
        sides = [[t for cell in cells_of(field, side) for t in dark_part(cell)] for side in (lift, -lift)]
        made.Mesh = Mesh.Mesh(sides[0] + [t[::-1] for t in sides[1]])  # seen from their own side


def leave_trimmed_away(values, face):
    """No values at points of the surface that the face does not reach."""
    low_u, high_u, low_v, high_v = face.Surface.bounds()
    for i, row in enumerate(values):
        for j in range(len(row)):
            u = low_u + (high_u - low_u) * i / (len(values) - 1)
            v = low_v + (high_v - low_v) * j / (len(row) - 1)
            if not face.isPartOfDomain(u, v):
                row[j] = None


def cells_of(field, lift):
    """Triangles of the grid whose corners have a value: (point, how dark) each; dark where above 0."""
    values = field["values"]
    points = [
        [Vector(*p) + Vector(*n) * lift for p, n in zip(*row)] for row in zip(field["points"], field["normals"])
    ]
    for i in range(len(values) - 1):
        for j in range(len(values[i]) - 1):
            for places in (((i, j), (i + 1, j), (i + 1, j + 1)), ((i, j), (i + 1, j + 1), (i, j + 1))):
                if all(values[a][b] is not None for a, b in places):
                    # a fraction of a stripe, dark from a half to one: a wave without the jump from one to nought
                    yield [(points[a][b], -math.sin(2 * math.pi * values[a][b])) for a, b in places]


def dark_part(triangle):
    """The triangles of the part where the corners' values, linear between them, are above 0."""
    corners = []
    for (p, a), (q, b) in zip(triangle, triangle[1:] + triangle[:1]):
        if a > 0:
            corners.append(p)
        if (a > 0) != (b > 0):
            corners.append(p + (q - p) * (a / (a - b)))
    return [[corners[0], b, c] for b, c in zip(corners[1:], corners[2:])]


class Value(Computed):
    """The aesthetic value of a face's net (SAV), or of a wire of one edge (CAV)."""

    properties = (
        SOURCE,
        ("App::PropertyFloat", "AestheticValue", "less is better; 0: Class A of least energy", 0.0),
        ("App::PropertyInteger", "Type", "of a curve: 1 at the minimum, 2 Class A, 3 one matrix, 4 several, 5 none", 0),
        ("App::PropertyFloat", "Alpha", "of a curve of one matrix: rotation, radians", 0.0),
        ("App::PropertyFloat", "Scale", "of a curve of one matrix", 0.0),
        ("App::PropertyString", "Worst", "of a face: name of the curve of the largest value", ""),
    )

    def execute(self, made):
        given = ks.Given(made.Source, made)
        if given.points is None and given.shape.Faces:
            answer = ks.perform("surface.sav", {"surface": ks.surface_of(ks.face_of(given))})
            made.AestheticValue, made.Worst = answer["sav"], answer["worst"]
            return
        curves = ks.curve_of(given, ks.plane_of(given))["curves"]
        if len(curves) != 1:
            raise ValueError(f"{given.label} has {len(curves)} edges: select one")
        (curve,) = curves
        if len(curve["points"]) == curve["degree"] + 1 and "weights" not in curve:
            curve = {"type": "bezier", "points": curve["points"]}
        answer = ks.perform("curve.cav", {"curve": curve})
        made.AestheticValue, made.Type = answer["cav"], answer["type"]
        made.Alpha, made.Scale = answer.get("alpha") or 0.0, answer.get("s") or 0.0


KINDS = {
    "Curve": ("Part::FeaturePython", Curve),
    "Fair": ("Part::FeaturePython", Fair),
    "Blend": ("Part::FeaturePython", Blend),
    "Comb": ("Part::FeaturePython", Comb),
    "Zebra": ("Mesh::FeaturePython", Zebra),
    "Value": ("App::FeaturePython", Value),
}


def make(kind, *sources, document=None):
    """A new object of one of the KINDS in a document, made from the sources (two of a Blend): objects, or (object,
    names of its faces or edges)."""
    type_name, proxy = KINDS[kind]
    made = (document or FreeCAD.ActiveDocument).addObject(type_name, kind)
    proxy(made)
    for name, source in zip(("First", "Second") if kind == "Blend" else ("Source",), sources):
        setattr(made, name, source)
    if made.ViewObject:  # none in freecadcmd
        made.ViewObject.Proxy = 0
        if kind == "Zebra":
            made.ViewObject.ShapeColor = (0.0, 0.0, 0.0)
    return made
