"""The notebook that draws the papers' figures anew: its cells run, and say what the papers say."""

import json
import math
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[2]
NOTEBOOK = ROOT / "examples" / "python" / "figures.ipynb"


def code_cells(notebook):
    return ["".join(c["source"]) for c in notebook["cells"] if c["cell_type"] == "code"]


@pytest.fixture(scope="module")
def drawn(tmp_path_factory):
    """What stands in the notebook's variables at its end, and the folder of its figures."""
    matplotlib = pytest.importorskip("matplotlib")
    matplotlib.use("Agg")
    from matplotlib import pyplot

    folder = tmp_path_factory.mktemp("figures")
    space = {"__name__": "__main__"}
    with matplotlib.rc_context():
        for number, cell in enumerate(code_cells(json.loads(NOTEBOOK.read_text(encoding="utf-8")))):
            exec(compile(cell, f"{NOTEBOOK.name}, code cell {number + 1}", "exec"), space)
            for figure in pyplot.get_fignums():
                pyplot.figure(figure).savefig(folder / f"{number}-{figure}.svg")
            pyplot.close("all")
    return space, folder


def test_every_figure_is_there(drawn):
    _, folder = drawn
    assert len(list(folder.glob("*.svg"))) == 6
    for picture in folder.glob("*.svg"):
        assert picture.stat().st_size > 5_000


def test_the_notebook_is_kept_without_what_it_printed():
    notebook = json.loads(NOTEBOOK.read_text(encoding="utf-8"))
    assert notebook["nbformat"] == 4
    for cell in notebook["cells"]:
        assert not cell.get("outputs") and cell.get("execution_count") is None


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
    assert said["before"] == pytest.approx(0.3925, abs=5e-5)  # docs/readings.md
    assert said["after"] == pytest.approx(0.3287, abs=5e-5)


def test_the_key_line_is_few_pieces(drawn):
    said = drawn[0]["fairing"]
    assert said["pieces"] <= 6 and said["rms"] <= said["tolerance"] < 1  # of a line 1,100 long
