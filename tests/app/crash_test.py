#!/usr/bin/env python3
"""crash_test.py KEYLINE EXAMPLES [--kills N] [--full-disks N]: old file or new, never neither.

Runs every command that writes, kills it (SIGKILL) at a moment spread over the time it takes, or
gives it a disk (a small tmpfs; where none may be mounted, a limit of a file's size) that fills at a
place spread over what it writes. Afterwards every output holds what it held before or what an
undisturbed run writes, whole; a failure is one line and status 3; the next run leaves no litter. A
library keeps every design that `add` reported, and still takes new ones.

The moments and places are those of a sequence without chance: the same N, the same trials.
KEYLINE_FULL=1: 1,000 kills and 200 full disks.
"""
import argparse
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
import time

OLD = b"what was here before\n"
GOLDEN = 0.6180339887498949  # its multiples, less their whole parts, spread evenly


def spread(i):
    return (i * GOLDEN) % 1


class Command:
    """One command line; `outputs` are the names it writes in the working folder."""

    def __init__(self, words, outputs=(), text=None):
        self.words = words
        self.outputs = list(outputs)
        self.text = text  # for its standard input

    def line(self, program):
        return [program, *self.words, *(w for name in self.outputs for w in ("-o", name))]


def commands(examples):
    def e(name):
        return str(examples / name)

    written = json.dumps({"op": "document.write", "file": "a.json", "curves": [
        {"name": "a", "curve": {"type": "polyline", "points": [[0, 0], [1, 1], [2, 0]]}}]})
    return [
        Command(["fair", e("clothoid.csv")], ["a.svg", "b.html", "c.json", "d.png"]),
        Command(["draw", "--points", "0,0", "2,0", "3,1.5", "--alpha", "-1"], ["a.svg", "b.pdf"]),
        Command(["analyze", e("cubic.json")], ["a.html", "b.png"]),
        Command(["edit", e("cubic.json")], ["a.json", "b.svg"]),
        Command(["edit", e("panel-a.json")], ["a.json"]),
        Command(["sketch", e("sketch.png")], ["a.svg", "b.json"]),
        Command(["convert", e("roof.csv")], ["a.dxf", "b.csv", "c.svgz", "d.pdf"]),
        Command(["convert", e("cubic.json")], ["a.step", "b.iges"]),
        Command(["mirror", e("cubic.json")], ["a.svg"]),
        Command(["reverse", e("cubic.json")], ["a.json"]),
        Command(["offset", e("cubic.json"), "--distance", "0.01"], ["a.dxf"]),
        Command(["split", e("cubic.json"), "--at", "0.5"], ["a.json"]),
        Command(["trim", e("cubic.json"), "--from", "0.2"], ["a.glif"]),
        Command(["join", e("cubic.json"), e("cubic.json"), "--tolerance", "10"], ["a.svg"]),
        Command(["blend", e("cubic.json"), e("clothoid.csv")], ["a.svg", "b.dxf"]),
        Command(["lac.segment", "--points", "0,0", "2,0", "3,1.5", "--alpha", "-1"], ["a.json"]),
        Command(["raise", e("bottle-truth.json")], ["a.json"]),
        Command(["transform", e("cubic.json"), "--scale", "2"], ["a.glif", "b.csv"]),
        Command(["network", e("hood-along.json"), e("hood-across.json")], ["a.json", "b.step"]),
        Command(["batch"], text=written + "\n"),
    ]


def wrote(command):
    return command.outputs or ["a.json"]


def same(name, content, reference):
    """Whole and new: but for the hour a file tells of itself."""
    def plain(data):
        return re.sub(rb"\d{4}-\d\d-\d\dT\d\d:\d\d:\d\d|\d{8}\.\d{6}|15H\d{8}\.\d{6}", b"HOUR", data)
    if name.endswith((".step", ".iges", ".html")):
        return plain(content) == plain(reference) or (
            name.endswith(".html") and len(content) == len(reference))
    return content == reference


