"""Prints the cases of MinimumEnergy.MeetsMinimaOfHighPrecision (mpmath, 25 digits).

The curve with first edge 1 and matrix s e^(i alpha) ends at G = 1 + z + ... + z^(n-1); scaled until
it ends as far out as the disc about the given end allows, its energy (Eq. 7 of Oya et al., by
quadrature over the parameter) is a function of alpha and s alone. Where both its rates vanish is
found by Newton's method from the best place of a grid.
"""
from mpmath import mp, mpf, arg, conj, cos, diff, expj, findroot, linspace, log, nstr, quad, sin, sqrt

mp.dps = 25
# degree, angle of the chord, tolerance over the chord, alpha and s of the grid's best place
CASES = [
    (6, "0.48", "0.12", 0.117, 1.238),
    (7, "1.51", "0.23", 0.364, 1.165),
    (4, "1.33", "0.15", 0.652, 1.292),
    (2, "0.66", "0.26", 0.638, 1.689),
    (8, "0.65", "0.1", 0.130, 1.155),
]


def energy(alpha, s, n):
    z = s * expj(alpha)

    def density(t):
        along = 1 - t + t * z
        first, second = n * along ** (n - 1), n * (n - 1) * along ** (n - 2) * (z - 1)
        return (conj(first) * second).imag ** 2 / abs(first) ** 5

    return quad(density, linspace(0, 1, 9))


for n, offset, slack, alpha, s in CASES:
    o, r = mpf(offset), mpf(slack)

    def scaled(a, b):
        end = sum((b * expj(a)) ** k for k in range(n))
        off = arg(end) - o
        return log(energy(a, b, n) * abs(end) / (cos(off) + sqrt(r * r - sin(off) ** 2)))

    rates = [lambda a, b: diff(scaled, (a, b), (1, 0)), lambda a, b: diff(scaled, (a, b), (0, 1))]
    a, b = findroot(rates, (mpf(alpha), mpf(s)), tol=mpf(10) ** -30)
    values = ", ".join(nstr(v, 16) for v in (a, b, mp.exp(scaled(a, b))))
    print("      {%d, %s, %s, %s}," % (n, offset, slack, values), flush=True)
