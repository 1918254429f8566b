#!/usr/bin/env python3
"""Makes every input of this folder from a known truth: python3 examples/make_examples.py [FOLDER].

Standard library only, seeded: the same bytes on every run; a test compares them with the committed
files. Each curve is a chain of log-aesthetic pieces (slope, length, curvature at both ends); the
noisy files have their truth beside them as NAME-truth.json, in the form `keyline` prints.
"""

import json
import math
import sys
from pathlib import Path

from chains import Chain, Noise, Piece
from drawings import passes, photo, sketch


def measured(chain, noise, stations, sigma):
    points = [chain.point(s) for s in stations]
    return [(x + noise.normal(sigma), y + noise.normal(sigma)) for x, y in points]


def rows(points, form, separator=","):
    return "".join(separator.join(form % c for c in p) + "\n" for p in points)


def truth(chain, **more):
    return json.dumps({**chain.as_json(), **more}, indent=1) + "\n"


# ---- the car: bonnet, windscreen, roof; quarter scale, millimetres -------------------------------


def car_keyline():
    return Chain((0.0, 20.0, 0.62), [
        Piece(0.5, 395.0, -1 / 300, -1 / 1600),   # bonnet: convergent
        Piece(-1.0, 46.0, -1 / 1600, 1 / 55),     # into the hollow at the windscreen's foot
        Piece(-1.0, 20.0, 1 / 55, -1 / 840),      # and out of it
        Piece(2 / 3, 330.0, -1 / 840, -1 / 700),  # windscreen: almost one radius
        Piece(-1.0, 250.0, -1 / 700, -1 / 2600),  # roof, sharp: two pieces of slope -1
        Piece(-1.0, 200.0, -1 / 2600, -1 / 1200),
    ])


def bonnet_scan():
    chain, noise, sigma = car_keyline(), Noise("bonnet-scan"), 0.1
    points = measured(chain, noise, noise.stations(0, chain.length, 700), sigma)
    for i in (61, 187, 342, 343, 519, 660):  # specks of dust, and a reflection of two points
        x, y = points[i]
        points[i] = (x + noise.normal(1.0), y + 4 + 6 * noise.random())
    head = "# key-line of a car, side view, scanned from a clay model at 1:4\nx [mm],z [mm]\n"
    return {"bonnet-scan.csv": head + rows(points, "%.3f"),
            "bonnet-scan-truth.json": truth(chain, sigma=sigma)}


def parts_of_the_car():
    chain, files = car_keyline(), {}
    for name, low, high, count in (("bonnet", 0, 500, 210), ("windscreen", 420, 860, 190),
                                   ("roof", 770, chain.length, 200)):
        noise = Noise(name)
        points = measured(chain, noise, noise.stations(low, high, count), 0.1)
        files[name + ".csv"] = "x,z\n" + rows(points, "%.3f")
    return files


def car_lattice():
    """Rows across the car (y), columns along it; the middle row is the key-line."""
    chain, noise = car_keyline(), Noise("lattice")
    columns = [chain.point(i * chain.length / 89) for i in range(90)]
    text = "# range data of a clay model, mm: 11 rows (y) of 90 columns (x), blank line between rows\n"
    for row in range(11):
        y = (row - 5) * 20.0
        crown = [(x, y, z - y * y / 1500) for x, z in columns]
        points = [(px, py, pz + noise.normal(0.05)) for px, py, pz in crown]
        text += ("\n" if row else "") + rows(points, "%.3f", " ")
    return {"car-lattice.xyz": text}


def car_cloud():
    """Random surface points in metres at full scale, for --section y=0 --band 0.03."""
    chain, noise, points = car_keyline(), Noise("cloud"), []
    for _ in range(3600):
        x, z = chain.point(chain.length * noise.random())
        y = 150 * (2 * noise.random() - 1)
        points.append(tuple(c / 250 for c in (x, y, z - y * y / 1500 + noise.normal(0.1))))
    return {"car-cloud.xyz": rows(points, "%.5f", " ")}


# ---- other shapes -------------------------------------------------------------------------------


def hull_waterline():
    """Half breadths of a waterline, m, rounded to the millimetre: entrance, parallel body, run."""
    chain = Chain((0.0, 0.0, 0.30), [
        Piece(-1.0, 9.0, 0.0, -1 / 48),
        Piece(-0.7, turning_length(-0.7, -1 / 48, 0.0, -0.30 + 9.0 / 96), -1 / 48, 0.0),
        Piece(-1.0, 11.0, 0.0, 0.0),
        Piece(-1.2, 12.0, 0.0, -1 / 40),
        Piece(-1.0, 6.0, -1 / 40, 0.0),
    ])
    points = [chain.point(i * chain.length / 60) for i in range(61)]
    head = "# waterline of a hull, half breadths in metres\nstation\thalf_breadth\n"
    return {"hull-waterline.tsv": head + rows(points, "%.3f", "\t"),
            "hull-waterline-truth.json": truth(chain)}


