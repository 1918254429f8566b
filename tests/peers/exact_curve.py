"""Log-aesthetic chains evaluated without Keyline, and distances from them.

The law of a piece (docs/log-aesthetic-curves.md): in the share v of its length the curvature is the
power mean of exponent -alpha of its end values. Direction and position are integrals of it, taken
here by Gauss's rule of ten nodes on panels that get finer towards both ends, where a curvature of
zero or infinity makes the integrand rough. Good to about 1e-12 of the length.
"""

import numpy as np
from scipy.spatial import cKDTree

NODES, WEIGHTS = np.polynomial.legendre.leggauss(10)
NODES, WEIGHTS = (NODES + 1) / 2, WEIGHTS / 2


def signed_power(x, e):
    return np.sign(x) * np.abs(x) ** e


def curvature(piece, v):
    """Curvature of a piece (as in the JSON) at the shares v of its length."""
    alpha = piece["alpha"]
    if "radius" in piece:
        r0, r1 = piece["radius"]
        sign = np.sign(r0 + r1)
        r0, r1 = abs(r0), abs(r1)
        if alpha == 0:
            return sign / (r0 ** (1 - v) * r1**v)
        return sign / ((1 - v) * r0**alpha + v * r1**alpha) ** (1 / alpha)
    k0, k1 = piece["curvature"]
    if k0 == k1:
        return np.full_like(v, k0)
    if alpha == 0:
        return np.sign(k0) * np.exp((1 - v) * np.log(abs(k0)) + v * np.log(abs(k1)))
    p = -alpha
    return signed_power((1 - v) * signed_power(k0, p) + v * signed_power(k1, p), 1 / p)


def panels(piece, count):
    """Shares of the length, denser towards the ends and towards an inflection inside."""
    t = np.linspace(0, 1, count + 1)
    graded = t * t * t * (t * (6 * t - 15) + 10)
    k0, k1 = piece.get("curvature", (1, 1))
    if k0 * k1 >= 0:
        return graded
    zero = abs(k0) ** -piece["alpha"] / (abs(k0) ** -piece["alpha"] + abs(k1) ** -piece["alpha"])
    return np.concatenate([zero * graded, zero + (1 - zero) * graded[1:]])


class ExactCurve:
    """Points, directions and curvatures of a chain, dense in arc length."""

    def __init__(self, chain, count=4000):
        position, angle = complex(*chain["start"]), chain["direction"]
        points, angles, curvatures = [position], [angle], []
        for piece in chain["pieces"]:
            edges = panels(piece, count)
            width = np.diff(edges)
            length = piece["length"]
            inner = curvature(piece, edges[:-1, None] + width[:, None] * NODES)
            turn = length * width * (inner @ WEIGHTS)
            start = angle + np.concatenate([[0], np.cumsum(turn)])
            # The direction at the nodes of a panel: the interpolant through its nodes, integrated.
            at_node = start[:-1, None] + length * width[:, None] * (inner @ INTEGRALS.T)
            step = length * width * (np.exp(1j * at_node) @ WEIGHTS)
            position_of = position + np.concatenate([[0], np.cumsum(step)])
            points.extend(position_of[1:])
            angles.extend(start[1:])
            with np.errstate(divide="ignore"):
                ends = curvature(piece, edges)
            curvatures.extend(ends if not curvatures else ends[1:])
            position, angle = position_of[-1], start[-1]
        self.points, self.angles = np.array(points), np.array(angles)
        self.curvatures = np.nan_to_num(np.array(curvatures), posinf=1e300, neginf=-1e300)
        self.tree = cKDTree(np.column_stack([self.points.real, self.points.imag]))

    def distances(self, xy):
        """From points to the curve: nearest sample, then the circle of curvature there."""
        _, nearest = self.tree.query(xy)
        offset = xy[:, 0] + 1j * xy[:, 1] - self.points[nearest]
        local = offset * np.exp(-1j * self.angles[nearest])
        k = self.curvatures[nearest]
        at_end = (nearest == 0) & (local.real < 0)
        at_end |= (nearest == len(self.points) - 1) & (local.real > 0)
        # | |p - centre| - radius | without dividing by the curvature
        square = np.abs(local) ** 2
        with np.errstate(over="ignore", invalid="ignore"):
            off = np.abs((k * square - 2 * local.imag) /
                         (np.sqrt(np.maximum(1 - 2 * k * local.imag + k * k * square, 0)) + 1))
        sharp = ~np.isfinite(off) | (np.abs(k) * np.abs(local) > 0.3)
        return np.where(at_end | sharp, np.abs(local), off)

    def gaps(self, xy):
        """Distances of the curve's points from the line through the points in order, less what a
        chord of that line and an arc of the curve's curvature are apart."""
        xy = xy[np.append(True, np.abs(np.diff(xy, axis=0)).max(axis=1) > 0)]
        start, edge = xy[:-1], np.diff(xy, axis=0)
        square = np.einsum("ij,ij->i", edge, edge)
        own = np.column_stack([self.points.real, self.points.imag])
        _, near = cKDTree(xy).query(own)
        best = np.full(len(own), np.inf)
        for shift in (-1, 0):
            index = np.clip(near + shift, 0, len(edge) - 1)
            a, e = start[index], edge[index]
            share = np.clip(np.einsum("ij,ij->i", own - a, e) / square[index], 0, 1)
            off = np.hypot(*(own - a - share[:, None] * e).T)
            with np.errstate(over="ignore"):
                sag = np.minimum(square[index] * np.abs(self.curvatures) / 8, np.sqrt(square[index]))
            best = np.minimum(best, np.maximum(off - sag, 0))
        return best


def integrals():
    """Row i: the weights of the integral from 0 to node i of the interpolant through the nodes."""
    vandermonde = np.vander(NODES, increasing=True)
    powers = np.arange(len(NODES)) + 1
    return (NODES[:, None] ** powers / powers) @ np.linalg.inv(vandermonde)


INTEGRALS = integrals()
