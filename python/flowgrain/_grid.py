"""Samples on a grid, from arrays as users have them: what the library takes as a field."""

from __future__ import annotations

from typing import Any, Sequence

import numpy as np

from ._core import ffi, lib
from ._library import Context, copy

SCALES = {"plain": "FG_SCALE_PLAIN", "geo": "FG_SCALE_GEO"}


class Grid:
    """Samples on ascending axes.

    Arrays have the shape ([nz,] ny, nx); missing samples are NaN. ``axes`` and ``periods`` (0:
    none) are in the order x, y(, z).
    """

    def __init__(self, velocity: list[np.ndarray], axes: list[np.ndarray], periods: list[float],
                 scale: str = "plain", places: Sequence[np.ndarray] = (),
                 circle: float = 0.0) -> None:
        self.velocity, self.axes, self.periods, self.scale = velocity, axes, periods, scale
        #: after which x is the same place again, whether or not the axis goes round; 0: never
        self.circle = circle
        #: where each of the user's samples lies, x, y(, z) of the user's shape
        self.places = list(places)

    @property
    def dimension(self) -> int:
        return len(self.axes)

    @property
    def bounds(self) -> np.ndarray:
        """Lowest and highest coordinate along each axis, (dimension, 2)."""
        ends = [(a[0], a[0] + p if p else a[-1]) for a, p in zip(self.axes, self.periods)]
        return np.array(ends)

    def create_field(self, context: Context, function: Any = lib.fg_field_create) -> Any:
        """The library's field, a copy."""
        arrays = ffi.new("fg_field_arrays *")
        arrays.dimension = self.dimension
        arrays.scale = getattr(lib, SCALES[self.scale])
        kept = []
        for k, (axis, velocity) in enumerate(zip(self.axes, self.velocity)):
            kept += [ffi.from_buffer("double[]", axis), ffi.from_buffer("float[]", velocity)]
            arrays.size[k] = len(axis)
            arrays.axis[k], arrays.velocity[k] = kept[-2:]
            arrays.period[k] = self.periods[k]
        return context.create(
            "fg_field", lib.fg_field_destroy, function, context.handle, arrays
        )

    def at_samples(self, nodes: np.ndarray, origin: Sequence[float], spacing: Sequence[float],
                   periodic: Sequence[float]) -> np.ndarray:
        """Values of an even raster, ([nz,] ny, nx), at the node nearest to each of the user's
        samples."""
        index = []
        for k, place in enumerate(self.places):
            count = nodes.shape[-1 - k]
            # a coordinate that is NaN is not of the grid: its label is that of some node
            at = np.nan_to_num(np.rint((place - origin[k]) / spacing[k])).astype(np.intp)
            index.append(at % count if periodic[k] else np.clip(at, 0, count - 1))
        return nodes[tuple(index[::-1])]


def _numbers(name: str, values: Any) -> Any:
    array = np.ma.asanyarray(values)
    if array.dtype.kind not in "biuf":
        raise ValueError(f"{name}: numbers are needed, not {array.dtype}")
    return array


def real_array(name: str, values: Any) -> np.ndarray:
    """Any numbers as float64, NaN where they are masked."""
    return np.ma.filled(_numbers(name, values).astype(np.float64), np.nan)


def velocity_arrays(components: Sequence[Any], mask: Any) -> list[np.ndarray]:
    """Components as float32 samples, contiguous, NaN where they are masked."""
    shape, found = np.shape(components[0]), []
    for name, values in zip("uvw", components):
        array = _numbers(name, values)
        if array.shape != shape:
            raise ValueError(f"{name} has the shape {array.shape}, but u has {shape}")
        with np.errstate(over="ignore"):
            samples = np.array(np.ma.getdata(array), np.float32, order="C")
        if array.dtype.itemsize > 4 and np.isinf(samples).any():
            too_fast = np.isinf(samples) & np.isfinite(np.ma.getdata(array))
            samples[too_fast] = np.finfo(np.float32).max  # the library refuses it with its number
        samples[np.ma.getmaskarray(array)] = np.nan
        if mask is not None:
            out = np.ma.filled(np.ma.asanyarray(mask), True).astype(bool)
            if out.shape != shape:
                raise ValueError(f"mask has the shape {out.shape}, but u has {shape}")
            samples[out] = np.nan
        found.append(samples)
    return found


