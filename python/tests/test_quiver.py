import io
import pickle

import numpy as np
import pytest

import flowgrain
from conftest import is_land, ocean, vortices

matplotlib = pytest.importorskip("matplotlib")
matplotlib.use("agg")
plt = pytest.importorskip("matplotlib.pyplot")


@pytest.fixture
def ax():
    _, axes = plt.subplots()
    yield axes
    plt.close("all")  # an unpickled figure, too


def rotation(x, y, about=(0.0, 0.0)):
    px, py = np.meshgrid(x, y)
    return about[1] - py, px - about[0]


def lines(q):
    """Centrelines in the data coordinates of the axes, tail to tip."""
    q.get_paths()
    return q._lines


def alike(one, other):
    return len(one) == len(other) and all(
        a.shape == b.shape and np.allclose(a, b, rtol=0, atol=0.05) for a, b in zip(one, other))


def test_arrows_follow_streamlines_on_any_axes(ax):
    """Circles in data coordinates, on axes of unequal scales; logarithmic and inverted ones."""
    x, y = np.linspace(1.0, 5.0, 61), np.linspace(-2.0, 2.0, 41)
    q = flowgrain.quiver(ax, x, y, *rotation(x, y, (3.0, 0.0)), arrows=12)
    assert len(q.get_paths()) == 12
    for line in lines(q):
        radius = np.hypot(*(line - (3.0, 0.0)).T)
        assert np.ptp(radius) < 0.03
        a, b = line[0] - (3.0, 0.0), line[1] - (3.0, 0.0)
        assert a[0] * b[1] - a[1] * b[0] > 0.0  # counter-clockwise
    ax.set_xscale("log")
    ax.invert_yaxis()
    for line in lines(q):
        assert np.ptp(np.hypot(*(line - (3.0, 0.0)).T)) < 0.05


def test_logarithmic_axes_begin_at_positive_coordinates(ax):
    x, y = np.linspace(-3.0, 9.0, 25), np.geomspace(10.0, 1000.0, 21)
    px, py = np.meshgrid(x, y)
    q = flowgrain.quiver(ax, x, y, np.ones_like(px), 0.3 * py, arrows=9)
    ax.set(xscale="log", yscale="log")
    assert ax.get_xlim() == pytest.approx((0.5 / 18.0**0.05, 9.0 * 18.0**0.05))
    assert len(q.get_paths()) == 9
    for line in lines(q):
        assert (line > (0.43, 9.99)).all() and (line < (9.0, 1000.0)).all()
        rise = np.diff(np.log(line[:, 1])) / np.diff(line[:, 0])  # dy/dx = 0.3 y
        assert rise == pytest.approx(np.full(len(rise), 0.3), rel=0.2)


def test_axes_in_any_order(ax, field):
    x, y, u, v = field
    sorted_ = lines(flowgrain.quiver(ax, x, y, u, v, u, arrows=9))
    for roll, flip in ((20, 1), (20, -1)):
        def moved(a, roll=roll, flip=flip):
            return np.roll(a, roll, -1)[..., ::flip]

        q = flowgrain.quiver(ax, moved(x), y, moved(u), moved(v), moved(u), arrows=9)
        assert alike(sorted_, lines(q)) and len(q.get_array()) == 9
    x = np.where(x > 4.0, np.nan, x)
    with pytest.raises(ValueError, match=r"x\[25\] is nan"):
        flowgrain.quiver(ax, x, y, u, v)


def test_uv_is_along_the_page(ax):
    ax.set_xlim(0, 1000)
    ax.set_ylim(1, 0)
    one = np.ones((9, 9))
    q = flowgrain.quiver(ax, np.linspace(0, 1000, 9), np.linspace(0, 1, 9), one, one, arrows=5,
                         angles="uv")
    for line in lines(q):
        way = np.diff(ax.transData.transform(line[[0, -1]]), axis=0)[0]
        assert way[0] > 0.0 and way[1] == pytest.approx(way[0], rel=1e-3)


