"""Aesthetic curves and surfaces.

Every operation of Keyline is a function of its name: keyline.fair(points), keyline.lac.segment(points,
alpha), keyline.curve.analyze(curve), …; help(keyline.fair) tells its fields. What is a curve in a result
is a Curve, which answers for whole NumPy arrays.

>>> import keyline
>>> curve = keyline.lac.segment([[0, 0], [2, 0], [3, 1.5]], -1)
>>> curve.curvature([0, curve.length]).shape
(2,)
"""

from __future__ import annotations

import os
from collections.abc import Mapping
from typing import Any

_beside = os.path.join(os.path.dirname(__file__), "keyline-cad")
if os.path.exists(_beside):  # the reader and writer of STEP and IGES that came with the package
    os.environ.setdefault("KEYLINE_CAD", _beside)

from . import _image, _operations  # noqa: E402
from ._errors import BadInput, Cancelled, Error, FileFailure, NotConverged, Undrawable, Unsupported
from ._keyline import __version__
from ._operations import perform
from ._values import Curve, Record, Segments, Surface, segments

_operations.build(globals())


class _Sketch(_operations.Namespace):
    """Operations sketch.…; called with an image it traces it."""

    def __call__(self, image: Any, **fields: Any) -> Any:
        """The strokes of an image: a file's name, its bytes, or an array of pixels."""
        return self.trace(**_image.image_field(image), **fields)  # type: ignore[attr-defined]


def _finish(names: dict[str, Any]) -> None:
    """What the declarations do not tell: a call for sketch, many segments at once."""
    if "sketch" in names:
        callable_space = _Sketch("sketch")
        callable_space.__dict__.update(vars(names["sketch"]))
        names["sketch"] = callable_space
    names["lac"].segments = segments


_finish(globals())


def read(file: str | os.PathLike[str], **fields: Any) -> Any:
    """Everything a file holds: curves and surfaces with name, layer and unit (document.read)."""
    return globals()["document"].read(os.fspath(file), **fields)


def write(file: str | os.PathLike[str], *shapes: Any, **fields: Any) -> Any:
    """Curves and surfaces into a file whose extension chooses the format (document.write): each alone, with a
    name and a layer as read() gives it, or as an array of points.

    >>> import keyline, os, tempfile
    >>> name = os.path.join(tempfile.mkdtemp(), "segment.dxf")
    >>> keyline.write(name, keyline.lac.segment([[0, 0], [2, 0], [3, 1.5]], -1), unit="mm").written[0].deviation < 1e-4
    True
    """
    if not shapes:
        raise BadInput("nothing to write", "shapes", "give curves or surfaces behind the file's name")
    named = [_named(shape) for shape in shapes]
    for kind in ("curves", "surfaces"):
        of_kind = [one for one in named if ("surface" in one) == (kind == "surfaces")]
        if of_kind:
            fields[kind] = of_kind
    return globals()["document"].write(os.fspath(file), **fields)


def _named(shape: Any) -> dict[str, Any]:
    """A shape as document.write has it in its lists."""
    if isinstance(shape, Surface):
        return {"surface": shape}
    if isinstance(shape, Curve):
        return {"curve": shape}
    if isinstance(shape, (Mapping, Record)):
        return dict(shape)
    return {"curve": {"type": "polyline", "points": shape}}


__all__ = [
    "BadInput", "Cancelled", "Curve", "Error", "FileFailure", "NotConverged", "Record", "Segments",
    "Surface", "Undrawable", "Unsupported", "__version__", "perform", "read", "write",
    *sorted(n for n, v in globals().items() if isinstance(v, _operations.Namespace)),
    *sorted(n for n, v in globals().items() if hasattr(v, "__signature__") and v.__module__ == "keyline"),
]  # fmt: skip


def __dir__() -> list[str]:
    return __all__
