"""Shapes of FreeCAD as Keyline's values and back."""

import FreeCAD
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


def plane_of(*sources):
    """The plane that holds all sources, as a placement: one sketch's own, else the one through the shapes."""
    if len(sources) == 1 and sources[0].isDerivedFrom("Sketcher::SketchObject"):
        return sources[0].getGlobalPlacement()
    shape = Part.Compound([source.Shape for source in sources])
    plane = shape.findPlane()
    if plane is not None:
        return FreeCAD.Placement(plane.Position, FreeCAD.Rotation(Vector(0, 0, 1), plane.Axis))
    points = [vertex.Point for vertex in shape.Vertexes]
    way = points[-1] - points[0]
    straight = all((p - points[0]).cross(way).Length <= 1e-9 * way.Length**2 for p in points)
    if not straight or any(not _is_straight(edge) for edge in shape.Edges):
        raise ValueError("the curves do not lie in one plane")
    normal = way.cross(Vector(0, 0, 1)) if way.cross(Vector(0, 0, 1)).Length > 1e-9 else Vector(1, 0, 0)
    return FreeCAD.Placement(points[0], FreeCAD.Rotation(way, normal.cross(way), normal, "XZY"))


def _is_straight(edge):
    return isinstance(edge.Curve, (Part.Line, Part.LineSegment))


def within(plane, point):
    """A point's two coordinates in the plane."""
    local = plane.inverse().multVec(point)
    return [local.x, local.y]


def edges_of(source):
    """The source's first wire from its start to its end: (edge, turned round) in order."""
    wire = Part.Wire(Part.sortEdges(source.Shape.Edges)[0])
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


def points_of(source, plane):
    """The corners of a wire that is nothing but straight lines, or measured points; None of another."""
    if hasattr(source, "Points") and hasattr(source.Points, "Points"):
        return [within(plane, p) for p in source.Points.Points]
    edges = edges_of(source)
    if not all(_is_straight(edge) for edge, _ in edges):
        return None
    ends = [[e.valueAt(e.FirstParameter), e.valueAt(e.LastParameter)][:: -1 if t else 1] for e, t in edges]
    return [within(plane, start) for start, _ in ends] + [within(plane, ends[-1][1])]


def curve_of(source, plane):
    """The source's first wire as a path of B-splines in the plane."""
    curves = []
    for edge, turned in edges_of(source):
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
    return {"type": "path", "curves": curves}


def surface_of(source):
    """The source's first face as a B-spline surface."""
    surface = source.Shape.Faces[0].toNurbs().Faces[0].Surface
    if not isinstance(surface, Part.BSplineSurface):
        surface = surface.toBSpline()
    if surface.isURational() or surface.isVRational():
        raise ValueError("the face is a rational surface: values of polynomial ones are defined")
    return {
        "type": "bspline-surface",
        "degree": [surface.UDegree, surface.VDegree],
        "knots": [list(surface.UKnotSequence), list(surface.VKnotSequence)],
        "points": [[list(p) for p in row] for row in surface.getPoles()],
    }


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
