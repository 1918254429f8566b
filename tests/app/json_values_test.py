#!/usr/bin/env python3
"""json_values_test.py KEYLINE EXAMPLES [FILE…] [--trials N] [--seed N]: JSON well formed and wrong.

Takes the example files and the requests that stand in the operations' schemas, and changes values
where they stand: numbers become huge, negative, nothing, text or null; lists are emptied, repeated,
turned round or cut; fields are swapped, renamed or left out. Whatever is made of that, a command
ends by itself within 20 s of the processor, with a status of its own (0, 1 or 2) and, where it
fails, with one line that begins with "keyline: "; nothing that was written holds a number that is
none, and a file is whole or what it was before (`fair` writes its best where none is near enough).
`batch` answers every request by one line.

One seed, one sequence of trials. KEYLINE_FULL=1: 3,000 of each kind. Further FILEs of JSON are taken too.
"""
import argparse
import copy
import json
import math
import os
import pathlib
import random
import re
import resource
import subprocess
import sys
import tempfile

OLD = "what was here before\n"
SECONDS = 20
MEMORY = 8 << 30
NUMBERS = [0, -1, 1, 1e-300, 1e300, -1e300, 1.7e308, 5e-324, 2**31, 2**63, -2**63, 1e15, 1e-9, 0.5]
OTHERS = [None, True, "", "nan", "Infinity", "1e5", [], {}, [None], [[]], [1], [1, 2, 3, 4], {"x": 1}]
# What `fair` says of a key-line that misses its tolerance or bounds: its best is written all the same.
BEST_ALL_THE_SAME = re.compile(r"^keyline: \S*: no chain found")
NO_NUMBER = re.compile(r"(?i)(?<![a-z_])[-+]?(nan|inf|infinity)(?![a-z_])")


def places(value, path=()):
    """Every place of a JSON value, as the keys that lead there."""
    found = [path]
    if isinstance(value, dict):
        inner = value.items()
    elif isinstance(value, list):
        inner = enumerate(value)
    else:
        return found
    for key, item in inner:
        found += places(item, (*path, key))
    return found


def other(dice):
    """One of OTHERS; a copy, since what is changed next may lie in it."""
    return copy.deepcopy(dice.choice(OTHERS))


def changed_number(number, dice):
    return dice.choice([
        lambda: dice.choice(NUMBERS), lambda: -number, lambda: number * 10 ** dice.randint(-12, 12),
        lambda: number * (1 + 1e-15), lambda: math.floor(number), lambda: other(dice)])()


def changed_list(items, dice):
    i = dice.randrange(len(items))
    return dice.choice([
        lambda: [], lambda: items[:1], lambda: items[:-1], lambda: items + items,
        lambda: items[::-1], lambda: [items[i]] * len(items), lambda: items[:i] + items[i + 1:],
        lambda: items[:i] + [items[i]] + items[i:], lambda: [items], lambda: items * 300,
        lambda: other(dice)])()


def changed_object(fields, dice):
    names = list(fields)
    a, b = dice.choice(names), dice.choice(names)

    def without():
        return {k: v for k, v in fields.items() if k != a}

    def swapped():
        return {**fields, a: fields[b], b: fields[a]}

    return dice.choice([without, swapped, lambda: {**without(), a + "_": fields[a]},
                        lambda: other(dice)])()


def changed_value(value, dice):
    if isinstance(value, list) and value:
        return changed_list(value, dice)
    if isinstance(value, dict) and value:
        return changed_object(value, dice)
    if isinstance(value, (int, float)) and not isinstance(value, bool):
        return changed_number(value, dice)
    return dice.choice([other(dice), dice.choice(NUMBERS), "a" * 1000, "../x"])


def changed(value, dice):
    """A copy of the value with one to three places changed."""
    value = copy.deepcopy(value)
    for _ in range(dice.choice([1, 1, 2, 3])):
        path = dice.choice(places(value))
        holder = {"": value}
        path = ("", *path)
        at = holder
        for key in path[:-1]:
            at = at[key]
        try:
            at[path[-1]] = changed_value(at[path[-1]], dice)
        except OverflowError:
            at[path[-1]] = 1e300
        value = holder[""]
    return value


