"""Paths of an SVG drawing as Keyline's curves and back: what the extensions share."""

import sys

import inkex
from inkex import CubicSuperPath, Path, PathElement

try:
    import keyline
except ImportError as missing:
    sys.exit(f"Keyline's Python package is missing for {sys.executable} ({missing}): install python3-keyline.")


class Extension(inkex.EffectExtension):
    """An extension that tells Keyline's failures as messages, not as tracebacks."""

    def effect(self):
        try:
            self.work()
        except keyline.Error as error:
            hint = f"\n{error.hint}" if error.hint else ""
            raise inkex.AbortExtension(f"{error.message}{hint}") from error

    def paths(self, least):
        chosen = list(self.svg.selection.filter(inkex.ShapeElement).values())
        if len(chosen) < least:
            raise inkex.AbortExtension(f"Select {least} path{'s' if least > 1 else ''}.")
        return chosen

    def tolerance_of(self, curves):
        """What was asked for, in the drawing's unit; 0.01 % of the size where it is 0."""
        return self.options.tolerance or 1e-4 * size_of(curves)


def size_of(curves):
    """The longer side of the box around all control points."""
    points = [p for curve in curves for part in members(curve) for p in part["points"]]
    return max(max(p[i] for p in points) - min(p[i] for p in points) for i in (0, 1))


def members(curve):
    return curve["curves"] if curve["type"] == "path" else [curve]


def curves_of(shape):
    """One path value for each subpath of a shape, in the drawing's own coordinates."""
    path = shape.path.transform(shape.composed_transform())
    for subpath in CubicSuperPath(path):
        closed = len(subpath) > 2 and list(subpath[0][1]) == list(subpath[-1][1])
        beziers = [
            {"type": "bezier", "points": [list(a[1]), list(a[2]), list(b[0]), list(b[1])]}
            for a, b in zip(subpath, subpath[1:])
            if a[1] != b[1] or a[2] != a[1] or b[0] != b[1]
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


def put(shape, data, **style):
    """A new path over a shape, in its layer and style."""
    made = PathElement()
    made.path = data.transform(-shape.getparent().composed_transform())
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
    target.path = data.transform(-target.composed_transform())
    for name in ("sodipodi:nodetypes", "inkscape:original-d", "inkscape:path-effect"):
        target.pop(name)
    return target
