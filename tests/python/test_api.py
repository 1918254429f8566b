"""The package as its users meet it."""

import copy
import math
import os
import pathlib
import pickle
import signal
import threading
import time
import types

import numpy as np
import pytest

import keyline

HANDLES = [[0, 0], [2, 0], [3, 1.5]]


def spiral():
    """A curve whose radius is 1 at its start and falls or grows as a logarithmic spiral's does."""
    return keyline.Curve(
        {
            "type": "log-aesthetic", "start": [0, 0], "direction": 0, "closed": False,
            "pieces": [{"alpha": 1.0, "length": 2.0, "curvature": [1.0, 0.5]}],
        }
    )  # fmt: skip


def noisy_points(n=400):
    t = np.linspace(0, 1.4, n)
    random = np.random.default_rng(1)
    return np.stack([100 * np.sin(t), 60 * (1 - np.cos(t))], axis=1) + random.normal(0, 0.01, (n, 2))


def test_a_curve_answers_for_arrays_by_closed_forms():
    curve = spiral()
    s = np.linspace(0, 2, 1001)
    assert np.allclose(curve.curvature(s), 1 / (1 + s / 2), rtol=1e-14, atol=0)  # radius 1 + s/2
    angle = curve.tangent_angle(s)
    assert np.allclose(angle, 2 * np.log1p(s / 2), rtol=0, atol=1e-14)
    assert np.allclose(curve.tangent(s), np.stack([np.cos(angle), np.sin(angle)], axis=1), atol=1e-15)
    points = curve.point(s)
    chords = np.hypot(*np.diff(points, axis=0).T)
    assert abs(chords.sum() - 2) < 1e-6
    assert np.allclose(curve.curvature_rate(s), -0.5 / (1 + s / 2) ** 2, rtol=1e-12)


def test_shapes_and_kinds_of_places():
    curve = spiral()
    assert curve.point(0).tolist() == [0, 0]
    assert curve.curvature(0).shape == ()
    assert curve.point(np.zeros((3, 4))).shape == (3, 4, 2)
    assert curve.curvature([0, 1]).shape == (2,)
    assert curve.curvature(np.array([0, 1], dtype=np.float32)).dtype == np.float64
    assert np.array_equal(curve.curvature(np.arange(10)[::2] / 5), curve.curvature(np.arange(0, 10, 2) / 5))
    assert curve.point(-1).tolist() == curve.point(0).tolist()
    with pytest.raises(keyline.BadInput, match=r"s\[1\]"):
        curve.curvature([0, math.nan])


def test_places_out_of_order_on_many_pieces():
    chain = keyline.Curve(
        {
            "type": "log-aesthetic", "start": [1, 2], "direction": 0.5,
            "pieces": [
                {"alpha": -1, "length": 1, "curvature": [0, 1]},
                {"alpha": 0.5, "length": 2, "curvature": [1, 0.25]},
                {"alpha": -1, "length": 1, "curvature": [0.25, -1]},
            ],
        }
    )  # fmt: skip
    s = np.random.default_rng(3).uniform(0, 4, 200)
    for ask in (chain.point, chain.curvature, chain.tangent_angle, chain.curvature_rate):
        alone = np.array([ask(one) for one in s])
        assert np.array_equal(ask(s), alone)


def test_segment_is_a_curve_that_knows_the_rest():
    curve = keyline.lac.segment(HANDLES, -1)
    assert isinstance(curve, keyline.Curve)
    assert np.allclose(curve.point([0, curve.length]), [[0, 0], [3, 1.5]], atol=1e-12)
    assert curve.lambda_ == curve.result.lambda_ == keyline.perform("lac.segment", {"points": HANDLES, "alpha": -1})["lambda"]
    assert curve.reversed is True
    with pytest.raises(AttributeError):
        curve.no_such_thing
    assert keyline.Curve(curve.value) == curve
    assert pickle.loads(pickle.dumps(curve)) == curve


def test_bezier_keeps_its_promise():
    curve = keyline.lac.segment(HANDLES, -1)
    for tolerance in (1e-2, 1e-4, 1e-6):
        bezier = curve.to_bezier(tolerance)
        assert 0 <= bezier.deviation <= tolerance
        share = np.linspace(0, 1, 501)
        far = np.hypot(*(bezier.point(share * bezier.length) - curve.point(share * curve.length)).T)
        assert far.max() < 10 * tolerance


def test_many_segments_are_the_same_curves():
    random = np.random.default_rng(2)
    points = random.uniform(-1, 1, (500, 3, 2))
    alpha = random.uniform(-2, 2, 500)
    many = keyline.lac.segments(points, alpha)
    assert 0 < many.drawn.sum() < 500
    for i in range(0, 500, 7):
        try:
            one = keyline.lac.segment(points[i], alpha[i])
        except keyline.Undrawable:
            assert not many.drawn[i]
            continue
        if not many.drawn[i]:
            assert one.clamped  # one piece cannot hold its curvatures
            continue
        assert np.allclose(many[i].point(many.length[i]), points[i, 2], atol=1e-10)
        assert many.length[i] == pytest.approx(one.length, rel=1e-9)
    with pytest.raises(ValueError):
        many[int(np.flatnonzero(~many.drawn)[0])]
    assert np.array_equal(keyline.lac.segments(points, alpha, threads=1).length, many.length)


