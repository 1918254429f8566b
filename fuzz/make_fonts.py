#!/usr/bin/env python3
"""Writes the seeds of font_reader_fuzz: fonts of our own with the glyphs S and a.

Needs fontTools (Debian: python3-fonttools). From the root: python3 fuzz/make_fonts.py
"""

from pathlib import Path

from fontTools.fontBuilder import FontBuilder
from fontTools.pens.t2CharStringPen import T2CharStringPen
from fontTools.pens.ttGlyphPen import TTGlyphPen

SEEDS = Path(__file__).parent / "seeds" / "font_reader_fuzz"
ORDER = [".notdef", "S", "a", "acute", "space"]
CODES = {ord("S"): "S", ord("a"): "a", ord(" "): "space"}


def bowl(pen, curve):
    """A contour of lines and curves that starts on a curve."""
    pen.moveTo((100, 0))
    pen.lineTo((400, 0))
    curve(pen)
    pen.lineTo((100, 500))
    pen.closePath()


def finish(builder):
    builder.setupHorizontalMetrics({name: (500, 0) for name in ORDER})
    builder.setupHorizontalHeader(ascent=800, descent=-200)
    builder.setupNameTable({"familyName": "Seed", "styleName": "Regular"})
    builder.setupOS2(sTypoAscender=800, usWinAscent=800, usWinDescent=200)
    builder.setupPost()


def quadratic(with_composite):
    def glyph(draw=lambda pen: None, base=None):
        pen = TTGlyphPen(base)
        draw(pen)
        return pen.glyph()

    glyphs = {name: glyph() for name in ORDER}
    glyphs["S"] = glyph(lambda p: bowl(p, lambda q: q.qCurveTo((500, 0), (500, 500), (400, 500))))
    glyphs["acute"] = glyph(lambda p: (
        p.qCurveTo((0, 0), (100, 0), (100, 100), (0, 100), None), p.closePath()))
    if with_composite:
        glyphs["a"] = glyph(
            lambda p: (p.addComponent("S", (1, 0, 0, 1, 0, 0)),
                       p.addComponent("acute", (0.5, 0.25, -0.25, 0.5, 50, 600))), glyphs)
    builder = FontBuilder(1000, isTTF=True)
    builder.setupGlyphOrder(ORDER)
    builder.setupCharacterMap(CODES)
    builder.setupGlyf(glyphs)
    finish(builder)
    return builder


def cubic():
    strings = {}
    for name in ORDER:
        pen = T2CharStringPen(500, None)
        if name in ("S", "a"):
            bowl(pen, lambda q: q.curveTo((500, 100), (500, 400), (400, 500)))
        strings[name] = pen.getCharString()
    builder = FontBuilder(1000, isTTF=False)
    builder.setupGlyphOrder(ORDER)
    builder.setupCharacterMap(CODES)
    builder.setupCFF("Seed", {"FullName": "Seed"}, strings, {})
    finish(builder)
    return builder


def main():
    SEEDS.mkdir(parents=True, exist_ok=True)
    for name, builder in {"plain.ttf": quadratic(False), "composite.ttf": quadratic(True),
                          "cubic.otf": cubic()}.items():
        builder.font["head"].created = builder.font["head"].modified = 0
        builder.font.recalcTimestamp = False
        builder.save(SEEDS / name)


if __name__ == "__main__":
    main()
