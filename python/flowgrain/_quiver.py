"""Arrows in matplotlib's axes, also cartopy's."""

from __future__ import annotations

import math
import warnings
from typing import Any

import numpy as np
from matplotlib.artist import Artist, allow_rasterization
from matplotlib.collections import PatchCollection
from matplotlib.colors import LinearSegmentedColormap
from matplotlib.patches import Polygon
from matplotlib.path import Path
from matplotlib.text import Text
from matplotlib.transforms import Bbox, IdentityTransform, Transform

from ._arrows import GALE, Arrows, _choice, _whole, line_outline, place
from ._grid import (Grid, axes_of, interpolate, make_grid, mesh_rank, over_no_gap, real_array,
                    resample_triangles, thinned, velocity_arrays)
from ._plane import CrsPlane, TransformPlane, period_of

#: the program's default palette: slow is light, fast is dark, all stand out from white
gale = LinearSegmentedColormap.from_list("gale", GALE)

ANGLES = ("xy", "uv")
NODES = 257  # of the raster that arrows are placed on, along its longer side
PAGE = 400.0  # the axes' longer side on the page that arrows are placed on
# Changes of a layout that arrows are kept through. The text of axes has another size at another
# resolution, and so has what a layout leaves to the axes: by less than a hundredth.
LEAST_SHIFT = 1.0 / (NODES - 1)  # of the axes' box
LEAST_RATIO = 0.04  # relative, of the proportions of its sides
MOST_SAMPLES = 200_000  # of a curvilinear grid that are looked at


