"""The audit of many files: the same table whatever runs it, whoever is killed meanwhile."""

import importlib.util
import os
import random
import signal
import subprocess
import sys
import threading
import time
from pathlib import Path

import pytest

import keyline
from keyline import audit

ROOT = Path(__file__).resolve().parents[2]


@pytest.fixture(scope="module")
def files(tmp_path_factory):
    """Curves of many sorts, one file twice, one that is none."""
    folder = tmp_path_factory.mktemp("archive")
    (folder / "deep").mkdir()
    for i in range(16):
        alpha = -2 + i / 4
        curve = keyline.lac.segment([[0, 0], [2, 0], [3.2, 1.2 + i / 400]], alpha)
        where = folder / "deep" if i % 2 else folder
        keyline.document.write(str(where / f"{i:02}.json"), curves=[{"name": f"c{i}", "curve": curve}])
    many = [{"name": f"m{i}", "curve": keyline.lac.segment([[0, 0], [2, 0], [3, 1 + i / 9]], -1)} for i in range(5)]
    keyline.document.write(str(folder / "many.json"), curves=many)
    (folder / "twin.json").write_bytes((folder / "00.json").read_bytes())
    (folder / "broken.json").write_text("{")
    return folder


@pytest.fixture(scope="module")
def table(files):
    target = files.parent / "serial.csv"
    assert audit.main(["--serial", "-o", str(target), f"{files}/**"]) == 0
    return target.read_text()


def test_the_table_tells_everything(files, table):
    lines = table.splitlines()
    assert lines[0].split(",")[:3] == ["file", "number", "name"]
    assert len(lines) == 1 + 16 + 1 + 1 + 5
    assert sum("broken.json" in line for line in lines) == 1
    clothoid = next(line for line in lines if "/04.json" in line)  # alpha = -1
    assert ",minus," in clothoid


def test_the_table_can_be_read_by_others(files, table):
    """It had the rights of a temporary file."""
    assert (files.parent / "serial.csv").stat().st_mode & 0o777 == 0o666 & ~_umask()


def audit_on_dask():
    return importlib.util.find_spec("distributed") is not None


def _umask():
    mask = os.umask(0)
    os.umask(mask)
    return mask


def test_what_cannot_be_written_is_told_before_the_work(files, capsys, monkeypatch):
    monkeypatch.setattr(audit, "measure", lambda *_: pytest.fail("measured"))
    for name in ("none/a.csv", "none/a.kl"):
        assert audit.main(["--serial", "-o", str(files.parent / name), f"{files}/00.json"]) == 3
        assert "cannot be written" in capsys.readouterr().err
    with pytest.raises(SystemExit, match="2"):
        audit.main(["--workers", "0", f"{files}/00.json"])
    if audit_on_dask():
        with pytest.raises(SystemExit, match="scheduler cannot be reached: missing port"):
            audit.main(["--scheduler", "nowhere", f"{files}/00.json"])
    monkeypatch.setitem(sys.modules, "pyarrow", None)
    with pytest.raises(SystemExit, match="pyarrow"):
        audit.main(["--serial", "-o", str(files.parent / "a.parquet"), f"{files}/00.json"])


def test_on_dask_with_workers_killed_all_the_time(files, table, monkeypatch):
    monkeypatch.setattr(audit, "FIRST_PART", 2)  # so that a file of five is measured in parts
    distributed = pytest.importorskip("distributed")
    import dask

    dask.config.set({"distributed.scheduler.allowed-failures": audit.DEATHS})
    stop = threading.Event()
    killed = []
    with distributed.LocalCluster(n_workers=2, threads_per_worker=1, dashboard_address=None) as cluster:

        def kill():
            # Somebody who works is killed, time and again; newcomers need time to start.
            while len(killed) < 5 and not stop.wait(0.05):
                at_work = [w for w in cluster.workers.values() if w.status.name == "running" and getattr(w, "pid", None)]
                if at_work:
                    victim = random.choice(at_work).pid
                    try:
                        os.kill(victim, signal.SIGKILL)
                        killed.append(victim)
                    except ProcessLookupError:
                        pass
                    stop.wait(4.0)

        killer = threading.Thread(target=kill)
        killer.start()
        target = files.parent / "dask.csv"
        try:
            # Again until somebody was hit: a quick machine may be done before.
            status = 0
            while status == 0 and not killed:
                target.unlink(missing_ok=True)
                status = audit.main(["--scheduler", cluster.scheduler_address, "-o", str(target), f"{files}/**"])
        finally:
            stop.set()
            killer.join()
    assert status == 0
    assert killed
    assert target.read_text() == table


def test_into_a_library_twice_holds_nothing_twice(files):
    target = files.parent / "archive.kl"
    for _ in range(2):
        assert audit.main(["--serial", "-o", str(target), f"{files}/**"]) == 0
    stats = keyline.library.stats(str(target))
    assert stats.things == 22
    assert keyline.library.find(str(target), name="c4").found[0].rhythm == "minus"


def test_content_names_the_task(files):
    assert audit.content_key(str(files / "00.json")) == audit.content_key(str(files / "twin.json"))
    assert audit.content_key(str(files / "00.json")) != audit.content_key(str(files / "02.json"))


def test_no_file_is_bad_usage(tmp_path):
    assert audit.main(["--serial", f"{tmp_path}/nothing*"]) == 2


def test_requests_under_xargs(files, tmp_path):
    """The NDJSON form: one batch a chunk, answers in the chunks' order."""
    program = os.environ.get("KEYLINE_PROGRAM", "")
    if not os.path.exists(program):
        pytest.skip("the command line tool is not built")
    names = sorted(str(p) for p in files.rglob("*.json"))
    requests = "".join(f'{{"op":"library.measure","id":"{n}","file":"{n}"}}\n' for n in names)
    (tmp_path / "requests").write_text(requests)
    script = (
        "split -l 4 requests chunk- && ls chunk-* | "
        f"xargs -P 2 -I@ sh -c '{program} batch < @ > answers-@' && cat answers-chunk-*"
    )
    done = subprocess.run(["sh", "-ec", script], cwd=tmp_path, capture_output=True, text=True)
    alone = subprocess.run([program, "batch"], input=requests, capture_output=True, text=True)
    assert done.stdout == alone.stdout
    assert done.stdout.count("\n") == len(names)
    assert [n in line for n, line in zip(names, done.stdout.splitlines())] == [True] * len(names)
