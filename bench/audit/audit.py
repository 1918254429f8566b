"""The audit of docs/design/batch.md over real files: ./dev bench audit [FOLDER] [SECONDS].

Every file of FOLDER (../shared/data unless given) is measured three ways: serially, on Dask with one
worker and with two, and with two of which one is killed every SECONDS (3 unless given). The tables must
be the same to the last byte. Exit status 1 where they are not, or where nobody was killed."""

import os
import random
import resource
import signal
import sys
import tempfile
import threading
import time
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(Path(os.environ.get("KEYLINE_BUILD", ROOT / "build" / "release")) / "bindings" / "python"))

import dask  # noqa: E402
import distributed  # noqa: E402

from keyline import audit  # noqa: E402


def processor():
    """Seconds of the processor this process and those it has waited for have had."""
    return sum(sum(resource.getrusage(who)[:2]) for who in (resource.RUSAGE_SELF, resource.RUSAGE_CHILDREN))


def table(paths, run, target):
    rows = audit.Table(str(target))
    for path, measured in run:
        rows.add(path, measured)
    rows.finish()
    return target.read_bytes()


class Killer:
    """Kills a worker every so many seconds until it is stopped."""

    def __init__(self, cluster, seconds):
        self.cluster, self.seconds, self.killed = cluster, seconds, 0
        self.stop = threading.Event()
        self.random = random.Random(1)
        self.thread = threading.Thread(target=self.run)
        self.thread.start()

    def run(self):
        while not self.stop.wait(self.seconds):
            there = [w for w in self.cluster.workers.values() if w.status.name == "running" and getattr(w, "pid", None)]
            if not there:
                continue
            try:
                os.kill(self.random.choice(there).pid, signal.SIGKILL)
                self.killed += 1
            except ProcessLookupError:
                pass

    def end(self):
        self.stop.set()
        self.thread.join()
        return self.killed


def on_dask(paths, workers, target, kill_every=None):
    """The table, and how often a worker was killed meanwhile."""
    with distributed.LocalCluster(n_workers=workers, threads_per_worker=1, dashboard_address=None) as cluster:
        cluster.scheduler.allowed_failures = audit.DEATHS
        start = time.perf_counter()
        killer = Killer(cluster, kill_every) if kill_every else None
        try:
            made = table(paths, audit.distributed(paths, cluster.scheduler_address, workers), target)
        finally:
            killed = killer.end() if killer else 0
        return made, time.perf_counter() - start, killed


def main():
    folder = Path(sys.argv[1]) if len(sys.argv) > 1 else ROOT.parent / "shared" / "data"
    seconds = float(sys.argv[2]) if len(sys.argv) > 2 else 3
    paths = audit.files_of([f"{folder}/**"])
    if not paths:
        print(f"audit.py: no file in {folder}", file=sys.stderr)
        return 1
    dask.config.set({"distributed.scheduler.allowed-failures": audit.DEATHS})
    here = Path(tempfile.mkdtemp())
    start, used = time.perf_counter(), processor()
    expected = table(paths, audit.serial(paths), here / "serial.csv")
    rows = expected.count(b"\n") - 1
    print(f"{len(paths)} files, {rows} rows; serially {time.perf_counter() - start:.1f} s, "
          f"{processor() - used:.1f} s of the processor")  # fmt: skip
    status = 0
    for workers, kill_every in ((1, None), (2, None), (2, seconds)):
        made, took, killed = on_dask(paths, workers, here / "dask.csv", kill_every)
        same = made == expected
        told = f", a worker killed {killed} times" if kill_every else ""
        print(f"{workers} workers{told}: {took:.1f} s, {'the same table' if same else 'ANOTHER TABLE'}", flush=True)
        if not same or (kill_every and killed == 0):
            status = 1
    return status


if __name__ == "__main__":
    sys.exit(main())
