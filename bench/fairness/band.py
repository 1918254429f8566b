"""The least energy that any curve in the band can have: the physical limit.

A curve whose curvature is linear between many nodes (a dense chain of clothoids), its energy
L^3 * integral of (d curvature / ds)^2 a sum of squares; the offsets of the points, linearised, are
limits of quadratic programmes solved one after another by a primal-dual interior point. Length is
held at the start's. What comes out keeps the band and is the better of two local optima, from the
smoothing spline and from the answer: an upper bound of the limit.
"""

import numpy as np
from scipy.linalg import lu_factor, lu_solve

NODES = 240
ROUNDS = 30
STEPS = 40        # of an interior point
ENOUGH = 1e-3     # of the energy, from round to round
SWING = 0.03      # weight of second differences beside the turning
HOLD = 0.999      # of the tolerance: what the linearised offsets may take
WITHIN = 1.02     # tolerances: as near as the linear picture comes
FIRST_TRUST = 0.2 # of the curvature's range: how far a node may go in a round


class Curve:
    """Nodes at `length`, `curvature` linear between; a first pose."""

    def __init__(self, length, curvature, pose):
        self.length, self.curvature, self.pose = length, curvature, np.array(pose, float)

    def places(self):
        h, k = np.diff(self.length), self.curvature
        turn = np.concatenate([[0], np.cumsum((k[1:] + k[:-1]) / 2 * h)]) + self.pose[2]
        middle = turn[:-1] + (3 * k[:-1] + k[1:]) / 8 * h
        steps = [(f(turn[:-1]) + 4 * f(middle) + f(turn[1:])) * h / 6 for f in (np.cos, np.sin)]
        xy = [self.pose[i] + np.concatenate([[0], np.cumsum(steps[i])]) for i in (0, 1)]
        return np.column_stack(xy), turn

    def energy(self):
        return float(np.sum(np.diff(self.curvature) ** 2 / np.diff(self.length)))


def nodes_for(length, curvature):
    """Even in half of length and half of turning."""
    bend = np.abs(curvature) + 1e-12
    grown = np.concatenate([[0], np.cumsum((bend[1:] + bend[:-1]) / 2 * np.diff(length))])
    share = grown / grown[-1] + length / length[-1]
    return np.interp(np.linspace(0, 2, NODES + 1), share, length)


def nodal(at, length, curvature):
    """Curvatures at nodes that turn, cell by cell, as far as a finer graph does: least squares, with
    a little of their second differences so that they do not swing."""
    turn = np.concatenate([[0], np.cumsum((curvature[1:] + curvature[:-1]) / 2 * np.diff(length))])
    h, n = np.diff(at), len(at)
    rows = np.zeros((2 * n - 3, n))
    for i in range(n - 1):
        rows[i, i : i + 2] = 0.5
    for i in range(n - 2):
        rows[n - 1 + i, i : i + 3] = SWING * np.array([1, -2, 1])
    mean = np.diff(np.interp(at, length, turn)) / h
    weight = np.sqrt(np.concatenate([h, (h[1:] + h[:-1]) / 2]))
    right = np.concatenate([mean, np.zeros(n - 2)])
    return np.linalg.lstsq(rows * weight[:, None], right * weight, rcond=None)[0]


def feet(points, places, turn):
    """For every point the node, the share of the cell beyond it, and the offset to the left."""
    cells = np.diff(places, axis=0)
    along = np.einsum("pcd,cd->pc", points[:, None] - places[None, :-1], cells)
    share = np.clip(along / np.sum(cells**2, axis=1), 0, 1)
    spot = places[None, :-1] + share[:, :, None] * cells
    cell = np.argmin(np.sum((points[:, None] - spot) ** 2, axis=2), axis=1)
    share = share[np.arange(len(points)), cell]
    h = turn[cell + 1] - turn[cell]
    direction = turn[cell] + share * h
    normal = np.column_stack([-np.sin(direction), np.cos(direction)])
    # a cell bows from its chord by its turning times its length over eight, seen from the foot
    size = np.linalg.norm(cells[cell], axis=1)
    bow = -np.einsum("p,p->p", h * size / 2, share * (1 - share))
    return cell, share, normal, np.einsum("pd,pd->p", spot[np.arange(len(points)), cell] - points,
                                          normal) + bow


