"""What librsvg reads of an SVG: drawn as SVG a hundred times as large, because it rounds coordinates
to 1/256 of a point."""

import re
import shutil
import subprocess

import plain_svg

NAME, READS, PLACED = "librsvg", ("svg",), False
ROUNDING = {"svg": 1e-5}
LARGER = 100


def version():
    if not shutil.which("rsvg-convert"):
        return None
    text = subprocess.run(["rsvg-convert", "--version"], capture_output=True, text=True).stdout
    return re.search(r"version ([\d.]+)", text).group(1)


def read(file):
    command = ["rsvg-convert", "--unlimited", "-f", "svg", "-z", str(LARGER), file]
    text = subprocess.run(command, check=True, capture_output=True, text=True).stdout
    curves = plain_svg.read(text)
    for curve in curves:
        curve.points = curve.points / LARGER
    return curves
