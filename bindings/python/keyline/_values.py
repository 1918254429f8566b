"""Curves, surfaces and records: what operations take and give."""

from __future__ import annotations

import html
import operator
from typing import Any, Iterable, Iterator, Mapping

import numpy as np

from . import _keyline
from ._errors import BadInput


class Record:
    """Named parts of a result, as attributes; `in`, `[]` and iteration by name too."""

    def __init__(self, parts: Mapping[str, Any]) -> None:
        self.__dict__.update(parts)

    def __getitem__(self, name: str) -> Any:
        return self.__dict__[name]

    def __contains__(self, name: object) -> bool:
        return name in self.__dict__

    def __iter__(self) -> Iterator[str]:
        return iter(self.__dict__)

    def keys(self) -> Iterable[str]:
        """With `[]` what a mapping needs: dict(record), and records in requests."""
        return self.__dict__.keys()

    def __repr__(self) -> str:
        return "Record(" + ", ".join(f"{k}={_short(v)}" for k, v in self.__dict__.items()) + ")"


def _short(value: Any) -> str:
    text = repr(value)
    if len(text) <= 60:
        return text
    if isinstance(value, (list, np.ndarray)):
        return f"<{len(value)} items>"
    return text[:57] + "…"


class _Held:
    """What holds a value of the public interface and gives back everything said beside it."""

    __slots__ = ("_handle", "result", "deviation")
    _handle: Any
    result: Record | None
    deviation: float | None

    def __getattr__(self, name: str) -> Any:
        result = object.__getattribute__(self, "result") if name != "result" else None
        if result is not None and name in result:
            return result[name]
        raise AttributeError(f"a {type(self).__name__} has no {name!r}")

    def __dir__(self) -> Iterable[str]:
        return [*super().__dir__(), *(self.result or ())]

    def __reduce__(self) -> Any:
        return type(self), (self.value,), (self.result, self.deviation)

    def __setstate__(self, state: tuple[Record | None, float | None]) -> None:
        self.result, self.deviation = state

    def __eq__(self, other: object) -> bool:
        return type(self) is type(other) and self.value == other.value  # type: ignore[attr-defined]

    __hash__ = None  # type: ignore[assignment]

    @property
    def value(self) -> dict[str, Any]:
        """The value of the public interface: what JSON holds."""
        return self._handle.value()  # type: ignore[no-any-return]


def _numbers(given: Any) -> Any:
    """An array of real numbers, none of them masked."""
    if np.ma.is_masked(given):
        raise BadInput("some of the values are masked", "", "give compressed() or filled() ones")
    numbers = np.asarray(given)
    if numbers.dtype.kind not in "fiubO" and numbers.size:
        raise TypeError(f"keyline: real numbers are wanted, not {numbers.dtype}")
    return numbers.astype(float, copy=False)


class Curve(_Held):
    """Any curve, in the plane or in space; places on it are arc lengths from its start, those beyond an end
    count as the end.

    >>> import keyline
    >>> curve = keyline.Curve({"type": "bezier", "points": [[0, 0], [1, 0], [2, 1]]})
    >>> curve.point([0, curve.length]).tolist()
    [[0.0, 0.0], [2.0, 1.0]]
    """

    __slots__ = ()

    def __init__(self, value: Any) -> None:
        self.result = None
        self.deviation = None
        if isinstance(value, Mapping) and "deviation" in value:
            value = dict(value)
            self.deviation = value.pop("deviation")
        self._handle = value._handle if isinstance(value, Curve) else _keyline.HeldCurve(value)

    @property
    def length(self) -> float:
        """Arc length of the whole."""
        return self._handle.length  # type: ignore[no-any-return]

    @property
    def dimension(self) -> int:
        """2 in the plane, 3 in space."""
        return self._handle.dimension  # type: ignore[no-any-return]

    def point(self, s: Any) -> Any:
        """Points at arc lengths s, one row each."""
        return self._handle.point(_numbers(s))

    def tangent(self, s: Any) -> Any:
        """Unit tangents at arc lengths s."""
        return self._handle.tangent(_numbers(s))

    def curvature(self, s: Any) -> Any:
        """Curvature at arc lengths s; in the plane signed, positive turning left."""
        return self._handle.curvature(_numbers(s))

    def curvature_rate(self, s: Any) -> Any:
        """Change of curvature by arc length (planar curves)."""
        return self._handle.curvature_rate(_numbers(s))

    def tangent_angle(self, s: Any) -> Any:
        """Direction of travel in radians (planar curves)."""
        return self._handle.tangent_angle(_numbers(s))

    def torsion(self, s: Any) -> Any:
        """Torsion at arc lengths s (curves in space)."""
        return self._handle.torsion(_numbers(s))

    def sample(self, n: int = 101) -> Any:
        """n points evenly spaced in arc length, both ends among them.

        >>> import keyline
        >>> keyline.Curve({"type": "polyline", "points": [[0, 0], [4, 0]]}).sample(3).tolist()
        [[0.0, 0.0], [2.0, 0.0], [4.0, 0.0]]
        """
        return self.point(np.linspace(0.0, self.length, n))

    def to_bezier(self, tolerance: float, degree: int = 3) -> Curve:
        """Béziers end to end within the tolerance; `deviation` of the answer bounds the distance.

        >>> import keyline
        >>> curve = keyline.lac.segment([[0, 0], [2, 0], [3, 1.5]], -1)
        >>> curve.to_bezier(1e-4).deviation <= 1e-4
        True
        """
        return Curve(self._handle.bezier(tolerance, degree))

    def plot(self, ax: Any = None, comb: float = 0.0, **style: Any) -> Any:
        """Draws the curve with matplotlib and gives back the axes.

        comb: length of the curvature comb's longest tooth as a share of the curve's length.
        """
        try:
            import matplotlib.pyplot as plt
        except ImportError as missing:
            raise ImportError("plot() draws with matplotlib, which is not installed") from missing
        if ax is None:
            ax = plt.gca()
        points = self.sample(401)
        ax.plot(*points.T[:2], **style)
        if comb and self.dimension == 2:
            ends = points + _teeth(self, comb, len(points))
            ax.plot(*ends.T, linewidth=0.8, color="0.4")
            for i in range(0, len(points), 8):
                ax.plot(*np.array([points[i], ends[i]]).T, linewidth=0.5, color="0.6")
        ax.set_aspect("equal")
        return ax

    def _repr_svg_(self) -> str:
        flat = self.sample(2 if self.length == 0 else 257)[:, :2] * [1, -1]
        low, high = flat.min(axis=0), flat.max(axis=0)
        size = max(float((high - low).max()), 1e-12)
        margin = 0.05 * size
        box = [*(low - margin), *(high - low + 2 * margin)]
        path = "M" + " L".join(f"{x:.6g},{y:.6g}" for x, y in flat)
        scale = 320 / max(box[2:])
        return (
            f'<svg xmlns="http://www.w3.org/2000/svg" width="{scale * box[2]:.4g}" '
            f'height="{scale * box[3]:.4g}" viewBox="{" ".join(f"{x:.6g}" for x in box)}">'
            f'<path d="{path}" fill="none" stroke="#0b5394" stroke-width="{2 / scale:.4g}"/></svg>'
        )

    def _repr_html_(self) -> str:
        said = {"length": f"{self.length:.6g}"}
        for name in self.result or ():
            part = self.result[name]  # type: ignore[index]
            if isinstance(part, (bool, int, float, str)):
                said[name] = f"{part:.6g}" if isinstance(part, float) else str(part)
        rows = "".join(f"<tr><th>{html.escape(k)}</th><td>{html.escape(v)}</td></tr>" for k, v in said.items())
        return f"<div>{self._repr_svg_()}<table>{rows}</table></div>"

    def __repr__(self) -> str:
        return f"<keyline.Curve {self.value['type']}, length {self.length:.6g}>"


