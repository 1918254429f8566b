"""The audit of docs/design/batch.md over real files: ./dev bench audit [FOLDER] [SECONDS].

Every file of FOLDER (../shared/data unless given) is measured three ways: serially, on Dask with one
worker and with two, and with two of which one is killed whenever the two have used SECONDS of the
processor (10 unless given; by the clock, a busy machine would kill what has hardly begun). The tables must be
the same to the last byte. Exit status 1 where they are not, or where nobody was killed."""

import os
import random
import resource
import subprocess
import sys
import tempfile
import threading
import time
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(Path(os.environ.get("KEYLINE_BUILD", ROOT / "build" / "release")) / "bindings" / "python"))

import distributed  # noqa: E402

from keyline import audit  # noqa: E402


# Here workers die far oftener than a file could be to blame for.
DEATHS = 1000


def processor():
    """Seconds of the processor this process and those it has waited for have had."""
    return sum(sum(resource.getrusage(who)[:2]) for who in (resource.RUSAGE_SELF, resource.RUSAGE_CHILDREN))


def used_by(process):
    """Seconds of the processor a running process has had, none once it is gone."""
    try:
        fields = Path(f"/proc/{process.pid}/stat").read_text().rpartition(")")[2].split()
    except OSError:
        return 0
    return (int(fields[11]) + int(fields[12])) / os.sysconf("SC_CLK_TCK")


def table(paths, run, target):
    rows = audit.Table(str(target))
    for path, measured in run:
        rows.add(path, measured)
    rows.finish()
    return target.read_bytes()


class Crew:
    """So many workers, each a process; who dies is replaced. One of them is killed whenever they have used
    `kill_every` seconds of the processor, where that is given."""

    def __init__(self, address, workers, kill_every=None):
        self.command = [sys.executable, "-m", "distributed.cli.dask_worker", address, "--nthreads", "1",
                        "--no-nanny", "--no-dashboard"]  # fmt: skip
        self.kill_every, self.killed = kill_every, 0
        self.stop = threading.Event()
        self.random = random.Random(1)
        self.processes = [self.hire() for _ in range(workers)]
        self.thread = threading.Thread(target=self.run)
        self.thread.start()

    def hire(self):
        path = os.pathsep.join(p for p in sys.path if p)
        return subprocess.Popen(self.command, env={**os.environ, "PYTHONPATH": path},
                                stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)  # fmt: skip

    def run(self):
        gone, due = 0, self.kill_every
        while not self.stop.wait(0.2):
            if self.kill_every and gone + sum(map(used_by, self.processes)) >= due:
                victim = self.random.choice(self.processes)
                gone += used_by(victim)
                victim.kill()
                victim.wait()
                self.killed += 1
                due += self.kill_every
            self.processes = [p if p.poll() is None else self.hire() for p in self.processes]

    def end(self):
        self.stop.set()
        self.thread.join()
        for process in self.processes:
            process.kill()
            process.wait()
        return self.killed


def on_dask(paths, workers, target, kill_every=None):
    """The table, and how often a worker was killed meanwhile."""
    with distributed.LocalCluster(n_workers=0, dashboard_address=None) as cluster:
        cluster.scheduler.allowed_failures = DEATHS
        start = time.perf_counter()
        crew = Crew(cluster.scheduler_address, workers, kill_every)
        try:
            made = table(paths, audit.distributed(paths, cluster.scheduler_address, workers), target)
        finally:
            killed = crew.end()
        return made, time.perf_counter() - start, killed


def main():
    folder = Path(sys.argv[1]) if len(sys.argv) > 1 else ROOT.parent / "shared" / "data"
    seconds = float(sys.argv[2]) if len(sys.argv) > 2 else 10
    paths = audit.files_of([f"{folder}/**"])
    if not paths:
        print(f"audit.py: no file in {folder}", file=sys.stderr)
        return 1
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