def weights(length):
    h = np.diff(length)
    return np.concatenate([[h[0] / 2], (h[1:] + h[:-1]) / 2, [h[-1] / 2]])


def movement(curve, places, spot, upto, normal):
    """What curvatures and pose move a spot by, along a normal."""
    row = np.zeros(len(curve.length) + 3)
    lever = spot - places[: upto + 1]
    row[: upto + 1] = weights(curve.length)[: upto + 1] * (-lever[:, 1] * normal[0]
                                                            + lever[:, 0] * normal[1])
    first = spot - places[0]
    row[-3:] = normal[0], normal[1], -first[1] * normal[0] + first[0] * normal[1]
    return row


class Limits:
    """|rows x + offset| <= room and |x| <= 1 for the first `boxed` unknowns, as G x <= most."""

    def __init__(self, rows, offset, room, boxed):
        self.rows, self.boxed = rows, boxed
        self.most = np.concatenate([room - offset, room + offset, np.ones(2 * boxed)])
        self.cuts = np.cumsum([len(rows), len(rows), boxed])

    def times(self, x):
        a, b = self.rows @ x, x[: self.boxed]
        return np.concatenate([a, -a, b, -b])

    def transposed(self, v):
        a, b, c, d = np.split(v, self.cuts)
        answer = self.rows.T @ (a - b)
        answer[: self.boxed] += c - d
        return answer

    def square(self, weight):
        """G' diag(weight) G."""
        a, b, c, d = np.split(weight, self.cuts)
        answer = self.rows.T @ ((a + b)[:, None] * self.rows)
        answer[np.arange(self.boxed), np.arange(self.boxed)] += c + d
        return answer


def longest(values, steps):
    """The largest share of the steps, one at most, that leaves all values above zero."""
    falls = steps < 0
    return min(1.0, 0.99 * float(np.min(-values[falls] / steps[falls]))) if falls.any() else 1.0


def quadratic(hessian, gradient, limits, equal, rest):
    """min x'Hx/2 + g'x within the limits, equal x = rest: a primal-dual interior point (Mehrotra);
    None where it does not come to an end."""
    n, most = len(gradient), limits.most
    x, y = np.zeros(n), np.zeros(len(rest))
    slack, price = np.maximum(most, 1e-2), np.full(len(most), 1.0 / len(most))
    for _ in range(STEPS):
        dual = hessian @ x + gradient + limits.transposed(price) + equal.T @ y
        primal, flat = limits.times(x) + slack - most, equal @ x - rest
        gap = slack @ price / len(most)
        if gap * len(most) < 1e-5 and np.abs(primal).max() < 1e-7:
            return x
        matrix = np.zeros((n + len(y), n + len(y)))
        matrix[:n, :n] = hessian + limits.square(price / slack)
        matrix[:n, n:], matrix[n:, :n] = equal.T, equal
        factors = lu_factor(matrix, check_finite=False)

        def direction(complement):
            right = -dual - limits.transposed((price * primal - complement) / slack)
            solved = lu_solve(factors, np.concatenate([right, -flat]), check_finite=False)
            ds = -primal - limits.times(solved[:n])
            dp = -(complement + price * ds) / slack
            return solved[:n], solved[n:], ds, dp, min(longest(slack, ds), longest(price, dp))

        _, _, ds, dp, step = direction(slack * price)
        ahead = (slack + step * ds) @ (price + step * dp) / len(most)
        dx, dy, ds, dp, step = direction(slack * price + ds * dp - (ahead / gap) ** 3 * gap)
        x, y, slack, price = x + step * dx, y + step * dy, slack + step * ds, price + step * dp
    return None


