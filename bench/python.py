"""The Python package beside the C++ it calls, and NumPy's exp beside both; python_bench.cpp has the C++
half. Needs the package: ./dev test or ./dev setup python first."""

import json
import os
import sys
import time
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]
for folder in (os.environ.get("KEYLINE_BUILD", ""), ROOT / "build" / "bench", ROOT / "build" / "release"):
    sys.path.append(str(Path(folder) / "bindings" / "python"))
try:
    import numpy as np

    import keyline
except ImportError as missing:
    print(f"python.py: {missing}", file=sys.stderr)
    sys.exit(77)


def best(work, times=7):
    """The least of several runs: what the machine can do."""
    took = []
    for _ in range(times):
        start = time.perf_counter()
        work()
        took.append(time.perf_counter() - start)
    return min(took)


def tell(name, peer, seconds):
    print(json.dumps({"name": name, "peer": peer, "seconds": seconds}))


random = np.random.default_rng(1)
handles = np.tile([[0.0, 0], [2, 0], [3.2, 1.2]], (100_000, 1, 1))
handles[:, 1] += random.uniform(-0.1, 0.1, (100_000, 2))
tell("python_segments/100000", "Python", best(lambda: keyline.lac.segments(handles, -1.0, threads=1)))

piece = {"alpha": 0.5, "length": 3, "curvature": [0.2, 2]}
curve = keyline.Curve({"type": "log-aesthetic", "start": [0, 0], "direction": 0, "pieces": [piece]})
at = np.arange(1_000_000) * 3e-6
tell("python_curvatures/1000000", "Python", best(lambda: curve.curvature(at)))
tell("python_curvatures/1000000", "NumPy's exp", best(lambda: np.exp(at)))