def make_grid(
    components: Sequence[Any], coordinates: Sequence[Any], mask: Any = None, period: Any = None,
    scale: str = "plain", circle: float = 0.0,
) -> Grid:
    """Checks and orders what a user has given; circle: that of `Grid`."""
    if scale not in SCALES:
        raise ValueError(f"scale is {scale!r}, not one of {', '.join(SCALES)}")
    shape, dimension = np.shape(components[0]), len(components)
    if len(shape) not in (1, dimension):
        order = "(ny, nx)" if dimension == 2 else "(nz, ny, nx)"
        raise ValueError(f"u has the shape {shape}; {order} is needed, or (n,) of points"
                         + ("; in 3D there is also w" if len(shape) == 3 else ""))
    velocity = velocity_arrays(components, mask)
    periods = _periods(period, dimension)
    if len(shape) == 1:
        return _grid_of_points(velocity, coordinates, periods, scale)
    axes = axes_of(coordinates, shape)
    if any(axis.ndim > 1 for axis in axes):
        return _curvilinear_grid(velocity, axes, periods, scale)
    grid = Grid(velocity, axes, periods, scale, circle=circle or 360.0 * (scale == "geo"))
    places = [_order_axis(grid, k) for k in range(dimension)]
    grid.places = list(np.meshgrid(*places[::-1], indexing="ij", sparse=True)[::-1])
    grid.velocity = [np.ascontiguousarray(samples) for samples in grid.velocity]
    return grid


def mesh_rank(x: Any, y: Any) -> int:
    """Whether two arrays, (..., ny, nx), can be coordinates of a grid: 2, as `numpy.meshgrid` makes
    them, in either indexing; 1, almost all cells have one orientation; 0, they are folded."""
    x, y = real_array("x", x), real_array("y", y)
    if x.shape != y.shape or x.ndim < 2 or min(x.shape) < 2:
        return 0
    x, y = (a.reshape(-1, *a.shape[-2:])[0] for a in (x, y))
    for a, b in ((x, y), (x.T, y.T)):
        if (a == a[0]).all() and (b.T == b[:, 0]).all():
            return 2 * (len(np.unique(a[0])) == a.shape[1] and len(np.unique(b[:, 0])) == len(b))
    (a, b), (c, d) = ((p[1:, 1:] - p[:-1, :-1], p[1:, :-1] - p[:-1, 1:]) for p in (x, y))
    area = a * d - b * c
    known = np.isfinite(area).sum()
    return int(max((area > 0.0).sum(), (area < 0.0).sum()) > 0.9 * known)


def _grid_of_points(velocity: list[np.ndarray], coordinates: Sequence[Any], periods: list[float],
                    scale: str) -> Grid:
    """The grid of scattered points, as the program makes one of a table's."""
    places = [np.ascontiguousarray(real_array("xyz"[k], c))
              for k, c in enumerate(coordinates) if c is not None]
    shapes = [place.shape for place in places]
    if any(periods) or shapes != [velocity[0].shape] * len(velocity):
        raise ValueError(f"u has the shape {velocity[0].shape}, that of points: "
                         f"{', '.join('xyz'[:len(velocity)])} need the same, not "
                         f"{', '.join(map(str, shapes)) or 'none'}, and no period")
    field = Grid(velocity, places, periods, scale).create_field(
        Context(), lib.fg_field_create_scattered)
    arrays = lib.fg_field_contents(field)
    if arrays.dimension < len(velocity):
        raise ValueError("the points lie in a plane: give its two coordinates and components")
    size = [arrays.size[k] for k in range(arrays.dimension)]
    axes = [copy(arrays.axis[k], (n,), np.float64) for k, n in enumerate(size)]
    velocity = [copy(arrays.velocity[k], tuple(size[::-1]), np.float32) for k in range(len(size))]
    for samples in velocity if arrays.valid else []:
        samples[copy(arrays.valid, samples.shape, np.uint8) == 0] = np.nan
    if scale == "geo":
        places[0] = in_one_piece(places[0])
    return Grid(velocity, axes, list(arrays.period)[:len(size)], scale, places,
                360.0 * (scale == "geo"))


