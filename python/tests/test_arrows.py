import concurrent.futures
import contextlib
import gc
import json
import os
import pickle
import resource
import signal
import subprocess
import threading
import warnings

import numpy as np
import pytest

import flowgrain
from conftest import is_land, ocean, vortices

PROGRAM = os.environ.get("FLOWGRAIN_PROGRAM")


def moved(count, at, to):
    """An axis with a sample elsewhere."""
    axis = np.arange(float(count))
    axis[at] = to
    return axis


def same(one, other):
    return len(one) == len(other) and all(map(np.array_equal, one.paths, other.paths))


@pytest.fixture(scope="module")
def dozen(field):
    return flowgrain.arrows(*field, n=12)


def test_arrows_follow_the_flow(field, dozen):
    x, y, u, v = field
    assert len(dozen) == 12 and dozen.counts.arrows == 12
    for arrow in dozen:
        way = np.diff(arrow.path, axis=0)
        middle = 0.5 * (arrow.path[1:] + arrow.path[:-1])
        i, j = np.searchsorted(x, middle[:, 0]) - 1, np.searchsorted(y, middle[:, 1]) - 1
        there = np.stack([u[j, i] + u[j + 1, i + 1], v[j, i] + v[j + 1, i + 1]], 1)
        cosine = (way * there).sum(1) / np.hypot(*way.T) / np.hypot(*there.T)
        assert np.median(cosine) > 0.98  # tail to tip, along the flow
        assert abs(_area(arrow.outline)) > 0.5 * arrow.area * 0.01
    assert np.isclose(dozen.area.sum(), 48.0, rtol=0.05)
    assert 0.0 < dozen.error < 15.0
    assert dozen.bounds.tolist() == [[1.0, 9.0], [-2.0, 4.0]]


def _area(polygon):
    x, y = polygon.T
    return 0.5 * (x * np.roll(y, -1) - y * np.roll(x, -1)).sum()


@pytest.mark.skipif(not PROGRAM, reason="FLOWGRAIN_PROGRAM names no program to compare with")
@pytest.mark.parametrize("options, arguments", [
    (["--arrows", "20"], {"n": 20}),
    (["--arrows", "9", "--seed", "5", "--start", "even"], {"n": 9, "seed": 5, "start": "even"}),
    (["--clusters", "9", "--nodes", "129"], {"n": 9, "kind": "clusters", "nodes": 129}),
])
def test_same_bits_as_the_program(tmp_path, field, options, arguments):
    x, y, u, v = field
    np.savez(tmp_path / "field.npz", u=u, v=v, x=x, y=y)
    subprocess.run([PROGRAM, "run", tmp_path / "field.npz", "-o", tmp_path / "out", "--quiet",
                    *options], check=True)
    theirs = json.loads((tmp_path / "out" / "scale-00.geojson").read_text())
    ours = flowgrain.arrows(x, y, u, v, **arguments).to_geojson()
    assert ours["clusters"] == theirs["clusters"] and ours["dropped"] == theirs["dropped"]
    assert len(ours["features"]) == len(theirs["features"])
    for mine, other in zip(ours["features"], theirs["features"]):
        assert mine["geometry"] == other["geometry"]
        for name, value in mine["properties"].items():
            assert value == other["properties"][name], name
    if "error" in theirs:
        error = flowgrain.arrows(x, y, u, v, **arguments).error
        assert error == pytest.approx(theirs["error"]["mean"], rel=1e-12)


X, Y = np.meshgrid(np.linspace(-1.0, 2.0, 31), np.linspace(-1.0, 1.0, 21))
RING = [(2.0 + Y) * np.cos(X), (2.0 + Y) * np.sin(X)]  # a curvilinear grid
ROTATION, SADDLE, SOURCE = (-Y, X), (X, -Y), (X + 0.2, Y)
SHEAR, STILL, WAVES = (Y, 0.0 * Y), (1.0 + 0.0 * Y, 0.0 * Y), (np.cos(3 * X), np.sin(4 * Y + X))
CORE = [c / (0.05 + X * X + Y * Y) for c in ROTATION]  # one orientation but near its centre
AXES = (X[0], Y[:, 0])