def closing(curve, places, turn):
    """The end comes back to the start: place, direction and curvature."""
    n = len(curve.length)
    rows = np.zeros((4, n + 3))
    for i, normal in enumerate(np.eye(2)):
        rows[i] = movement(curve, places, places[-1], n - 1, normal)
        rows[i, -3:-1] = 0
    rows[2, :n] = weights(curve.length)
    rows[3, 0], rows[3, n - 1] = 1, -1
    whole = 2 * np.pi * round((turn[-1] - turn[0]) / (2 * np.pi))
    gap = places[-1] - places[0]
    return rows, np.array([-gap[0], -gap[1], whole - (turn[-1] - turn[0]),
                           curve.curvature[-1] - curve.curvature[0]])


def hessian_of(length):
    n = len(length)
    matrix = np.zeros((n + 3, n + 3))
    for i, h in enumerate(np.diff(length)):
        matrix[i : i + 2, i : i + 2] += np.array([[1, -1], [-1, 1]]) / h
    return matrix


def next_curve(curve, points, tolerance, closed, trust):
    """One quadratic programme; the curve it leads to or None."""
    places, turn = curve.places()
    cell, share, normal, offset = feet(points, places, turn)
    cells = np.diff(places, axis=0)
    rows = np.array([movement(curve, places, places[c] + s * cells[c], c, u)
                     for c, s, u in zip(cell, share, normal)])
    room = max(HOLD * tolerance, 0.7 * np.abs(offset).max())
    n = len(curve.length)
    unit = np.concatenate([np.full(n, trust), np.ones(3)])  # of the unknowns
    scale = 1 / max(curve.energy(), 1e-300)
    hessian = scale * hessian_of(curve.length)
    gradient = unit * (hessian @ np.concatenate([curve.curvature, np.zeros(3)]))
    equal, rest = closing(curve, places, turn) if closed else (np.zeros((0, n + 3)), np.zeros(0))
    step = quadratic(unit * hessian * unit[:, None] + 1e-9 * np.eye(n + 3), gradient,
                     Limits(rows * unit / tolerance, offset / tolerance, room / tolerance, n),
                     equal * unit, rest)
    if step is None:
        return None
    return Curve(curve.length, curve.curvature + trust * step[:n], curve.pose + step[n:])


def beyond(curve, points, tolerance):
    places, turn = curve.places()
    return np.abs(feet(points, places, turn)[3]).max() / tolerance


def started(length, curvature, start, direction):
    """A finer graph of curvature on nodes of its own, of length about 1."""
    at = nodes_for(length, curvature)
    return Curve(at, nodal(at, length, curvature), (*start, direction))


def calmed(curve, points, closed, tolerance):
    """From a curve downhill; None where no round stays in the band."""
    span, best = np.ptp(curve.curvature), None
    trust, off = FIRST_TRUST * span, beyond(curve, points, tolerance)
    for _ in range(ROUNDS):
        found = next_curve(curve, points, tolerance, closed, trust)
        ahead = beyond(found, points, tolerance) if found else np.inf
        if ahead > max(WITHIN, off * 1.05):  # the linear picture does not reach so far
            trust /= 3
            if trust < 1e-6 * span:
                break
            continue
        gain = 1 - found.energy() / curve.energy()
        curve, off = found, ahead
        if off < WITHIN and (best is None or curve.energy() < best.energy()):
            best = curve
        if off < WITHIN and abs(gain) < ENOUGH:
            break
    return best


def least_energy(points, closed, tolerance, spline, chain):
    """The calmest Curve found within the tolerance, from the spline and from the chain's
    (length, curvature, start, direction)."""
    size = spline.length[-1]
    way = spline.points[1] - spline.points[0]
    begun = (spline.length, spline.curvature, spline.points[0], np.arctan2(way[1], way[0]))
    found = [calmed(started(length / size, curvature * size, np.array(start) / size, direction),
                    np.array(points, float) / size, closed, tolerance / size)
             for length, curvature, start, direction in (begun, chain)]
    return min((f for f in found if f), key=Curve.energy, default=None)
