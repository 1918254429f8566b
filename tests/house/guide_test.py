"""guide_test.py ROOT KEYLINE [PAGE…]: every command and Python program of README and guide does what a reader sees.

Commands are the lines of blocks marked `sh` that start with `keyline` or `./dev run`, and those in the table of
examples; programs are the blocks marked `python` of pages about Python. Each page's run one after the other in a
folder of its own beside the examples; each must end with status 0 and write the files it names with -o.
With KEYLINE_TIMES set, each command's time is told. What the README counts under its picture is what `fair` counts.
Options that README and guide name in their text (`--tolerance 0.1`), or messages, are options of some command.
"""

import os
import pathlib
import re
import shlex
import subprocess
import sys
import tempfile
import time

root, keyline = pathlib.Path(sys.argv[1]).resolve(), pathlib.Path(sys.argv[2]).resolve()
PROGRAM = re.compile(r"^(?:keyline|\./dev run) ")
NOT_RUN = re.compile(r"^\S+(?: run)? studio ")  # serves until it is stopped: tests/studio
START = "```{}\n(.*?)^```$"


def pages():
    named = [root / page for page in sys.argv[3:]]
    others = [root / name for name in ("README.md", "examples/README.md", "bindings/python/README.md")]
    return named or [*others, *sorted((root / "docs").rglob("*.md"))]


def commands(text):
    for block in re.findall(START.format("sh"), text, re.S | re.M):
        yield from (line for line in block.replace("\\\n", " ").splitlines() if PROGRAM.match(line))
    yield from (c for c in re.findall(r"\| `(\./dev run [^`]*)` \|$", text, re.M))


def run(command, folder, environment):
    started = time.monotonic()
    done = subprocess.run(["bash", "-c", command], cwd=folder, env=environment, capture_output=True, text=True)
    if os.environ.get("KEYLINE_TIMES"):
        print(f"{time.monotonic() - started:6.2f} s  {command.splitlines()[0]}")
    return [] if done.returncode == 0 else [f"status {done.returncode}: {done.stderr.strip()[-300:]}"]


def unwritten(command, folder):
    words = shlex.split(command.split(">")[0], comments=True)
    made = [b for a, b in zip(words, words[1:]) if a in {"-o", "--overlay"} and not b.endswith(":-")]
    return [f"{name} was not written" for name in made if not (folder / name).is_file()]


def faults_of(page, environment):
    text = page.read_text()
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        (folder / "examples").symlink_to(root / "examples")
        for command in commands(text):
            if NOT_RUN.match(command):
                continue
            as_installed = command.replace("./dev run ", "keyline ")
            for fault in run(as_installed, folder, environment) + unwritten(as_installed, folder):
                yield f"{command}: {fault}"
        if "PYTHONPATH" in environment:
            for program in re.findall(START.format("python"), text, re.S | re.M):
                (folder / "program.py").write_text(program)
                for fault in run(f"{sys.executable} -B program.py", folder, environment):
                    yield f"Python of {page.name}: {fault}"


def miscounted():
    """What the README says came of the scan, and what does."""
    words = "zero one two three four five six seven eight nine ten eleven twelve thirteen fourteen fifteen".split()
    said = re.search(r"(\w+) strays dropped, (\w+) pieces out.*?(\w+) waves where.*?has (\w+)",
                     (root / "README.md").read_text(), re.S)
    command = [keyline, "fair", root / "examples/bonnet-scan.csv", "-o", "svg:-"]
    told = subprocess.run(command, capture_output=True, text=True).stderr
    counted = re.search(r"(\d+) stray points.*?(\d+) pieces in.*?comb: (\d+) waves.*?as near: (\d+) waves", told, re.S)
    if not said or not counted:
        return ["README.md: its counts, or those of `fair`, are not found"]
    numbers = [words.index(word) if word in words else word for word in said.groups()]
    return [] if numbers == [*map(int, counted.groups())] else [f"README.md counts {numbers}, `fair` {counted.groups()}"]


def named_options():
    """Where an option is named, and which: in inline code of pages, in the strings of sources."""
    for page in [root / "README.md", root / "docs/limits.md", *sorted((root / "docs/guide").glob("*.md"))]:
        yield from ((page, option) for option in re.findall(r"`(--[a-z][a-z-]*)", page.read_text()))
    for folder in ("keyline", "apps"):
        for source in sorted((root / folder).rglob("*.cpp")):
            for literal in re.findall(r'"((?:[^"\\\n]|\\.)*)"', source.read_text()):
                yield from ((source, option) for option in re.findall(r"(?<![\w<!-])--[a-z][a-z-]*", literal))


def unknown_options():
    """Those that no command has, nor has one that begins so."""
    completion = subprocess.run([keyline, "completion", "bash"], capture_output=True, text=True).stdout
    known = set(re.findall(r"--[a-z][a-z-]*", completion)) | {"--all"}  # of `keyline --help`
    if len(known) < 100:
        yield "keyline completion bash lists hardly any option"
    for place, option in named_options():
        meant = (option, option.replace("--no-", "--"))
        if not any(name.startswith(meant) for name in known):
            yield f"{place.relative_to(root)} names {option}, which no command has"


with tempfile.TemporaryDirectory() as programs:
    (pathlib.Path(programs) / "keyline").symlink_to(keyline)
    environment = os.environ | {"PATH": f"{programs}:{os.environ['PATH']}", "MPLBACKEND": "agg"}
    found = [f"{page.relative_to(root)}: {fault}" for page in pages() for fault in faults_of(page, environment)]
    found += [*miscounted(), *unknown_options()]
print("\n".join(found))
sys.exit(1 if found else 0)
