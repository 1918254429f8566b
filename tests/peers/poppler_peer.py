"""What poppler reads of a PDF: pdftocairo draws it as SVG, a hundred times as large, because it rounds
coordinates to 1/256 pt. That is exact for pages of whole points."""

import re
import shutil
import subprocess
from pathlib import Path

import plain_svg

NAME, READS, PLACED = "poppler", ("pdf",), False
ROUNDING = {"pdf": 2e-5}
LARGER = 100


def version():
    if not shutil.which("pdftocairo"):
        return None
    text = subprocess.run(["pdftocairo", "-v"], capture_output=True, text=True).stderr
    return re.search(r"version ([\d.]+)", text).group(1)


def read(file):
    size = subprocess.run(["pdfinfo", file], capture_output=True, text=True, check=True).stdout
    sides = re.search(r"Page size:\s*(\d+) x (\d+) pts", size).groups()
    side = str(LARGER * max(int(s) for s in sides))
    out = Path(f"{file}.svg")
    command = ["pdftocairo", "-svg", "-expand", "-nocenter", "-paperw", side, "-paperh", side, file, out]
    subprocess.run(command, check=True, capture_output=True)
    curves = plain_svg.read(out.read_text())
    for curve in curves:
        curve.points = curve.points / LARGER
    return curves
