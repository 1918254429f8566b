"""An audit of many files on many machines: python -m keyline.audit [OPTIONS] GLOB…

Every file is measured by library.measure: each of its curves and surfaces with rhythm, slopes, CAV, SAV,
size. Tasks are named by the content they work on, so that a file is measured once however often it is
asked for, and a task that dies with its worker is simply run again: the table is the same as that of
--serial, byte for byte, in the order of the files' names.

  --scheduler tcp://…   a Dask scheduler; without it a cluster on this machine (--workers N of them)
  --serial              no Dask at all
  -o FILE               .csv (default: standard output), .parquet (needs pyarrow), or a design library
                        (any other name), which is added to and never holds a thing twice

The exit status is 0 also where files could not be read: the table has a row that says why.
"""

from __future__ import annotations

import argparse
import csv
import glob
import hashlib
import os
import sys
import time
from typing import Any, Iterable, Iterator

import keyline

COLUMNS = (
    "file", "number", "name", "layer", "kind", "unit", "size", "length", "volume", "rhythm", "slopes",
    "pieces", "lcg_variance", "self_affinity", "cav_type", "cav", "nearest_cav", "sav", "notes", "error",
)  # fmt: skip

# What a task is named by beside its content: another measure, another name.
VERSION = f"keyline-{keyline.__version__}-1"
# A worker that is killed takes its task's reputation with it; Dask gives up on a task after three. A file
# that kills its worker by itself is reported after so many.
DEATHS = 25
# A drawing of hundreds of curves takes minutes: its first task measures so many, those after it what
# takes so many seconds of the processor. Who is killed loses no more than that.
FIRST_PART = 32
SECONDS = 5.0


def content_key(path: str) -> str:
    """The name of the task that measures a file: its content, and how it is read (by its extension)."""
    digest = hashlib.sha256(VERSION.encode())
    digest.update(os.path.splitext(path)[1].lower().encode() + b"\0")
    with open(path, "rb") as file:
        for block in iter(lambda: file.read(1 << 20), b""):
            digest.update(block)
    return "keyline-audit-" + digest.hexdigest()


def measure(path: str, first: int = 0, most: int | None = None) -> dict[str, Any]:
    """The entries of a file from the one numbered `first` (0: all from the beginning) and at most so many,
    or why there are none. Runs on a worker; one thread, no memory of others."""
    fields = {"file": path, "first": first} | ({} if most is None else {"most": most})
    start = time.process_time()
    try:
        measured = {"entries": keyline.perform("library.measure", fields, threads=1)["entries"]}
    except keyline.Error as failure:
        measured = {"entries": [], "error": str(failure)}
    return measured | {"seconds": time.process_time() - start}


def main_piece(entry: dict[str, Any]) -> dict[str, Any]:
    """The longest piece: what a curve is called by."""
    pieces = entry.get("pieces", [])
    return max(pieces, key=lambda p: p["share"], default={})


def _text(value: Any) -> str:
    if value is None:
        return ""
    return repr(value) if isinstance(value, float) else str(value)


def rows_of(path: str, measured: dict[str, Any]) -> Iterator[dict[str, str]]:
    """The lines of the table for one file."""
    if "error" in measured:
        yield {"file": path, "error": measured["error"]}
    for number, entry in enumerate(measured["entries"], start=1):
        piece = main_piece(entry)
        row = {name: _text(entry.get(name)) for name in COLUMNS}
        row.update(file=path, number=str(number), pieces=str(len(entry.get("pieces", []))), error="")
        row.update(rhythm=piece.get("rhythm", ""), slopes=" ".join(map(repr, piece.get("slopes", []))))
        row.update(lcg_variance=_text(piece.get("lcg_variance")), self_affinity=_text(piece.get("self_affinity")))
        row.update(notes="; ".join(entry.get("notes", [])))
        yield row


class Table:
    """Rows into a file that is there whole or not at all."""

    def __init__(self, target: str | None) -> None:
        self.rows: list[dict[str, str]] = []
        self.target = target
        if target and target.endswith(".parquet"):
            _pyarrow()

    def add(self, path: str, measured: dict[str, Any]) -> None:
        """The rows of one file."""
        self.rows += rows_of(path, measured)

    def finish(self) -> None:
        """Written in the order of files and numbers, whatever order they came in."""
        self.rows.sort(key=lambda row: (row["file"], int(row.get("number") or 0)))
        if not self.target:
            return self._csv(sys.stdout)
        part = self.target + ".part"
        if self.target.endswith(".parquet"):
            columns = {name: [row.get(name, "") for row in self.rows] for name in COLUMNS}
            pyarrow = _pyarrow()
            pyarrow.parquet.write_table(pyarrow.table(columns), part)
        else:
            with open(part, "w", newline="", encoding="utf-8") as file:
                self._csv(file)
        os.replace(part, self.target)

    def _csv(self, file: Any) -> None:
        writer = csv.DictWriter(file, COLUMNS, restval="", lineterminator="\n")
        writer.writeheader()
        writer.writerows(self.rows)


