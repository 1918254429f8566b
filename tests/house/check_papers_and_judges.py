#!/usr/bin/env python3
"""check_papers_and_judges.py ROOT: the two tables that promise to be whole are.

No cell of docs/papers.md is empty, and every operation on curves and surfaces has a row in
docs/accuracy.md that names a test.
"""
import pathlib
import re
import sys

root = pathlib.Path(sys.argv[1])
faults = []

for number, line in enumerate((root / "docs/papers.md").read_text().splitlines(), 1):
    if line.startswith("|") and not all(cell.strip() for cell in line.strip("|").split("|")):
        faults.append(f"docs/papers.md:{number}: an empty cell")

ROOMS = r"(?:lac|curve|fit|surface)"
named = re.compile(rf'\.name = "({ROOMS}\.\w+)"')
operations = {name for file in (root / "keyline/operations").glob("*.cpp")
              for name in named.findall(file.read_text())}
judged = set()
for line in (root / "docs/accuracy.md").read_text().splitlines():
    cells = line.strip("|").split("|") if line.startswith("|") else []
    if len(cells) != 5 or "." not in cells[3]:
        continue
    room = ""
    for word in re.findall(r"`([\w.]+)`", cells[0]):
        room = word.split(".")[0] if not word.startswith(".") else room
        judged.add(room + word if word.startswith(".") else word)
faults += [f"docs/accuracy.md: no row for {name}" for name in sorted(operations - judged)]
if not operations:
    sys.exit("no operation is declared below keyline/operations")
print("\n".join(faults))
sys.exit(1 if faults else 0)