class Trials:
    def __init__(self, program, examples):
        self.program = str(program)
        self.commands = commands(examples)
        self.faults = []
        self.references = {}
        self.seconds = {}

    def start(self, command, folder, limit=None):
        def bound():
            if limit is not None:
                signal.signal(signal.SIGXFSZ, signal.SIG_IGN)
                resource.setrlimit(resource.RLIMIT_FSIZE, (limit, limit))
        process = subprocess.Popen(command.line(self.program), cwd=folder, stdin=subprocess.PIPE,
                                   stdout=subprocess.DEVNULL, stderr=subprocess.PIPE,
                                   preexec_fn=bound)
        try:
            process.stdin.write((command.text or "").encode())
            process.stdin.close()
        except BrokenPipeError:
            pass
        return process

    def run(self, command, folder, limit=None):
        process = self.start(command, folder, limit)
        said = process.stderr.read()
        process.stderr.close()
        return process.wait(), said.decode(errors="replace")

    def measure(self):
        for i, command in enumerate(self.commands):
            with tempfile.TemporaryDirectory() as folder:
                began = time.monotonic()
                status, said = self.run(command, folder)
                self.seconds[i] = time.monotonic() - began
                if status != 0:
                    sys.exit(f"{command.words} fails undisturbed: {said}")
                self.references[i] = {
                    name: pathlib.Path(folder, name).read_bytes() for name in wrote(command)}

    def fault(self, command, what):
        self.faults.append(f"{' '.join(command.words)}: {what}")
        print(f"FAULT {self.faults[-1]}", flush=True)

    def look(self, i, command, folder, may_be_old=True):
        for name in wrote(command):
            path = pathlib.Path(folder, name)
            if not path.exists():
                self.fault(command, f"{name} is gone")
                continue
            content = path.read_bytes()
            if not (may_be_old and content == OLD) and \
                    not same(name, content, self.references[i][name]):
                self.fault(command, f"{name} is neither old nor new ({len(content)} bytes)")

    def litter(self, command, folder):
        left = sorted(set(os.listdir(folder)) - set(wrote(command)))
        if left:
            self.fault(command, f"left {left}")

    def prepare(self, command, folder):
        for name in wrote(command):
            pathlib.Path(folder, name).write_bytes(OLD)

    def kill_once(self, n):
        i = n % len(self.commands)
        command = self.commands[i]
        with tempfile.TemporaryDirectory() as folder:
            self.prepare(command, folder)
            process = self.start(command, folder)
            time.sleep(1.1 * spread(n) * self.seconds[i])
            process.kill()
            process.stderr.read()
            process.stderr.close()
            killed = process.wait() == -signal.SIGKILL
            self.look(i, command, folder)
            status, said = self.run(command, folder)
            if status != 0:
                self.fault(command, f"the next run fails: {said}")
            self.look(i, command, folder, may_be_old=False)
            self.litter(command, folder)
        return killed

    def fill_once(self, n, disk):
        i = n % len(self.commands)
        command = self.commands[i]
        sizes = [len(c) for c in self.references[i].values()]
        with disk.of(int(1.2 * spread(n) * sum(sizes)), len(sizes)) as (folder, limit):
            self.prepare(command, folder)
            disk.fill(folder)
            status, said = self.run(command, folder, limit)
            disk.free(folder)
            self.look(i, command, folder)
            self.litter(command, folder)
            if command.text is None and status not in (0, 3):
                self.fault(command, f"status {status}: {said}")
            lines = [x for x in said.splitlines() if x.startswith("keyline: ")]
            if status == 3 and (not lines or len(said.splitlines()) != len(lines)):
                self.fault(command, f"says {said!r}")
        return status != 0 or command.text is not None

    def all_of(self, what, first, count, trial):
        """How many of the trials met what they were made for."""
        met = 0
        for n in range(first, first + count):
            met += trial(n)
            if (n - first) % 100 == 99:
                print(f"{what} {n + 1 - first} of {count}", flush=True)
        return met

    def kill_library(self, count):
        """`library add` killed: what was reported is there, and the file still works."""
        add = ["library", "add", str(self.examples_of_library()), "--library", "l.db"]
        with tempfile.TemporaryDirectory() as folder:
            began = time.monotonic()
            self.run(Command(add), folder)
            seconds = time.monotonic() - began
            for n in range(count):
                process = self.start(Command(add), folder)
                time.sleep(1.1 * spread(n) * seconds)
                process.kill()
                process.stderr.read()
                process.stderr.close()
                process.wait()
                status, said = self.run(Command(["library", "stats", "--library", "l.db"]), folder)
                if status != 0:
                    self.fault(Command(add), f"the library is lost: {said}")
            self.run(Command(add), folder)
            left = sorted(set(os.listdir(folder)) - {"l.db", "l.db-wal", "l.db-shm"})
            if left:
                self.fault(Command(add), f"left {left}")

    def examples_of_library(self):
        return next(w for w in self.commands[3].words if w.endswith("cubic.json"))


