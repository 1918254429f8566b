#!/usr/bin/env python3
"""Redraws figures of the papers with the Python package: figures.py FOLDER.

Each function draws one figure with matplotlib and gives back numbers that the paper states; the tests
run the whole and look at the numbers.
"""

import sys
from pathlib import Path

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402
import numpy as np  # noqa: E402

import keyline  # noqa: E402


def standard_forms(axes):
    """[Compound] Fig. 2: log-aesthetic curves of radius 1 at the origin, slope by slope."""
    turning = {}
    for alpha in (-1.0, 0.0, 0.5, 1.0, 2.0):
        # rho^alpha = 1 + alpha s (alpha 0: rho = e^s), the standard form with lambda = 1
        length = 1.5
        end = np.exp(length) if alpha == 0 else max(1 + alpha * length, 0.02) ** (1 / alpha)
        if alpha < 0:  # up to close before its inflection
            length = 0.98
            end = (1 + alpha * length) ** (1 / alpha)
        curve = keyline.Curve(
            {
                "type": "log-aesthetic", "start": [0, 0], "direction": 0,
                "pieces": [{"alpha": alpha, "length": length, "curvature": [1, 1 / end]}],
            }
        )  # fmt: skip
        curve.plot(axes, label=f"α = {alpha:g}")
        turning[alpha] = float(curve.tangent_angle(length) - curve.tangent_angle(0))
    axes.legend()
    axes.set_title("Standard forms")
    return {"turning": turning}


def slopes_of_one_triangle(axes):
    """[QLAC] / [Compound]: one triangle of handles, many slopes; the logarithmic curvature graphs are
    straight lines of those slopes."""
    read = {}
    for alpha in (-2.0, -1.0, 0.0, 1.0, 2.0):
        curve = keyline.lac.segment([[0, 0], [2, 0], [2.8, 1.2]], alpha)
        analysis = keyline.curve.analyze(curve)
        graph = analysis.pieces[0].lcg
        axes.plot(*np.asarray(graph.points).T, label=f"α = {alpha:g}")
        read[alpha] = graph.slope
    axes.set_xlabel("log ρ")
    axes.set_ylabel("log(ρ ds/dρ)")
    axes.legend()
    axes.set_title("Logarithmic curvature graphs")
    return {"slopes": read}


def quasi(axes):
    """[QLAC]: quasi-log-aesthetic Béziers of growing degree beside the curve they stand for."""
    handles = [[0, 0], [2, 0], [2.8, 1.2]]
    exact = keyline.lac.segment(handles, 0.5)
    exact.plot(axes, color="0.7", linewidth=4, label="log-aesthetic")
    deviation = {}
    for degree in (4, 6, 8, 10):
        bezier = keyline.lac.quasi(points=handles, alpha=0.5, degree=degree, form="taylor-angle")
        bezier.plot(axes, linewidth=1, label=f"degree {degree}")
        deviation[degree] = bezier.result.deviation
    axes.legend()
    axes.set_title("Quasi-log-aesthetic Béziers")
    return {"deviation": deviation}


def compound(axes):
    """[Compound] Fig. 4: compound rhythm in one triangle, the share of the turning from 0.2 to 0.8."""
    joints = {}
    for ratio in (0.2, 0.4, 0.6, 0.8):
        curve = keyline.lac.compound([[0, 0], [2, 0], [2.8, 1.2]], [-1, 1.5], ratio)
        curve.plot(axes, comb=0.15, label=f"ratio {ratio:g}")
        joints[ratio] = np.asarray(curve.joint).tolist()
    axes.set_title("Compound rhythm")
    return {"joints": joints}


def class_a(axes):
    """[Oya] Sec. 3.2: the cubic of α = π/4, s = 1.05 and its edit; the energy falls from 0.3925 to
    0.3287 (papers/NOTES.md)."""
    given = {"alpha": np.pi / 4, "s": 1.05, "degree": 3, "tangent": [1, 2], "end_tolerance": 0.01}
    edited = keyline.curve.edit(**given)
    edited.plot(axes, comb=0.2, label="edited")
    axes.set_title("Least strain energy")
    return {"before": edited.result.before.energy, "after": edited.result.after.energy}


def fairing(axes):
    """[Fairing]: noisy points of a key-line, faired, with the comb that shows it."""
    t = np.linspace(0, 1.3, 300)
    noise = np.random.default_rng(4).normal(0, 0.02, (300, 2))
    points = np.stack([1000 * np.sin(t), 400 * (1 - np.cos(t))], axis=1) + noise
    faired = keyline.fair(points)
    axes.plot(*points.T, ".", markersize=2, color="0.6")
    faired.plot(axes, comb=0.1)
    axes.set_title(f"Faired: pieces {len(faired.pieces)}")
    return {"pieces": len(faired.pieces), "rms": faired.result.deviation.rms, "tolerance": faired.tolerance}


FIGURES = (standard_forms, slopes_of_one_triangle, quasi, compound, class_a, fairing)


def main(folder):
    """Draws all of them; gives back what each said."""
    said = {}
    for draw in FIGURES:
        figure, axes = plt.subplots(figsize=(6, 4.5))
        said[draw.__name__] = draw(axes)
        figure.tight_layout()
        figure.savefig(Path(folder) / f"{draw.__name__}.svg")
        figure.savefig(Path(folder) / f"{draw.__name__}.png", dpi=110)
        plt.close(figure)
    return said


if __name__ == "__main__":
    if len(sys.argv) != 2:
        sys.exit("figures.py FOLDER: where the figures go")
    for name, numbers in main(sys.argv[1]).items():
        print(name, numbers)