def test_the_columns_are_not_copies():
    many = keyline.lac.segments([HANDLES] * 3, -1)
    assert not many.length.flags.owndata and many.length.base is not None


def test_failures_are_exceptions_with_places():
    with pytest.raises(keyline.BadInput) as wrong:
        keyline.lac.segment([[0, 0], [1, 0], [2, math.inf]], -1)
    assert "points" in wrong.value.path
    with pytest.raises(keyline.Undrawable) as none:
        keyline.lac.segment([[0, 0], [0.1, 0], [1, 2]], 3)
    assert none.value.hint
    with pytest.raises(TypeError):
        keyline.lac.segment(HANDLES)
    with pytest.raises(TypeError):
        keyline.lac.segment(HANDLES, -1, no_such_field=1)
    with pytest.raises(TypeError):
        keyline.lac.segment(HANDLES, object())
    with pytest.raises(keyline.Error):
        keyline.perform("no.such", {})


def test_what_is_no_request_is_told_in_its_own_words():
    """Each once ended Python, or spoke of C++ types, or took a masked value for a measured one."""
    handles = [[0, 0], [2, 0], [3, 1.5]]
    ring: list = []
    ring.append(ring)
    with pytest.raises(RecursionError):
        keyline.lac.segment(ring, -1)
    masked = np.ma.array(handles, mask=[[0, 0], [0, 1], [0, 0]])
    for call in (lambda: keyline.lac.segment(masked, -1), lambda: keyline.lac.segments(masked[None], -1)):
        with pytest.raises(keyline.BadInput, match="masked"):
            call()
    assert keyline.lac.segment([[0, 0], [10**30, 0], [15 * 10**29, 10**30]], -1).length > 1e30
    with pytest.raises(keyline.BadInput, match="UTF-8"):
        keyline.read(os.fsdecode(b"\xe9.csv"))
    with pytest.raises(TypeError, match=r"keyline.lac.segment\(\): .*alhpa.*did you mean 'alpha'\?"):
        keyline.lac.segment(handles, alhpa=-1)
    with pytest.raises(TypeError, match="complex"):
        spiral().point(1j)
    given = types.MappingProxyType({"points": handles, "alpha": -1})
    assert keyline.perform("lac.segment", given)["lambda"] > 0


def test_beziers_that_cannot_be_are_told():
    for tolerance, degree in ((0, 3), (-1, 3), (math.nan, 3), (1e-3, 1), (1e-3, 99)):
        with pytest.raises(keyline.BadInput, match="tolerance|degree"):
            spiral().to_bezier(tolerance, degree)


def test_copies_know_the_rest_too():
    """A worker of a pool hands back what the result said, not the bare curve."""
    curve = keyline.lac.segment([[0, 0], [2, 0], [3, 1.5]], -1)
    for again in (copy.copy(curve), copy.deepcopy(curve), pickle.loads(pickle.dumps(curve))):
        assert again == curve and again.lambda_ == curve.lambda_
    cubics = curve.to_bezier(1e-4)
    assert pickle.loads(pickle.dumps(cubics)).deviation == cubics.deviation
    assert "lambda_" in dir(curve)


def test_fair_from_points_with_progress():
    told = []
    faired = keyline.fair(noisy_points(), progress=lambda share, doing: told.append((share, doing)))
    assert isinstance(faired, keyline.Curve)
    assert len(faired.pieces) >= 1
    assert told and all(0 <= share <= 1 for share, _ in told)
    assert faired.result.deviation.max <= 1


def test_an_exception_of_the_progress_function_stops_the_work():
    def refuse(share, doing):
        raise ZeroDivisionError

    start = time.monotonic()
    with pytest.raises(ZeroDivisionError):
        keyline.fair(noisy_points(20_000), progress=refuse)
    assert time.monotonic() - start < 30


def test_ctrl_c_cancels():
    timer = threading.Timer(0.2, os.kill, (os.getpid(), signal.SIGINT))
    timer.start()
    with pytest.raises(KeyboardInterrupt):
        while True:
            keyline.fair(noisy_points(20_000))


def test_other_threads_run_meanwhile():
    counted = []
    stop = threading.Event()

    def count():
        while not stop.wait(0.001):
            counted.append(time.monotonic())

    counter = threading.Thread(target=count)
    counter.start()
    keyline.fair(noisy_points())
    many = np.tile(np.asarray(HANDLES, dtype=float), (300_000, 1, 1))
    began = time.monotonic()
    keyline.lac.segments(many, 0.3, threads=1)
    ended = time.monotonic()
    stop.set()
    counter.join()
    assert sum(began < t < ended for t in counted) >= 2