def no_constant(name):
    raise ValueError(f"{name} is no number")


def strictly(text):
    return json.loads(text, parse_constant=no_constant)


def written(value):
    """JSON's text; a product that overflowed stands as a number no double holds."""
    text = json.dumps(value)
    return text.replace("-Infinity", "-1e999").replace("Infinity", "1e999").replace("NaN", "null")


def bound(sanitized):
    """Limits of a trial. A sanitizer takes addresses by the terabyte, and ten times as long."""
    seconds = 10 * SECONDS if sanitized else SECONDS
    resource.setrlimit(resource.RLIMIT_CPU, (seconds, seconds + 1))
    if not sanitized:
        resource.setrlimit(resource.RLIMIT_AS, (MEMORY, MEMORY))
    resource.setrlimit(resource.RLIMIT_CORE, (0, 0))


class Trials:
    def __init__(self, program, keep, sanitized):
        self.program = str(program)
        self.sanitized = sanitized
        self.keep = keep
        self.faults = 0
        self.statuses = {}
        self.slowest = (0, "")  # seconds of the processor, what was given

    def run(self, words, folder, text=None):
        before = resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime
        done = subprocess.run([self.program, *words], cwd=folder, input=text, capture_output=True,
                              text=True, errors="replace", timeout=600,
                              preexec_fn=lambda: bound(self.sanitized))
        seconds = resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime - before
        given = text or (pathlib.Path(folder) / "given.json").read_text()
        self.slowest = max(self.slowest, (seconds, f"{' '.join(words)}: {given}"))
        key = (words[0], done.returncode)
        self.statuses[key] = self.statuses.get(key, 0) + 1
        return done

    def fault(self, words, what, given):
        self.faults += 1
        place = ""
        if self.keep:
            self.keep.mkdir(parents=True, exist_ok=True)
            path = self.keep / f"{self.faults:03}.json"
            path.write_text(given)
            place = f" ({path})"
        print(f"FAULT {' '.join(words)}: {what}{place}\n  {given[:300]}", flush=True)

    def file_trial(self, given, name, dice):
        kind = dice.choice(["fair", "analyze", "convert", "convert"])
        ends = ["json", "svg", "dxf", "csv", "pdf"] if kind != "analyze" else ["json", "html"]
        words = [kind, "given.json", "--quiet", "-o", f"out.{dice.choice(ends)}"]
        if kind != "convert" and dice.random() < 0.5:
            words = [kind, "given.json", "--quiet", "--json"]
        text = written(given)
        with tempfile.TemporaryDirectory() as folder:
            folder = pathlib.Path(folder)
            (folder / "given.json").write_text(text)
            output = folder / words[-1] if words[-1] != "--json" else None
            if output:
                output.write_text(OLD)
            done = self.run(words, folder)
            for what in self.judged(done, output):
                self.fault(words, f"{name}: {what}", text)
            left = set(os.listdir(folder)) - {"given.json"} - ({output.name} if output else set())
            if left:
                self.fault(words, f"{name}: left {sorted(left)}", text)

    def judged(self, done, output):
        """What is wrong with how a command ended."""
        if done.returncode not in (0, 1, 2):
            yield f"status {done.returncode}, {done.stderr[-300:]!r}"
            return
        if done.returncode != 0:
            lines = done.stderr.splitlines()
            if len(lines) != 1 or not lines[0].startswith("keyline: "):
                yield f"says {done.stderr[:500]!r}"
            if done.returncode == 1 and BEST_ALL_THE_SAME.search(done.stderr):
                yield from self.no_number_that_is_none(done.stdout, output)
                return
            if done.stdout:
                yield "a failure that prints a result"
            if output and output.read_bytes() != OLD.encode():
                yield f"{output.name} is not what it was"
            return
        yield from self.no_number_that_is_none(done.stdout, output)

    def no_number_that_is_none(self, printed, output):
        try:
            if not output:
                strictly(printed)
            elif output.suffix == ".json":
                strictly(output.read_text())
        except ValueError as error:
            yield f"no JSON: {error}"
        if output:
            data = output.read_bytes()
            if data == OLD.encode() or not data:
                yield f"status 0, but {output.name} was not written"
            if output.suffix in (".svg", ".dxf", ".csv") and NO_NUMBER.search(data.decode()):
                yield f"{output.name} holds a number that is none"

    def batch_trial(self, requests):
        text = "".join(written(r) + "\n" for r in requests)
        with tempfile.TemporaryDirectory() as folder:
            done = self.run(["batch", "--quiet"], folder, text)
            answers = done.stdout.splitlines()
            if len(answers) != len(requests) or done.returncode not in (0, 1, 2):
                self.one_by_one(requests, done)
                return
            for request, answer in zip(requests, answers):
                self.judge_answer(request, answer)

    def one_by_one(self, requests, done):
        if len(requests) > 1:
            for request in requests:
                self.batch_trial([request])
        else:
            self.fault(["batch"], f"status {done.returncode}, {len(done.stdout.splitlines())} answers, "
                       f"{done.stderr[-300:]!r}", written(requests[0]))

    def judge_answer(self, request, answer):
        try:
            told = strictly(answer)
        except ValueError as error:
            self.fault(["batch"], f"no JSON: {error}", written(request))
            return
        if not isinstance(told, dict) or ("error" in told and not told["error"]):
            self.fault(["batch"], f"answers {answer[:200]}", written(request))


