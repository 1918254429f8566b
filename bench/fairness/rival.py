"""The rival: the smoothest quintic spline (FITPACK) whose points stay within a tolerance."""

import numpy as np
from scipy.interpolate import splev, splprep

SAMPLES = 6001
TRIALS = 18


class Rival:
    """Arc length and curvature of a spline, and its points."""

    def __init__(self, tck):
        t = np.linspace(0, 1, SAMPLES)
        self.points = np.column_stack(splev(t, tck))
        (dx, dy), (ddx, ddy) = splev(t, tck, 1), splev(t, tck, 2)
        speed = np.hypot(dx, dy)
        self.curvature = (dx * ddy - dy * ddx) / speed**3
        mean = (speed[1:] + speed[:-1]) / 2
        self.length = np.concatenate([[0], np.cumsum(mean * np.diff(t))])

    def farthest(self, points, at):
        """Largest distance of a point, looked for near its parameter."""
        reach = np.arange(-60, 61)
        near = np.clip(np.searchsorted(np.linspace(0, 1, SAMPLES), at)[:, None] + reach, 0,
                       SAMPLES - 1)
        return np.linalg.norm(self.points[near] - points[:, None, :], axis=2).min(axis=1).max()


def smoothest(points, closed, tolerance):
    """The smoothest within the tolerance; None where even the least smoothing leaves it."""
    points = np.array(points, float)
    points = points[np.concatenate([[True], np.linalg.norm(np.diff(points, axis=0), axis=1) > 0])]
    if closed and np.linalg.norm(points[0] - points[-1]) > 0:
        points = np.vstack([points, points[:1]])
    best, low, high = None, -7.0, 0.0  # decades of the tolerance that the offsets' mean may have
    for _ in range(TRIALS):
        middle = (low + high) / 2
        try:
            tck, at = splprep(points.T, s=len(points) * (tolerance * 10**middle) ** 2, k=5,
                              per=closed, quiet=2)
        except (ValueError, TypeError):
            low = middle
            continue
        spline = Rival(tck)
        if spline.farthest(points, at) <= tolerance:
            best, low = spline, middle
        else:
            high = middle
    return best