def test_as_many_arrows_in_any_view(ax, field):
    x, y, u, v = field
    q = flowgrain.quiver(ax, x, y, u, v, arrows=15)
    for view in ((1, 9, -2, 4), (5, 8, 0, 3), (1.5, 2.5, -1, -0.5)):
        ax.set_xlim(view[:2])
        ax.set_ylim(view[2:])
        assert len(q.get_paths()) == 15
        for line in lines(q):
            assert (line >= (view[0] - 1e-6, view[2] - 1e-6)).all()
            assert (line <= (view[1] + 1e-6, view[3] + 1e-6)).all()
    ax.set_xlim(100, 101)  # nothing is there
    assert len(q.get_paths()) == 0
    ax.figure.canvas.draw()


def test_kept_arrows_stay_in_place(ax, field):
    x, y, u, v = field
    q = flowgrain.quiver(ax, x, y, u, v, arrows=15, adaptive=False)
    before = lines(q)
    width = np.ptp(q.get_paths()[0].vertices, 0)
    ax.set_xlim(4, 6)
    assert alike(before, lines(q))
    assert np.ptp(q.get_paths()[0].vertices, 0)[0] > 2.0 * width[0]


def test_resolution_does_not_matter(ax, field):
    x, y, u, v = field
    q = flowgrain.quiver(ax, x, y, u, v, arrows=15)
    before = lines(q)
    for options in ({"dpi": 50}, {"dpi": 217}, {"format": "pdf"}, {"format": "svg"}):
        ax.figure.savefig(io.BytesIO(), **options)
        assert lines(q) is before  # not placed again


def test_a_layout_of_another_resolution_keeps_arrows(field):
    """The text of axes has another size at another resolution, and so has what it leaves."""
    x, y, u, v = field
    figure, ax = plt.subplots(layout="constrained")
    q = flowgrain.quiver(ax, x, y, u, v, arrows=15)
    ax.set(xlabel="x", ylabel="y", title="a field")
    figure.colorbar(q, label="m/s")
    before, sizes = None, set()
    for options in ({"dpi": 120}, {"format": "svg"}, {"format": "pdf"}, {"dpi": 37}):
        figure.savefig(io.BytesIO(), **options)
        before = lines(q) if before is None else before
        assert lines(q) is before
        sizes.add(tuple(ax.get_position().size))
    assert len(sizes) > 1  # the layouts differ
    figure.set_size_inches(6.4, 3.0)
    figure.savefig(io.BytesIO())
    assert lines(q) is not before
    plt.close(figure)


def test_figures_of_any_resolution_have_the_same_bits(field):
    x, y, u, v = field
    found = []
    for dpi in (72, 100, 217, 300):
        figure, ax = plt.subplots(dpi=dpi)
        q = flowgrain.quiver(ax, x, y, u, v, arrows=15)
        figure.canvas.draw()
        found.append((lines(q), q._sizes))
        plt.close(figure)
    for other, sizes in found[1:]:
        assert np.array_equal(sizes, found[0][1])
        assert all(np.array_equal(a, b) for a, b in zip(other, found[0][0]))


def test_arrows_are_told_in_points_of_the_axes(ax, field):
    x, y, u, v = field
    q = flowgrain.quiver(ax, x, y, u, v, arrows=15)
    scale = 72.0 / ax.figure.dpi
    for path, line in zip(q.arrows.paths, lines(q)):
        seen = (ax.transData.transform(line) - ax.bbox.min) * scale
        assert np.allclose(path, seen, rtol=0, atol=1e-6)
    for outline, polygon in zip(q.arrows.outlines, q.get_paths()):
        seen = (polygon.vertices[:-1] - ax.bbox.min) * scale
        assert np.allclose(outline, seen, rtol=0, atol=1e-6)


def test_colours(ax, field):
    x, y, u, v = field
    q = flowgrain.quiver(ax, x, y, u, v, arrows=15)
    bar = ax.figure.colorbar(q)
    ends = bar.vmin, bar.vmax
    ax.figure.canvas.draw()
    speed = np.hypot(u, v)
    assert ends == (bar.vmin, bar.vmax) == q.arrows.speed_range
    assert ends == (q.get_array().min(), q.get_array().max())
    assert speed.min() <= q.get_array().min() < q.get_array().max() <= speed.max()
    assert np.array_equal(q.get_facecolors(), q.to_rgba(q.get_array()))
    px, _ = np.meshgrid(x, y)
    other = flowgrain.quiver(ax, x, y, u, v, px, arrows=15, cmap="viridis", vmin=0, vmax=10)
    middles = [line[:, 0].mean() for line in lines(other)]
    assert np.asarray(other.get_array()) == pytest.approx(np.array(middles), abs=0.15)
    assert other.get_clim() == (0, 10) and other.get_cmap().name == "viridis"
    plain = flowgrain.quiver(ax, x, y, u, v, arrows=3, color="red")
    ax.figure.canvas.draw()
    assert plain.get_facecolors().tolist() == [[1, 0, 0, 1]]


