"""Shapes of FreeCAD as Keyline's values and back."""

import math

import FreeCAD
import numpy
import Part

try:
    import keyline
except ImportError as missing:
    raise ImportError(f"Keyline's Python package is missing ({missing}): install python3-keyline") from missing

Vector = FreeCAD.Vector


def perform(operation, request):
    """The operation's answer; its failure as an error that FreeCAD shows beside the object."""
    try:
        return keyline.perform(operation, request)
    except keyline.Error as error:
        raise RuntimeError(f"{error.message}; {error.hint}" if error.hint else error.message) from error


class Given:
    """What a link means, as it lies in the container of the object made of it: a shape, or measured points."""

    def __init__(self, link, made):
        self.source, parts = link if isinstance(link, tuple) else (link, [])  # of older documents the object alone
        if self.source is None:
            raise ValueError("there is no source: set it among the properties")
        self.label = self.source.Label
        into = _container(made).inverse().multiply(_container(self.source))
        self.points = None
        if hasattr(self.source, "Points") and hasattr(self.source.Points, "Points"):
            own = into.multiply(self.source.Placement)
            self.points = [own.multVec(Vector(*p)) for p in self.source.Points.Points]
        elif hasattr(self.source, "Shape"):
            shape = self.source.Shape
            if any(parts):
                shape = Part.Compound([shape.getElement(part) for part in parts if part])
            self.shape = shape.copy()
            self.shape.Placement = into.multiply(self.shape.Placement)
        else:
            raise ValueError(f"{self.label} has no shape")
        sketch = self.source.isDerivedFrom("Sketcher::SketchObject")
        self.plane = into.multiply(self.source.Placement) if sketch else None


def _container(thing):
    """Where the part or body that holds a thing lies; a link cannot tell, and counts as held by none."""
    if not hasattr(thing, "getGlobalPlacement"):
        return FreeCAD.Placement()
    return thing.getGlobalPlacement().multiply(thing.Placement.inverse())


def plane_of(*given):
    """The plane that holds all that is given, as a placement: one sketch's own, else the one through the shapes."""
    if len(given) == 1 and given[0].plane:
        return given[0].plane
    if given[0].points:
        return _plane_through(given[0])
    shape = Part.Compound([one.shape for one in given])
    plane = shape.findPlane()
    if plane is not None:
        return FreeCAD.Placement(plane.Position, FreeCAD.Rotation(Vector(0, 0, 1), plane.Axis))
    points = [vertex.Point for vertex in shape.Vertexes]
    if len(points) < 2:
        raise ValueError(f"{given[0].label} has no edges")
    way = points[-1] - points[0]
    straight = all((p - points[0]).cross(way).Length <= 1e-9 * way.Length**2 for p in points)
    if not straight or any(not _is_straight(edge) for edge in shape.Edges):
        raise ValueError("the curves do not lie in one plane")
    normal = way.cross(Vector(0, 0, 1)) if way.cross(Vector(0, 0, 1)).Length > 1e-9 else Vector(1, 0, 0)
    return FreeCAD.Placement(points[0], FreeCAD.Rotation(way, normal.cross(way), normal, "XZY"))


def _plane_through(given):
    """The plane of least squares through measured points; how far they lie off it is told."""
    points = numpy.array([tuple(p) for p in given.points])
    middle = points.mean(axis=0)
    axes = numpy.linalg.svd(points - middle, full_matrices=False)[2]
    off = abs((points - middle) @ axes[2]).max()
    if off > 1e-7:
        FreeCAD.Console.PrintWarning(f"{given.label}: up to {off:.3g} off the plane through its points\n")
    turned = FreeCAD.Rotation(Vector(*axes[0]), Vector(*axes[1]), Vector(*axes[2]), "XYZ")
    return FreeCAD.Placement(Vector(*middle), turned)


def _is_straight(edge):
    return isinstance(edge.Curve, (Part.Line, Part.LineSegment))


def within(plane, point):
    """A point's two coordinates in the plane."""
    local = plane.inverse().multVec(point)
    return [local.x, local.y]


