"""The papers' figures are drawn anew, and say what the papers say."""

import math
import runpy
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[2]


@pytest.fixture(scope="module")
def drawn(tmp_path_factory):
    pytest.importorskip("matplotlib")
    folder = tmp_path_factory.mktemp("figures")
    script = runpy.run_path(str(ROOT / "examples" / "python" / "figures.py"))
    return script["main"](folder), folder


def test_every_figure_is_there(drawn):
    _, folder = drawn
    assert len(list(folder.glob("*.svg"))) == len(list(folder.glob("*.png"))) == 6
    for picture in folder.glob("*.svg"):
        assert picture.stat().st_size > 5_000


def test_turning_in_closed_form(drawn):
    turning = drawn[0]["standard_forms"]["turning"]
    assert turning[1.0] == pytest.approx(math.log(2.5), abs=1e-12)  # rho = 1 + s: the logarithmic spiral
    assert turning[0.0] == pytest.approx(1 - math.exp(-1.5), abs=1e-12)  # [Compound] Eq. 2.3 as corrected
    assert turning[2.0] == pytest.approx(1, abs=1e-12)  # sqrt(1 + 2 s) - 1


def test_graphs_are_lines_of_their_slopes(drawn):
    for alpha, slope in drawn[0]["slopes_of_one_triangle"]["slopes"].items():
        assert slope == pytest.approx(alpha, abs=1e-6)


def test_quasi_curves_come_nearer_with_their_degree(drawn):
    deviation = list(drawn[0]["quasi"]["deviation"].values())
    assert deviation == sorted(deviation, reverse=True) and deviation[-1] < deviation[0] / 10


def test_the_energy_of_oya(drawn):
    said = drawn[0]["class_a"]
    assert said["before"] == pytest.approx(0.3925, abs=5e-5)  # papers/NOTES.md
    assert said["after"] == pytest.approx(0.3287, abs=5e-5)


def test_the_key_line_is_few_pieces(drawn):
    said = drawn[0]["fairing"]
    assert said["pieces"] <= 6 and said["rms"] <= said["tolerance"] < 1  # of a line 1,100 long