def turning_length(alpha, curvature_start, curvature_end, turning):
    """Length at which a piece of these ends turns by the given angle."""
    return turning / Piece(alpha, 1.0, curvature_start, curvature_end).turning(1)


def airfoil():
    """Selig's order, trailing edge over the nose and back; NACA four-digit formulas, 3412."""
    m, p, t = 0.03, 0.4, 0.12

    def surface(x, side):
        half = 5 * t * (0.2969 * math.sqrt(x) - 0.1260 * x - 0.3516 * x**2 + 0.2843 * x**3
                        - 0.1036 * x**4)
        scale, inner = (m / p**2, 0.0) if x < p else (m / (1 - p) ** 2, 1 - 2 * p)
        camber = scale * (inner + 2 * p * x - x * x)
        slope = math.atan(2 * scale * (p - x))
        return x - side * half * math.sin(slope), camber + side * half * math.cos(slope)

    xs = [(1 + math.cos(math.pi * i / 45)) / 2 for i in range(46)]
    points = [surface(x, 1) for x in xs] + [surface(x, -1) for x in reversed(xs[:-1])]
    lines = "".join(" %9.6f %9.6f\n" % p for p in points)
    return {"airfoil.dat": "KEYLINE 3412 made from formulas\n" + lines}


def bottle():
    """Half profile with corners at foot and lip: foot, body, shoulder, neck, lip; mm."""
    shoulder = 0.9
    drop = turning_length(-1.0, 0.0, 1 / 30, shoulder / 2)
    wall = Chain((36.0, 0.0, math.pi / 2), [
        Piece(-1.0, 110.0, 0.0, 0.0),
        Piece(-1.0, drop, 0.0, 1 / 30), Piece(-1.0, drop, 1 / 30, 0.0),
        Piece(-1.0, drop, 0.0, -1 / 30), Piece(-1.0, drop, -1 / 30, 0.0),
        Piece(-1.0, 45.0, 0.0, 0.0),
    ])
    noise = Noise("bottle")
    x_neck, y_top, _ = wall.poses[-1]
    points = [(36.0 * i / 30, 0.0) for i in range(30)]
    points += [wall.point(s) for s in noise.stations(0, wall.length, 260)]
    points += [(x_neck - x_neck * i / 20, y_top) for i in range(1, 11)]
    points = [(x + noise.normal(0.04), y + noise.normal(0.04)) for x, y in points]
    return {"bottle.csv": "r;h\n" + rows(points, "%.3f", ";"),
            "bottle-truth.json": truth(wall, sigma=0.04)}


def unordered():
    """An S-shaped curve whose points come in no order at all."""
    chain = Chain((-20.0, 5.0, -0.4), [Piece(-1.0, 80.0, 1 / 30, -1 / 25),
                                       Piece(1.0, 60.0, -1 / 25, -1 / 90)])
    noise = Noise("unordered")
    points = measured(chain, noise, noise.stations(0, chain.length, 220), 0.02)
    noise.shuffle(points)
    return {"unordered.xyz": rows(points, "%.4f", " "),
            "unordered-truth.json": truth(chain, sigma=0.02)}


def outlines():
    """Two closed outlines told apart by an id column, each of four quarters mirrored into each other."""
    text, noise = "id,x,y\n", Noise("outlines")
    ovals = (("pebble", 0.5, 1 / 60, 1 / 25, 0.0), ("egg", -0.5, 1 / 80, 1 / 30, 150.0))
    for name, alpha, k0, k1, x in ovals:
        length = turning_length(alpha, k0, k1, math.pi / 2)
        there, back = Piece(alpha, length, k0, k1), Piece(alpha, length, k1, k0)
        chain = Chain((x, 0.0, 0.0), [there, back, there, back], closed=True)
        stations = [chain.length * i / 180 for i in range(180)]
        for p in measured(chain, noise, stations, 0.03):
            text += name + "," + rows([p], "%.3f")
    return {"outlines.csv": text}


def clothoid():
    """Exact points of one clothoid, from a straight start to radius 40 over length 100."""
    chain = Chain((10.0, -5.0, 0.25), [Piece(-1.0, 100.0, 0.0, 1 / 40)])
    points = [chain.point(i) for i in range(101)]
    return {"clothoid.csv": "x,y\n" + rows(points, "%.12f"), "clothoid-truth.json": truth(chain)}


def cubic():
    """The cubic of Oya, Hanafusa and Aoyama, section 4.1: edges v, Mv, M^2 v with v = (1, 2) and M a
    rotation by pi/4 times 1.05. Not Class A."""
    points, edge = [(0.0, 0.0)], complex(1, 2)
    for _ in range(3):
        points.append((points[-1][0] + edge.real, points[-1][1] + edge.imag))
        edge *= 1.05 * complex(math.cos(math.pi / 4), math.sin(math.pi / 4))
    listed = ",".join("[%.12f,%.12f]" % p for p in points)
    return {"cubic.json": '{"type":"bezier","points":[%s]}\n' % listed}


