#!/usr/bin/env python3
"""table.py FOLDER [FILTER]: runs the benchmarks and their peers, prints one table.

Ours are the Google Benchmark programs FOLDER/*_bench, named "<subject>/<size>". A peer is a script
beside this file that prints one JSON object per line: {"name": "<subject>/<size>", "peer": who,
"seconds": time of one run}. A peer whose modules are missing says so on standard error and exits 77.
A peer that is a C++ library is a benchmark of the program itself, "<subject>/peer:<who>/<size>".
"""

import json
import re
import subprocess
import sys
from pathlib import Path

UNIT = {"ns": 1e-9, "us": 1e-6, "ms": 1e-3, "s": 1.0}


def ours(folder, pattern):
    """Seconds per run of every benchmark; the median where one was repeated."""
    seconds = {}
    for program in sorted(folder.glob("*_bench")):
        command = [program, "--benchmark_format=json", f"--benchmark_filter={pattern or '.'}"]
        result = subprocess.run(command, stdout=subprocess.PIPE, check=True, text=True)
        for row in json.loads(result.stdout or '{"benchmarks": []}')["benchmarks"]:
            if row.get("error_occurred"):
                print(f"bench: {row['name']}: {row['error_message']}", file=sys.stderr)
            elif row.get("aggregate_name", "median") == "median":
                name = re.sub(r"/(real_time|process_time|repeats:\d+|iterations:\d+)|_median", "",
                              row["name"])
                seconds[name] = row["real_time"] * UNIT[row["time_unit"]]
    return seconds


def take_peers(seconds):
    """Moves the peers among a program's own benchmarks to {name: [(peer, seconds), …]}."""
    found = {}
    for name in [name for name in seconds if "/peer:" in name]:
        who = re.search(r"/peer:([^/]*)", name)
        plain = name.replace(who.group(0), "")
        found.setdefault(plain, []).append((who.group(1), seconds.pop(name)))
    return found


def peers(pattern):
    """{name: [(peer, seconds), …]} of all peer scripts that can run here: NAME.py beside NAME_bench.cpp."""
    found = {}
    for bench in sorted(Path(__file__).resolve().parent.glob("*_bench.cpp")):
        script = bench.with_name(bench.name.removesuffix("_bench.cpp") + ".py")
        if not script.exists():
            continue
        result = subprocess.run([sys.executable, "-B", script], stdout=subprocess.PIPE, text=True)
        if result.returncode == 77:
            continue
        result.check_returncode()
        for line in result.stdout.splitlines():
            row = json.loads(line)
            if not pattern or re.search(pattern, row["name"]):
                found.setdefault(row["name"], []).append((row["peer"], row["seconds"]))
    return found


def time_text(seconds):
    for unit in ("ns", "us", "ms"):
        if seconds < 1000 * UNIT[unit]:
            return f"{seconds / UNIT[unit]:.3g} {unit}"
    return f"{seconds:.3g} s"


def sort_key(name):
    return [int(part) if part.isdigit() else 0 for part in name.split("/")], name


def main():
    pattern = sys.argv[2] if len(sys.argv) > 2 else ""
    mine, others = ours(Path(sys.argv[1]), pattern), peers(pattern)
    for name, rows in take_peers(mine).items():
        others.setdefault(name, []).extend(rows)
    table = [("what", "keyline", "peer", "its time", "ratio")]
    for name in sorted(mine, key=lambda n: (n.split("/")[0], sort_key(n))):
        peers_of_it = others.get(name) or [("", None)]
        for peer, seconds in peers_of_it:
            its_time = time_text(seconds) if seconds else ""
            ratio = f"{seconds / mine[name]:.2f}x" if seconds else ""
            table.append((name, time_text(mine[name]), peer, its_time, ratio))
    widths = [max(len(row[i]) for row in table) for i in range(5)]
    for row in table:
        print("  ".join(c.ljust(w) for c, w in zip(row, widths)).rstrip())
    for name in sorted(set(others) - set(mine)):
        print(f"bench: the peer's {name} has no counterpart here", file=sys.stderr)


if __name__ == "__main__":
    main()
