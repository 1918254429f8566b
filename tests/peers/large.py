#!/usr/bin/env python3
"""large.py KEYLINE [SHARE]: time and memory of large files, beside Inkscape and OCCT.

Makes an SVG and an STL of 25, 50 and 100 MB and a STEP file of 12.5, 25 and 50 MB (SHARE of that; 1
unless given), has Keyline read each and take one curve of it, has Inkscape list the objects of the
SVG and OCCT's DRAW load STL and STEP, and prints a row of a Markdown table for each: CPU time and the
largest memory of the whole process with its children. Needs some 5 GB of memory and ten minutes.
"""

import json
import math
import os
import random
import resource
import struct
import subprocess
import sys
import tempfile
from pathlib import Path

import draw_peer

MOST_SECONDS = 900


def make_svg(file, size):
    """Paths of 100 random cubics with five decimals."""
    chance = random.Random(1)
    with file.open("w") as out:
        out.write('<svg xmlns="http://www.w3.org/2000/svg" width="210mm" height="297mm">\n')
        while out.tell() < size:
            numbers = [f"{chance.random() * 200:.5f}" for _ in range(602)]
            curves = "".join("C" + " ".join(numbers[k : k + 6]) for k in range(2, 602, 6))
            out.write(f'<path d="M{numbers[0]} {numbers[1]}{curves}"/>\n')
        out.write('<path id="wanted" d="M0 0L1 1"/>\n</svg>\n')


def make_stl(file, size):
    """A height field, binary."""
    side = int(math.sqrt(size / 100))
    height = lambda i, j: math.sin(i / 50) + math.cos(j / 70)
    with file.open("wb") as out:
        out.write(b"\0" * 80 + struct.pack("<I", 2 * side * side))
        for i in range(side):
            for j in range(side):
                a, b, c, d = ((i + p, j + q, height(i + p, j + q))
                              for p, q in ((0, 0), (1, 0), (0, 1), (1, 1)))
                for corners in ((a, b, c), (b, d, c)):
                    out.write(struct.pack("<12fH", 0, 0, 1, *corners[0], *corners[1], *corners[2], 0))


def make_step(keyline, file, size):
    """Bicubic patches of 10 x 10 points, written by Keyline, 22 kB each."""
    chance = random.Random(1)
    knots = [0] * 4 + [1, 2, 3, 4, 5, 6] + [7] * 4
    patches = []
    for n in range(int(size / 22300)):
        points = [[[i, j, chance.random()] for j in range(10)] for i in range(10)]
        surface = {"type": "bspline-surface", "degree": [3, 3], "knots": [knots, knots],
                   "points": points}
        patches.append({"name": f"patch-{n + 1}", "surface": surface})
    source = file.with_suffix(".json")
    source.write_text(json.dumps({"unit": "mm", "surfaces": patches}))
    subprocess.run([keyline, "convert", source, "-o", file], check=True)


def measured(command, environment=None):
    """CPU seconds and MB of a command; None where it fails or takes too long."""
    process = subprocess.Popen(command, env=environment, stdin=subprocess.DEVNULL,
                               stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL,
                               preexec_fn=lambda: resource.setrlimit(
                                   resource.RLIMIT_CPU, (MOST_SECONDS, MOST_SECONDS)))
    _, status, usage = os.wait4(process.pid, 0)
    process.returncode = status
    if status != 0:
        return None
    return usage.ru_utime + usage.ru_stime, usage.ru_maxrss / 1024


def shown(result):
    return "fails" if result is None else f"{result[0]:.1f} s, {result[1]:.0f} MB"


def draw(folder, script):
    (folder / "script.tcl").write_text(f"pload MODELING XDE DATAEXCHANGE\n{script}\nexit\n")
    libraries = folder / "libraries"
    libraries.mkdir(exist_ok=True)
    for link in libraries.iterdir():
        link.unlink()
    return measured([draw_peer.PROGRAM, "-b", "-f", folder / "script.tcl"],
                    draw_peer.libraries(libraries))


def rows(keyline, folder, share):
    one = ["--quiet", "-o", folder / "one.json"]
    for megabytes in (25, 50, 100):
        file = folder / "big.svg"
        make_svg(file, megabytes * 1e6 * share)
        ours = measured([keyline, "convert", file, "--select", "wanted", *one])
        yield file, ours, "Inkscape", measured(["inkscape", "--query-all", file])
    for megabytes in (25, 50, 100):
        file = folder / "big.stl"
        make_stl(file, megabytes * 1e6 * share)
        ours = measured([keyline, "convert", file, "--section", "y=3.3", *one])
        yield file, ours, "DRAW", draw(folder, f"readstl s {file}")
    for megabytes in (12.5, 25, 50):
        file = folder / "big.step"
        make_step(keyline, file, megabytes * 1e6 * share)
        ours = measured([keyline, "convert", file, "--select", "patch-1", *one])
        yield file, ours, "DRAW", draw(folder, f"stepread {file} a *")


def main():
    share = float(sys.argv[2]) if len(sys.argv) > 2 else 1
    print("| file | MB | Keyline | another reader | which |\n|---|---|---|---|---|")
    with tempfile.TemporaryDirectory() as folder:
        for file, ours, which, theirs in rows(sys.argv[1], Path(folder), share):
            size = file.stat().st_size / 1e6
            print(" | ".join(["| " + file.suffix[1:].upper(), f"{size:.1f}", shown(ours),
                             shown(theirs), which + " |"]),
                  flush=True)


if __name__ == "__main__":
    main()