def _periods(period: Any, dimension: int) -> list[float]:
    if period is None:
        return [0.0] * dimension
    given = [period] if np.ndim(period) == 0 else list(period)
    if len(given) > dimension:
        raise ValueError(f"{len(given)} periods for {dimension} axes")
    periods = [0.0 if p is None else float(p) for p in given]
    if not all(np.isfinite(p) and p >= 0.0 for p in periods):
        raise ValueError(f"a period of {period!r}: a length, or None, is needed")
    return periods + [0.0] * (dimension - len(periods))


def _coordinate(k: int, values: Any, shape: tuple[int, ...]) -> np.ndarray:
    """Coordinates along axis k, one for each sample along it or one for each sample."""
    count = shape[-1 - k]
    if values is None:
        return np.arange(count, dtype=np.float64)
    name = "xyz"[k]
    array = real_array(name, values)
    if array.shape not in ((count,), shape):
        raise ValueError(
            f"{name} has the shape {array.shape}; u, of shape {shape}, needs ({count},) or {shape}"
            + (": is u transposed?" if array.ndim == 1 and len(array) in shape else "")
        )
    return array


def axes_of(coordinates: Sequence[Any], shape: tuple[int, ...]) -> list[np.ndarray]:
    """Axes, also of coordinates of each sample that are the same along all others; else those of
    each sample."""
    axes = [_coordinate(k, values, shape) for k, values in enumerate(coordinates)]
    found: list[np.ndarray] = []
    for k, values in enumerate(axes):
        if values.ndim == 1:
            found.append(values)
            continue
        along = len(shape) - 1 - k
        line = np.moveaxis(values, along, -1).reshape(-1, shape[along])[0]
        spread = np.ptp(line) if np.isfinite(line).all() else np.nan
        aligned = np.expand_dims(line, [d for d in range(len(shape)) if d != along])
        if not np.abs(values - aligned).max() <= 1e-9 * spread:
            return [np.broadcast_to(_expanded(a, m, len(shape)), shape) for m, a in enumerate(axes)]
        found.append(np.ascontiguousarray(line))
    return found


def _expanded(values: np.ndarray, k: int, dimension: int) -> np.ndarray:
    if values.ndim > 1:
        return values
    return np.expand_dims(values, [d for d in range(dimension) if d != dimension - 1 - k])


# A gap is more than WIDE times as long as the median interval up to BESIDE from it: three lines of
# an even grid may be left out, for their interval of 4 is rounded.
WIDE, BESIDE = 4.5, 3
GAP_LINES = 8  # without a value, so that no line goes over a gap as over single missing samples


def ordered(name: str, axis: np.ndarray, circle: float = 0.0) -> tuple[np.ndarray, np.ndarray]:
    """Coordinates along an axis, and the indices of its samples that make them ascend.

    A descending axis is flipped. One that jumps back once and ends before it began, as longitudes
    from 0 to 180 and then from -180 on, is rolled; where this leaves a wider gap, the part behind
    the jump is a circle farther on. A last sample that repeats the first is left out. Any other
    order is refused, and so are equal coordinates and those that are no numbers.
    """
    for i in np.flatnonzero(~np.isfinite(axis))[:1]:
        raise ValueError(f"{name}[{i}] is {axis[i]:g}; an axis needs a number for each sample")
    order = np.arange(len(axis))
    if 2 * (np.diff(axis) < 0.0).sum() > len(axis) - 1:
        order = order[::-1]
    jumps = np.flatnonzero(np.diff(axis[order]) < 0.0) + 1
    if len(jumps) == 1 and axis[order[-1]] <= axis[order[0]]:
        before, behind = np.split(order, jumps)
        if axis[order[-1]] == axis[order[0]]:
            behind = behind[:-1]
        onward = axis[behind[:1]] + circle - axis[before[-1]] if circle else np.inf
        if len(behind) and axis[before[0]] - axis[behind[-1]] > 1.5 * onward > 0.0:
            axis = axis.copy()
            axis[behind] += circle
            order = np.append(before, behind)
        else:
            order = np.append(behind, before)
    for i in np.flatnonzero(~(np.diff(axis[order]) > 0.0))[:1]:
        a, b = sorted(order[i:i + 2])
        if axis[a] == axis[b]:
            raise ValueError(f"{name}[{a}] and {name}[{b}] are both {axis[a]:.9g}; an axis needs "
                             "other coordinates for each sample")
        raise ValueError(
            f"{name} neither ascends nor descends: {name}[{a}] is {axis[a]:.9g}, {name}[{b}] is "
            f"{axis[b]:.9g}; sort it with its samples: np.argsort, or ds.sortby({name!r})")
    return axis, order