def matrix_edges(alpha, s, length, right, up, count=3):
    """Edges v, Mv, M^2 v of a control polygon in the plane of right and up."""
    edges = []
    for i in range(count):
        a, b = (length * s ** i * f(i * alpha) for f in (math.cos, math.sin))
        edges.append([a * r + b * u for r, u in zip(right, up)])
    return edges


def translational_net(row, column):
    """A net whose rows are translates of each other, and so its columns."""
    net, start = [], [0.0, 0.0, 0.0]
    for step in column + [[0.0, 0.0, 0.0]]:
        point, line = list(start), [list(start)]
        for edge in row:
            point = [p + e for p, e in zip(point, edge)]
            line.append(point)
        net.append(line)
        start = [p + e for p, e in zip(start, step)]
    return net


def surface_file(name, net, **more):
    rows_text = ",\n".join("[" + ",".join("[%.9f,%.9f,%.9f]" % tuple(p) for p in row) + "]"
                           for row in net)
    head = {"type": "bezier-surface", "name": name, "unit": "mm", **more}
    return json.dumps(head)[:-1] + ', "points":[\n' + rows_text + "]}\n"


def panels():
    """Bicubic patches like the surfaces (a), (b) and (c) of Oya, Hanafusa and Aoyama: all network
    curves Class A; six with one matrix outside Class A and two with none; all pushed out of shape."""
    x, y, z = (1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, 1.0)
    a = translational_net(matrix_edges(0.28, 1.32, 75.0, x, z), matrix_edges(0.22, 1.28, 55.0, y, z))
    b = translational_net(matrix_edges(0.30, 1.02, 100.0, x, z), matrix_edges(0.24, 1.01, 70.0, y, z))
    b[1][2] = [p + d for p, d in zip(b[1][2], (2.0, 1.5, 0.5))]
    noise, c = Noise("panel-c"), []
    for i in range(4):
        line = []
        for j in range(4):
            u, v = i / 3, j / 3
            exact = (300 * v + 8 * u * u, 200 * u + 11 * v * v,
                     40 * v * (1.3 - v) + 25 * u * (1.1 - u) + 9 * v * v * u)
            line.append([q + noise.normal(2.5) for q in exact])
        c.append(line)
    return {"panel-a.json": surface_file("panel a", a), "panel-b.json": surface_file("panel b", b),
            "panel-c.json": surface_file("panel c", c)}


def skin():
    """A bicubic B-spline surface of two by three Bezier patches: a crowned roof with a dent."""
    def knots(inner):
        return [0.0] * 4 + inner + [1.0] * 4
    net = []
    for i in range(5):
        line = []
        for j in range(6):
            u, v = i / 4, j / 5
            dent = 6.0 * math.exp(-((u - 0.6) ** 2 + (v - 0.4) ** 2) / 0.03)
            line.append([1200 * v, 900 * (u - 0.5), 140 * v * (1.6 - v) - 160 * (u - 0.5) ** 2 - dent])
        net.append(line)
    text = surface_file("roof skin", net, degree=[3, 3],
                        knots=[knots([0.5]), knots([1 / 3, 2 / 3])])
    return {"skin.json": text.replace("bezier-surface", "bspline-surface")}


def hood():
    """Curves of a bonnet that cross like warp and weft: cubics over a plane, sums of one along and
    one across, so that they meet."""
    length, width = 1200.0, 900.0
    along, across = (0.0, 55.0, 75.0, 60.0), (0.0, 40.0, 40.0, 0.0)

    def height(control, t):
        return sum(c * b for c, b in zip(control, ((1 - t) ** 3, 3 * t * (1 - t) ** 2,
                                                   3 * t * t * (1 - t), t ** 3)))

    def curves_file(name, curves):
        rows = ",\n".join('{"name": "%s %d", "curve": {"type": "bezier", "points": [%s]}}' %
                          (name, i + 1, ",".join("[%.9f,%.9f,%.9f]" % p for p in points))
                          for i, points in enumerate(curves))
        return '{"unit": "mm", "curves": [\n' + rows + "]}\n"

    u = [[(length * i / 3, width * t, z + height(across, t)) for i, z in enumerate(along)]
         for t in (0.0, 0.5, 1.0)]
    v = [[(length * t, width * i / 3, z + height(along, t)) for i, z in enumerate(across)]
         for t in (0.0, 0.4, 1.0)]
    return {"hood-along.json": curves_file("along", u),
            "hood-across.json": curves_file("across", v)}


MAKERS = (bonnet_scan, parts_of_the_car, car_lattice, car_cloud, hull_waterline, airfoil, bottle,
          unordered, outlines, clothoid, cubic, panels, skin, hood, sketch, photo, passes)


def main():
    folder = Path(sys.argv[1]) if len(sys.argv) > 1 else Path(__file__).resolve().parent
    folder.mkdir(parents=True, exist_ok=True)
    for make in MAKERS:
        for name, text in make().items():
            if isinstance(text, bytes):
                (folder / name).write_bytes(text)
            else:
                (folder / name).write_text(text, encoding="utf-8", newline="\n")


if __name__ == "__main__":
    main()