def test_an_image_as_an_array_and_as_a_file(tmp_path):
    pixels = np.full((120, 200), 255, dtype=np.uint8)
    pixels[58:62, 20:180] = 0
    strokes = keyline.sketch(pixels).strokes
    assert len(strokes) == 1
    from keyline._image import png_of

    file = tmp_path / "line.png"
    file.write_bytes(png_of(pixels))
    assert len(keyline.sketch(file).strokes) == 1
    assert len(keyline.sketch(np.stack([pixels] * 3, axis=2) / 255).strokes) == 1


def test_pixels_of_every_kind_are_one_picture():
    """16 bits once wrapped round to 8, floats up to 255 were all white, transparent paper was black."""
    from keyline._image import png_of

    gray = np.array([[0, 51, 255], [102, 204, 153]])
    picture = png_of(gray)
    for same in (gray.astype(np.uint8), gray / 255, (gray * 257).astype(np.uint16)):
        assert png_of(same) == picture, same.dtype
    clear = np.zeros((2, 3, 4), np.uint8)
    assert png_of(clear) == png_of(np.full((2, 3, 3), 255))
    for wrong in (gray + 1, gray.astype(float), np.full((2, 3), np.nan), np.zeros((0, 0)), gray.astype(complex)):
        with pytest.raises(ValueError, match="pixels|image"):
            png_of(wrong)


def test_surfaces_answer_too():
    net = [[[i, k, 0.1 * i * k] for k in range(4)] for i in range(4)]
    surface = keyline.Surface({"type": "bezier-surface", "points": net})
    # a bilinear height over an even net: x = 3u, y = 3v, z = 0.9 uv
    u, v = np.array([0, 0.5, 1]), np.array([0, 0.25, 1])
    assert np.allclose(surface.point(u, v), np.stack([3 * u, 3 * v, 0.9 * u * v], axis=1))
    normal = np.stack([-0.3 * v, -0.3 * u, np.ones(3)], axis=1)
    assert np.allclose(surface.normal(u, v), normal / np.linalg.norm(normal, axis=1)[:, None])
    assert keyline.surface.sav(surface).sav >= 0


def test_notebooks_see_pictures():
    curve = keyline.lac.segment(HANDLES, -1)
    assert curve._repr_svg_().startswith("<svg")
    assert "lambda_" in curve._repr_html_()
    matplotlib = pytest.importorskip("matplotlib")
    matplotlib.use("Agg")
    axes = curve.plot(comb=0.2)
    assert len(axes.lines) > 10


def test_every_example_of_every_operation_gives_what_json_gives(monkeypatch):
    from keyline._operations import declarations

    monkeypatch.chdir(os.path.join(os.path.dirname(__file__), "..", ".."))
    for declaration in declarations():
        for example in declaration.examples:
            assert isinstance(keyline.perform(declaration.name, example), dict), declaration.name


def test_what_is_written_is_read_again(tmp_path):
    examples = pathlib.Path(__file__).resolve().parents[2] / "examples"
    curve = keyline.lac.segment([[0, 0], [2, 0], [3, 1.5]], -1)
    panel = keyline.read(examples / "panel-a.json").surfaces[0]
    named = {"name": "clothoid", "curve": curve}
    triangle = np.array([[0.0, 0.0], [3.0, 0.0], [3.0, 4.0]])
    keyline.write(tmp_path / "all.json", curve, named, triangle, panel, unit="mm")
    read = keyline.read(tmp_path / "all.json")
    assert [c.name for c in read.curves] == ["", "clothoid", ""]
    assert [c.curve.length for c in read.curves] == [curve.length, curve.length, 7.0]
    assert (read.unit, read.surfaces[0].name) == ("mm", "panel a")
    with pytest.raises(keyline.BadInput, match="nothing to write"):
        keyline.write(tmp_path / "none.json")


@pytest.mark.skipif(not os.path.isdir(os.environ.get("KEYLINE_SHARED_DATA", "")), reason="no shared data")
def test_what_was_read_is_a_request_again():
    examples = pathlib.Path(__file__).resolve().parents[2] / "examples"
    read = keyline.read(examples / "clothoid.csv")
    assert set(dict(read)) == set(read)
    given = keyline.fair(line=read.curves[0].line)
    assert given.curve.length == pytest.approx(100, abs=0.01)  # by clothoid-truth.json


def test_files_of_every_kind_are_read():
    assert hasattr(keyline, "document"), "document.read is not declared"
    folder = os.environ["KEYLINE_SHARED_DATA"]
    read = 0
    for root, _, names in os.walk(folder):
        for name in sorted(names):
            if name.endswith((".svg", ".dxf", ".step", ".glif")) and os.path.getsize(os.path.join(root, name)) < 300_000:
                try:
                    keyline.read(os.path.join(root, name))
                    read += 1
                except keyline.Error:
                    pass
            if read > 20:
                return
    assert read > 3