class Quiver(PatchCollection):
    """Curved arrows in axes: what `quiver` returns.

    The arrows are placed when they are drawn, on what the axes show then; `arrows`, `get_array` and
    a colour bar place them at once.
    """

    def __init__(self, ax: Any, args: tuple[Any, ...], *, arrows: int, transform: Any,
                 adaptive: bool, angles: str, effort: str, mask: Any, cmap: Any, norm: Any,
                 vmin: float | None, vmax: float | None, **kwargs: Any) -> None:
        x, y, u, v, c = _arguments(ax, args)
        self._count = _whole("arrows", arrows)
        self._adaptive, self._effort = bool(adaptive), effort
        self._along_axes = _choice("angles", angles, ANGLES) == 0
        self._plane = _plane_of(ax, transform)
        self._given = (x, y)
        self._mask = mask
        self._drawn = False  # just now
        self._mapped = False  # to colours
        self._is_ranged = True  # ends of the colours are the user's, or set
        self._view: Any = None  # what the axes showed when arrows were placed
        self._page = np.full(2, PAGE)  # the axes' box then
        self._placed: Arrows | None = None
        self._icons: Any = None
        self._lines: list[np.ndarray] = []
        self._sizes = np.zeros((0, 4))
        self._set_samples(u, v, c)
        mapped = "color" not in kwargs and "facecolor" not in kwargs and "facecolors" not in kwargs
        kwargs.setdefault("linewidth", 0.4)  # tails are thin
        kwargs.setdefault("edgecolor", "face")
        kwargs.setdefault("zorder", 2.5)  # above lines, such as those of a grid, below texts
        super().__init__([], **kwargs)
        if mapped:
            self.set_cmap(gale if cmap is None else cmap)
            self.set_norm(norm)
            self.set_clim(vmin, vmax)
            self._is_ranged = norm is not None or vmin is not None or vmax is not None
        self._mapped = mapped
        self.set_transform(IdentityTransform())

    def _set_samples(self, u: Any, v: Any, c: Any) -> None:
        x, y = self._given
        shape = np.ma.asanyarray(u).shape
        points = len(shape) == 1
        axes = (x, y) if points else axes_of((x, y), shape)
        curvilinear = max(axis.ndim for axis in axes) > 1
        self._grid = None if curvilinear else self._on_axes([u, v], axes, self._mask)
        velocity = self._grid.velocity if self._grid else velocity_arrays([u, v], self._mask)
        self._velocity = [samples.astype(np.float64) for samples in velocity]
        speed = np.hypot(*self._velocity)
        if not (speed > 0.0).any():
            raise ValueError("quiver: the velocity is zero or missing everywhere")
        self._values = speed
        self._c: np.ndarray | None = None
        if c is not None:
            values = real_array("C", c)
            if values.shape != shape:
                raise ValueError(f"C has the shape {values.shape}, but U has {shape}")
            if not curvilinear and not points:  # in the same order as the velocity
                values = self._on_axes([values, values], axes, None).velocity[0]
            self._values = self._c = np.asarray(values, np.float64)

    def _on_axes(self, components: list[Any], axes: Any, mask: Any) -> Grid:
        circle = self._plane.circle
        if np.ndim(components[0]) == 1:  # points
            return make_grid(components, axes, mask, scale="geo" if circle == 360.0 else "plain")
        return make_grid(components, axes, mask, period_of(axes[0], circle), circle=circle)

    # Arrows are placed on a page that the axes' box fills, of one size and of rounded proportions:
    # neither resolution nor a layout that differs by parts of a pixel gives others. All that is
    # kept is in coordinates of the data.

    def _to_page(self, places: np.ndarray) -> np.ndarray:
        return places * self._page

    def _stretch(self) -> np.ndarray:
        """Points (1/72 inch) of the axes' box now for one length of the page."""
        return self.axes.bbox.size * (72.0 / self.axes.figure.dpi) / self._page

    def _outline_of_samples(self) -> tuple[np.ndarray, np.ndarray]:
        """Coordinates round and within the grid."""
        if self._grid is None:
            x, y = self._given
            pick = tuple(np.linspace(0, n - 1, min(n, 33)).astype(int) for n in x.shape)
            return x[np.ix_(*pick)].ravel(), y[np.ix_(*pick)].ravel()
        (left, right), (low, high) = self._grid.bounds
        x, y = np.meshgrid(np.linspace(left, right, 17), np.linspace(low, high, 17))
        return x.ravel(), y.ravel()

    def _look(self) -> tuple[np.ndarray, float]:
        """What is to be compared to know whether the view has changed: places of the grid's
        outline, and the logarithm of the proportions of the axes' box."""
        width, height = self.axes.bbox.size
        ratio = math.log(width / height) if width > 0.0 and height > 0.0 else 0.0
        return self._plane.forward(*self._outline_of_samples()), ratio

    def _window(self, places: np.ndarray) -> np.ndarray:
        """The part of the page to be filled, ((left, low), (right, high))."""
        seen = places[np.isfinite(places).all(1)]
        if not len(seen):
            return np.zeros((2, 2))
        if self._plane.fills_outline:  # 17 samples a side do not find the outline of a map
            seen = self._plane.outline()
        window = np.stack([seen.min(0), seen.max(0)])
        if self._adaptive:
            window = np.stack([np.maximum(window[0], 0.0), np.minimum(window[1], 1.0)])
        return self._to_page(window)

    def _raster(self, window: np.ndarray) -> Grid:
        """The field as it is seen: directions on the page, with the speeds of the samples."""
        extent = window[1] - window[0]
        step = extent.max() / (NODES - 1)
        axes = [np.linspace(window[0][k], window[1][k], max(int(np.ceil(extent[k] / step)) + 1, 9))
                for k in range(2)]
        if self._grid is None:
            velocity = self._from_curvilinear(axes)
        else:
            velocity = self._from_axes(axes)
        return Grid([np.ascontiguousarray(c, np.float32) for c in velocity], axes, [0.0, 0.0])

    def _from_axes(self, axes: list[np.ndarray]) -> list[np.ndarray]:
        assert self._grid is not None
        nodes = np.stack(np.meshgrid(*axes), -1)
        x, y = self._plane.inverse(nodes.reshape(-1, 2) / self._page)
        x, y = x.reshape(nodes.shape[:2]), y.reshape(nodes.shape[:2])
        u, v = (interpolate(self._grid, c, x, y) for c in self._velocity)
        if self._along_axes:
            return self._plane.turn(x, y, u, v, self._page)
        return [u, v]

    def _from_curvilinear(self, axes: list[np.ndarray]) -> list[np.ndarray]:
        x, y = self._given
        x, y, u, v = thinned([x, y, *self._velocity], MOST_SAMPLES)
        velocity = self._plane.turn(x, y, u, v, self._page) if self._along_axes else [u, v]
        places = self._to_page(self._plane.forward(x.ravel(), y.ravel())).reshape(*x.shape, 2)
        whole = over_no_gap(self._plane.space(x, y, places))
        # neighbours on either side of a map's cut are none
        widest = 0.5 * self._page[0] if self._plane.fills_outline else np.inf
        return resample_triangles(places[..., 0], places[..., 1], velocity, axes, whole, widest)

    def _update(self) -> None:
        """Places the arrows, unless they are placed for what the axes show."""
        if not self._drawn:  # else the axes have seen to it
            locate = self.axes.get_axes_locator()
            self.axes.apply_aspect(locate(self.axes, None) if locate else None)
        if self._placed is not None and (not self._adaptive or _is_panned(self.axes)):
            return
        view = self._look()
        same = self._view is not None and _alike(self._view, view)
        if self._placed is not None and same:
            return
        if not same:
            # where U and V are along the page, its proportions turn them
            step = LEAST_RATIO if self._along_axes else 0.025 * LEAST_RATIO
            self._view, self._page, self._icons = view, _page_of(view[1], step), None
        self._lines, self._sizes = [], np.zeros((0, 4))
        self.set_array(np.zeros(0) if self._mapped else None)
        warm, self._placed, self._icons = self._icons, None, None
        window = self._window(self._view[0])
        if (window[1] - window[0] > 1.0).all():
            self._fill(self._raster(window), warm)

    def _fill(self, raster: Grid, warm: Any) -> None:
        count = self._count
        while self._placed is None and count > 0:
            try:
                self._placed, self._icons = place(raster, count, self._effort, warm)
            except ValueError:  # no arrow, or not so many, has room in this part of the field
                count //= 2
        found = self._placed
        if found is None:
            return
        back = (self.axes.transData - self.axes.transAxes).inverted()
        self._lines = [back.transform(path / self._page) for path in found.paths]
        self._sizes = np.stack(
            [found.width, found.tail_width, found.head_length, found.head_width], 1)
        if self._mapped:
            self.set_array(found.speed if self._c is None else self._along(found.paths))
            if not self._is_ranged and self._c is None:
                _set_range(self.norm, found.speed_range)
            self._is_ranged = True

    def _along(self, paths: list[np.ndarray]) -> np.ndarray:
        """Mean of C along each line."""
        assert self._c is not None
        means = []
        for path in paths:
            x, y = self._plane.inverse(path / self._page)
            if self._grid is not None and self._c.ndim == 2:
                values = interpolate(self._grid, self._c, x, y)
            else:
                gx, gy = self._given
                near = [np.nanargmin((gx - a) ** 2 + (gy - b) ** 2) for a, b in zip(x, y)]
                values = self._c.ravel()[near]
            good = np.isfinite(values)
            means.append(values[good].mean() if good.any() else np.nan)
        return np.array(means)

    @property
    def arrows(self) -> Arrows | None:
        """What is shown, in points from the lower left corner of the axes; None: nothing."""
        self._update()
        return self._shown()

    def _shown(self) -> Arrows | None:
        return None if self._placed is None else self._placed._stretched(self._stretch())

    def get_array(self) -> Any:
        """Speeds, or means of C, of the arrows."""
        if self._mapped and self._placed is None and self.axes is not None:
            self._update()
        return super().get_array()

    def autoscale_None(self) -> None:
        """Ends of the colours that are not given: of the arrows, or where there is none in view of
        all values."""
        values = self.get_array()
        if values is not None and not len(values):
            values = self._values[np.isfinite(self._values)]
        self.norm.autoscale_None(values)

    def to_rgba(self, x: Any, *args: Any, **kwargs: Any) -> np.ndarray:
        if self._mapped and not self.norm.scaled():
            self.autoscale_None()
        return super().to_rgba(x, *args, **kwargs)

    def set_UVC(self, U: Any, V: Any, C: Any = None) -> None:
        """Shows other values on the same coordinates; arrows move on from where they are."""
        self._set_samples(U, V, C)
        self._placed = None
        self.stale = True

    def get_paths(self) -> list[Path]:
        """Polygons of the arrows, in display coordinates."""
        self._update()
        forward = self.axes.transData
        scale = np.sqrt(self._stretch().prod()) * self.axes.figure.dpi / 72.0
        self._paths = []
        for line, sizes in zip(self._lines, self._sizes):
            polygon = line_outline(forward.transform(line), sizes * scale, 1)
            if not len(polygon):
                polygon = np.full((1, 2), np.nan)
            self._paths.append(Path(np.append(polygon, polygon[:1], 0), closed=True))
        return self._paths

    def __getstate__(self) -> dict[str, Any]:
        """Arrows are placed again after unpickling."""
        return {**super().__getstate__(), "_placed": None, "_icons": None, "_view": None}

    @allow_rasterization
    def draw(self, renderer: Any) -> None:
        self._drawn = True
        try:
            self._update()  # first, for the colours
            super().draw(renderer)
        finally:
            self._drawn = False

    def get_datalim(self, transData: Any) -> Bbox:
        x, y = self._outline_of_samples()
        if self._plane.is_data and transData is self.axes.transData:  # without rounding
            places = np.stack([x, y], 1)
        else:
            display = self.axes.transAxes.transform(self._plane.forward(x, y))
            places = transData.inverted().transform(display)
        places = places[np.isfinite(places).all(1)]
        return Bbox([places.min(0), places.max(0)]) if len(places) else Bbox.null()

    def _least_positive(self) -> np.ndarray:
        """Where logarithmic axes begin: (1, 2), within the data."""
        least = []
        for values in self._given if self._grid is None else self._grid.axes:
            positive = values[values > 0.0]
            least.append(positive.min() if len(positive) else np.nanmin(values))
        return np.array([least])

    def get_window_extent(self, renderer: Any = None) -> Bbox:
        return self.get_datalim(IdentityTransform())

    def width_of(self, speed: float) -> float:
        """Width in points, where the head begins, of an arrow of some speed."""
        return _width_of(self.arrows, speed)


