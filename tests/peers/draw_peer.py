"""What OCCT's test harness DRAW reads of STEP and IGES."""

import os
import re
import shutil
import subprocess
import tempfile
from pathlib import Path

import numpy as np

from plain_svg import Curve

NAME, READS, PLACED, ROUNDING = "DRAW", ("step", "iges"), True, {}
COUNT = 300
PROGRAM = "occt-draw-7.6"

SCRIPT = """
pload MODELING XDE DATAEXCHANGE
catch {{{read}}} message
foreach s [directory a*] {{
  if {{[string match "* is a shape *" [whatis $s]]}} {{ lappend found $s }}
}}
foreach s $found {{
  foreach e [explode $s e] {{
    mkcurve c $e
    bounds c u v
    set from [dval u]
    set step [expr ([dval v] - $from) / {last}.]
    puts "KIND [lindex [dump c] 10] [regexp -all {{Circle}} [dump c]]"
    for {{set i 0}} {{$i <= {last}}} {{incr i}} {{
      cvalue c $from+$i*$step x y z
      puts "POINT [dval x] [dval y] [dval z]"
    }}
  }}
}}
exit
"""


def libraries(folder):
    """DRAW loads its plug-ins by the names that only development packages have."""
    for library in Path("/usr/lib").glob("*/libTK*.so.7"):
        (folder / library.name.removesuffix(".7")).symlink_to(library)
    return {**os.environ, "LD_LIBRARY_PATH": str(folder),
            "CSF_OCCTResourcePath": "/usr/share/opencascade/resources"}


def version():
    if not shutil.which(PROGRAM):
        return None
    text = subprocess.run(["dpkg-query", "-W", "-f", "${Version}", "occt-draw"], capture_output=True,
                          text=True).stdout
    return text.split("+")[0]


def run(script):
    with tempfile.TemporaryDirectory() as folder:
        place = Path(folder)
        (place / "script.tcl").write_text(script)
        command = [PROGRAM, "-b", "-f", place / "script.tcl"]
        return subprocess.run(command, env=libraries(place), capture_output=True, text=True,
                              stdin=subprocess.DEVNULL, timeout=600).stdout


def read(file):
    reader = f"stepread {file} a *" if file.suffix == ".step" else f"igesbrep {file} a *"
    curves = []
    for line in run(SCRIPT.format(read=reader, last=COUNT - 1)).splitlines():
        if line.startswith("KIND"):
            curves.append(Curve([], kind="Circle" if line.split()[-1] != "0" else "BSplineCurve"))
        elif line.startswith("POINT"):
            curves[-1].points.append([float(v) for v in line.split()[1:3]])
    for curve in curves:
        curve.points = np.array(curve.points)
    return curves