class Disk:
    """A disk that fills: a tmpfs of one's own, else a limit of the size of files."""

    def __init__(self):
        self.spare = 0
        probe = tempfile.mkdtemp()
        self.mounts = subprocess.run(["mount", "-t", "tmpfs", "-o", "size=64k", "tmpfs", probe],
                                     capture_output=True).returncode == 0
        if self.mounts:
            subprocess.run(["umount", probe], check=True)
        os.rmdir(probe)

    def of(self, spare, files):
        disk = self

        class Made:
            def __enter__(self):
                self.folder = tempfile.mkdtemp()
                disk.spare = spare
                if not disk.mounts:
                    return self.folder, spare // files
                size = spare + 65536 * (files + 2)
                subprocess.run(["mount", "-t", "tmpfs", "-o", f"size={size}", "tmpfs", self.folder],
                               check=True)
                return self.folder, None

            def __exit__(self, *_):
                if disk.mounts:
                    subprocess.run(["umount", "-l", self.folder], check=True)
                shutil.rmtree(self.folder, ignore_errors=True)

        return Made()

    def fill(self, folder):
        """All but so many bytes taken by a file of ours."""
        if not self.mounts:
            return
        at = os.statvfs(folder)
        taken = max(0, at.f_bavail * at.f_frsize - self.spare)
        pathlib.Path(folder, "ballast").write_bytes(bytes(taken))

    def free(self, folder):
        pathlib.Path(folder, "ballast").unlink(missing_ok=True)


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("program", type=pathlib.Path)
    parser.add_argument("examples", type=pathlib.Path)
    full = bool(os.environ.get("KEYLINE_FULL"))
    parser.add_argument("--kills", type=int, default=1000 if full else 20)
    parser.add_argument("--full-disks", type=int, default=200 if full else 20)
    parser.add_argument("--first", type=int, default=0, help="number of the first trial")
    options = parser.parse_args()
    trials = Trials(options.program.resolve(), options.examples.resolve())
    trials.measure()
    began = time.monotonic()
    killed = trials.all_of("kill", options.first, options.kills, trials.kill_once)
    trials.kill_library(max(2, options.kills // 20))
    disk = Disk()
    refused = trials.all_of("full disk", options.first, options.full_disks,
                            lambda n: trials.fill_once(n, disk))
    print(f"{len(trials.commands)} commands, {killed} killed of {options.kills} runs, "
          f"{max(2, options.kills // 20)} of a library, {refused} refused of {options.full_disks} "
          f"on {'full disks' if disk.mounts else 'files that may not grow'}; "
          f"{time.monotonic() - began:.0f} s, {len(trials.faults)} faults")
    return 1 if trials.faults else 0


if __name__ == "__main__":
    sys.exit(main())