def _teeth(curve: Curve, share: float, n: int) -> Any:
    s = np.linspace(0.0, curve.length, n)
    curvature = curve.curvature(s)
    largest = np.abs(curvature).max() or 1.0
    tangent = curve.tangent(s)
    normal = np.stack([tangent[:, 1], -tangent[:, 0]], axis=1)
    return (share * curve.length / largest) * curvature[:, None] * normal


class Surface(_Held):
    """A Bézier or B-spline patch; u and v lie in [0, 1]."""

    __slots__ = ()

    def __init__(self, value: Any) -> None:
        self.result = None
        self.deviation = None
        self._handle = value._handle if isinstance(value, Surface) else _keyline.HeldSurface(value)

    def point(self, u: Any, v: Any) -> Any:
        """Points at pairs of parameters."""
        return self._handle.point(_numbers(u), _numbers(v))

    def normal(self, u: Any, v: Any) -> Any:
        """Unit normals at pairs of parameters."""
        return self._handle.normal(_numbers(u), _numbers(v))

    def plot(self, ax: Any = None, n: int = 25, **style: Any) -> Any:
        """Draws the patch as a net of n by n points with matplotlib and gives back the axes."""
        import matplotlib.pyplot as plt

        if ax is None:
            ax = plt.figure().add_subplot(projection="3d")
        u, v = np.meshgrid(np.linspace(0, 1, n), np.linspace(0, 1, n))
        ax.plot_wireframe(*np.moveaxis(self.point(u, v), -1, 0), **{"linewidth": 0.5, **style})
        return ax

    def __repr__(self) -> str:
        return f"<keyline.Surface {self.value['type']}>"


class Segments:
    """Many log-aesthetic segments as columns: `start`, `direction`, `length`, `curvature` (at both
    ends), `lambda_`, `drawn` (False: there is none) and `reversed`. An item is a Curve."""

    def __init__(self, columns: dict[str, Any], alpha: Any) -> None:
        self.__dict__.update(columns)
        self.alpha = alpha

    def __len__(self) -> int:
        return len(self.length)  # type: ignore[attr-defined]

    def __repr__(self) -> str:
        return f"<keyline.Segments {len(self)}, {np.count_nonzero(self.drawn)} drawn>"  # type: ignore[attr-defined]

    def __getitem__(self, i: int) -> Curve:
        i = operator.index(i)
        if not self.drawn[i]:  # type: ignore[attr-defined]
            raise ValueError(f"segment {i} cannot be drawn; keyline.lac.segment tells why")
        alpha = float(self.alpha[i if self.alpha.size > 1 else 0])
        piece = {"alpha": alpha, "length": self.length[i], "curvature": self.curvature[i]}  # type: ignore[attr-defined]
        return Curve(
            {
                "type": "log-aesthetic",
                "start": self.start[i],  # type: ignore[attr-defined]
                "direction": self.direction[i],  # type: ignore[attr-defined]
                "closed": False,
                "pieces": [piece],
            }
        )


def segments(points: Any, alpha: Any = -1.0, threads: int = 0) -> Segments:
    """keyline.lac.segment for many triples of handles at once: points of shape (n, 3, 2), one alpha
    or n of them.

    >>> import keyline
    >>> many = keyline.lac.segments([[[0, 0], [2, 0], [3, 1.5]]] * 4, [-1, 0, 1, 2])
    >>> many.drawn.tolist()
    [True, True, True, True]
    """
    slopes = np.atleast_1d(_numbers(alpha))
    return Segments(_keyline.segments(_numbers(points), slopes, threads), slopes)