def test_ends_of_colours(ax, field):
    """Those of the arrows that are placed first, of all values where there is no arrow; given ones
    are matplotlib's."""
    x, y, u, v = field
    q = flowgrain.quiver(ax, x, y, u, v, arrows=15)
    color = q.to_rgba(0.3)
    ends = q.get_clim()
    assert ends == q.arrows.speed_range
    q.set_UVC(2 * u, 2 * v)
    ax.figure.canvas.draw()
    assert q.get_clim() == ends and q.get_array().max() > 1.5 * ends[1]
    assert np.array_equal(q.to_rgba(0.3), color)
    half = flowgrain.quiver(ax, x, y, u, v, arrows=15, vmin=0)
    ax.figure.canvas.draw()
    assert half.get_clim() == (0, half.get_array().max())
    even = flowgrain.quiver(ax, x, y, np.ones_like(u), 0 * v, arrows=5)
    assert len(even.get_array()) == 5 and even.get_clim() == (0, 1)
    ax.set_xlim(100, 101)
    away = flowgrain.quiver(ax, x, y, u, v, arrows=5)
    bar = ax.figure.colorbar(away)
    speed = np.hypot(u, v)
    assert (bar.vmin, bar.vmax) == pytest.approx((speed.min(), speed.max()))


def test_animation_moves_on(ax):
    """Arrows of the next frame start from those of the last."""
    x = y = np.linspace(-1.0, 1.0, 41)

    def frame(shift):
        px, py = np.meshgrid(x, y)
        return 1.0 + 0.0 * px, np.sin(3.0 * (px - shift)) * np.cos(py)

    q = flowgrain.quiver(ax, x, y, *frame(0.0), arrows=20)
    before = np.array([line.mean(0) for line in lines(q)])
    q.set_UVC(*frame(0.02))
    after = np.array([line.mean(0) for line in lines(q)])
    assert len(after) == 20
    gap = np.sqrt(((before[:, None] - after) ** 2).sum(2)).min(1)
    assert np.median(gap) < 0.05
    with pytest.raises(ValueError, match="v has the shape"):
        q.set_UVC(np.ones((41, 41)), np.ones((3, 3)))


def test_curvilinear_and_polar(ax):
    angle, radius = np.meshgrid(np.linspace(0.2, 2.9, 61), np.linspace(0.5, 1.5, 25))
    x, y = radius * np.cos(angle), radius * np.sin(angle)
    q = flowgrain.quiver(ax, x, y, -y, x, arrows=10)
    for line in lines(q):
        assert np.ptp(np.hypot(*line.T)) < 0.02
    figure = plt.figure()
    polar = figure.add_subplot(projection="polar")
    theta, r = np.linspace(0.0, 2.0 * np.pi, 73), np.linspace(0.2, 1.0, 17)
    q = flowgrain.quiver(polar, theta, r, np.ones((17, 73)), np.zeros((17, 73)), arrows=12)
    assert len(q.get_paths()) == 12
    for line in lines(q):
        assert np.ptp(line[:, 1]) < 0.01  # round the pole, also across theta = 0
    plt.close(figure)


@pytest.mark.parametrize("east", [180.0, 360.0])
def test_global_curvilinear_grids_end_at_their_seam(ax, east):
    lon, lat, land, u, v = ocean(east)
    q = flowgrain.quiver(ax, lon, lat, u, v, arrows=40, mask=land)
    assert len(lines(q)) == 40
    assert not any(is_land(*line.T).any() for line in lines(q))
    assert np.ptp(np.concatenate(lines(q))[:, 0]) > 320.0