def _order_axis(grid: Grid, k: int) -> np.ndarray:
    """Makes an axis ascend, and leaves out the sample that repeats the first a period later.
    Returns the coordinates in the user's order."""
    along = grid.dimension - 1 - k
    places, order = ordered("xyz"[k], grid.axes[k], 0.0 if k else grid.circle)
    ends = ([samples.take(i, along) for samples in grid.velocity] for i in (0, -1))
    if len(order) < len(places) and not np.allclose(*ends, equal_nan=True):
        raise ValueError(f"{'xyz'[k]}[0] and {'xyz'[k]}[{len(places) - 1}] are both "
                         f"{places[0]:.9g}, with other samples")
    axis, period = places[order], grid.periods[k]
    if period and len(axis) > 2 and abs(axis[-1] - axis[0] - period) <= 1e-6 * period:
        axis, order = axis[:-1], order[:-1]
    grid.velocity = [samples.take(order, along) for samples in grid.velocity]
    seam = np.flatnonzero(np.abs(np.diff(order)) > 1)[:1] + 1
    if len(seam) and np.diff(axis)[seam - 1] > WIDE * np.median(np.diff(axis)):
        # nothing is known between the ends of an axis that was rolled
        inside = np.linspace(axis[seam - 1], axis[seam], GAP_LINES + 2)[1:-1, 0]
        axis = np.insert(axis, seam[0], inside)
        grid.velocity = [np.insert(samples, np.repeat(seam, GAP_LINES), np.nan, along)
                         for samples in grid.velocity]
    grid.axes[k] = np.ascontiguousarray(axis)
    return places


# A raster is as fine as the samples, within these limits of nodes along its longer side.
FEWEST, MOST = 65, 769


def _curvilinear_grid(
    velocity: list[np.ndarray], places: list[np.ndarray], periods: list[float], scale: str
) -> Grid:
    """A regular grid instead of a curvilinear one in 2D, with linear interpolation in triangles."""
    if len(velocity) == 3:
        raise ValueError("in 3D x, y and z must be axes, arrays of one dimension each")
    if any(periods):
        raise ValueError("a period needs coordinates along the axes, x of shape (nx,) and y (ny,)")
    x, y = places = [in_one_piece(places[0]) if scale == "geo" else places[0], places[1]]
    good = np.isfinite(x) & np.isfinite(y)
    if not good.any():
        raise ValueError("x and y have no sample where both are numbers")
    low = [x[good].min(), y[good].min()]
    extent = [np.ptp(x[good]), np.ptp(y[good])]
    if not min(extent) > 0.0:
        raise ValueError(f"x and y extend over {extent[0]:g} x {extent[1]:g}: no area")
    # about as many nodes as there are samples
    spacing = np.sqrt(extent[0] * extent[1] / good.sum())
    longest = max(extent)
    spacing = min(max(spacing, longest / (MOST - 1)), longest / (FEWEST - 1))
    axes = []
    for start, length in zip(low, extent):
        axes.append(np.linspace(start, start + length, max(int(np.ceil(length / spacing)) + 1, 2)))
    thin = thinned([x, y, *velocity], MOST * MOST)
    whole = over_no_gap(on_sphere(*thin[:2]) if scale == "geo" else thin[:2])
    widest = 180.0 if scale == "geo" else np.inf  # cells where longitudes jump by a turn are none
    raster = resample_triangles(thin[0], thin[1], thin[2:], axes, whole, widest)
    grid = Grid([np.ascontiguousarray(r, np.float32) for r in raster], axes, periods, scale)
    grid.places = places
    return grid


