"""What fontTools reads of a .glif."""

import numpy as np

import plain_svg

NAME, READS, PLACED, ROUNDING = "fontTools", ("glif",), True, {}


def version():
    try:
        import fontTools
    except ImportError:
        return None
    return fontTools.version


def read(file):
    from fontTools.pens.recordingPen import RecordingPen
    from fontTools.pens.pointPen import PointToSegmentPen
    from fontTools.ufoLib.glifLib import readGlyphFromString

    pen = RecordingPen()
    readGlyphFromString(file.read_bytes(), pointPen=PointToSegmentPen(pen))
    curves, pieces, at = [], [], 0j
    for verb, points in pen.value:
        z = [complex(*p) for p in points]
        if verb == "moveTo":
            pieces, at = [], z[0]
        elif verb in ("lineTo", "curveTo"):
            pieces.append(np.array([at, *z]))
            at = z[-1]
        else:
            sampled = plain_svg.samples(pieces, 1000)
            curves.append(plain_svg.Curve(np.column_stack([sampled.real, sampled.imag])))
    return curves
