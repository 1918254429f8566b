#!/usr/bin/env python3
"""Peer of sketch_bench.cpp: potrace (Debian), a process of its own, on the ink of the same drawing."""

import json
import shutil
import subprocess
import sys
import tempfile
import time

try:
    import numpy as np
except ImportError as missing:
    print(f"bench: {missing}; ./dev setup bench installs it", file=sys.stderr)
    sys.exit(77)


def bitmap(megapixels):
    """PBM bytes of the drawing of sketch_bench.cpp, ink where it covers half a pixel."""
    height = round((megapixels * 1e6 / 1.5) ** 0.5)
    width = height * 3 // 2
    u = np.fmod(np.arange(width) + 0.5, 400)[None, :] - 200
    rows = []
    for start in range(0, height, 256):
        y = np.arange(start, min(start + 256, height)) + 0.5
        v = np.fmod(y, 400)[:, None] - 200
        ring = np.abs(np.hypot(u, v) - 150)
        wave = np.where(np.abs(u) < 120, np.abs(v - 60 * np.sin(0.02 * u)), 99.0)
        rows.append(np.packbits(np.minimum(ring, wave) < 2.0, axis=1))
    return b"P4\n%d %d\n" % (width, height) + np.concatenate(rows).tobytes()


def main():
    if not shutil.which("potrace"):
        print("bench: no potrace; ./dev setup bench installs it", file=sys.stderr)
        sys.exit(77)
    for megapixels in (2, 8, 32):
        with tempfile.NamedTemporaryFile(suffix=".pbm") as file:
            file.write(bitmap(megapixels))
            file.flush()
            best = min(timed(["potrace", "-s", "-o", "/dev/null", file.name]) for _ in range(3))
        row = {"name": f"sketch_whole/{megapixels}", "peer": "potrace", "seconds": best}
        print(json.dumps(row), flush=True)


def timed(command):
    start = time.perf_counter()
    subprocess.run(command, check=True)
    return time.perf_counter() - start


if __name__ == "__main__":
    main()
