"""Two rivals of fit.spline on one function: FITPACK's smoothing spline and a differential evolution
of the knots, both by scipy. The criterion, its floor (the data's rounding) and its limit
2n + m <= N are those of keyline::fit ([Fairing] Eq. 5)."""

import time

import numpy as np
from scipy.interpolate import splev, splrep
from scipy.optimize import differential_evolution

DEGREE = 3
SMOOTHINGS = 400  # values of s FITPACK is tried with
POPULATION = 10   # of differential evolution, times the number of knots


class Series:
    """FITPACK wants increasing x: repeats are averaged, with their weight."""

    def __init__(self, x, y, rounding):
        self.x, self.y, self.rounding = x, y, rounding
        self.unique, where = np.unique(x, return_inverse=True)
        repeats = np.bincount(where)
        self.mean = np.bincount(where, y) / repeats
        self.weight = np.sqrt(repeats)

    def criterion(self, spline):
        """BIC of a spline (t, c, k) of FITPACK's."""
        count = len(self.x)
        knots = len(spline[0]) - 2 * (DEGREE + 1)
        if knots > 0 and 2 * knots + DEGREE + 1 > count:
            return np.inf
        squares = np.sum((self.y - splev(self.x, spline)) ** 2)
        floor = count * self.rounding**2 / 12
        return (count * np.log(max(squares, floor, 1e-300)) +
                np.log(count) * (2 * knots + DEGREE + 1))

    def least_squares(self, knots):
        """BIC of the least-squares spline of these inner knots; infinite where there is none."""
        try:
            spline = splrep(self.unique, self.mean, w=self.weight, k=DEGREE, t=np.sort(knots),
                            task=-1)
        except (ValueError, TypeError):
            return np.inf
        return self.criterion(spline) if np.all(np.isfinite(spline[1])) else np.inf

    def cost(self, knots):
        """The same for a search, which needs a number everywhere."""
        value = self.least_squares(knots)
        return value if np.isfinite(value) else 1e6


def fitpack(series):
    """(BIC, knots) of the best of many smoothing splines."""
    total = np.sum((series.y - series.y.mean()) ** 2)
    best = (np.inf, 0)
    for s in np.geomspace(1e-8 * total, total, SMOOTHINGS):
        spline = splrep(series.unique, series.mean, w=series.weight, k=DEGREE, s=s)
        best = min(best, (series.criterion(spline), len(spline[0]) - 2 * (DEGREE + 1)))
    return best


def evolution(series, numbers, seconds, seed=1):
    """(BIC, knots, ended) of differential evolution of the places of n knots, for each n of
    `numbers`; seconds in all, shared evenly. Ended: every one by itself."""
    best = (series.least_squares([]), 0)
    ended = True
    low, high = series.unique[0], series.unique[-1]
    margin = 1e-9 * (high - low)
    for n in numbers:
        if n < 1:
            continue
        until = time.process_time() + seconds / len(numbers)

        def late(_, convergence, until=until):
            return time.process_time() > until

        found = differential_evolution(series.cost, [(low + margin, high - margin)] * n,
                                       popsize=POPULATION, maxiter=100000, tol=1e-8, seed=seed,
                                       polish=False, callback=late)
        ended = ended and found.success and time.process_time() <= until
        best = min(best, (found.fun, n))
    return (*best, ended)
