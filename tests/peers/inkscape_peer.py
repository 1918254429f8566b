"""What Inkscape reads. An SVG is opened and everything moved there and back, so that every path goes
through Inkscape's own geometry; what it saves is measured. A DXF goes through its importer, run as
Inkscape runs it (without a screen Inkscape itself cannot ask for the importer's settings)."""

import re
import shutil
import subprocess
from pathlib import Path

import plain_svg

NAME, READS, PLACED = "Inkscape", ("svg", "dxf"), True
# Eight digits in what it saves; six in the straight lines its importer makes.
ROUNDING = {"svg": 2e-5, "dxf": 5e-4}
IMPORTER = Path("/usr/share/inkscape/extensions/dxf_input.py")


def version():
    if not shutil.which("inkscape"):
        return None
    text = subprocess.run(["inkscape", "--version"], capture_output=True, text=True).stdout
    return re.search(r"Inkscape ([\d.]+)", text).group(1)


def read(file):
    if file.suffix == ".dxf":
        command = ["/usr/bin/python3", "-B", IMPORTER, "--scalemethod=file", file]
        return plain_svg.read(subprocess.run(command, capture_output=True, check=True).stdout)
    out = Path(f"{file}.inkscape.svg")
    actions = "select-all:all;transform-translate:100,0;transform-translate:-100,0"
    command = ["inkscape", file, f"--actions={actions};export-filename:{out};export-do"]
    subprocess.run(command, capture_output=True, check=True, timeout=300)
    return plain_svg.read(out.read_text())
