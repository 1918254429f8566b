#!/usr/bin/env python3
"""mutate.py ROOT [ROOM…] [--sites N] [--jobs N] [--page FILE]: do the tests notice?

Puts one fault at a time into the sources of a room (an operator, a constant or a condition turned),
builds the room's tests, runs them and names the faults they let pass. Works in a copy of the tree
under build/mutate, so that nothing is left behind. Deterministic: the same tree gives the same
faults in the same order, N of them spread over the room by a hash of their place.

A fault that does not compile counts for nothing. A survivor may be explained in
tests/house/mutants_explained.txt (file | line | change | why): it then counts as explained.
"""
import argparse
import hashlib
import os
import pathlib
import re
import shutil
import subprocess
import sys
import time

ROOMS = ["numeric", "curve", "lac", "classa", "fit", "fairing", "exchange"]

# What stands in the text, what takes its place. clang-format sets blanks around binary operators and
# none around templates and pointers, which is what makes plain patterns safe.
SWAPS = [
    (" < ", " <= "), (" <= ", " < "), (" > ", " >= "), (" >= ", " > "),
    (" == ", " != "), (" != ", " == "), (" && ", " || "), (" || ", " && "),
    (" + ", " - "), (" - ", " + "), (" * ", " / "), (" / ", " * "),
    (" += ", " -= "), (" -= ", " += "), (" *= ", " /= "), (" /= ", " *= "),
    ("std::min(", "std::max("), ("std::max(", "std::min("),
    ("return true;", "return false;"), ("return false;", "return true;"),
]
NUMBER = re.compile(r"(?<![\w.\"'])(\d+\.\d*(?:e[+-]?\d+)?|\d+e[+-]?\d+|\d+)(?![\w.\"'])")
CONDITION = re.compile(r"\bif \((?!const|auto|!)")


def blanked(text):
    """The text with comments, strings and preprocessor lines as blanks: same length, same lines."""
    pattern = re.compile(
        r'//[^\n]*|/\*.*?\*/|R"\((?:.*?)\)"|"(?:\\.|[^"\\\n])*"|\'(?:\\.|[^\'\\\n])*\'|^[ \t]*#[^\n]*',
        re.S | re.M)
    return pattern.sub(lambda m: re.sub(r"[^\n]", " ", m.group()), text)


def matching(text, at):
    """Place of the bracket that closes the one at `at`; -1 where there is none."""
    depth = 0
    for i in range(at, len(text)):
        depth += (text[i] == "(") - (text[i] == ")")
        if depth == 0:
            return i
    return -1


def sites_of(path, text):
    """Every fault the file can have: (start, end, replacement)."""
    code = blanked(text)
    found = []
    for old, new in SWAPS:
        for m in re.finditer(re.escape(old), code):
            found.append((m.start(), m.end(), new))
    for m in NUMBER.finditer(code):
        line = code[code.rfind("\n", 0, m.start()) + 1:code.find("\n", m.end())]
        if re.search(r"\b(static_assert|template|case)\b", line):
            continue
        old = m.group()
        new = str(int(old) + 1) if old.isdigit() else f"(2 * {old})"
        if not old.isdigit() and float(old) == 0:
            new = "1.0"
        found.append((m.start(), m.end(), new))
    for m in CONDITION.finditer(code):
        close = matching(code, m.end() - 1)
        inner = text[m.end():close]
        if close > 0 and ";" not in inner and "=" not in re.sub(r"[=!<>]=", "", inner):
            found.append((m.end(), close, f"!({inner})"))
    return [(path, *site) for site in found]


def chosen(sites, count, root):
    def key(site):
        path, start, end, new = site
        name = f"{path.relative_to(root)}:{start}:{new}"
        return hashlib.sha256(name.encode()).hexdigest()
    return sorted(sites, key=key)[:count] if count else sorted(sites, key=key)


