"""`pip install .` in a fresh virtual environment, without a network and without anything to download."""

import os
import subprocess
import sys
import venv
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[2]


@pytest.fixture(scope="module")
def python(tmp_path_factory):
    folder = tmp_path_factory.mktemp("venv")
    venv.create(folder, system_site_packages=True, with_pip=True)
    # no index and no way out: what is not here cannot be had
    environment = {**os.environ, "PIP_NO_INDEX": "1", "http_proxy": "http://127.0.0.1:9", "https_proxy": "http://127.0.0.1:9"}
    environment.pop("PYTHONPATH", None)
    command = [folder / "bin" / "python", "-m", "pip", "install", "--quiet", "--disable-pip-version-check", ROOT]
    done = subprocess.run(command, capture_output=True, text=True, env=environment, cwd=folder)
    assert done.returncode == 0, done.stderr
    return folder / "bin" / "python"


def run(python, text, cwd):
    environment = {k: v for k, v in os.environ.items() if k not in ("PYTHONPATH", "KEYLINE_CAD")}
    return subprocess.run([python, "-c", text], capture_output=True, text=True, env=environment, cwd=cwd)


def test_the_installed_package_works(python, tmp_path):
    text = (
        "import keyline\n"
        "assert 'venv' in keyline.__file__, keyline.__file__\n"
        "curve = keyline.lac.segment([[0, 0], [2, 0], [3, 1.5]], -1)\n"
        "print(curve.length)"
    )
    done = run(python, text, tmp_path)
    assert done.returncode == 0, done.stderr
    assert abs(float(done.stdout) - 3.4932) < 1e-3


def test_step_files_are_read_by_the_program_in_the_wheel(python, tmp_path):
    if not os.path.exists(os.environ.get("KEYLINE_CAD", "")):
        pytest.skip("built without OCCT")
    text = (
        "import keyline\n"
        "curve = {'type': 'bezier', 'points': [[0, 0], [1, 0], [2, 1], [2, 2]]}\n"
        "keyline.document.write('x.step', curves=[{'name': 'a', 'curve': curve}])\n"
        "print(len(keyline.read('x.step').curves))"
    )
    done = run(python, text, tmp_path)
    assert (done.returncode, done.stdout.strip()) == (0, "1"), done.stderr


def test_the_wheel_says_what_it_is(python, tmp_path):
    done = subprocess.run([python, "-m", "pip", "show", "--files", "keyline"], capture_output=True, text=True, cwd=tmp_path)
    assert "Requires: numpy" in done.stdout
    for name in ("keyline/py.typed", "keyline/__init__.pyi", "keyline/audit.py"):
        assert name in done.stdout