def requests_of(program):
    """The examples of all operations that neither read nor write files."""
    def of(*words):
        return json.loads(subprocess.run([program, "operations", *words], check=True,
                                         capture_output=True, text=True).stdout)
    requests = []
    for operation in of("--json"):
        if not operation["name"].startswith(("document.", "library.", "sketch.")):
            requests += of(operation["name"]).get("examples", [])
    return requests


def models_of(program, examples):
    """The example files of JSON, and what other commands make of examples: chains, splines, faces."""
    models = {path.name: json.loads(path.read_text()) for path in sorted(examples.glob("*.json"))}
    with tempfile.TemporaryDirectory() as folder:
        for name in ("clothoid.csv", "roof.csv", "outlines.csv"):
            subprocess.run([program, "fair", examples / name, "--quiet", "-o", "out.json"], cwd=folder,
                           check=True)
            models[f"fair {name}"] = json.loads(pathlib.Path(folder, "out.json").read_text())
    return models


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("program", type=pathlib.Path)
    parser.add_argument("examples", type=pathlib.Path)
    parser.add_argument("files", type=pathlib.Path, nargs="*")
    parser.add_argument("--trials", type=int, default=3000 if os.environ.get("KEYLINE_FULL") else 60)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--keep", type=pathlib.Path, help="a folder for what made a fault")
    parser.add_argument("--sanitized", action="store_true", help="the program is")
    options = parser.parse_args()
    dice = random.Random(options.seed)
    program = options.program.resolve()
    trials = Trials(program, options.keep and options.keep.resolve(), options.sanitized)
    models = models_of(program, options.examples.resolve())
    models.update({path.name: json.loads(path.read_text()) for path in options.files})
    requests = requests_of(program)
    names = sorted(models)
    for n in range(options.trials):
        name = names[n % len(names)]
        trials.file_trial(changed(models[name], dice), name, dice)
    at_once = 25
    for n in range(0, options.trials, at_once):
        trials.batch_trial([changed(requests[k % len(requests)], dice)
                            for k in range(n, min(n + at_once, options.trials))])
    print(f"{len(models)} files and {len(requests)} requests, {options.trials} trials of either; "
          f"statuses {dict(sorted(trials.statuses.items()))}; {trials.faults} faults; "
          f"slowest {trials.slowest[0]:.1f} s: {trials.slowest[1][:100]}")
    if trials.keep:
        trials.keep.mkdir(parents=True, exist_ok=True)
        (trials.keep / "slowest.txt").write_text(trials.slowest[1])
    return 1 if trials.faults else 0


if __name__ == "__main__":
    sys.exit(main())
