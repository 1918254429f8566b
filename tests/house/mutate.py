#!/usr/bin/env python3
"""mutate.py ROOT [ROOM…] [--sample N] [--seed N] [--only TEXT] [--within SECONDS] [--jobs N]
[--page FILE]: do the tests notice?

Puts one fault at a time into the sources of a room (an operator, a constant or a condition turned),
builds the room's tests, runs them, the quickest first, until one fails, and names the faults they
let pass. Works in a copy of the tree for each room
under build/mutate, so that nothing is left behind and rooms may run side by side.
Deterministic: the same tree and seed give the same faults in the same order, N of them spread over
the room by a hash of their place. --only tries those faults of the sample again whose file, line or
change holds TEXT. --within asks the tests alone that take no longer than SECONDS each.

A fault that does not compile counts for nothing. One that is explained in
tests/house/mutants_explained.txt (file | line | change | why) is not tried: it counts as explained.
"""
import argparse
import fcntl
import hashlib
import json
import os
import pathlib
import re
import resource
import shutil
import signal
import subprocess
import sys
import tempfile

HUGE = 1e300  # seconds
MOST_MEMORY = 8 << 30  # address space of a test run; no sound one comes near
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
            if old == " + " and '"' in (text[m.start() - 1], text[m.end()]):
                continue  # of texts: nothing else would compile
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


def chosen(sites, count, seed, root):
    def key(site):
        path, start, end, new = site
        name = f"{path.relative_to(root)}:{start}:{new}" + (f":{seed}" if seed else "")
        return hashlib.sha256(name.encode()).hexdigest()
    return sorted(sites, key=key)[:count] if count else sorted(sites, key=key)


class Copy:
    """A tree of its own for a room, with a build folder of its own: rooms may run side by side."""

    def __init__(self, root, room, jobs):
        self.root = root
        self.room = room
        self.jobs = jobs
        self.tree = root / "build" / "mutate" / room / "tree"
        self.build = self.tree / "build" / "release"  # as in every tree: a compiler's cache knows it
        self.said = ""  # by the last run of ninja
        self.tree.mkdir(parents=True, exist_ok=True)
        self.lock = open(self.tree.parent / "lock", "w")
        try:
            fcntl.flock(self.lock, fcntl.LOCK_EX | fcntl.LOCK_NB)
        except BlockingIOError:
            sys.exit(f"mutate: another run is at work in {self.tree.parent}")

    def refresh(self):
        """The tree as it is now. What changes is newer than anything built from what it was, and
        what is gone from the tree goes from the copy too."""
        listed = subprocess.run(["git", "ls-files", "-co", "--exclude-standard"], cwd=self.root,
                                check=True, capture_output=True, text=True).stdout.split("\n")
        files = {name for name in listed if name and (self.root / name).is_file()}
        for name in files:
            source, target = self.root / name, self.tree / name
            if target.is_file() and target.read_bytes() == source.read_bytes():
                continue
            target.parent.mkdir(parents=True, exist_ok=True)
            shutil.copyfile(source, target)
            shutil.copymode(source, target)
        for folder in self.tree.iterdir():
            if not folder.is_dir() or folder == self.build.parent:
                continue
            for path in list(folder.rglob("*")):
                if path.is_file() and str(path.relative_to(self.tree)) not in files:
                    path.unlink()

    def configure(self):
        """The room is compiled file by file, for one is compiled for each fault, and at -O1, which
        takes half the time of -O3. The others are as in every tree: a compiler's cache knows them."""
        shared = self.tree.parent / "shared"  # beside the tree, as with the tree itself
        if not shared.is_symlink() and (self.root.parent / "shared").exists():
            shared.symlink_to(self.root.parent / "shared")
        if (self.build / "build.ninja").exists():
            return
        launcher = ["-DCMAKE_CXX_COMPILER_LAUNCHER=ccache"] if shutil.which("ccache") else []
        subprocess.run(["cmake", "--preset", "release", "-DKEYLINE_UNITY=ON",
                        f"-DKEYLINE_APART=keyline_{self.room}", *launcher],
                       cwd=self.tree, check=True, stdout=subprocess.DEVNULL)

    def make(self, target, faulty=False):
        # A compiler's cache gives back what is sound and keeps nothing that is not.
        environment = {**os.environ, **({"CCACHE_READONLY": "1"} if faulty else {})}
        run = subprocess.run(["ninja", "-C", self.build, "-j", str(self.jobs), target],
                             env=environment, stdout=subprocess.PIPE, stderr=subprocess.STDOUT,
                             text=True)
        self.said = run.stdout
        return run.returncode == 0


