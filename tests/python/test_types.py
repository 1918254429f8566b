"""The stub is what mypy accepts and what the package is."""

import ast
import os
import subprocess
import sys
from pathlib import Path

import pytest

import keyline

PACKAGE = Path(keyline.__file__).parent
GOOD = """
import numpy as np
import keyline

curve = keyline.lac.segment([[0, 0], [2, 0], [3, 1.5]], -1.0)
number: float = curve.lambda_ or 0.0
whole: keyline.Curve = curve
bezier: keyline.Curve = curve.to_bezier(1e-3)
faired = keyline.fair(points=np.zeros((10, 2)), progress=lambda share, doing: None)
many: keyline.Segments = keyline.lac.segments(np.zeros((4, 3, 2)), [-1, 0, 1, 2])
"""
WRONG = {
    'keyline.lac.segment([[0, 0], [2, 0], [3, 1.5]], "minus one")': "arg-type",
    "keyline.lac.segment([[0, 0], [2, 0], [3, 1.5]])": "call-arg",
    "keyline.lac.segment([[0, 0]], -1.0, alfa=2)": "call-arg",
    "keyline.lac.segments": None,
    "keyline.lac.segmnt([[0, 0]], -1.0)": "attr-defined",
    "x: str = keyline.lac.segment([[0, 0]], -1.0).lambda_": "assignment",
}


def mypy(text, tmp_path):
    pytest.importorskip("mypy")
    file = tmp_path / "use.py"
    file.write_text(text)
    environment = {**os.environ, "MYPYPATH": str(PACKAGE.parent)}
    command = [sys.executable, "-m", "mypy", "--strict", "--show-error-codes", "--no-color-output",
               "--cache-dir", str(tmp_path / "cache"), str(file)]  # fmt: skip
    done = subprocess.run(command, capture_output=True, text=True, env=environment, cwd=tmp_path)
    return done.stdout


def test_the_stub_and_what_is_written_by_it_are_sound(tmp_path):
    assert "Success" in mypy(GOOD, tmp_path)


def test_mistakes_are_noticed(tmp_path):
    text = "import keyline\n" + "\n".join(WRONG) + "\n"
    told = mypy(text, tmp_path)
    for line, code in enumerate(WRONG.values(), start=2):
        noticed = [t for t in told.splitlines() if f"use.py:{line}:" in t]
        assert (code is None) == (not noticed), told
        assert code is None or any(f"[{code}]" in t for t in noticed), told


def test_the_stub_names_what_the_package_has():
    tree = ast.parse((PACKAGE / "__init__.pyi").read_text())
    told = {n.name for n in tree.body if isinstance(n, (ast.FunctionDef, ast.ClassDef))}
    told |= {n.target.id for n in tree.body if isinstance(n, ast.AnnAssign)}
    told |= {a.asname or a.name for n in tree.body if isinstance(n, ast.ImportFrom) for a in n.names}
    for name in keyline.__all__:
        assert name in told, name