@pytest.mark.parametrize("first, second, order, warning", [
    # the documented order, in which meshes and axes are never doubted but for what are such, too
    (AXES, ROTATION, "xyuv", None), (AXES, SADDLE, "xyuv", None), (AXES, WAVES, "xyuv", None),
    ((X, Y), WAVES, "xyuv", None), ((X, Y), SHEAR, "xyuv", None), ((X, Y), CORE, "xyuv", None),
    ((X, Y), STILL, "xyuv", None), ((X, Y), (X, Y), "xyuv", None), (RING, WAVES, "xyuv", None),
    ((X, Y), RING, "xyuv", None), ((X.T, Y.T), [c.T for c in WAVES], "xyuv", None),
    # both are possible
    ((X, Y), ROTATION, "xyuv", UserWarning), ((X, Y), SADDLE, "xyuv", UserWarning),
    ((X, Y), SOURCE, "xyuv", UserWarning), (ROTATION, (X, Y), "xyuv", UserWarning),
    ((X.T, Y.T), [c.T for c in ROTATION], "xyuv", UserWarning),
    (RING, CORE, "xyuv", UserWarning),
    # the order of before
    (WAVES, AXES, "uvxy", FutureWarning), (ROTATION, AXES, "uvxy", FutureWarning),
    (WAVES, (X, Y), "uvxy", FutureWarning), (SHEAR, (X, Y), "uvxy", FutureWarning),
    (STILL, (X, Y), "uvxy", FutureWarning), (CORE, (X, Y), "uvxy", FutureWarning),
    (WAVES, RING, "uvxy", FutureWarning), (WAVES, (X.tolist(), Y.tolist()), "uvxy", FutureWarning),
    (WAVES, (None, None), "uvxy", FutureWarning),
])
def test_order_of_arguments(first, second, order, warning):
    named = dict(zip(order, (*first, *second)), n=3, nodes=33)
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        expected = flowgrain.arrows(**named)  # without a doubt
    with pytest.warns(warning) if warning else contextlib.nullcontext():
        assert same(expected, flowgrain.arrows(*first, *second, n=3, nodes=33))
    if order == "xyuv":
        assert same(expected, flowgrain.arrows(*second, x=first[0], y=first[1], n=3, nodes=33))
        assert same(expected, flowgrain.arrows(*first, u=second[0], v=second[1], n=3, nodes=33))


@pytest.mark.parametrize("args, names", [
    ((X,), {}), ((X, Y, X), {}), ((X, Y, X, Y), {"u": X}), ((X, Y, X, Y, X), {}), ((), {}),
    ((), {"u": X}), ((), {"x": X, "y": Y}), ((X, Y), {"x": X, "u": X}),
])
def test_arguments_that_lack_something(args, names):
    with pytest.raises(TypeError, match="are needed"):
        flowgrain.arrows(*args, **names)


def test_any_type_and_order_of_samples(field, dozen):
    x, y, u, v = field
    assert same(dozen, flowgrain.arrows(x, y, u.astype(">f8"), np.asfortranarray(v), n=12))
    assert same(dozen, flowgrain.arrows(x[::-1], y[::-1], u[::-1, ::-1], v[::-1, ::-1], n=12))
    assert same(dozen, flowgrain.arrows(*np.meshgrid(x, y), u, v, n=12))
    assert same(dozen, flowgrain.arrows(list(x), list(y), u.tolist(), v.tolist(), n=12))
    whole = np.rint(u * 20).astype(np.int8), np.rint(v * 20).astype(np.int8)
    floats = [c.astype(np.float32) for c in whole]
    assert same(flowgrain.arrows(*whole, n=5), flowgrain.arrows(*floats, n=5))