class Tests:
    """A room's tests in three parts, the quickest first, each with the time it takes when sound."""

    def __init__(self, copy, room, within):
        self.program = copy.build / "tests" / room / f"keyline_{room}_tests"
        times = self.kept(copy.tree.parent / "times.json", within)
        whole = sum(times.values())
        self.parts = []
        names, spent, part = [], 0.0, 0.0
        shares = [0.02, 0.2, 2]
        for name in sorted(times, key=times.get):
            if spent + times[name] > shares[0] * whole and names:
                self.parts.append((names, part))
                names, part = [], 0.0
                while spent + times[name] > shares[0] * whole:
                    shares.pop(0)
            names.append(name)
            spent += times[name]
            part += times[name]
        self.parts.append((names, part))

    def kept(self, file, within):
        """Seconds each test takes, from the last run of the very same program where there was one.
        Tests that took longer than `within` when last run are left out."""
        program = hashlib.sha256(self.program.read_bytes()).hexdigest()
        last = json.loads(file.read_text()) if file.exists() else {"program": "", "seconds": {}}
        seconds, longer = last["seconds"], {}
        if last["program"] != program or last.get("within", HUGE) < within:
            longer = {name: s for name, s in seconds.items() if s > within}
            seconds = {**self.recorded(longer), **longer}
            file.write_text(json.dumps({"program": program, "within": within if longer else HUGE,
                                        "seconds": seconds}))
        return {name: s for name, s in seconds.items() if s <= within}

    def recorded(self, without):
        """Seconds each test takes; ends the program where one fails without any fault."""
        with tempfile.TemporaryDirectory() as folder:
            told = pathlib.Path(folder) / "told.json"
            run = subprocess.run([self.program, "--gtest_brief=1", f"--gtest_output=json:{told}",
                                  "--gtest_filter=*-" + ":".join(without)],
                                 stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
            if run.returncode != 0:
                sys.exit(f"mutate: {self.program.name} fails without any fault:\n{run.stdout}")
            suites = json.loads(told.read_text())["testsuites"]
        return {f"{suite['name']}.{test['name']}": float(test["time"].rstrip("s"))
                for suite in suites for test in suite["testsuite"]}

    def notice(self):
        return not all(self.pass_part(names, seconds) for names, seconds in self.parts)

    def pass_part(self, names, seconds):
        """Time is the processor's: the answer must not depend on what else the machine does."""
        most = int(10 + 5 * seconds)

        def limit():
            resource.setrlimit(resource.RLIMIT_CPU, (most, most))
            resource.setrlimit(resource.RLIMIT_CORE, (0, 0))
            resource.setrlimit(resource.RLIMIT_AS, (MOST_MEMORY, MOST_MEMORY))
        command = [self.program, "--gtest_brief=1", "--gtest_fail_fast",
                   "--gtest_filter=" + ":".join(names)]
        try:
            return subprocess.run(command, timeout=60 + 20 * most, preexec_fn=limit,
                                  stdout=subprocess.DEVNULL,
                                  stderr=subprocess.DEVNULL).returncode == 0
        except subprocess.TimeoutExpired:
            return False


def bare(line):
    """A line of source without the comment behind it."""
    return re.sub(r"\s*//.*", "", line)


def explanations(root):
    file = root / "tests" / "house" / "mutants_explained.txt"
    known = {}
    for line in file.read_text().splitlines() if file.exists() else []:
        if line.strip() and not line.startswith("#"):
            parts = [part.strip() for part in line.split(" | ")]
            known[parts[0], bare(parts[1]), parts[2]] = parts[3]
    return known


def told(root, text, site):
    """(file, its line without a comment, change) of a fault, for people and for explanations. Of
    several of a kind in one line the second and those behind it are numbered."""
    path, start, end, new = site
    begin = text.rfind("\n", 0, start) + 1
    line = bare(text[begin:text.find("\n", start)].strip())
    before = text[begin:start].count(text[start:end])
    change = f"{text[start:end].strip()} → {new.strip()}" + (f" ({before + 1})" if before else "")
    return (str(path.relative_to(root)), line.replace("|", "¦"),
            change.replace("\n", " ").replace("|", "¦"))


def faults_of(root, room):
    sites = []
    for path in sorted((root / "keyline" / room).rglob("*")):
        if path.suffix in (".cpp", ".h") and "occt" not in path.parts:
            sites += sites_of(path, path.read_text())
    return sites


def outcome_of(copy, tests, target, site, text):
    path, start, end, new = site
    try:
        path.write_text(text[:start] + new + text[end:])
        if not copy.make(target, faulty=True):
            return "stillborn"
        return "killed" if tests.notice() else "survived"
    finally:
        path.write_text(text)


def run_room(room, options, report):
    copy = Copy(options.root.resolve(), room, options.jobs)
    copy.refresh()
    copy.configure()
    root = copy.tree
    target = f"keyline_{room}_tests"
    if not copy.make(target):
        sys.exit(f"mutate: {target} does not build\n{copy.said[-2000:]}")
    tests = Tests(copy, room, options.within)
    known = explanations(copy.root)
    sites = faults_of(root, room)
    stale = set(known) - {told(root, site[0].read_text(), site) for site in sites}
    for name in sorted(stale):
        if name[0].startswith(f"keyline/{room}/"):
            print(f"{room}: explained, but gone: {' | '.join(name)}", file=report, flush=True)
    result = {"room": room, "sites": len(sites), "stillborn": 0, "killed": 0, "explained": [],
              "survived": []}
    for site in chosen(sites, options.sample, options.seed, root):
        text = site[0].read_text()
        name = told(root, text, site)
        if not any(options.only in part for part in name):
            continue
        outcome = "explained" if name in known else outcome_of(copy, tests, target, site, text)
        if outcome == "explained":
            result[outcome].append((*name, known[name]))
        elif outcome == "survived":
            result[outcome].append(name)
        else:
            result[outcome] += 1
        print(f"{room}: {outcome:9} {name[0]}: {name[1]} [{name[2]}]", file=report, flush=True)
    copy.make(target)
    return result


def page_of(results):
    lines = ["| room | places | tried | killed | explained | survived | killed of the unexplained |",
             "|---|---:|---:|---:|---:|---:|---:|"]
    for r in results:
        tried = r["killed"] + len(r["explained"]) + len(r["survived"])
        open_ = tried - len(r["explained"])
        share = 100 * r["killed"] / open_ if open_ else 100
        lines.append(f"| `{r['room']}` | {r['sites']} | {tried} | {r['killed']} | "
                     f"{len(r['explained'])} | {len(r['survived'])} | {share:.0f} % |")
    for title, kind in (("Survivors", "survived"), ("Explained", "explained")):
        lines += ["", f"## {title}", ""]
        rows = [row for r in results for row in r[kind]]
        lines += [f"- `{row[0]}`: `{row[1]}` ({row[2]})" + (f": {row[3]}" if len(row) > 3 else "")
                  for row in rows] or ["None."]
    return "\n".join(lines) + "\n"


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("root", type=pathlib.Path)
    parser.add_argument("rooms", nargs="*", default=ROOMS)
    parser.add_argument("--sample", type=int, default=40, help="faults a room, 0: all")
    parser.add_argument("--seed", type=int, default=0, help="another sample")
    parser.add_argument("--only", default="", help="of the sample, what holds this text")
    parser.add_argument("--within", type=float, default=HUGE, help="seconds a test may take")
    parser.add_argument("--jobs", type=int, default=1, help="compilers at once")
    parser.add_argument("--page", type=pathlib.Path, help="where the table goes too")
    options = parser.parse_intermixed_args()
    signal.signal(signal.SIGTERM, lambda *_: sys.exit("mutate: ended"))  # what is changed goes back
    results = [run_room(room, options, sys.stderr) for room in options.rooms or ROOMS]
    page = page_of(results)
    print(page, end="")
    if options.page:
        options.page.write_text(page)
    return 1 if any(r["survived"] for r in results) else 0


if __name__ == "__main__":
    sys.exit(main())
