"""Chains of log-aesthetic pieces and the noise of measuring them, for make_examples.py."""

import math
import random

# Nodes and weights of the 5-point Gauss-Legendre rule on [-1, 1].
_A = math.sqrt(5 - 2 * math.sqrt(10 / 7)) / 3
_B = math.sqrt(5 + 2 * math.sqrt(10 / 7)) / 3
_WA = (322 + 13 * math.sqrt(70)) / 900
_WB = (322 - 13 * math.sqrt(70)) / 900
GAUSS = ((-_B, _WB), (-_A, _WA), (0.0, 128 / 225), (_A, _WA), (_B, _WB))


class Piece:
    """Curvature is the power mean of its two end values in arc length, exponent -alpha."""

    def __init__(self, alpha, length, curvature_start, curvature_end):
        self.alpha, self.length = alpha, length
        self.curvature = (curvature_start, curvature_end)

    def turning(self, v):
        """Turning of the tangent over the first fraction v of the length, in closed form."""
        k0, k1 = self.curvature
        if k0 == k1:
            return self.length * k0 * v
        if self.alpha == 0:
            ratio = math.log(k1 / k0)
            return self.length * k0 * math.expm1(ratio * v) / ratio
        if self.alpha == 1:
            c = k0 / k1 - 1
            return self.length * k0 * math.log1p(c * v) / c
        side = -1.0 if k0 + k1 < 0 and self.alpha > 0 else 1.0
        exponent = -self.alpha
        a, b = (signed_power(side * k, exponent) for k in (k0, k1))
        e = 1 / exponent + 1
        swept = abs(a + (b - a) * v) ** e - abs(a) ** e
        return side * self.length * swept / ((b - a) * e)

    def as_json(self):
        return {"alpha": self.alpha, "length": self.length, "curvature": list(self.curvature)}


def signed_power(x, e):
    return math.copysign(abs(x) ** e, x) if x else 0.0


class Chain:
    """A start (x, y, direction) and pieces; point(s) at arc length s."""

    def __init__(self, start, pieces, closed=False):
        self.start, self.pieces, self.closed = start, pieces, closed
        self.length = sum(p.length for p in pieces)
        self.poses = [start]
        for p in pieces:
            x, y, direction = self.poses[-1]
            dx, dy = self._advance(p, direction, 0, p.length)
            self.poses.append((x + dx, y + dy, direction + p.turning(1)))

    @staticmethod
    def _advance(piece, direction, s0, s1, panels=24):
        dx = dy = 0.0
        h = (s1 - s0) / panels
        for i in range(panels):
            middle = s0 + (i + 0.5) * h
            for node, weight in GAUSS:
                angle = direction + piece.turning((middle + node * h / 2) / piece.length)
                dx += weight * h / 2 * math.cos(angle)
                dy += weight * h / 2 * math.sin(angle)
        return dx, dy

    def point(self, s):
        i = 0
        while s > self.pieces[i].length and i + 1 < len(self.pieces):
            s -= self.pieces[i].length
            i += 1
        x, y, direction = self.poses[i]
        dx, dy = self._advance(self.pieces[i], direction, 0, min(s, self.pieces[i].length))
        return x + dx, y + dy

    def as_json(self):
        x, y, direction = self.start
        return {"type": "log-aesthetic", "start": [x, y], "direction": direction,
                "closed": self.closed, "pieces": [p.as_json() for p in self.pieces]}


class Noise(random.Random):
    """Seeded by the file's name, so that adding a file leaves the others as they are."""

    def normal(self, sigma):
        radius = math.sqrt(-2 * math.log(1 - self.random()))
        return sigma * radius * math.cos(2 * math.pi * self.random())

    def stations(self, low, high, count):
        """Increasing, from low to high, unevenly spaced as a hand-held scanner leaves them."""
        step = (high - low) / (count - 1)
        inner = [low + (i + 0.7 * (self.random() - 0.5)) * step for i in range(1, count - 1)]
        return [low, *inner, high]