def thinned(arrays: Sequence[np.ndarray], most: int) -> list[np.ndarray]:
    """Every second, third, ... row and column, and the last, of arrays of more values than so."""
    shape = arrays[0].shape
    every = max(int(np.ceil(np.sqrt(arrays[0].size / most))), 1)
    kept = [np.unique(np.append(np.arange(0, n, every), n - 1)) for n in shape]
    return [a[np.ix_(*kept)] for a in arrays] if every > 1 else list(arrays)


def in_one_piece(longitude: np.ndarray) -> np.ndarray:
    """Longitudes of a region that begin behind the widest gap between them, so that those on both
    sides of the antimeridian hang together. Without a gap of 30 degrees they stay as they are."""
    known = np.unique(longitude[np.isfinite(longitude)])
    if not len(known) or known[-1] - known[0] > 360.0:
        return longitude
    gaps = np.diff(known, append=known[0] + 360.0)
    if gaps.max() < 30.0 or gaps[-1] == gaps.max():
        return longitude
    return np.where(longitude <= known[gaps.argmax()], longitude + 360.0, longitude)


def on_sphere(longitude: np.ndarray, latitude: np.ndarray) -> np.ndarray:
    """Unit vectors, (3, ny, nx), of degrees."""
    lon, lat = np.radians(longitude), np.radians(latitude)
    return np.stack([np.cos(lat) * np.cos(lon), np.cos(lat) * np.sin(lon), np.sin(lat)])


def over_no_gap(places: Sequence[np.ndarray]) -> np.ndarray:
    """Which cells, (ny - 1, nx - 1), of a curvilinear grid lie where it was sampled, by coordinates
    in a plane or in space, and by the program's rule (src/sample/gaps.h).

    An edge between neighbours along a line of the grid goes over a gap where it is more than WIDE
    times as long as the median of the edges of that line that are at most BESIDE away, itself among
    them; the larger one of two in the middle. Edges without a length, and those with an end that is
    not known, do not count. A cell is over a gap where one of its four edges goes over one. So
    neighbours across a gap between swaths, or a jump of longitudes, are none; up to three lines may
    be left out of an even grid; spacings may change anywhere, at once too, since from there on they
    are those of half the edges.
    """
    whole = np.ones([n - 1 for n in places[0].shape], bool)
    for along in (0, 1):
        steps = [np.moveaxis(np.diff(a, axis=along), along, -1) for a in places]
        length = np.sqrt(sum(step * step for step in steps))
        known = np.pad(np.where(length > 0.0, length, np.nan), ((0, 0), (BESIDE, BESIDE)),
                       constant_values=np.nan)
        near = np.sort(np.lib.stride_tricks.sliding_window_view(known, 2 * BESIDE + 1, 1), -1)
        middle = np.isfinite(near).sum(-1, keepdims=True) // 2  # numbers come before NaN
        gap = length > WIDE * np.take_along_axis(near, middle, -1)[..., 0]
        beside = gap[1:] | gap[:-1]
        whole &= ~(beside if along else beside.T)
    return whole


