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


__all__ = [
    "BadInput", "Cancelled", "Curve", "Error", "FileFailure", "NotConverged", "Record", "Segments",
    "Surface", "Undrawable", "Unsupported", "__version__", "perform", "read",
    *sorted(n for n, v in globals().items() if isinstance(v, _operations.Namespace)),
    *sorted(n for n, v in globals().items() if hasattr(v, "__signature__") and v.__module__ == "keyline"),
]  # fmt: skip