@pytest.mark.parametrize("k", [0, 1])
@pytest.mark.parametrize("way", [1, -1])
def test_axes_that_begin_within_are_rolled(field, dozen, k, way):
    x, y, u, v = field
    axes = [x, y]
    axes[k] = np.roll(axes[k], 17)[::way]
    u, v = (np.flip(c, 1 - k) if way < 0 else c for c in (np.roll(c, 17, 1 - k) for c in (u, v)))
    found = flowgrain.arrows(*axes, u, v, n=12)
    assert same(dozen, found)
    labels = np.flip(found.labels, 1 - k) if way < 0 else found.labels
    assert np.array_equal(labels, np.roll(dozen.labels, 17, 1 - k))
    assert same(dozen, flowgrain.arrows(*np.meshgrid(*axes), u, v, n=12))


def test_axes_of_a_volume_are_ordered():
    axis = np.linspace(0.0, 1.0, 9)
    z, y, x = np.meshgrid(axis, axis, axis, indexing="ij")
    u, v, w = 0.5 - y, x - 0.5, 0.1 + 0.2 * z
    plain = flowgrain.arrows(axis, axis, u, v, w=w, z=axis, n=3, nodes=9)
    u, v, w = (np.roll(c[:, :, ::-1], 4, 0) for c in (u, v, w))
    assert same(plain, flowgrain.arrows(axis[::-1], axis, u, v, w=w, z=np.roll(axis, 4), n=3,
                                        nodes=9))
    with pytest.raises(ValueError, match=r"z\[2\] is nan"):
        flowgrain.arrows(axis, axis, u, v, w=w, z=moved(9, 2, np.nan))


def globe(longitude):
    """A wind, (ny, nx), and its latitudes."""
    latitude = np.arange(-60.0, 61.0, 5.0)
    lon, lat = np.meshgrid(np.radians(longitude), np.radians(latitude))
    return 10.0 * np.cos(lat) + 2.0 * np.sin(lon), 3.0 * np.sin(3.0 * lon), latitude


@pytest.mark.parametrize("east", [360.0, 355.0])  # with the first meridian twice, or once
@pytest.mark.parametrize("break_at", [180.0, 175.0, 90.0])
def test_longitudes_of_any_half(east, break_at):
    longitude = np.arange(0.0, east + 1.0, 5.0)
    u, v, latitude = globe(longitude)
    turned = np.where(longitude > break_at, longitude - 360.0, longitude)
    options = {"n": 10, "period": 360, "scale": "geo"}
    found = flowgrain.arrows(turned, latitude, u, v, **options)
    order = np.unique(turned, return_index=True)[1]
    assert same(found, flowgrain.arrows(turned[order], latitude, u[:, order], v[:, order],
                                        **options))
    assert found.labels.shape == u.shape


def test_a_region_across_the_antimeridian():
    """Longitudes go on where they are known as such; else nothing is drawn where there is none."""
    longitude = np.arange(100.0, 261.0, 5.0)
    u, v, latitude = globe(longitude)
    turned = np.where(longitude > 180.0, longitude - 360.0, longitude)
    geo = flowgrain.arrows(turned, latitude, u, v, n=10, scale="geo")
    assert same(geo, flowgrain.arrows(longitude, latitude, u, v, n=10, scale="geo"))
    assert geo.bounds[0].tolist() == [100.0, 260.0]
    assert set(np.unique(geo.labels)) >= set(range(1, geo.counts.clusters + 1))
    plain = flowgrain.arrows(turned, latitude, u, v, n=10)
    for path in plain.paths:
        assert (path[:, 0] < -100.0 + 1e-6).all() or (path[:, 0] > 100.0 - 1e-6).all()


def stations(count=900, west=0.0):
    """x, y, u, v of points with a hole, in an order of their own."""
    random = np.random.default_rng(5)
    x, y = random.uniform(0.0, 8.0, count), random.uniform(0.0, 6.0, count)
    kept = np.hypot(x - 4.0, y - 3.0) > 1.6
    x, y = x[kept], y[kept]
    return west + x, y, 1.0 + np.sin(y), np.cos(0.7 * x)


