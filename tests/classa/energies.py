"""Prints the cases of strain_energy_test.cpp: Eq. 7 of Oya et al. with 40 digits (mpmath)."""
from mpmath import mp, mpf, quad, linspace

mp.dps = 40
CURVES = [
    [("0", "0"), ("1", "0"), ("2", "1"), ("2.5", "3")],
    [("0", "0"), ("1", "2"), ("0", "3"), ("-2", "3.5"), ("-4", "2")],
    [("0", "0"), ("3", "0.01"), ("0.02", "0.03"), ("3", "0.05")],
    [("0", "0"), ("1", "0"), ("2", "1"), ("3", "1")],
    [("-1", "5"), ("0", "5.5"), ("1.5", "5"), ("2", "3"), ("3", "2.9"), ("4", "2.5"), ("5", "0")],
]


def bezier(points, t):
    points = list(points)
    while len(points) > 1:
        points = [((1 - t) * a[0] + t * b[0], (1 - t) * a[1] + t * b[1]) for a, b in zip(points, points[1:])]
    return points[0]


def hodograph(points):
    n = len(points) - 1
    return [(n * (b[0] - a[0]), n * (b[1] - a[1])) for a, b in zip(points, points[1:])]


def energy(points):
    points = [(mpf(x), mpf(y)) for x, y in points]
    first, second = hodograph(points), hodograph(hodograph(points))

    def density(t):
        (x1, y1), (x2, y2) = bezier(first, t), bezier(second, t)
        return (x1 * y2 - x2 * y1) ** 2 / (x1 * x1 + y1 * y1) ** mpf("2.5")

    return quad(density, linspace(0, 1, 129))


for points in CURVES:
    control = ", ".join("{%s, %s}" % p for p in points)
    print("      {{{%s}, {}}, %s}," % (control, mp.nstr(energy(points), 20)))
