"""A comb in three figures: waves, energy, jolt, on arc length scaled to 1 (keyline's own are the
same, analysis/comb_figures.h; these are worked out apart from it)."""

import math

import numpy as np

LEAST_WAVE = 0.02  # of the curvature's range: lower ones are not seen
WINDOW = 0.005     # of the length, for the jolt
SAMPLES = 4001


def signed_power(base, exponent):
    return math.copysign(abs(base) ** exponent, base) if base else 0.0


def curvature_at(piece, t):
    """kappa^-alpha is linear along a log-aesthetic piece, its logarithm where the slope is 0."""
    power = -piece["alpha"]
    first, last = piece["curvature"]
    if first == last:
        return first
    size = max(abs(first), abs(last))
    a, b = first / size, last / size
    if a * b <= 0:  # through or into an inflection: only slopes below 0 reach it
        mixed = (1 - t) * signed_power(a, power) + t * signed_power(b, power)
        return size * signed_power(mixed, 1 / power)
    log_a, log_b = math.log(abs(a)), math.log(abs(b))
    if abs(power) * abs(log_b - log_a) < 1e-7:
        return math.copysign(size * math.exp((1 - t) * log_a + t * log_b), a)
    largest = max(power * log_a, power * log_b)
    mean = (1 - t) * math.exp(power * log_a - largest) + t * math.exp(power * log_b - largest)
    return math.copysign(size * math.exp((math.log(mean) + largest) / power), a)


def graph_of_chain(chain, steps=300):
    """Arc length and curvature, denser towards the ends of every piece."""
    shares = [0.5 - 0.5 * math.cos(math.pi * i / steps) for i in range(steps + 1)]
    length, curvature, start = [], [], 0.0
    for piece in chain["pieces"]:
        for t in shares:
            length.append(start + t * piece["length"])
            curvature.append(curvature_at(piece, t))
        start += piece["length"]
    return np.array(length), np.array(curvature)


def waves_of(curvature, least):
    """Turns of the way curvature runs that rise by `least` at least."""
    turns, rising = 0, None
    low = high = curvature[0]
    for value in curvature:
        low, high = min(low, value), max(high, value)
        if rising is not False and value < high - least:
            turns += rising is True
            rising, low, high = False, value, value
        elif rising is not True and value > low + least:
            turns += rising is False
            rising, low, high = True, value, value
    return turns


def figures(length, curvature):
    """(waves, energy, jolt) of a graph of curvature."""
    at = (length - length[0]) / (length[-1] - length[0])
    size = length[-1] - length[0]
    keep = np.concatenate([[True], np.diff(at) > 1e-12])
    at, bend = at[keep], curvature[keep] * size
    even = np.interp(np.linspace(0, 1, SAMPLES), at, bend)
    low, high = np.percentile(even, [0.5, 99.5])
    if high <= low:
        return 0, 0.0, 0.0
    steps = np.diff(at)
    energy = float(np.sum(np.diff(bend) ** 2 / steps))
    window = round(WINDOW * (SAMPLES - 1))
    jolt = float(np.max(np.abs(even[window:] - even[:-window]))) / (high - low)
    return waves_of(even, LEAST_WAVE * (high - low)), energy, jolt


def height_of(length, curvature):
    """How high a stretch rises over its chord: curvature integrated twice."""
    step = np.diff(length)
    turn = np.concatenate([[0], np.cumsum(step * (curvature[1:] + curvature[:-1]) / 2)])
    off = np.concatenate([[0], np.cumsum(step * (turn[1:] + turn[:-1]) / 2)])
    share = (length - length[0]) / max(length[-1] - length[0], 1e-300)
    return float(np.max(np.abs(off - share * off[-1])))


def low_bends(length, curvature, closed, height):
    """Stretches of the other sign than before and behind them (not the ends of an open curve), whose
    height over the chord is below `height`."""
    sign = np.sign(curvature)
    signed = np.flatnonzero(sign)
    parts = np.split(signed, np.flatnonzero(np.diff(sign[signed])) + 1)
    if closed and len(parts) > 1 and sign[parts[0][0]] == sign[parts[-1][0]]:
        shift = length[-1] - length[0]
        length = np.concatenate([length, length + shift])
        curvature = np.concatenate([curvature, curvature])
        parts = parts[1:-1] + [np.concatenate([parts[-1], parts[0] + len(sign)])]
    if len(parts) < 2:
        return 0
    inner = parts if closed else parts[1:-1]
    return sum(height_of(length[p], curvature[p]) < height for p in inner)