def test_nothing_is_drawn_over_gaps(ax):
    """Between swaths, in a view of one of them, too; but round the pole of polar axes."""
    across = np.append(np.linspace(-9.0, -4.0, 21), np.linspace(4.0, 9.0, 21))
    x, y = np.meshgrid(across, np.linspace(-18.0, 18.0, 150))
    x = x + 0.15 * y
    q = flowgrain.quiver(ax, x, y, 8.0 + 0.0 * x, np.sin(y), arrows=30)
    for view in ((-12, 12), (-3, 12)):
        ax.set_xlim(view)
        off = np.concatenate([line[:, 0] - 0.15 * line[:, 1] for line in lines(q)])
        assert len(lines(q)) == 30 and (np.abs(off) > 3.8).all()
    figure = plt.figure()
    polar = figure.add_subplot(projection="polar")
    theta, r = np.meshgrid(np.linspace(0.0, 2.0 * np.pi, 73), np.linspace(0.2, 1.0, 17))
    theta = (theta + 0.3 * r) % (2.0 * np.pi)
    q = flowgrain.quiver(polar, theta, r, np.ones((17, 73)), np.zeros((17, 73)), arrows=60)
    assert any((np.abs(np.diff(line[:, 0] % (2.0 * np.pi))) > 6.0).any() for line in lines(q))
    plt.close(figure)


def test_points(ax):
    x, y = np.random.default_rng(4).uniform(0.0, 1.0, (2, 900)) * [[8.0], [6.0]]
    kept = np.hypot(x - 4.0, y - 3.0) > 1.6
    x, y = x[kept], y[kept]
    q = flowgrain.quiver(ax, x, y, 1.0 + np.sin(y), np.cos(0.7 * x), x, arrows=10)
    assert len(lines(q)) == 10
    for line in lines(q):
        assert np.hypot(*(line - (4.0, 3.0)).T).min() > 1.2
        middle, way = 0.5 * (line[1:] + line[:-1]), np.diff(line, axis=0)
        there = np.stack([1.0 + np.sin(middle[:, 1]), np.cos(0.7 * middle[:, 0])], 1)
        cosine = (way * there).sum(1) / np.hypot(*way.T) / np.hypot(*there.T)
        assert np.median(cosine) > 0.98
    assert np.allclose(q.get_array(), [line[:, 0].mean() for line in lines(q)], rtol=0, atol=0.4)
    q.set_UVC(-np.cos(y), np.sin(x))
    assert len(lines(q)) == 10
    assert ax.dataLim.bounds == pytest.approx((x.min(), y.min(), np.ptp(x), np.ptp(y)))
    with pytest.raises(ValueError, match="or that of X and Y"):
        flowgrain.quiver(ax, x[1:], y, x, y)
    with pytest.raises(ValueError, match="lie on one line"):
        flowgrain.quiver(ax, x, x, x, y)


def test_dates_and_pickles(ax):
    days = np.arange("2001-01-01", "2001-02-10", dtype="M8[D]")
    height = np.linspace(0.0, 5.0, 21)
    px, py = np.meshgrid(np.arange(40.0), height)
    q = flowgrain.quiver(ax, days, height, 1.0 + 0.0 * px, np.cos(px / 4.0), arrows=8)
    paths = q.get_paths()
    dates = pytest.importorskip("matplotlib.dates")
    assert ax.dataLim.x0 == dates.date2num(days[0]) and ax.dataLim.y0 == 0.0 and len(paths) == 8
    other = pickle.loads(pickle.dumps(ax.figure)).axes[0].collections[0]
    for one, copy in zip(paths, other.get_paths()):
        assert np.allclose(one.vertices, copy.vertices, atol=1e-6)


