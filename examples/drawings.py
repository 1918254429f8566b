"""Pictures of a small car in pencil, for make_examples.py."""

import math
import struct
import zlib

from chains import Noise


def grey_png(width, height, rows):
    """PNG bytes of an 8 bit grey picture with 120 dots per inch."""
    def chunk(name, data):
        return (struct.pack(">I", len(data)) + name + data
                + struct.pack(">I", zlib.crc32(name + data)))
    header = struct.pack(">IIBBBBB", width, height, 8, 0, 0, 0, 0)
    per_metre = struct.pack(">IIB", 4724, 4724, 1)
    lines = b"".join(b"\0" + bytes(row) for row in rows)
    return (b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", header) + chunk(b"pHYs", per_metre)
            + chunk(b"IDAT", zlib.compress(lines, 9)) + chunk(b"IEND", b""))


def bezier(handles, count=600):
    """Points of a cubic."""
    for i in range(count + 1):
        t = i / count
        b = ((1 - t) ** 3, 3 * t * (1 - t) ** 2, 3 * t * t * (1 - t), t ** 3)
        yield tuple(sum(w * h[k] for w, h in zip(b, handles)) for k in (0, 1))


def pencil(page, width, points, noise, wide, dark):
    """Draws a soft line: darkness by distance from the points, pressure swelling along it."""
    points = list(points)
    phase = noise.random() * 6.28
    for i, (x, y) in enumerate(points):
        u = i / len(points)
        half = 0.5 * wide * (0.75 + 0.25 * math.sin(3 * u + phase))
        x += 0.3 * math.sin(9 * u + phase)
        y += 0.3 * math.cos(7 * u + phase)
        for row in range(int(y - half - 1), int(y + half + 2)):
            for column in range(int(x - half - 1), int(x + half + 2)):
                reach = half + 0.5 - math.hypot(column + 0.5 - x, row + 0.5 - y)
                at = row * width + column
                page[at] = max(page[at], dark * min(1.0, max(0.0, reach)))


def car_in_pencil(width, height, noise):
    """Ink of a small car from the side, the roof line drawn three times."""
    ink = [0.0] * (width * height)
    roof = [(70, 200), (170, 150), (220, 70), (350, 68)]
    rear = [(350, 68), (470, 66), (540, 110), (585, 190)]
    for shift in (0.0, 1.6, -1.8):
        for part in (roof, rear):
            moved = [(x, y + shift * (1 if i in (1, 2) else 0.4)) for i, (x, y) in enumerate(part)]
            pencil(ink, width, bezier(moved), noise, 2.2, 0.62)
    lines = [[(70, 200), (55, 215), (55, 240), (70, 250)],
             [(585, 190), (600, 215), (600, 240), (585, 250)],
             [(222, 128), (250, 95), (300, 88), (340, 88)],
             [(222, 128), (280, 126), (320, 124), (340, 122)],
             [(356, 88), (420, 86), (470, 98), (500, 120)],
             [(356, 122), (400, 121), (460, 121), (500, 120)],
             [(70, 250), (78, 251), (85, 252), (98, 252)],
             [(206, 252), (280, 254), (380, 254), (440, 252)],
             [(548, 252), (560, 252), (575, 251), (585, 250)]]
    for line in lines:
        pencil(ink, width, bezier(line), noise, 2.6, 0.7)
    for centre in (152, 494):
        for radius in (54, 40):
            circle = [(centre + radius * math.cos(0.01 * k), 254 + radius * math.sin(0.01 * k))
                      for k in range(315 if radius == 54 else 0, 629)]
            pencil(ink, width, circle, noise, 2.8, 0.75)
    return ink


def on_shaded_paper(ink, width, height, noise):
    """Rows of grey, the paper darker towards the lower right."""
    rows = []
    for y in range(height):
        row = []
        for x in range(width):
            paper = 236 - 40 * (x / width) ** 2 - 18 * (y / height) + noise.normal(1.5)
            row.append(max(0, min(255, round(paper * (1 - ink[y * width + x])))))
        rows.append(row)
    return rows


def sketch():
    """The car on shaded paper."""
    width, height = 640, 320
    noise = Noise("sketch.png")
    ink = car_in_pencil(width, height, noise)
    return {"sketch.png": grey_png(width, height, on_shaded_paper(ink, width, height, noise))}


def passes():
    """A shoulder line looked for in four passes, an arch in three, and a sill drawn once."""
    width, height = 480, 240
    noise = Noise("passes.png")
    ink = [0.0] * (width * height)
    shoulder = [(40, 120), (150, 70), (300, 60), (440, 110)]
    arch = [(90, 200), (100, 110), (200, 110), (210, 200)]
    for line, times in ((shoulder, 4), (arch, 3)):
        for _ in range(times):
            handles = [(x + noise.normal(3), y + noise.normal(3)) for x, y in line]
            pencil(ink, width, bezier(handles), noise, 2.2, 0.7)
    pencil(ink, width, bezier([(230, 200), (300, 204), (370, 203), (440, 196)]), noise, 2.2, 0.7)
    return {"passes.png": grey_png(width, height, on_shaded_paper(ink, width, height, noise))}


def unit(v, sign=1):
    """v at length 1, turned round for -1."""
    return tuple(sign * c / math.hypot(*v) for c in v)


def across(a, b):
    """Cross product."""
    return (a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0])


def photo():
    """The car on a sheet that lies aslant on a dark table, half of it in shadow."""
    wide, high = 640, 320
    noise = Noise("photo.png")
    ink = car_in_pencil(wide, high, noise)
    width, height = 760, 570
    focal = 0.8 * math.hypot(width, height)
    away = 1.25 * math.hypot(wide, high)
    slant, turn = 0.6, 0.25  # the camera looks down from the lower right
    forward = unit((-0.3 * math.sin(slant), -0.95 * math.sin(slant), math.cos(slant)))
    right = unit(across(forward, (math.sin(turn), math.cos(turn), 0)), -1)
    down = across(forward, right)
    rows = []
    for y in range(height):
        row = []
        for x in range(width):
            light = 0.0
            for i in range(4):
                u, v = x + 0.25 + 0.5 * (i % 2) - width / 2, y + 0.25 + 0.5 * (i // 2) - height / 2
                ray = [focal * f + u * r + v * d for f, r, d in zip(forward, right, down)]
                far = away * forward[2] / ray[2]
                px = wide / 2 - away * forward[0] + far * ray[0]
                py = high / 2 - away * forward[1] + far * ray[1]
                if 0 <= px < wide and 0 <= py < high:
                    light += 0.25 * 0.82 * (1 - 0.9 * ink[int(py) * wide + int(px)])
                else:
                    light += 0.25 * (0.16 + 0.02 * math.sin(0.15 * px + 3 * math.sin(0.01 * py)))
            shadow = 1 / (1 + math.exp(-0.07 * (x - 330 + 0.35 * y)))
            grey = 255 * (light * (0.5 + 0.5 * shadow)) ** (1 / 2.2) + noise.normal(1.2)
            row.append(max(0, min(255, round(grey))))
        rows.append(row)
    return {"photo.png": grey_png(width, height, rows)}