@pytest.mark.skipif(not PROGRAM, reason="FLOWGRAIN_PROGRAM names no program to compare with")
def test_points_are_read_as_the_program_reads_tables(tmp_path):
    points = [np.float32(a).astype(float) for a in stations()]
    np.savetxt(tmp_path / "points.csv", np.stack(points, 1), "%.17g", ",", header="x,y,u,v",
               comments="")
    subprocess.run([PROGRAM, "run", tmp_path / "points.csv", "-o", tmp_path / "out", "--quiet",
                    "--arrows", "9"], check=True)
    theirs = json.loads((tmp_path / "out" / "scale-00.geojson").read_text())["features"]
    ours = flowgrain.arrows(*points, n=9).to_geojson()["features"]
    assert [f["geometry"] for f in ours] == [f["geometry"] for f in theirs]


def test_points():
    x, y, u, v = stations()
    found = flowgrain.arrows(x, y, u, v, n=10)
    assert found.labels.shape == x.shape
    for path in found.paths:
        assert np.hypot(*(path - (4.0, 3.0)).T).min() > 1.2  # not over the hole
        middle, way = 0.5 * (path[1:] + path[:-1]), np.diff(path, axis=0)
        there = np.stack([1.0 + np.sin(middle[:, 1]), np.cos(0.7 * middle[:, 0])], 1)
        cosine = (way * there).sum(1) / np.hypot(*way.T) / np.hypot(*there.T)
        assert np.median(cosine) > 0.99
    gone = np.hypot(x - 1.5, y - 4.0) < 1.2
    for path in flowgrain.arrows(x, y, u, v, mask=gone, n=10).paths:
        assert np.hypot(*(path - (1.5, 4.0)).T).min() > 0.9
    east = flowgrain.arrows(*stations(west=176.0), n=10, scale="geo")
    x, y, u, v = stations(west=176.0)
    turned = flowgrain.arrows(np.where(x > 180.0, x - 360.0, x), y, u, v, n=10, scale="geo")
    assert same(east, turned) and np.array_equal(east.labels, turned.labels)
    assert east.bounds[0] == pytest.approx((176.0, 184.0), abs=0.1)


def test_points_of_a_grid_are_its_samples(field, dozen):
    x, y, u, v = field
    order = np.random.default_rng(2).permutation(u.size)
    points = [a.ravel()[order] for a in (*np.meshgrid(x, y), u, v)]
    found = flowgrain.arrows(*points, n=12)
    assert same(dozen, found) and np.array_equal(found.labels, dozen.labels.ravel()[order])


def test_points_in_space():
    x, y, z = np.random.default_rng(1).uniform(0.0, 1.0, (3, 800))
    found = flowgrain.arrows(x, y, 0.5 - y, x - 0.5, w=0.3 + 0.0 * z, z=z, n=3, nodes=17)
    assert found.bounds.shape == (3, 2) and len(found) == 3 and found.labels.shape == (800,)
    with pytest.raises(ValueError, match="lie in a plane"):
        flowgrain.arrows(x, y, x, y, w=x, z=0.0 * z, n=3)