def _page_of(ratio: float, step: float) -> np.ndarray:
    """Width and height of the page, of proportions that are given by their logarithm and rounded
    by a step."""
    shorter = np.round(PAGE * math.exp(-step * abs(round(ratio / step))), 3)
    return np.array([PAGE, shorter] if ratio > 0.0 else [shorter, PAGE])


def _alike(view: tuple[np.ndarray, float], other: tuple[np.ndarray, float]) -> bool:
    """Whether arrows that are placed for one view may be kept in another."""
    return abs(view[1] - other[1]) < LEAST_RATIO and np.allclose(
        view[0], other[0], rtol=0.0, atol=LEAST_SHIFT, equal_nan=True)


def _width_of(found: Arrows | None, speed: float) -> float:
    if found is None or not len(found):
        return 1.0
    order = np.argsort(found.speed)
    return float(np.interp(speed, found.speed[order], np.sort(found.width)))


def _arguments(ax: Any, args: tuple[Any, ...]) -> tuple[Any, Any, Any, Any, Any]:
    """X, Y, U, V, C of quiver's arguments ([X, Y], U, V, [C])."""
    if not 2 <= len(args) <= 5:
        raise TypeError(f"quiver takes ([X, Y], U, V, [C]), not {len(args)} arrays")
    c = args[-1] if len(args) in (3, 5) else None
    u, v = args[-3:-1] if c is not None else args[-2:]
    shape = np.ma.asanyarray(u).shape
    if len(shape) != 2 and (len(args) < 4 or any(np.shape(a) != shape for a in args[:2])):
        raise ValueError(f"U has the shape {shape}; (ny, nx) is needed, or that of X and Y, points,"
                         " in the order X, Y, U, V")
    x, y = args[:2] if len(args) > 3 else (np.arange(shape[1]), np.arange(shape[0]))
    if np.ndim(x) == 2 and mesh_rank(u, v) > mesh_rank(x, y):
        if not mesh_rank(x, y):
            raise ValueError("X and Y are folded, as coordinates never are, and U and V may be "
                             "coordinates: the order is X, Y, U, V")
        warnings.warn("U and V are those of a mesh grid, X and Y are not: the order is X, Y, U, V",
                      stacklevel=4)
    ax.xaxis.update_units(x)  # dates, say
    ax.yaxis.update_units(y)
    x, y = ax.convert_xunits(x), ax.convert_yunits(y)
    return real_array("X", x), real_array("Y", y), u, v, c