def _pyarrow() -> Any:
    try:
        import pyarrow.parquet
    except ImportError:
        raise SystemExit("keyline.audit: Parquet needs pyarrow, which is not installed; write .csv") from None
    return pyarrow


class Shelf:
    """Entries into a design library; one file, one transaction."""

    def __init__(self, target: str) -> None:
        self.target = target
        self.failed: list[str] = []

    def add(self, path: str, measured: dict[str, Any]) -> None:
        """The entries of one file."""
        if "error" in measured:
            self.failed.append(f"{path}: {measured['error']}")
        elif measured["entries"]:
            fields = {"library": self.target, "entries": measured["entries"], "source": path}
            keyline.perform("library.add", fields)

    def finish(self) -> None:
        """What could not be read is told."""
        for line in sorted(self.failed):
            print(f"keyline.audit: {line}", file=sys.stderr)


def serial(paths: Iterable[str]) -> Iterator[tuple[str, dict[str, Any]]]:
    """One file after the other, here."""
    for path in paths:
        yield path, measure(path)


def distributed(paths: list[str], scheduler: str | None, workers: int) -> Iterator[tuple[str, dict[str, Any]]]:
    """The same on Dask, in the order in which they are done."""
    import dask
    from distributed import Client, LocalCluster, as_completed

    dask.config.set({"distributed.scheduler.allowed-failures": DEATHS})
    cluster = None
    if scheduler is None:
        cluster = LocalCluster(n_workers=workers, threads_per_worker=1, dashboard_address=None)
    try:
        client = Client(scheduler or cluster)
    except (OSError, ValueError) as error:
        raise SystemExit(f"keyline.audit: the scheduler cannot be reached: {error}") from None
    with client:
        same: dict[str, list[str]] = {}
        for path in paths:
            same.setdefault(content_key(path), []).append(path)

        found: dict[str, list[Any]] = {key: [] for key in same}

        def part(key: str, most: int) -> Any:
            first = len(found[key])
            name = f"{key}-{first}-{most}"
            return client.submit(measure, same[key][0], first, most, key=name, pure=True)

        running = as_completed([part(key, FIRST_PART) for key in same])
        for task in running:
            key, _, most = task.key.rsplit("-", 2)
            try:
                measured = task.result()
            except Exception as death:  # KilledWorker: the file took every worker with it
                measured = {"entries": [], "error": f"not measured: {type(death).__name__}"}
            task.release()
            found[key] += measured["entries"]
            if len(measured["entries"]) == int(most):
                running.add(part(key, max(1, int(int(most) * SECONDS / max(measured["seconds"], 1e-3)))))
                continue
            whole = {**measured, "entries": found.pop(key)}
            for path in same[key]:
                yield path, whole
    if cluster:
        cluster.close()


def files_of(patterns: list[str]) -> list[str]:
    """The files the patterns mean, each once, by name; ** goes into folders."""
    found = {f for pattern in patterns for f in glob.glob(pattern, recursive=True) if os.path.isfile(f)}
    return sorted(found)


def _at_least_one(text: str) -> int:
    if int(text) < 1:
        raise ValueError(text)
    return int(text)


def main(arguments: list[str] | None = None) -> int:
    """The command."""
    parser = argparse.ArgumentParser(prog="python -m keyline.audit", description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)  # fmt: skip
    parser.add_argument("pattern", nargs="+", metavar="GLOB")
    parser.add_argument("-o", "--output", metavar="FILE")
    parser.add_argument("--scheduler", metavar="ADDRESS")
    parser.add_argument("--workers", type=_at_least_one, default=os.cpu_count() or 1, metavar="N")
    parser.add_argument("--serial", action="store_true")
    told = parser.parse_args(arguments)
    paths = files_of(told.pattern)
    if not paths:
        print("keyline.audit: no file is meant by " + " ".join(told.pattern), file=sys.stderr)
        return 2
    if told.output and not os.access(os.path.dirname(os.path.abspath(told.output)), os.W_OK):
        # before the archive is measured, which takes hours
        print(f"keyline.audit: {told.output} cannot be written: no such folder, or not to write to", file=sys.stderr)
        return 3
    table = told.output is None or told.output.endswith((".csv", ".parquet"))
    sink: Table | Shelf = Table(told.output) if table else Shelf(told.output)
    run = serial(paths) if told.serial else distributed(paths, told.scheduler, told.workers)
    for done, (path, measured) in enumerate(run, start=1):
        sink.add(path, measured)
        if sys.stderr.isatty():
            print(f"\r{done} of {len(paths)} files", end="", file=sys.stderr)
    sink.finish()
    return 0


if __name__ == "__main__":
    sys.exit(main())