def resample_triangles(
    x: np.ndarray, y: np.ndarray, values: Sequence[np.ndarray], axes: Sequence[np.ndarray],
    cells: np.ndarray, widest: float,
) -> list[np.ndarray]:
    """Samples of a curvilinear grid at the nodes of an even raster.

    Each of the cells that are to count, (ny - 1, nx - 1), is cut in two triangles, unless these are
    wider along x than `widest`; nodes in a triangle get what is linear between its corners, others
    NaN.
    """
    number = np.arange(x.size).reshape(x.shape)
    a, b = number[:-1, :-1].ravel(), number[:-1, 1:].ravel()
    c, d = number[1:, 1:].ravel(), number[1:, :-1].ravel()
    corners = np.concatenate([np.stack([a, b, c], 1), np.stack([a, c, d], 1)])
    px, py = x.ravel()[corners], y.ravel()[corners]
    samples = [v.ravel()[corners].astype(np.float64) for v in values]
    whole = np.tile(cells.ravel(), 2) & np.isfinite(px).all(1) & np.isfinite(py).all(1)
    whole &= px.max(1) - px.min(1) <= widest
    for s in samples:
        whole &= np.isfinite(s).all(1)
    px, py, samples = px[whole], py[whole], [s[whole] for s in samples]
    nodes = [len(axis) for axis in axes]
    origin = [axis[0] for axis in axes]
    step = [(axis[-1] - axis[0]) / (len(axis) - 1) for axis in axes]
    # the triangles and nodes of which one may hold the other
    first, size = [], []
    for place, k in ((px, 0), (py, 1)):
        low = np.ceil((place.min(1) - origin[k]) / step[k] - 1e-9).astype(np.int64)
        high = np.floor((place.max(1) - origin[k]) / step[k] + 1e-9).astype(np.int64)
        low, high = np.maximum(low, 0), np.minimum(high, nodes[k] - 1)
        first.append(low)
        size.append(np.maximum(high - low + 1, 0))
    pairs = size[0] * size[1]
    if pairs.sum() > 64 * nodes[0] * nodes[1] + 1_000_000:
        raise ValueError("x and y: cells overlap; longitudes that jump by 360 between neighbours?")
    triangle = np.repeat(np.arange(len(pairs)), pairs)
    rank = np.arange(len(triangle)) - np.repeat(np.cumsum(pairs) - pairs, pairs)
    column = first[0][triangle] + rank % np.maximum(size[0][triangle], 1)
    row = first[1][triangle] + rank // np.maximum(size[0][triangle], 1)
    weights = _barycentric(px[triangle], py[triangle],
                           origin[0] + column * step[0], origin[1] + row * step[1])
    inside = (weights >= -1e-9).all(1)
    at = (row * nodes[0] + column)[inside]
    rasters = []
    for s in samples:
        raster = np.full(nodes[0] * nodes[1], np.nan)
        raster[at] = (weights[inside] * s[triangle[inside]]).sum(1)
        rasters.append(raster.reshape(nodes[1], nodes[0]))
    return rasters


def _barycentric(px: np.ndarray, py: np.ndarray, x: np.ndarray, y: np.ndarray) -> np.ndarray:
    """Weights of three corners, (m, 3) each, at points; NaN in triangles without area."""
    x1, x2 = px[:, 1] - px[:, 0], px[:, 2] - px[:, 0]
    y1, y2 = py[:, 1] - py[:, 0], py[:, 2] - py[:, 0]
    dx, dy = x - px[:, 0], y - py[:, 0]
    with np.errstate(divide="ignore", invalid="ignore"):
        area = x1 * y2 - x2 * y1
        second, third = (dx * y2 - x2 * dy) / area, (x1 * dy - dx * y1) / area
    return np.stack([1.0 - second - third, second, third], 1)


def interpolate(grid: Grid, values: np.ndarray, x: np.ndarray, y: np.ndarray) -> np.ndarray:
    """Values of samples on the axes of a grid in 2D at any points, bilinear; NaN outside and where
    a corner is missing."""
    index, weight = [], []
    outside = ~(np.isfinite(x) & np.isfinite(y))
    for k, place in enumerate((x, y)):
        axis, period = grid.axes[k], grid.periods[k]
        place = np.where(outside, axis[0], place)
        circle, slack = period or (0.0 if k else grid.circle), 1e-9 * (axis[-1] - axis[0])
        if circle:
            place = axis[0] - slack + np.mod(place - axis[0] + slack, circle)
        if period:
            axis = np.append(axis, axis[0] + period)
        outside |= (place < axis[0] - slack) | (place > axis[-1] + slack)
        low = np.clip(np.searchsorted(axis, place, "right") - 1, 0, len(axis) - 2)
        index.append((low, (low + 1) % len(grid.axes[k])))
        weight.append(np.clip((place - axis[low]) / (axis[low + 1] - axis[low]), 0.0, 1.0))
    (i0, i1), (j0, j1) = index
    wx, wy = weight
    result = (1 - wy) * ((1 - wx) * values[j0, i0] + wx * values[j0, i1]) + wy * (
        (1 - wx) * values[j1, i0] + wx * values[j1, i1]
    )
    return np.where(outside, np.nan, result)