def _plane_of(ax: Any, transform: Any) -> Any:
    if transform is None:
        return TransformPlane(ax, None)
    if isinstance(transform, Transform):
        return TransformPlane(ax, transform)
    if hasattr(transform, "transform_points"):
        if not hasattr(ax, "projection"):
            raise ValueError("transform is one of cartopy, but the axes are not")
        return CrsPlane(ax, transform)
    if hasattr(transform, "_as_mpl_transform"):
        return TransformPlane(ax, transform._as_mpl_transform(ax))
    raise ValueError(f"transform is a {type(transform).__name__}, not one of matplotlib or cartopy")


def _set_range(norm: Any, speeds: tuple[float, float]) -> None:
    """Ends of the colours; speeds that differ by rounding are equal."""
    low, high = speeds
    norm.vmin, norm.vmax = low if high - low > 1e-6 * high else 0.0, high


def _is_panned(ax: Any) -> bool:
    """While a mouse button moves the view, arrows move with it."""
    return getattr(ax, "_pan_start", None) is not None


def quiver(
    ax: Any, *args: Any, arrows: int = 40, transform: Any = None, adaptive: bool = True,
    angles: str = "xy", effort: str = "normal", mask: Any = None, cmap: Any = None,
    norm: Any = None, vmin: float | None = None, vmax: float | None = None, **kwargs: Any,
) -> Quiver:
    """Draws a vector field as few curved arrows: ``quiver(ax, [X, Y], U, V, [C])``.

    The arrows follow the flow as it is seen in the axes: on logarithmic, inverted and polar axes
    and on maps of cartopy. Their colour is the speed, or C; so is their width the speed.

    Parameters
    ----------
    ax : matplotlib.axes.Axes
    X, Y : array_like, (nx,) and (ny,), or both of the shape of U; optional
        Coordinates, by default 0, 1, ...
    U, V : array_like, (ny, nx), or (n,) of scattered points
        Components along X and Y; masked and NaN samples are missing.
    C : array_like, of the shape of U, optional
        What colours show, in place of the speed.
    arrows : int
        How many are on screen.
    transform : matplotlib.transforms.Transform or cartopy.crs.CRS, optional
        What the coordinates are of, by default the data of the axes. With a CRS of longitude and
        latitude U and V are along east and north, else along its axes.
    adaptive : bool
        Places the arrows anew when the view changes, so that there are always so many. Otherwise
        they are placed once, on all of the field, and kept.
    angles : {"xy", "uv"}
        "xy": arrows follow the streamlines of dX/dt = U, dY/dt = V, as seen. "uv": U is to the
        right and V upwards on the page, whatever the axes.
    effort : {"normal", "quick", "thorough"}
        Of the search for the best places.
    mask : array_like of bool, (ny, nx), optional
        True where a sample is missing.
    cmap, norm, vmin, vmax
        As in matplotlib. By default the program's palette, from the slowest to the fastest arrow
        but for few that are far faster than the others, of those that are placed first: later
        frames and views keep these ends. Of C, and where one of norm, vmin and vmax is given, the
        ends that are not are the least and the largest value of the arrows.
    **kwargs
        Properties of `matplotlib.collections.PatchCollection`. ``color`` gives all arrows one.

    Returns
    -------
    Quiver
        One artist, a `PatchCollection` and so a `ScalarMappable`; ``set_UVC(U, V, C)`` changes it.

    Raises
    ------
    ValueError
        Shapes that do not fit, a velocity that is zero or missing everywhere.

    Examples
    --------
    >>> fig, ax = plt.subplots()                                      # doctest: +SKIP
    >>> q = flowgrain.quiver(ax, x, y, u, v, arrows=30)               # doctest: +SKIP
    >>> fig.colorbar(q, label="m/s")                                  # doctest: +SKIP
    """
    artist = Quiver(ax, args, arrows=arrows, transform=transform, adaptive=adaptive, angles=angles,
                    effort=effort, mask=mask, cmap=cmap, norm=norm, vmin=vmin, vmax=vmax, **kwargs)
    ax.add_collection(artist, autolim=False)
    limits = artist.get_datalim(ax.transData) if artist._plane.has_data_limits else None
    if limits is not None and np.isfinite(limits.get_points()).all():
        ax.update_datalim(limits)
        if artist._plane.is_data:
            ax.update_datalim(artist._least_positive())
        ax.autoscale_view()
    return artist