def test_key(ax, field):
    x, y, u, v = field
    q = flowgrain.quiver(ax, x, y, u, v, arrows=15)
    for position, off in (("E", (1, 0)), ("W", (-1, 0)), ("N", (0, 1)), ("S", (0, -1))):
        key = flowgrain.quiverkey(q, 0.8, 1.05, 0.3, "0.3 m/s", labelpos=position)
        ax.figure.canvas.draw()
        patch, place = key._parts(q.arrows)
        middle = ax.transAxes.transform((0.8, 1.05))
        assert np.sign(np.round(np.subtract(place, middle))).tolist() == list(off)
        assert patch.get_facecolor() == pytest.approx(q.to_rgba(0.3))
        wide, high = np.ptp(patch.get_xy(), 0)
        assert wide == pytest.approx(0.4 * ax.figure.dpi, rel=0.01) and 1.0 < high < 20.0
    ax.figure.savefig(io.BytesIO(), format="svg", bbox_inches="tight")
    with pytest.raises(ValueError, match="labelpos"):
        flowgrain.quiverkey(q, 0, 0, 1, "", labelpos="X")


def test_arrows_are_placed_once_for_a_layout(field, monkeypatch):
    from flowgrain import _quiver

    x, y, u, v = field
    counted, place = [], _quiver.place
    monkeypatch.setattr(_quiver, "place", lambda *a: counted.append(a) or place(*a))
    figure, ax = plt.subplots(layout="constrained")
    q = flowgrain.quiver(ax, x, y, u, v, arrows=5)
    flowgrain.quiverkey(q, 0.8, 1.05, 0.3, "0.3 m/s")
    figure.canvas.draw()
    assert len(counted) == 1
    figure.colorbar(q)  # of the arrows that are there
    assert len(counted) == 1
    figure.canvas.draw()  # it takes room from the axes
    assert len(counted) == 2
    plt.close(figure)


def test_layout_and_limits(ax, field):
    x, y, u, v = field
    q = flowgrain.quiver(ax, x, y, u, v, arrows=5)
    assert ax.dataLim.bounds == pytest.approx((1.0, -2.0, 8.0, 6.0))
    ax.figure.tight_layout()
    box = q.get_window_extent().transformed(ax.transData.inverted())
    assert box.bounds == pytest.approx((1.0, -2.0, 8.0, 6.0))
    assert flowgrain.quiver(ax, u, v, arrows=3).get_datalim(ax.transData).x1 == 64.0
    assert q in ax.collections
    q.remove()
    assert q not in ax.collections


def test_swapped_arguments(ax):
    x, y = np.meshgrid(np.linspace(-1.0, 2.0, 31), np.linspace(-1.0, 1.0, 21))
    waves, core = (np.cos(3 * x), np.sin(4 * y + x)), (-y / (0.1 + x * x), x / (0.1 + x * x))
    for u, v in ((-y, x), (x, -y), waves, core, (y, 0 * y), (x, y)):  # fields, in the right order
        flowgrain.quiver(ax, x, y, u, v)
    for u, v in (waves, (y, 0 * y)):
        with pytest.raises(ValueError, match="the order is X, Y, U, V"):
            flowgrain.quiver(ax, u, v, x, y)
    with pytest.raises(ValueError, match="in the order X, Y, U, V"):
        flowgrain.quiver(ax, *waves, x[0], y[:, 0])
    r = 0.1 + x * x + y * y
    with pytest.warns(UserWarning, match="the order is X, Y, U, V"):
        flowgrain.quiver(ax, -y / r, x / r, x, y)


@pytest.mark.parametrize("args, options, message", [
    ((np.zeros((5, 5)), np.zeros((5, 5))), {}, "zero or missing everywhere"),
    ((np.ones(5), np.ones(5)), {}, r"\(ny, nx\)"),
    ((np.arange(5), np.arange(5), np.ones((5, 5, 5)), np.ones((5, 5, 5))), {}, r"\(ny, nx\)"),
    ((np.arange(4), np.arange(5), np.ones((5, 5)), np.ones((5, 5))), {}, "x has the shape"),
    ((np.ones((5, 5)), np.ones((5, 5)), np.ones((5, 4))), {}, "C has the shape"),
    ((np.ones((5, 5)), np.ones((5, 5))), {"arrows": 0}, "arrows is 0"),
    ((np.ones((5, 5)), np.ones((5, 5))), {"angles": "north"}, "not one of xy, uv"),
    ((np.ones((5, 5)), np.ones((5, 5))), {"transform": 3}, "not one of matplotlib or cartopy"),
])
def test_refusals(ax, args, options, message):
    with pytest.raises(ValueError, match=message):
        flowgrain.quiver(ax, *args, **options)
    assert not ax.collections


