#!/usr/bin/env python3
"""What editing many patches does to the joints between them: one row of a Markdown table per file.
Folds and breaks of the zebra (whatever the light) in degrees, before and after.

usage: joints.py KEYLINE FILE… [-- OPTION…]   options go to `keyline edit`, as --joints G2
"""

import json
import math
import os
import subprocess
import sys
import time


def total(surfaces, when):
    return sum(s[when]["sav"] for s in surfaces if when in s)


def degrees(radians):
    """Rounding of doubles is no fold."""
    return f"{0 if radians < 1e-9 else math.degrees(radians):.3g}"


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
    zebra = " | ".join(f"{degrees(before['zebra'][w])} to {degrees(after['zebra'][w])}"
                       for w in ("mean_jump", "jump", "mean_turn", "turn"))
    orders = " | ".join(f"{before[g]} to {after[g]}" for g in ("G0", "G1", "G2"))
    departure = max((s["departure"] for s in surfaces if "departure" in s), default=0)
    return (f"| `{name}` | {patches} | {before['joints']} | {total(surfaces, 'before'):.5g} | "
            f"{total(surfaces, 'after'):.5g} | {departure:.3g} | {orders} | {joints['lost']} | "
            f"{degrees(before['angle'])} to {degrees(after['angle'])} | {zebra} | {seconds:.1f} |")


def main():
    words = sys.argv[1:]
    options = words[words.index("--") + 1:] if "--" in words else []
    files = words[1:words.index("--")] if "--" in words else words[1:]
    if not files:
        sys.exit(__doc__)
    print("| file | patches | joints | SAV before | after | departure | G0 | G1 | G2 | lost | fold | "
          "zebra jumps | at most | turns | at most | s |")
    print("|---" * 16 + "|")
    for file in files:
        print(row(words[0], file, options), flush=True)


if __name__ == "__main__":
    main()
