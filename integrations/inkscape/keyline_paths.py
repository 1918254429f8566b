"""Paths of an SVG drawing as Keyline's curves and back: what the extensions share."""

import math
import sys

import inkex
from inkex import CubicSuperPath, Path, PathElement

try:
    import keyline
except ImportError as missing:
    sys.exit(f"Keyline's Python package is missing for {sys.executable} ({missing}): install python3-keyline.")


class Extension(inkex.EffectExtension):
    """An extension that tells Keyline's failures as messages, not as tracebacks."""

    def perform(self, shape, operation, request):
        """The operation's answer; its failure as a message that names the shape."""
        try:
            return keyline.perform(operation, request)
        except keyline.Error as error:
            hint = f"\n{error.hint}" if error.hint else ""
            raise inkex.AbortExtension(f"{shape.get_id()}: {error.message}{hint}") from error

    def paths(self):
        """What is selected, each path of a group alone; anything without a path is refused by name."""
        chosen = [path for shape in self.svg.selection for path in paths_in(shape)]
        if not chosen:
            raise inkex.AbortExtension("Select a path.")
        return chosen

    def tolerance_of(self, curves):
        """What was asked for, in the drawing's unit; 0.01 % of the size where it is 0."""
        return self.options.tolerance or 1e-4 * size_of(curves)


NOTHING = 1e-9  # of a path's size: what arcs leave between their end and the start
OWN_PATH = (PathElement, inkex.Rectangle, inkex.Circle, inkex.Ellipse, inkex.Line, inkex.Polyline, inkex.Polygon)
ADVICE = {"text": "Path > Object to Path", "use": "Edit > Clone > Unlink Clone", "image": "Path > Trace Bitmap"}


def paths_in(shape):
    """The shape, or the paths of a group."""
    if isinstance(shape, (inkex.Group, inkex.Anchor)):
        return [path for part in shape if isinstance(part, inkex.ShapeElement) for path in paths_in(part)]
    if not isinstance(shape, OWN_PATH):
        advice = ADVICE.get(shape.TAG, "select paths only")
        raise inkex.AbortExtension(f"{shape.get_id()} is no path but of the kind {shape.TAG}: {advice}.")
    if not list(curves_of(shape)):
        raise inkex.AbortExtension(f"{shape.get_id()} is a path without length: delete it.")
    way = shape.composed_transform()
    if way.a * way.d == way.b * way.c:
        raise inkex.AbortExtension(f"{shape.get_id()} is pressed flat by its transform: take that away.")
    return [shape]


def size_of(curves):
    """The longer side of the box around all control points."""
    points = [p for curve in curves for part in members(curve) for p in part["points"]]
    return max(max(p[i] for p in points) - min(p[i] for p in points) for i in (0, 1))


def members(curve):
    return curve["curves"] if curve["type"] == "path" else [curve]


def curves_of(shape):
    """One path value for each subpath of a shape, in the drawing's own coordinates."""
    for subpath in CubicSuperPath(shape.path.transform(shape.composed_transform())):
        places = [p for node in subpath for p in node]
        least = NOTHING * max(max(p[i] for p in places) - min(p[i] for p in places) for i in (0, 1))
        closed = len(subpath) > 2 and math.dist(subpath[0][1], subpath[-1][1]) <= least
        corners = ([a[1], a[2], b[0], b[1]] for a, b in zip(subpath, subpath[1:]))
        beziers = [
            {"type": "bezier", "points": [list(p) for p in points]}
            for points in corners
            if max(math.dist(points[0], p) for p in points) > least
        ]
        if beziers:
            yield {"type": "path", "curves": beziers, "closed": closed}


def points_of(curve):
    """The nodes of a path that is nothing but straight lines; None of another."""
    parts = curve["curves"]
    if any(p["points"][:2] != [p["points"][0]] * 2 or p["points"][2:] != [p["points"][3]] * 2 for p in parts):
        return None
    return [p["points"][0] for p in parts] + [parts[-1]["points"][3]]


def as_path(form):
    """Béziers of degree 3, as an answer's "bezier" has them, as the data of a path."""
    data = Path()
    for i, part in enumerate(members(form)):
        points = part["points"]
        if i == 0:
            data.append(inkex.paths.Move(*points[0]))
        data.append(inkex.paths.Curve(*points[1], *points[2], *points[3]))
    if form.get("closed"):
        data.append(inkex.paths.ZoneClose())
    return data


def written(data):
    """The data as text; inkex itself keeps six digits, with which directions and curvatures differ at joints."""
    return " ".join(" ".join([command.letter, *(f"{v:.12g}" for v in command.args)]) for command in data)


def put(shape, data, **style):
    """A new path over a shape, in its layer and style."""
    made = PathElement()
    made.set("d", written(data.transform(-shape.getparent().composed_transform())))
    made.style = shape.specified_style() | style
    made.style["fill"] = "none"
    shape.getparent().append(made)
    return made


def replace(shape, data):
    """The shape's own path changed, its style and transform kept."""
    target = shape
    if not isinstance(shape, PathElement):
        target = shape.to_path_element()
        shape.replace_with(target)
    target.set("d", written(data.transform(-target.composed_transform())))
    for name in ("sodipodi:nodetypes", "inkscape:original-d", "inkscape:path-effect"):
        target.pop(name)
    return target