class QuiverKey(Artist):
    """An arrow as wide and of the colour as one of some speed, with a label."""

    def __init__(self, Q: Quiver, X: float, Y: float, U: float, label: str, *,
                 coordinates: str = "axes", labelpos: str = "E", labelsep: float = 0.1,
                 labelcolor: Any = None, fontproperties: Any = None, color: Any = None,
                 length: float = 0.4, zorder: float | None = None) -> None:
        super().__init__()
        self.Q, self.X, self.Y, self.U = Q, X, Y, float(U)
        if labelpos not in ("N", "S", "E", "W"):
            raise ValueError(f"labelpos is {labelpos!r}, not one of N, S, E, W")
        places = {"axes": Q.axes.transAxes, "figure": Q.axes.figure.transFigure,
                  "data": Q.axes.transData, "inches": Q.axes.figure.dpi_scale_trans}
        if coordinates not in places:
            raise ValueError(f"coordinates is {coordinates!r}, not one of {', '.join(places)}")
        self._place = places[coordinates]
        self.labelpos, self.labelsep, self.length, self.color = labelpos, labelsep, length, color
        align = {"N": ("center", "bottom"), "S": ("center", "top"), "E": ("left", "center"),
                 "W": ("right", "center")}[labelpos]
        self.text = Text(text=label, ha=align[0], va=align[1], fontproperties=fontproperties)
        if labelcolor is not None:
            self.text.set_color(labelcolor)
        self.zorder = Q.zorder + 0.1 if zorder is None else zorder

    def set_figure(self, fig: Any) -> None:
        super().set_figure(fig)
        self.text.set_figure(fig)

    def _parts(self, found: Arrows | None) -> tuple[Polygon, tuple[float, float]]:
        dpi = self.Q.axes.figure.dpi
        middle = self._place.transform((self.X, self.Y))
        half = 0.5 * self.length * dpi
        width = _width_of(found, self.U) * dpi / 72.0
        # as wide a head as placed arrows have
        head = (2.6, 2.6)
        if found is not None and len(found):
            head = (np.median(found.head_length / found.width),
                    np.median(found.head_width / found.width))
        line = middle + np.stack([np.linspace(-half, half, 24), np.zeros(24)], 1)
        tail = 0.4 * width
        polygon = line_outline(line, np.array([width, tail, head[0] * width, head[1] * width]))
        color = self.color
        if color is None:
            if self.Q._mapped:  # before arrows are placed, for a layout, colours do not matter
                color = "none" if found is None else self.Q.to_rgba(self.U)
            else:
                color = self.Q.get_facecolor()[0]
        gap = self.labelsep * dpi
        off = {"N": (0.0, gap), "S": (0.0, -gap), "E": (half + gap, 0.0), "W": (-half - gap, 0.0)}
        x, y = middle + off[self.labelpos]
        patch = Polygon(polygon, closed=True, facecolor=color, edgecolor="none",
                        transform=IdentityTransform())
        patch.set_figure(self.Q.axes.figure)
        return patch, (x, y)

    @allow_rasterization
    def draw(self, renderer: Any) -> None:
        if not self.get_visible():
            return
        patch, (x, y) = self._parts(self.Q.arrows)
        patch.draw(renderer)
        self.text.set_position((x, y))
        self.text.draw(renderer)
        self.stale = False

    def get_window_extent(self, renderer: Any = None) -> Bbox:
        # layouts ask before the axes have their size: no arrows are placed for that
        patch, (x, y) = self._parts(self.Q._shown())
        self.text.set_position((x, y))
        return Bbox.union([patch.get_window_extent(renderer),
                           self.text.get_window_extent(renderer)])


def quiverkey(Q: Quiver, X: float, Y: float, U: float, label: str, **kwargs: Any) -> QuiverKey:
    """Adds an arrow of speed U with a label, as a key to the arrows' width and colour.

    Parameters
    ----------
    Q : Quiver
        What `quiver` has returned.
    X, Y : float
        Where the arrow's middle is.
    U : float
        The speed.
    label : str
    coordinates : {"axes", "figure", "data", "inches"}
        Of X and Y.
    labelpos : {"E", "N", "S", "W"}
        On which side of the arrow the label is, ``labelsep`` inches away.
    length : float
        Of the arrow, inches.
    labelcolor, fontproperties, color, zorder
        As in `matplotlib.axes.Axes.quiverkey`.

    Returns
    -------
    QuiverKey
    """
    key = QuiverKey(Q, X, Y, U, label, **kwargs)
    Q.axes.add_artist(key)
    key.set_clip_on(False)
    return key


__all__ = ["Quiver", "QuiverKey", "gale", "quiver", "quiverkey"]
