#!/usr/bin/env python3
"""What editing many patches does to the joints between them: one row of a Markdown table per file.

usage: joints.py KEYLINE FILE… [-- OPTION…]   options go to `keyline edit`, as --joints G2
"""

import json
import os
import subprocess
import sys
import time


def total(surfaces, when):
    return sum(s[when]["sav"] for s in surfaces if when in s)


def row(keyline, file, options):
    start = time.monotonic()
    run = subprocess.run([keyline, "edit", file, "--json", *options], capture_output=True, text=True)
    seconds = time.monotonic() - start
    name = os.path.basename(file)
    if run.returncode != 0:
        return f"| `{name}` | {run.stderr.strip().splitlines()[-1].removeprefix('keyline: ')} |"
    answer = json.loads(run.stdout)
    surfaces = [answer] if "before" in answer else answer["surfaces"]
    joints = answer["joints"]
    before, after = joints["before"], joints["after"]
    patches = sum(len(s.get("patch_edits", [s])) for s in surfaces)
    orders = " | ".join(f"{before[g]} to {after[g]}" for g in ("G0", "G1", "G2"))
    departure = max((s["departure"] for s in surfaces if "departure" in s), default=0)
    return (f"| `{name}` | {patches} | {before['joints']} | {total(surfaces, 'before'):.5g} | "
            f"{total(surfaces, 'after'):.5g} | {departure:.3g} | {orders} | {joints['lost']} | {seconds:.1f} |")


def main():
    words = sys.argv[1:]
    options = words[words.index("--") + 1:] if "--" in words else []
    files = words[1:words.index("--")] if "--" in words else words[1:]
    if not files:
        sys.exit(__doc__)
    print("| file | patches | joints | SAV before | after | departure | G0 | G1 | G2 | lost | s |")
    print("|---|---|---|---|---|---|---|---|---|---|---|")
    for file in files:
        print(row(words[0], file, options), flush=True)


if __name__ == "__main__":
    main()