def edges_of(given):
    """The wire from its start to its end: (edge, turned round) in order."""
    wires = Part.sortEdges(given.shape.Edges) if given.points is None else []
    if len(wires) != 1:
        raise ValueError(f"{given.label} holds {len(wires)} wires: one is wanted, or select its edges")
    wire = Part.Wire(wires[0])
    edges = wire.OrderedEdges
    ends = [(e.valueAt(e.FirstParameter), e.valueAt(e.LastParameter)) for e in edges]
    if len(edges) == 1:
        return [(edges[0], edges[0].Orientation == "Reversed")]
    at = ends[0][0]  # the end of the first edge that no other touches first
    if min((at - p).Length for p in ends[1]) < min((ends[0][1] - p).Length for p in ends[1]):
        at = ends[0][1]
    ordered = []
    for edge, (start, end) in zip(edges, ends):
        turned = (at - end).Length < (at - start).Length
        ordered.append((edge, turned))
        at = start if turned else end
    return ordered


def points_of(given, plane):
    """The corners of a wire that is nothing but straight lines, or measured points; None of another."""
    if given.points:
        return [within(plane, p) for p in given.points]
    edges = edges_of(given)
    if not all(_is_straight(edge) for edge, _ in edges):
        return None
    ends = [[e.valueAt(e.FirstParameter), e.valueAt(e.LastParameter)][:: -1 if t else 1] for e, t in edges]
    return [within(plane, start) for start, _ in ends] + [within(plane, ends[-1][1])]


def curve_of(given, plane):
    """The wire as a path of B-splines in the plane."""
    curves = []
    for edge, turned in edges_of(given):
        spline = edge.Curve.toBSpline(edge.FirstParameter, edge.LastParameter)
        if turned:
            spline.reverse()
        value = {
            "type": "bspline",
            "degree": spline.Degree,
            "knots": list(spline.KnotSequence),
            "points": [within(plane, pole) for pole in spline.getPoles()],
        }
        if spline.isRational():
            value["weights"] = spline.getWeights()
        curves.append(value)
    return {"type": "path", "curves": curves, "closed": closes(curves[0]["points"][0], curves[-1]["points"][-1])}


def closes(first, last):
    """Whether a wire that begins and ends there is closed."""
    return math.dist(first, last) < 1e-7


def face_of(given):
    """Its one face."""
    faces = given.shape.Faces if given.points is None else []
    if len(faces) != 1:
        raise ValueError(f"{given.label} holds {len(faces)} faces: select one")
    return faces[0].toNurbs().Faces[0]


def surface_of(face):
    """The surface of a face, as a B-spline; rational where cylinders and spheres are."""
    surface = face.Surface
    if not isinstance(surface, Part.BSplineSurface):
        surface = surface.toBSpline()
    surface.setUNotPeriodic()
    surface.setVNotPeriodic()
    value = {
        "type": "bspline-surface",
        "degree": [surface.UDegree, surface.VDegree],
        "knots": [list(surface.UKnotSequence), list(surface.VKnotSequence)],
        "points": [[list(p) for p in row] for row in surface.getPoles()],
    }
    if surface.isURational() or surface.isVRational():
        value["weights"] = surface.getWeights()
    return value


def wire_of(form, plane):
    """A B-spline, or a path of them, as a wire in the plane."""
    return Part.Wire([_spline(c, plane).toShape() for c in form.get("curves", [form])])


def _spline(value, plane):
    knots = []
    for knot in value["knots"]:
        if not knots or knot != knots[-1][0]:
            knots.append([knot, 0])
        knots[-1][1] += 1
    made = Part.BSplineCurve()
    poles = [plane.multVec(Vector(x, y, 0)) for x, y in value["points"]]
    multiplicities = [count for _, count in knots]
    weights = value.get("weights") or [1.0] * len(poles)
    made.buildFromPolesMultsKnots(poles, multiplicities, [k for k, _ in knots], False, value["degree"], weights)
    return made