class TestMaps:
    ccrs = pytest.importorskip("cartopy.crs")

    @pytest.fixture
    def polar(self):
        figure = plt.figure()
        yield figure.add_subplot(projection=self.ccrs.NorthPolarStereo())
        plt.close(figure)

    longitude, latitude = np.arange(0.0, 360.0, 5.0), np.arange(-90.0, 91.0, 5.0)

    def wind(self):
        """Solid rotation about the point at 90 E on the equator."""
        lon, lat = np.meshgrid(np.radians(self.longitude), np.radians(self.latitude))
        return -np.sin(lat) * np.sin(lon), -np.cos(lon)

    def test_east_is_round_the_pole(self, polar):
        polar.set_extent([-180, 180, 30, 90], self.ccrs.PlateCarree())
        east = np.ones((len(self.latitude), len(self.longitude)))
        east[[0, -1]] = 0.0
        q = flowgrain.quiver(polar, self.longitude, self.latitude, east, 0 * east, arrows=20,
                             transform=self.ccrs.PlateCarree())
        found = lines(q)
        assert len(found) == 20
        for line in found:
            radius = np.hypot(*line.T)
            if radius.min() > 1.5e6:
                assert np.ptp(radius) < 0.02 * radius.mean()
                assert line[0, 0] * line[1, 1] - line[0, 1] * line[1, 0] > 0.0

    @pytest.mark.parametrize("first, last", [(0.0, 355.0), (100.0, 260.0), (-250.0, -80.0)])
    def test_longitudes_of_any_half(self, first, last):
        """Of the globe or a region; the map's own are others again."""
        longitude, latitude = np.arange(first, last + 1.0, 5.0), np.arange(-60.0, 61.0, 5.0)
        lon, lat = np.meshgrid(np.radians(longitude), np.radians(latitude))
        u, v = 10.0 * np.cos(lat), 5.0 * np.sin(3.0 * lon)
        found = []
        for given in (longitude, (longitude + 180.0) % 360.0 - 180.0, longitude % 360.0):
            figure = plt.figure()
            ax = figure.add_subplot(projection=self.ccrs.PlateCarree(180.0))
            ax.set_global()
            q = flowgrain.quiver(ax, given, latitude, u, v, arrows=12,
                                 transform=self.ccrs.PlateCarree())
            found.append(lines(q))
            plt.close(figure)
        assert len(found[0]) == 12 and alike(found[0], found[1]) and alike(found[0], found[2])
        east = np.concatenate(found[0])[:, 0] % 360.0  # in degrees from 180 E
        width = (last - first) % 360.0
        assert ((east + 180.0 - first) % 360.0 < width + 5.0).all()
        assert np.ptp((east + 180.0 - first) % 360.0) > 0.8 * width

    def test_nothing_is_drawn_between_swaths(self):
        across = np.append(np.linspace(-9.0, -4.0, 21), np.linspace(4.0, 9.0, 21))
        lon, lat = np.meshgrid(across, np.linspace(-18.0, 18.0, 80))
        lon = lon + 0.15 * lat
        figure = plt.figure()
        ax = figure.add_subplot(projection=self.ccrs.PlateCarree(180.0))
        ax.set_extent([-12, 12, -20, 20], ax.projection)
        q = flowgrain.quiver(ax, (lon + 360.0) % 360.0 - 180.0, lat, 8.0 + 0.0 * lon, np.sin(lat),
                             arrows=20, transform=self.ccrs.PlateCarree())
        off = np.concatenate([line[:, 0] - 0.15 * line[:, 1] for line in lines(q)])
        assert (np.abs(off) > 3.8).all() and off.min() < -5.0 and off.max() > 5.0
        plt.close(figure)

    def test_points_round_the_pole(self, polar):
        """Stations in triangles on the sphere: nothing is torn where longitudes begin."""
        polar.set_extent([-180, 180, 50, 90], self.ccrs.PlateCarree())
        a, b, c = np.random.default_rng(6).normal(size=(3, 4000))
        lon = np.degrees(np.arctan2(b, a))
        lat = np.degrees(np.arctan2(np.abs(c), np.hypot(a, b)))
        lon, lat = lon[lat > 40.0], lat[lat > 40.0]
        q = flowgrain.quiver(polar, lon, lat, np.cos(np.radians(lat)), 0.0 * lat, arrows=16,
                             transform=self.ccrs.PlateCarree())
        assert len(lines(q)) == 16
        for line in lines(q):
            radius = np.hypot(*line.T)
            assert radius.min() < 1e6 or np.ptp(radius) < 0.05 * radius.mean()
            assert line[0, 0] * line[1, 1] - line[0, 1] * line[1, 0] > 0.0

    def test_flow_crosses_the_pole_and_the_cut(self, polar):
        """Arrows lie on the small circles about the axis of a rotation."""
        polar.set_extent([-180, 180, 30, 90], self.ccrs.PlateCarree())
        q = flowgrain.quiver(polar, self.longitude, self.latitude, *self.wind(), arrows=20,
                             transform=self.ccrs.PlateCarree())
        for line in lines(q):
            lon, lat, _ = self.ccrs.PlateCarree().transform_points(polar.projection, *line.T).T
            along = np.cos(np.radians(lat)) * np.sin(np.radians(lon))
            assert np.ptp(along) < 0.03

    def test_vectors_are_those_of_cartopy(self, polar):
        """Away from the poles, with what cartopy expects of east on a plate carree."""
        source = self.ccrs.PlateCarree()
        lon, lat = np.meshgrid(np.linspace(10, 80, 8), np.linspace(20, 80, 7))
        u, v = np.cos(lon), np.sin(2 * lat)
        q = flowgrain.quiver(polar, lon, lat, u, v, arrows=3, transform=source)
        assert q.arrows is not None  # the axes have their aspect
        ours = q._plane.turn(lon, lat, u, v, q._page)
        east = u / np.cos(np.radians(lat))
        theirs = polar.projection.transform_vectors(source, lon, lat, east, v)
        scale = np.hypot(u, v) / np.hypot(*theirs)
        for one, other in zip(ours, theirs):
            assert one == pytest.approx(other * scale, abs=2e-3)

    def test_whole_globe(self):
        figure = plt.figure()
        globe = figure.add_subplot(projection=self.ccrs.Robinson())
        globe.set_global()
        q = flowgrain.quiver(globe, self.longitude, self.latitude, *self.wind(), arrows=30,
                             transform=self.ccrs.PlateCarree())
        assert len(q.get_paths()) == 30
        places = np.concatenate(lines(q))
        inside = globe.projection.domain.buffer(2e5)
        shapely = pytest.importorskip("shapely.geometry")
        assert all(inside.contains(shapely.Point(p)) for p in places[::7])
        assert np.ptp(places[:, 0]) > 0.9 * np.ptp(globe.projection.x_limits)
        plt.close(figure)

    def test_maps_of_any_resolution_have_the_same_bits(self):
        found = []
        for dpi in (72, 120, 300):
            figure = plt.figure(dpi=dpi, layout="constrained")
            globe = figure.add_subplot(projection=self.ccrs.Orthographic(-40, 30))
            globe.set_global()
            q = flowgrain.quiver(globe, self.longitude, self.latitude, *self.wind(), arrows=30,
                                 transform=self.ccrs.PlateCarree())
            figure.colorbar(q, label="m/s")
            figure.canvas.draw()
            found.append(lines(q))
            plt.close(figure)
        for other in found[1:]:
            assert all(np.array_equal(a, b) for a, b in zip(other, found[0]))

    def test_a_crs_needs_a_map(self, ax):
        with pytest.raises(ValueError, match="axes are not"):
            flowgrain.quiver(ax, self.longitude, self.latitude, *self.wind(),
                             transform=self.ccrs.PlateCarree())


def test_no_matplotlib_is_needed_without_pictures():
    import subprocess
    import sys

    code = "import flowgrain, sys; assert 'matplotlib' not in sys.modules; " \
        "assert 'xarray' not in sys.modules"
    subprocess.run([sys.executable, "-c", code], check=True)


def test_large_grids_are_drawn(ax):
    x, y, u, v = vortices(1001, 801)
    q = flowgrain.quiver(ax, *np.meshgrid(x, y), u, v, arrows=10)
    assert len(q.get_paths()) == 10