class Copy:
    """A tree of its own with a build folder of its own."""

    def __init__(self, root, jobs):
        self.root = root
        self.jobs = jobs
        self.tree = root / "build" / "mutate" / "tree"
        self.build = self.tree / "build" / "release"  # as in every tree: a compiler's cache knows it

    def refresh(self):
        self.tree.mkdir(parents=True, exist_ok=True)
        files = subprocess.run(["git", "ls-files", "-co", "--exclude-standard"], cwd=self.root,
                               check=True, capture_output=True, text=True).stdout.split("\n")
        for name in filter(None, files):
            source, target = self.root / name, self.tree / name
            if not source.is_file():
                continue
            if target.exists() and target.read_bytes() == source.read_bytes():
                continue
            target.parent.mkdir(parents=True, exist_ok=True)
            shutil.copy2(source, target)

    def configure(self):
        shared = self.tree.parent / "shared"  # beside the tree, as with the tree itself
        if not shared.is_symlink() and (self.root.parent / "shared").exists():
            shared.symlink_to(self.root.parent / "shared")
        if (self.build / "build.ninja").exists():
            return
        launcher = ["-DCMAKE_CXX_COMPILER_LAUNCHER=ccache"] if shutil.which("ccache") else []
        subprocess.run(["cmake", "--preset", "release", *launcher], cwd=self.tree, check=True,
                       stdout=subprocess.DEVNULL)

    def make(self, target):
        return subprocess.run(["ninja", "-C", self.build, "-j", str(self.jobs), target],
                              stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)

    def test(self, room, seconds):
        program = self.build / "tests" / room / f"keyline_{room}_tests"
        began = time.monotonic()
        try:
            run = subprocess.run([program, "--gtest_brief=1", "--gtest_fail_fast"], timeout=seconds,
                                 stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
            return run.returncode == 0, time.monotonic() - began
        except subprocess.TimeoutExpired:
            return False, time.monotonic() - began


def explanations(root):
    file = root / "tests" / "house" / "mutants_explained.txt"
    known = {}
    for line in file.read_text().splitlines() if file.exists() else []:
        if line.strip() and not line.startswith("#"):
            parts = [part.strip() for part in line.split(" | ")]
            known[tuple(parts[:3])] = parts[3]
    return known


def told(root, text, site):
    """(file, line as it is, change) of a fault, for people and for explanations."""
    path, start, end, new = site
    begin = text.rfind("\n", 0, start) + 1
    line = text[begin:text.find("\n", start)].strip()
    return (str(path.relative_to(root)), line.replace("|", "¦"),
            f"{text[start:end].strip()} → {new.strip()}".replace("\n", " ").replace("|", "¦"))


def run_room(copy, room, count, report):
    root = copy.tree
    sites = []
    for path in sorted((root / "keyline" / room).rglob("*")):
        if path.suffix in (".cpp", ".h") and "occt" not in path.parts:
            sites += sites_of(path, path.read_text())
    target = f"keyline_{room}_tests"
    if copy.make(target).returncode != 0:
        sys.exit(f"mutate: {target} does not build")
    sound, seconds = copy.test(room, 3600)
    if not sound:
        sys.exit(f"mutate: the tests of {room} fail without any fault")
    known = explanations(copy.root)
    result = {"room": room, "sites": len(sites), "killed": 0, "stillborn": 0, "explained": [],
              "survivors": []}
    for site in chosen(sites, count, root):
        path, start, end, new = site
        text = path.read_text()
        name = told(root, text, site)
        try:
            path.write_text(text[:start] + new + text[end:])
            built = copy.make(target).returncode == 0
            passed = built and copy.test(room, 30 + 5 * seconds)[0]
        finally:
            path.write_text(text)
        if not built:
            outcome = "stillborn"
            result["stillborn"] += 1
        elif not passed:
            outcome = "killed"
            result["killed"] += 1
        elif name in known:
            outcome = "explained"
            result["explained"].append((*name, known[name]))
        else:
            outcome = "SURVIVED"
            result["survivors"].append(name)
        print(f"{room}: {outcome:9} {name[0]}: {name[1]} [{name[2]}]", file=report, flush=True)
    copy.make(target)
    return result


def page_of(results):
    lines = ["| room | places | tried | killed | explained | survived | share |",
             "|---|---:|---:|---:|---:|---:|---:|"]
    for r in results:
        tried = r["killed"] + len(r["explained"]) + len(r["survivors"])
        share = 100 * r["killed"] / tried if tried else 0
        lines.append(f"| `{r['room']}` | {r['sites']} | {tried} | {r['killed']} | "
                     f"{len(r['explained'])} | {len(r['survivors'])} | {share:.0f} % |")
    for title, kind in (("Survivors", "survivors"), ("Explained", "explained")):
        lines += ["", f"## {title}", ""]
        rows = [row for r in results for row in r[kind]]
        lines += [f"- `{row[0]}`: `{row[1]}` ({row[2]})" + (f": {row[3]}" if len(row) > 3 else "")
                  for row in rows] or ["None."]
    return "\n".join(lines) + "\n"


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("root", type=pathlib.Path)
    parser.add_argument("rooms", nargs="*", default=ROOMS)
    parser.add_argument("--sites", type=int, default=40, help="faults a room, 0: all")
    parser.add_argument("--jobs", type=int, default=os.cpu_count())
    parser.add_argument("--page", type=pathlib.Path, help="where the table goes too")
    options = parser.parse_args()
    copy = Copy(options.root.resolve(), options.jobs)
    copy.refresh()
    copy.configure()
    results = [run_room(copy, room, options.sites, sys.stderr) for room in options.rooms or ROOMS]
    page = page_of(results)
    print(page, end="")
    if options.page:
        options.page.write_text(page)
    return 1 if any(r["survivors"] for r in results) else 0


if __name__ == "__main__":
    sys.exit(main())