@pytest.mark.parametrize("change, message", [
    ({"x": None, "y": None}, "x, y need the same, not none"),
    ({"x": np.arange(7)}, r"not \(7,\), \("),
    ({"y": None}, "need the same"),
    ({"period": 360}, "no period"),
    ({"x": np.arange(340.0), "y": np.arange(340.0)}, "lie on one line"),
    ({"x": np.arange(340) // 2, "y": np.arange(340) // 2}, "points 0 and 1, both at.*\nleave one "
                                                           "time and one level$"),
    ({"x": moved(340, 9, np.inf)}, "point 9: the point's coordinate 1 is inf"),
    ({"u": np.full(340, -9999.0), "v": np.full(340, -9999.0)}, "point 0: both.*\nmake it NaN"),
    ({"scale": "geo", "y": np.arange(340.0)}, "no place on the globe"),
])
def test_refused_points(change, message):
    points = {k: a[:340] for k, a in zip(("x", "y", "u", "v"), stations())}
    with pytest.raises(ValueError, match=message):
        flowgrain.arrows(**{**points, **change})


def test_missing_samples_are_avoided(field):
    x, y, u, v = field
    hole = np.hypot(*np.meshgrid(x - 6.0, y - 1.0)) < 1.2
    nan = np.where(hole, np.nan, u)
    masked = np.ma.masked_array(u, hole)
    given = flowgrain.arrows(x, y, u, v, n=12, mask=hole)
    assert same(given, flowgrain.arrows(x, y, nan, v, n=12))
    assert same(given, flowgrain.arrows(x, y, masked, v, n=12))
    for path in given.paths:
        assert np.hypot(*(path - (6.0, 1.0)).T).min() > 1.1
    assert (given.labels[np.hypot(*np.meshgrid(x - 6.0, y - 1.0)) < 1.0] < 1).all()


def test_labels_are_of_the_samples(field, dozen):
    x, y, u, v = field
    assert dozen.labels.shape == u.shape
    assert set(np.unique(dozen.labels)) >= set(range(1, dozen.counts.clusters + 1))
    clusters = flowgrain.arrows(*field, n=12, kind="clusters")
    assert len(clusters) + clusters.counts.dropped >= clusters.counts.clusters
    for center, cluster in zip(clusters.center, clusters.cluster):
        at = np.abs(y - center[1]).argmin(), np.abs(x - center[0]).argmin()
        assert clusters.labels[at] == cluster
    # turned samples have turned labels
    turned = flowgrain.arrows(x, y[::-1], u[::-1], v[::-1], n=12)
    assert np.array_equal(turned.labels, dozen.labels[::-1])


def test_uneven_and_curvilinear_coordinates():
    # solid rotation, which bilinear samples have exactly
    x, y = np.linspace(-1.0, 1.0, 41) ** 3, np.linspace(-1.0, 1.0, 31)
    x2, y2 = np.meshgrid(x, y)
    uneven = flowgrain.arrows(x, y, -y2, x2, n=8)
    for path in uneven.paths:
        assert np.ptp(np.hypot(*path.T)) < 0.02
    angle, radius = np.meshgrid(np.linspace(0.2, 2.9, 61), np.linspace(0.5, 1.5, 25))
    px, py = radius * np.cos(angle), radius * np.sin(angle)
    ring = flowgrain.arrows(x=px, y=py, u=-py, v=px, n=8)
    for path in ring.paths:
        distance = np.hypot(*path.T)
        assert np.ptp(distance) < 0.02 and 0.5 < distance.mean() < 1.5
    assert ring.labels.shape == px.shape


def lattice(*steps):
    """Places of a grid, turned by 0.5, whose columns and rows are so far apart."""
    x, y = np.meshgrid(*(np.append(0.0, np.cumsum(step)) for step in steps))
    return [np.cos(0.5) * x - np.sin(0.5) * y, np.sin(0.5) * x + np.cos(0.5) * y]


ROWS = [1.0] * 12


@pytest.mark.parametrize("columns, gaps", [
    ([1.0] * 20, []),
    ([1.0] * 9 + [33.0] + [1.0] * 9, [9]),  # between two swaths
    ([1.0] * 9 + [4.0] + [1.0] * 9, []),  # three columns left out
    ([1.0] * 9 + [5.0] + [1.0] * 9, [9]),
    ([1.0] * 4 + [7.0, 6.0] + [1.0] * 4, [4, 5]),  # one column between two gaps
    ([1.0] * 9 + [30.0], [9]),
    ([0.01] * 9 + [1.0] * 9, []),  # a finer part
    ([1e-6 * 1.9 ** n for n in range(20)], []),  # a boundary layer
    ([0.0, 0.0, 0.3] * 7, []),  # places rounded to few figures
    ([1.0], []), ([1.0, 9.0], []),
])
def test_gaps_of_a_curvilinear_grid(columns, gaps):
    from flowgrain._grid import over_no_gap

    expected = ~np.isin(np.arange(len(columns)), gaps)
    for k in (1, -1):
        found = over_no_gap(lattice(columns[::k], ROWS))
        assert np.array_equal(found, np.tile(expected[::k], (12, 1)))
        assert np.array_equal(over_no_gap(lattice(ROWS, columns[::k])), found.T)
    x, y = lattice(columns, ROWS)
    x[5, 0] = np.nan  # not known: no edge
    assert np.array_equal(over_no_gap([x, y]), np.tile(expected, (12, 1)))


@pytest.mark.parametrize("scale, east", [("plain", 180.0), ("plain", 360.0), ("geo", 180.0)])
def test_global_curvilinear_grids_end_at_their_seam(scale, east):
    lon, lat, land, u, v = ocean(east)
    found = flowgrain.arrows(lon, lat, u, v, mask=land, scale=scale, n=40)
    assert found.bounds[0] == pytest.approx((east - 360.0, east), abs=2.0)
    assert not any(is_land(*path.T).any() for path in found.paths)
    # along the flow there
    for path in found.paths:
        a, b = np.radians(0.5 * (path[1:] + path[:-1])).T
        there = np.cos(b) * np.cos(3 * a) + 0.4 * np.sin(2 * b), np.cos(b) * np.sin(2 * a)
        across = np.cos(b) if scale == "geo" else 1.0
        way = np.diff(path[:, 0]) * across, np.diff(path[:, 1])
        cosine = (way[0] * there[0] + way[1] * there[1]) / np.hypot(*way) / np.hypot(*there)
        assert np.median(cosine) > 0.97


@pytest.mark.parametrize("wrap", [False, True])
def test_nothing_is_drawn_between_swaths(wrap):
    across = np.append(np.linspace(-9.0, -4.0, 21), np.linspace(4.0, 9.0, 21))
    lon, lat = np.meshgrid(175.0 + across, np.linspace(-18.0, 18.0, 150))
    lon = lon + 0.15 * lat
    given = (lon + 180.0) % 360.0 - 180.0 if wrap else lon
    found = flowgrain.arrows(given, lat, 8.0 + 0.0 * lon, np.sin(0.1 * lat), n=30, scale="geo")
    assert found.bounds[0] == pytest.approx((lon.min(), lon.max()))
    off = np.concatenate([path[:, 0] - 0.15 * path[:, 1] for path in found.paths]) - 175.0
    assert (np.abs(off) > 3.9).all() and off.min() < -5.0 and off.max() > 5.0


def test_periodic_longitude_and_geojson():
    longitude, latitude = np.arange(0.0, 361.0, 5.0), np.arange(-60.0, 61.0, 5.0)
    lon, lat = np.meshgrid(np.radians(longitude), np.radians(latitude))
    u, v = 10.0 * np.cos(lat), 3.0 * np.sin(3.0 * lon)
    globe = flowgrain.arrows(longitude, latitude, u, v, n=15, period=360, scale="geo")
    assert globe.bounds[0].tolist() == [0.0, 360.0]
    assert globe.labels.shape == u.shape
    collection = globe.to_geojson()
    assert json.loads(json.dumps(collection)) == collection
    for feature in collection["features"]:
        lines = feature["geometry"]["coordinates"]
        lines = lines if feature["geometry"]["type"] == "MultiLineString" else [lines]
        for line in lines:
            assert np.abs(np.array(line)[:, 0]).max() <= 180.0
            assert np.abs(np.diff(np.array(line)[:, 0])).max() < 90.0


def test_scales_follow_each_other(field):
    scales = list(flowgrain.evolve(*field, n=[30, 12, 5]))
    assert [len(s) for s in scales] == [30, 12, 5]
    for finer, coarser in zip(scales, scales[1:]):
        assert set(finer.parent) <= set(coarser.id)
        assert len(set(finer.id) & set(coarser.id)) > 0
        assert finer.time <= coarser.time and finer.error < coarser.error
    assert same(scales[0], flowgrain.arrows(*field, n=30))


def test_volume():
    axis = np.linspace(0.0, 1.0, 17)
    z, y, x = np.meshgrid(axis, axis, axis, indexing="ij")
    found = flowgrain.arrows(axis, axis, 0.5 - y, x - 0.5, w=0.1 + 0.0 * x, z=axis, n=6, nodes=17)
    assert len(found) == 6 and found.paths[0].shape[1] == 3 and found.labels.shape == x.shape
    vertices, triangles = found.solids()[0]
    edges = np.sort(triangles[:, [0, 1, 1, 2, 2, 0]].reshape(-1, 2), 1)
    assert (np.unique(edges, axis=0, return_counts=True)[1] == 2).all()  # closed
    assert found._repr_svg_() is None
    with pytest.raises(ValueError, match="solids"):
        found.outlines
    with pytest.raises(ValueError, match="outlines"):
        flowgrain.arrows(x[0] + 1.0, y[0], n=3).solids()


def test_tolerance(field):
    few = flowgrain.arrows(*field, tolerance=8.0)
    assert few.error <= 8.0 and 4 <= len(few) < 40


def test_sequence(dozen):
    assert isinstance(dozen[3:5], flowgrain.Arrows) and len(dozen[3:5]) == 2
    assert np.array_equal(dozen[-1].path, dozen.paths[11])
    fast = dozen[dozen.speed > np.median(dozen.speed)]
    assert len(fast) == 6 and fast.speed.min() > np.median(dozen.speed)
    assert np.array_equal(fast[0].outline, fast.outlines[0])
    assert [a.id for a in dozen] == dozen.id.tolist()
    with pytest.raises(IndexError):
        dozen[12]
    assert "12 arrows" in repr(dozen)
    other = pickle.loads(pickle.dumps(dozen))
    assert same(dozen, other) and other.error == dozen.error
    assert np.array_equal(other.labels, dozen.labels)
    picture = dozen._repr_svg_()
    assert picture.count("<polygon") == 12 and 'width="480" height="360"' in picture


@pytest.mark.parametrize("change, message", [
    ({"u": np.zeros((49, 65)), "v": np.zeros((49, 65))}, "zero everywhere"),
    ({"u": np.full((49, 65), np.nan)}, "valid|missing"),
    ({"v": np.zeros((65, 49))}, r"v has the shape \(65, 49\)"),
    ({"u": np.zeros(65)}, r"v has the shape \(49, 65\), but u has \(65,\)"),
    ({"u": np.zeros((2, 3, 4, 5))}, r"\(ny, nx\) is needed, or \(n,\) of points"),
    ({"u": np.zeros((49, 65), complex)}, "complex"),
    ({"u": np.full((49, 65), 1e300)}, "speeds up to 1e.30 are taken"),
    ({"x": np.zeros(7)}, r"x has the shape \(7,\)"),
    ({"x": np.zeros(65)}, r"x\[0\] and x\[1\] are both 0"),
    ({"x": moved(65, 7, np.nan)}, r"x\[7\] is nan"),
    ({"y": moved(49, 48, np.inf)}, r"y\[48\] is inf"),
    ({"y": moved(49, 9, 8.0)}, r"y\[8\] and y\[9\] are both 8"),
    ({"y": moved(49, 9, 8.0)[::-1]}, r"y\[39\] and y\[40\] are both 8"),
    ({"x": moved(65, 9, 30.0)}, r"x neither ascends nor descends: x\[9\] is 30, x\[10\] is 10; .*"
                                r"ds.sortby\('x'\)"),
    ({"x": np.arange(65) % 20}, "x neither ascends nor descends"),
    ({"x": np.append(np.arange(40, 72) % 64, np.arange(8, 41))}, "both 40, with other samples"),
    ({"x": np.array(["a"] * 65)}, "numbers are needed"),
    ({"mask": np.zeros((3, 3))}, "mask has the shape"),
    ({"mask": np.ones((49, 65))}, "valid|missing"),
    ({"n": 0}, "n is 0"),
    ({"n": 2.5}, "n is 2.5"),
    ({"n": None}, "n is None"),
    ({"n": 20001}, "20001 arrows are too many"),
    ({"seed": -1}, "seed is -1"),
    ({"seed": 2**64}, "seed is 18446744073709551616; a whole number from 1 to"),
    ({"nodes": 7}, "7 nodes a side; from 9"),
    ({"threads": 0}, "threads is 0"),
    ({"tolerance": 0.0}, "tolerance is 0.0"),
    ({"coverage": "much"}, "coverage is 'much'"),
    ({"scale": "geographic"}, "not one of plain, geo"),
    ({"scale": "geo", "y": np.linspace(0, 100, 49)}, "beyond the poles"),
    ({"kind": "rings"}, "not one of arrows, clusters"),
    ({"coverage": 2.0}, "coverage"),
    ({"anisotropy": -1.0}, "anisotropy"),
    ({"period": 3.0}, "does not fit its period"),
    ({"period": float("nan")}, "period"),
    ({"z": np.arange(3)}, "z is given without w"),
])
def test_refusals(field, change, message):
    arguments = dict(zip(("x", "y", "u", "v"), field), n=12)
    with pytest.raises(ValueError, match=message):
        flowgrain.arrows(**{**arguments, **change})


def test_hints_name_arguments_of_python():
    axis = np.linspace(0.0, 1.0, 9)
    cube = np.ones((9, 9, 9))
    with pytest.raises(ValueError, match="cannot be handled yet\\nscale='plain' takes"):
        flowgrain.arrows(axis, axis, cube, cube, w=cube, z=axis, scale="geo")


def test_threads_give_the_same_bits_at_once(field, dozen):
    others = [vortices(65, 49, 8.0, tall) for tall in (5.0, 7.0)]
    alone = [flowgrain.arrows(*other, n=12) for other in others]
    with concurrent.futures.ThreadPoolExecutor(3) as pool:
        futures = [pool.submit(flowgrain.arrows, *f, n=12) for f in (field, *others)]
        found = [future.result() for future in futures]
    for one, other in zip([dozen, *alone], found):
        assert same(one, other)


def test_the_interpreter_goes_on_meanwhile():
    """The GIL is released: Python code runs while arrows are placed."""
    begun, ended, counted = threading.Event(), threading.Event(), 0

    def work():
        begun.set()
        flowgrain.arrows(*vortices(), n=40)
        ended.set()

    thread = threading.Thread(target=work)
    thread.start()
    begun.wait()
    while not ended.is_set():
        counted += 1
    thread.join()
    assert counted > 100


def test_interrupt():
    """Ctrl-C ends a call that would take minutes."""
    # a job in the background ignores it
    before = signal.signal(signal.SIGINT, signal.default_int_handler)
    timer = threading.Timer(0.5, os.kill, (os.getpid(), signal.SIGINT))
    timer.start()
    with pytest.raises(KeyboardInterrupt):
        flowgrain.arrows(*vortices(257, 193), n=3000)
    timer.join()
    signal.signal(signal.SIGINT, before)
    assert threading.active_count() < 5
    # and the next call works
    assert len(flowgrain.arrows(*vortices(), n=5)) == 5


@pytest.mark.skipif(not os.path.exists("/proc/self/statm"), reason="no /proc")
def test_nothing_is_leaked(field):
    def once():
        found = flowgrain.arrows(*field, n=3, nodes=65)
        found.outlines, found.labels, found.error
        with pytest.raises(ValueError):
            flowgrain.arrows(field[2] * 0.0, field[3] * 0.0)

    def pages():
        gc.collect()
        with open("/proc/self/statm") as file:
            return int(file.read().split()[1])

    def work():  # in one thread, for each has memory of its own
        for _ in range(15):  # what the library's threads keep has its size after some
            once()
        before = pages()
        for _ in range(10):
            once()
        grown.append((pages() - before) * resource.getpagesize())

    grown = []
    thread = threading.Thread(target=work)
    thread.start()
    thread.join()
    # a field has 25 KiB, a mesh more
    assert grown[0] < 10 * 20000
