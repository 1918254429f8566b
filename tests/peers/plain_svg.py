"""Paths of a plain SVG (as Inkscape, poppler and librsvg write it) as points in millimetres.

Knows what those programs write: path data, transforms, viewBox and size, groups. Not a reader for
files at large.
"""

import re
import xml.etree.ElementTree as ElementTree
from dataclasses import dataclass

import numpy as np

LABEL = "{http://www.inkscape.org/namespaces/inkscape}label"
MILLIMETRES = {"": 25.4 / 96, "px": 25.4 / 96, "pt": 25.4 / 72, "mm": 1.0, "cm": 10.0, "in": 25.4}
NUMBER = r"[-+]?(?:\d+\.?\d*|\.\d+)(?:[eE][-+]?\d+)?"


@dataclass
class Curve:
    """What a program reads: points along a curve in order, in millimetres, y up, and its label."""

    points: np.ndarray
    name: str = ""
    layer: str = ""
    color: str = ""
    kind: str = ""


def matrix_of(text):
    m = np.eye(3)
    for name, args in re.findall(r"(\w+)\s*\(([^)]*)\)", text or ""):
        v = [float(t) for t in re.findall(NUMBER, args)]
        if name == "matrix":
            step = np.array([[v[0], v[2], v[4]], [v[1], v[3], v[5]], [0, 0, 1]])
        elif name == "translate":
            step = np.array([[1, 0, v[0]], [0, 1, v[1] if len(v) > 1 else 0], [0, 0, 1]])
        elif name == "scale":
            step = np.diag([v[0], v[-1], 1.0])
        else:
            raise ValueError(f"transform {name}")
        m = m @ step
    return m


def page_matrix(root):
    """From user units to millimetres, y upwards; the origin stays where it is."""
    size = [re.match(rf"({NUMBER})\s*(\w*)", root.get(side)) for side in ("width", "height")]
    w, h = (float(s.group(1)) * MILLIMETRES[s.group(2)] for s in size)
    if root.get("viewBox") is None:
        return np.diag([MILLIMETRES[""], -MILLIMETRES[""], 1.0])
    _, _, bw, bh = (float(t) for t in root.get("viewBox").split())
    return np.diag([w / bw, -h / bh, 1.0])


def subpaths(data):
    """Lists of Béziers (arrays of 2 or 4 points) of path data with M L H V C Q A Z of both
    kinds."""
    tokens = re.findall(rf"[A-Za-z]|{NUMBER}", data)
    at, start, result, i, verb = 0j, 0j, [], 0, "M"
    need = {"M": 2, "L": 2, "H": 1, "V": 1, "C": 6, "Q": 4, "A": 7, "Z": 0}
    while i < len(tokens):
        if tokens[i].isalpha():
            verb = tokens[i]
            i += 1
        base = at if verb.islower() else 0j
        v = [float(t) for t in tokens[i : i + need[verb.upper()]]]
        i += len(v)
        kind = verb.upper()
        if kind == "M":
            at = start = base + complex(*v)
            result.append([])
            verb = "l" if verb == "m" else "L"
            continue
        if kind == "Z":
            piece = np.array([at, start])
        elif kind == "C":
            ends = [base + complex(*v[k : k + 2]) for k in (0, 2, 4)]
            piece = np.array([at, *ends])
        elif kind == "Q":
            middle, end = (base + complex(*v[k : k + 2]) for k in (0, 2))
            piece = np.array([at, (at + 2 * middle) / 3, (end + 2 * middle) / 3, end])
        elif kind == "A":
            piece = arc(at, v[:5], base + complex(*v[5:]))
        else:
            to = complex(*v) if kind == "L" else complex(v[0], 0 if base else at.imag)
            if kind == "V":
                to = complex(0 if base else at.real, v[0])
            piece = np.array([at, base + to])
        if len(piece) != 2 or piece[0] != piece[1]:
            result[-1].append(piece)
        at = piece[-1]
    return [pieces for pieces in result if pieces]


def arc(start, shape, end):
    """Points on an elliptical arc; more than four, so that they are taken as they are."""
    rx, ry, turn, large, sweep = shape
    rotation = np.exp(1j * np.radians(turn))
    unit = lambda z: complex((z / rotation).real / rx, (z / rotation).imag / ry)
    a, b = unit(start), unit(end)
    half = (b - a) / 2
    reach = max(0.0, 1 / abs(half) ** 2 - 1) ** 0.5
    center = (a + b) / 2 + half * 1j * reach * (1 if (large != sweep) else -1)
    if abs(half) > 1:
        a, b = center + (a - center) / abs(half), center + (b - center) / abs(half)
    from_, total = np.angle(a - center), np.angle((b - center) / (a - center))
    if sweep and total < 0:
        total += 2 * np.pi
    if not sweep and total > 0:
        total -= 2 * np.pi
    z = center + abs(a - center) * np.exp(1j * (from_ + total * np.linspace(0, 1, 2001)))
    return (z.real * rx + 1j * z.imag * ry) * rotation


def samples(pieces, count):
    t = np.linspace(0, 1, count)[:, None]
    points = []
    for p in pieces:
        if len(p) == 4:
            z = (1 - t) ** 3 * p[0] + 3 * t * (1 - t) ** 2 * p[1] + 3 * t * t * (1 - t) * p[2]
            z = z + t**3 * p[3]
        elif len(p) == 2:
            z = (1 - t) * p[0] + t * p[1]
        else:
            z = p[:, None]
        points.append(z[:, 0])
    return np.concatenate(points)


def color_of(element):
    style = element.get("style", "")
    found = re.search(r"(?<![-\w])stroke:\s*([^;]+)", style)
    value = element.get("stroke") or (found.group(1) if found else "")
    rgb = re.match(r"rgb\(([\d.]+)%,\s*([\d.]+)%,\s*([\d.]+)%\)", value)
    if rgb:
        return "#%02x%02x%02x" % tuple(round(2.55 * float(v)) for v in rgb.groups())
    return value


def read(text, count=1000):
    """Every subpath, in millimetres of the drawing's own coordinates, y up."""
    root = ElementTree.fromstring(text)
    result = []

    def walk(element, m, layer, color):
        m = m @ matrix_of(element.get("transform"))
        color = color_of(element) or color
        tag = element.tag.split("}")[-1]
        if tag in ("defs", "symbol", "clipPath"):
            return
        if tag == "g":
            layer = element.get(LABEL) or layer
        if tag == "path" and element.get("d"):
            for pieces in subpaths(element.get("d")):
                z = samples(pieces, count)
                p = m @ np.stack([z.real, z.imag, np.ones(len(z))])
                name = element.get(LABEL) or element.get("id", "")
                result.append(Curve(p[:2].T, name, layer, color))
        for child in element:
            walk(child, m, layer, color)

    walk(root, page_matrix(root), "", "")
    return result
