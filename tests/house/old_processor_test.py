"""old_processor_test.py KEYLINE ROOT: the same binary on a processor without AVX2 (qemu's Nehalem, of 2008) gives
the same answers. Skipped (77) without qemu-x86_64-static."""

import json
import os
import shutil
import subprocess
import sys

QEMU = shutil.which("qemu-x86_64-static")
if not QEMU or os.uname().machine != "x86_64":
    print("skipped: qemu-x86_64-static is not installed (Debian: qemu-user-static)")
    sys.exit(77)
keyline, root = sys.argv[1:]
# The system's sines and logarithms differ in the last digit, too, and the search for the faired chain ends within
# 1e-9 of its size. Next to 0 a digit of the numbers around counts, which are up to some thousand.
RELATIVE, NEAR_ZERO = 1e-9, 1e-11


def ask(where, *request):
    done = subprocess.run([*where, keyline, *request], capture_output=True, text=True, cwd=root)
    return done.returncode, done.stdout, done.stderr


def differences(a, b, path=""):
    if isinstance(a, dict) and isinstance(b, dict) and a.keys() == b.keys():
        for key in a:
            yield from differences(a[key], b[key], f"{path}.{key}")
    elif isinstance(a, list) and isinstance(b, list) and len(a) == len(b):
        for i, (x, y) in enumerate(zip(a, b)):
            yield from differences(x, y, f"{path}[{i}]")
    elif isinstance(a, float) and isinstance(b, (float, int)) or isinstance(b, float) and isinstance(a, int):
        if abs(a - b) > RELATIVE * max(abs(a), abs(b)) + NEAR_ZERO:
            yield f"{path}: {a} {b}"
    elif a != b:
        yield f"{path}: {a} {b}"


old = [QEMU, "-cpu", "Nehalem"]
status, _, said = ask(["env", "KEYLINE_SIMD=avx2", *old], "draw", "--points", "0,0", "2,0", "3,1.5", "--alpha", "0.5")
found = [] if status == 2 and "this processor has scalar, sse2" in said else [f"AVX2 there: {status} {said}"]
for request in (["draw", "--points", "0,0", "2,0", "3,1.5", "--alpha", "0.5", "--json"],
                ["fair", "examples/bonnet-scan.csv", "--quiet", "--json"]):
    there, here = ask(old, *request), ask([], *request)
    if (there[0], here[0]) != (0, 0):
        found.append(f"{request}: {there[0]} {there[2]} {here[0]} {here[2]}")
    else:
        found += differences(json.loads(there[1])["curve"], json.loads(here[1])["curve"])
print("\n".join(found[:20]))
sys.exit(1 if found else 0)
