"""The measured profiles beside the project, and what is asked of the program about them."""

import json
import math
import os
import subprocess
from pathlib import Path

FOLDER = Path(__file__).resolve().parents[3] / "shared" / "data" / "1_profiles"
FEWEST = 20  # points: fewer tell no noise


class Absent(Exception):
    """The measured profiles are not beside this project."""


def numbers(line):
    """The numbers of a line of a table and the words before them."""
    words = line.replace(",", " ").replace(";", " ").split()
    values = []
    for word in words:
        try:
            values.append(float(word))
        except ValueError:
            values = []
    return words[: len(words) - len(values)], values


def table(path):
    """Curves of a file by name: columns x y, name x y, or x y and two widths of a track."""
    curves = {}
    for line in path.read_text(errors="replace").splitlines():
        if line.startswith("#"):
            continue
        words, values = numbers(line)
        name = words[0] if len(words) == 1 and len(values) == 2 else ""
        if (words and not name) or len(values) not in (2, 4):
            continue
        curves.setdefault(name, []).append(values[:2])
    for points in curves.values():  # Lednicer's form begins with how many points either side has
        if min(points[0]) > 1.5 and max(map(max, points[1:] or [[9, 9]])) <= 1.5:
            del points[0]
    return {name: points for name, points in curves.items() if len(points) >= FEWEST}


def all_profiles():
    """(name, points) of every curve: airfoils, outlines, tracks."""
    if not FOLDER.is_dir():
        raise Absent(f"{FOLDER} is not there")
    found = []
    for pattern in ("airfoil/*.dat", "contour/*.csv", "track/*.csv"):
        for path in sorted(FOLDER.glob(pattern)):
            for curve, points in table(path).items():
                found.append((f"{path.stem.removesuffix('_open')} {curve}".strip(), points))
    return found


def fair(program, points, **options):
    """What `fair` answers, with the processor's seconds under "seconds"; None where it refuses."""
    request = json.dumps({"op": "fair", "points": points, **options}) + "\n"
    child = subprocess.Popen([program, "batch"], stdin=subprocess.PIPE, stdout=subprocess.PIPE,
                             stderr=subprocess.DEVNULL, text=True)
    child.stdin.write(request)
    child.stdin.close()
    answer = child.stdout.read()
    _, _, used = os.wait4(child.pid, 0)
    child.returncode = 0
    answer = json.loads(answer)
    if not answer["ok"]:
        return None
    return {**answer["result"], "seconds": used.ru_utime + used.ru_stime}


def chain_of(result):
    """The answer's chain; None where corners part it or parts are kept as given."""
    curve = result["curve"]
    members = curve["curves"] if curve["type"] == "path" else [curve]
    return members[0] if len(members) == 1 and members[0]["type"] == "log-aesthetic" else None


def joints_of(result):
    """Where the pieces of a chain meet, a closed one's seam left out."""
    return [joint["position"] for joint in result["continuity"][: len(result["pieces"]) - 1]]


def spacing_at(points, place):
    """The wider of the gaps on either side of the point nearest to a place."""
    i = min(range(len(points)), key=lambda j: math.dist(points[j], place))
    gaps = [math.dist(points[j], points[j + 1]) for j in (i - 1, i) if 0 <= j < len(points) - 1]
    return max(gaps)
