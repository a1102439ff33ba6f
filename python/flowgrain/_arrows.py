"""Arrows of a field: one set of them, or scales from many to few."""

from __future__ import annotations

import warnings
from typing import Any, Iterator, NamedTuple, Sequence, overload

import numpy as np

from ._core import ffi, lib
from ._grid import Grid, make_grid, mesh_rank
from ._library import Context, copy

KINDS = ("arrow", "ring", "spiral")
EFFORTS = ("normal", "quick", "thorough")
LENGTHS = ("free", "fair")
STARTS = ("clusters", "even")
SETS = ("arrows", "clusters")
MOST_WITHIN = 1000  # arrows that a tolerance may ask for

# The program's default palette, slow to fast.
GALE = (
    "#21a4aa", "#009bb0", "#0092b4", "#0888b8", "#227cba", "#3270bc", "#4263bc", "#5055b9",
    "#5c46b2", "#653aa2", "#6b2e8f", "#6e237c", "#6f1867", "#6c1252", "#660e3d", "#5f0c2b",
    "#570c1b",
)  # fmt: skip


class Counts(NamedTuple):
    """How many arrows there are, and how many clusters of which so many gave no arrow."""

    arrows: int
    clusters: int
    dropped: int


class Arrow(NamedTuple):
    """One arrow. Lengths and areas are in the units of the coordinates."""

    #: (k, 2) or (k, 3), from the tail to the tip of the head
    path: np.ndarray
    #: (m, 2), the closed polygon of body and head, its first vertex not repeated; None in 3D
    outline: np.ndarray | None
    #: mean speed of the part of the field that it stands for
    speed: float
    #: area (volume) of that part
    area: float
    #: number of the cluster, in ``Arrows.labels``, that it is in or nearest to; 0: none
    cluster: int
    #: the same in all scales, from 1; 0 for arrows of clusters
    id: int
    #: "arrow", or "ring" or "spiral" round a vortex
    kind: str


class Surface(NamedTuple):
    """A closed surface. A vertex on a crease has several corners, one for each normal."""

    vertex: np.ndarray  # (k, 3) coordinates
    corner: np.ndarray  # (m,) the vertex of each corner
    normal: np.ndarray  # (m, 3) of each corner, outwards
    triangle: np.ndarray  # (t, 3) corners


class _Scale(NamedTuple):
    """What the arrows of one scale have in common."""

    grid: Grid
    counts: Counts
    speed_range: tuple[float, float]
    density: np.ndarray | None
    nodes: np.ndarray | None  # labels of the density's nodes
    places: tuple[Sequence[float], ...]  # origin, spacing, periodic: of these
    time: float
    step: int


class Arrows(Sequence[Arrow]):
    """Curved arrows of a field, as `arrows` and `evolve` return them.

    A sequence of `Arrow`; a slice, an array of indices or a boolean array gives `Arrows` again.

    Attributes
    ----------
    paths : list of ndarray, (k, 2) or (k, 3)
        Centrelines from the tail to the tip of the head.
    outlines : list of ndarray, (m, 2)
        Closed polygons of body and head, the first vertex not repeated. Only in 2D; `solids` has
        the triangles in 3D.
    speed : ndarray
        Mean speed of the part of the field that each stands for.
    area : ndarray
        Area (volume) of that part.
    width, tail_width, head_length, head_width : ndarray
        Full width of the body at the head and at the tail, and the head's size.
    center : ndarray, (n, 2) or (n, 3)
    cluster : ndarray of int
        The cluster in `labels` that each is in or nearest to; 0: none.
    id, parent : ndarray of int
        The number of an arrow, the same in all scales, and that of the arrow which it goes into in
        the next scale; 0: not known.
    kind : list of str
        "arrow", or "ring" or "spiral" round a vortex.
    counts : Counts
        ``arrows``, ``clusters``, ``dropped`` of the whole scale.
    time, step : float, int
        Of the evolution that the clusters are of.
    bounds : ndarray, (2, 2) or (3, 2)
        Lowest and highest coordinate along each axis.
    """

    def __init__(self, icons: Sequence[Any], scale: _Scale, measured: Any) -> None:
        self._scale = scale
        self._measured = measured
        dimension = scale.grid.dimension
        self.paths = [
            np.ascontiguousarray(
                copy(lib.icon_points(i), (i.point_count, 3), np.float64)[:, :dimension]
            )
            for i in icons
        ]

        def array(name: str, dtype: Any = np.float64) -> np.ndarray:
            return np.array([getattr(i, name) for i in icons], dtype)

        self.speed, self.area = array("speed"), array("area")
        self.width, self.tail_width = array("width"), array("tail_width")
        self.head_length, self.head_width = array("head_length"), array("head_width")
        self.center = np.array([list(i.center) for i in icons]).reshape(-1, 3)[:, :dimension]
        self.cluster, self.id = array("cluster", np.int32), array("id", np.int32)
        self.parent = array("parent", np.int32)
        self.kind = [KINDS[i.kind] for i in icons]
        self._outlines: list[np.ndarray] | None = None

    @property
    def outlines(self) -> list[np.ndarray]:
        if self._outlines is None:
            if self.bounds.shape[0] == 3:
                raise ValueError("arrows in 3D have no outlines; their triangles are solids()")
            sizes = np.stack([self.width, self.tail_width, self.head_length, self.head_width], 1)
            self._outlines = [line_outline(p, s, i) for p, s, i in zip(self.paths, sizes, self.id)]
        return self._outlines

    def solids(self) -> list[tuple[np.ndarray, np.ndarray]]:
        """Closed surfaces of arrows in 3D.

        Returns
        -------
        list of (vertices, triangles)
            (k, 3) coordinates, and (m, 3) indices of vertices, counter-clockwise seen from outside.
        """
        return [(vertex, corner[triangle]) for vertex, corner, _, triangle in self._surfaces()]

    def _surfaces(self) -> list[Surface]:
        if self.bounds.shape[0] == 2:
            raise ValueError("arrows in 2D have no solids; their polygons are outlines")
        sizes = np.stack([self.width, self.tail_width, self.head_length, self.head_width], 1)
        return [_line_solid(path, s) for path, s in zip(self.paths, sizes)]

    @property
    def bounds(self) -> np.ndarray:
        return self._scale.grid.bounds

    @property
    def counts(self) -> Counts:
        return self._scale.counts

    @property
    def time(self) -> float:
        return self._scale.time

    @property
    def step(self) -> int:
        return self._scale.step

    @property
    def speed_range(self) -> tuple[float, float]:
        """Ends of a colour key: least and largest speed of the whole scale, but for outliers."""
        return self._scale.speed_range

    @property
    def density(self) -> np.ndarray | None:
        """The density whose positive parts are the clusters, float32, at the nodes of an even
        raster over `bounds`; of arrows within a tolerance, which no evolution precedes, a density
        of the parts that they stand for. None in 3D in that case."""
        return self._scale.density

    @property
    def labels(self) -> np.ndarray | None:
        """Number of the cluster of each sample, of the shape of u: from 1, 0 outside, -1 in those
        too small to count. None where there is no density."""
        s = self._scale
        return None if s.nodes is None else s.grid.at_samples(s.nodes, *s.places)

    @property
    def error(self) -> float:
        """Degrees by which the directions that a reader of the whole scale's arrows would
        reconstruct are wrong, the mean over the domain of three readers; computed when asked for.
        """
        return self._measured()

    def __len__(self) -> int:
        return len(self.paths)

    @overload
    def __getitem__(self, index: int) -> Arrow: ...

    @overload
    def __getitem__(self, index: slice) -> "Arrows": ...

    def __getitem__(self, index: Any) -> Any:
        if isinstance(index, (int, np.integer)):
            n = range(len(self))[index]
            return Arrow(
                self.paths[n],
                self.outlines[n] if self.bounds.shape[0] == 2 else None,
                float(self.speed[n]),
                float(self.area[n]),
                int(self.cluster[n]),
                int(self.id[n]),
                self.kind[n],
            )
        chosen = np.arange(len(self))[index]
        part = object.__new__(Arrows)
        part._scale, part._measured = self._scale, self._measured
        for name in ("speed", "area", "width", "tail_width", "head_length", "head_width", "center",
                     "cluster", "id", "parent"):
            setattr(part, name, getattr(self, name)[chosen])
        part.paths = [self.paths[n] for n in chosen]
        part.kind = [self.kind[n] for n in chosen]
        part._outlines = None if self._outlines is None else [self._outlines[n] for n in chosen]
        return part

    def _stretched(self, factor: np.ndarray) -> "Arrows":
        """The same with coordinates along each axis times a factor, all factors about equal."""
        part = self[:]
        size = float(factor.prod() ** (1.0 / len(factor)))
        part.paths, part.center = [path * factor for path in self.paths], self.center * factor
        part.area = self.area * factor.prod()
        for name in ("width", "tail_width", "head_length", "head_width"):
            setattr(part, name, getattr(self, name) * size)
        part._outlines = None
        grid = self._scale.grid
        axes = [axis * f for axis, f in zip(grid.axes, factor)]
        periods = [period * f for period, f in zip(grid.periods, factor)]
        part._scale = self._scale._replace(grid=Grid(grid.velocity, axes, periods, grid.scale))
        return part

    def __iter__(self) -> Iterator[Arrow]:
        return (self[n] for n in range(len(self)))

    def __repr__(self) -> str:
        low, high = (self.speed.min(), self.speed.max()) if len(self) else (0.0, 0.0)
        return f"<flowgrain.Arrows: {len(self)} arrows, speeds {low:.3g} to {high:.3g}>"

    def to_geojson(self) -> dict[str, Any]:
        """A GeoJSON FeatureCollection, as the program writes it: a line for each arrow from tail to
        tip, with its properties. With ``scale="geo"`` longitudes lie within 180 degrees, and lines
        are cut at the antimeridian.
        """
        dimension = self.bounds.shape[0]
        geo = self._scale.grid.scale == "geo"
        features = []
        for n, path in enumerate(self.paths):
            properties: dict[str, Any] = {
                "cluster": int(self.cluster[n]),
                "kind": self.kind[n],
                "volume" if dimension == 3 else "area": float(self.area[n]),
            }
            for name in ("speed", "width", "tail_width", "head_length", "head_width"):
                properties[name] = float(getattr(self, name)[n])
            center = self.center[n].copy()
            if geo:
                center[0] = _turned(center[0])
            properties["center"] = center.tolist()
            if self.id[n] > 0:
                properties["id"] = int(self.id[n])
            if self.parent[n] > 0:
                properties["parent"] = int(self.parent[n])
            parts = _cut(path) if geo else [path.tolist()]
            one = len(parts) == 1
            geometry = {
                "type": "LineString" if one else "MultiLineString",
                "coordinates": parts[0] if one else parts,
            }
            features.append({"type": "Feature", "geometry": geometry, "properties": properties})
        collection: dict[str, Any] = {
            "type": "FeatureCollection",
            "clusters": self.counts.clusters,
            "dropped": self.counts.dropped,
        }
        if geo:
            collection["projection"] = "+proj=longlat"
        collection["features"] = features
        return collection

    def _repr_svg_(self) -> str | None:
        """A picture for notebooks, coloured by speed; none in 3D."""
        if self.bounds.shape[0] == 3:
            return None
        (left, right), (low, high) = self.bounds
        wide = 480.0
        scale = wide / (right - left)
        tall = min(max((high - low) * scale, 60.0), 960.0)
        upright = tall / (high - low)
        least, most = self.speed_range
        share = np.clip((self.speed - least) / ((most - least) or 1.0), 0.0, 1.0)
        lines = [
            f'<svg xmlns="http://www.w3.org/2000/svg" width="{wide:.0f}" height="{tall:.0f}" '
            f'viewBox="0 0 {wide:.0f} {tall:.0f}"><title>{len(self)} arrows</title>'
            '<rect width="100%" height="100%" fill="#fff"/>'
        ]
        # slow ones first, so that fast ones lie above; sizes are the picture's
        size = np.sqrt(scale * upright)
        for n in np.argsort(self.speed, kind="stable"):
            path = (self.paths[n] - (left, low)) * (scale, -upright) + (0.0, tall)
            sizes = size * np.array([self.width[n], self.tail_width[n], self.head_length[n],
                                     self.head_width[n]])
            points = " ".join(f"{x:.2f},{y:.2f}" for x, y in line_outline(path, sizes, self.id[n]))
            color = GALE[int(share[n] * (len(GALE) - 1) + 0.5)]
            lines.append(f'<polygon points="{points}" fill="{color}"/>')
        return "\n".join(lines) + "</svg>"


def _turned(longitude: float) -> float:
    return float(longitude - 360.0 * np.rint(longitude / 360.0))


def _cut(path: np.ndarray) -> list[list[list[float]]]:
    """A line in longitude and latitude, within 180 degrees, in parts."""
    turn = 360.0 * np.rint(path[0, 0] / 360.0)
    parts: list[list[list[float]]] = [[[path[0, 0] - turn, path[0, 1]]]]
    for (x0, y0), (x1, y1) in zip(path[:-1], path[1:]):
        if abs(x1 - turn) > 180.0:
            side = 180.0 if x1 > turn else -180.0
            at = y0 + (y1 - y0) * (side + turn - x0) / (x1 - x0)
            parts[-1].append([side, at])
            parts.append([[-side, at]])
            turn += 2.0 * side
        parts[-1].append([x1 - turn, y1])
    return parts


def line_outline(path: np.ndarray, sizes: np.ndarray, id: int = 0) -> np.ndarray:
    """The polygon of an arrow along a line in 2D; sizes: width, tail width, head length, width.
    That of a placed arrow, which has an id, is without kinks."""
    points = np.zeros((len(path), 3))
    points[:, :2] = path
    sizes = np.ascontiguousarray(sizes, np.float64)
    vertices, count = ffi.new("double **"), ffi.new("int *")
    status = lib.line_outline(vertices, count, ffi.from_buffer("double[]", points), len(path),
                              ffi.from_buffer("double[]", sizes), int(id))
    if status == lib.FG_STATUS_MEMORY:
        raise MemoryError("no memory for an arrow's outline")
    if status != lib.FG_STATUS_OK:  # of no length or width
        return np.zeros((0, 2))
    polygon = copy(vertices[0], (count[0], 2), np.float64)
    lib.free(vertices[0])
    return polygon


def _line_solid(path: np.ndarray, sizes: np.ndarray) -> Surface:
    context = Context()
    out = ffi.new("fg_surface **")
    points = np.ascontiguousarray(path, np.float64)
    context.call(lib.line_solid, out, context.handle, ffi.from_buffer("double[]", points),
                 len(path), ffi.from_buffer("double[]", np.ascontiguousarray(sizes)))
    surface = ffi.gc(out[0], lib.fg_surface_destroy)
    if surface.triangle_count == 0:
        nothing = np.zeros((0, 3))
        return Surface(nothing, np.zeros(0, np.int32), nothing, np.zeros((0, 3), np.int32))
    corners = surface.corner_count
    return Surface(
        copy(lib.surface_vertex(surface), (surface.vertex_count, 3), np.float64),
        copy(surface.corner, (corners,), np.int32),
        copy(lib.surface_normal(surface), (corners, 3), np.float32),
        copy(lib.surface_triangle(surface), (surface.triangle_count, 3), np.int32))


def _choice(name: str, value: str, words: tuple[str, ...]) -> int:
    if value not in words:
        raise ValueError(f"{name} is {value!r}, not one of {', '.join(words)}")
    return words.index(value)


def _whole(name: str, value: Any, least: int = 1, most: int = 2**31 - 1) -> int:
    try:
        whole = int(value)
    except (TypeError, ValueError, OverflowError):
        whole = least - 1
    if whole != value or not least <= whole <= most:
        raise ValueError(f"{name} is {value!r}; a whole number from {least} to {most} is needed")
    return whole


def _share(name: str, value: float | None) -> float:
    if value is None:
        return 0.0
    return _positive(name, value, "a number between 0 and 1")


def _positive(name: str, value: Any, wanted: str) -> float:
    try:
        number = float(value)
    except (TypeError, ValueError):
        number = 0.0
    if not 0.0 < number < float("inf"):
        raise ValueError(f"{name} is {value!r}; {wanted} is needed")
    return number


class _Run:
    """A run of scales, and all that must outlive it."""

    def __init__(self, grid: Grid, numbers: Sequence[int] | None, *, kind: str, seed: int,
                 anisotropy: float | None, coverage: float | None, nodes: int | None, start: str,
                 lengths: str, effort: str, threads: int | None) -> None:
        options = ffi.new("fg_run_options *")
        options.kind = _choice("kind", kind, SETS)
        wanted = [_whole("n", n) for n in numbers or ()]
        given = ffi.new("int[]", wanted)
        options.numbers, options.count = given, len(wanted)
        options.even_start = bool(_choice("start", start, STARTS))
        options.evolution.seed = _whole("seed", seed, most=2**64 - 1)
        options.evolution.anisotropy = _share("anisotropy", anisotropy)
        options.evolution.coverage = _share("coverage", coverage)
        options.evolution.nodes = 0 if nodes is None else _whole("nodes", nodes, 2)
        options.evolution.threads = 0 if threads is None else _whole("threads", threads)
        options.placement = _placement(lengths, effort)[0]
        self.grid, self.context = grid, Context()
        self.field = grid.create_field(self.context)
        self.run = self.context.create("fg_run", lib.fg_run_destroy, lib.fg_run_create,
                                       self.context.handle, self.field, options)

    def next(self, previous: Arrows | None = None) -> Arrows | None:
        out = ffi.new("const fg_run_scale **")
        self.context.call(lib.fg_run_next, out, self.run)
        if not out[0]:
            return None
        scale = out[0]
        if previous is not None and scale.finer:
            previous.parent[:] = [i.parent for i in _icons(scale.finer)]
        return _make_arrows(self, self.field, scale.icons, scale.density,
                            time=scale.step.time, step=scale.step.step)


def _placement(lengths: str, effort: str) -> Any:
    options = ffi.new("fg_placement_options *")
    options.lengths = _choice("lengths", lengths, LENGTHS)
    options.effort = _choice("effort", effort, EFFORTS)
    return options


def _icons(icons: Any) -> list[Any]:
    return [lib.fg_icons_at(icons, n) for n in range(lib.fg_icons_count(icons))]


def _make_arrows(owner: Any, field: Any, icons: Any, density: Any, time: float = 0.0,
                 step: int = 0) -> Arrows:
    """owner: has `grid` and `context`, and keeps what is borrowed alive."""
    speeds = ffi.new("double[2]")
    lib.fg_icons_speed_range(speeds, icons)
    every = _icons(icons)
    counts = Counts(len(every), lib.fg_icons_clusters(icons), lib.fg_icons_dropped(icons))
    u = nodes = None
    places: tuple[Sequence[float], ...] = ()
    dimension = owner.grid.dimension
    if density:
        arrays = lib.fg_density_contents(density)
        shape = tuple(arrays.nodes[k] for k in reversed(range(dimension)))
        u = copy(arrays.u, shape, np.float32)
        nodes = copy(lib.fg_density_labels(density), shape, np.int32)
        places = tuple(list(a)[:dimension]
                       for a in (arrays.origin, arrays.spacing, arrays.periodic))
    scale = _Scale(owner.grid, counts, (speeds[0], speeds[1]), u, nodes, places, time, step)
    return Arrows(every, scale, _Measured(owner, field, icons))


class _Measured:
    """The readers' error of icons, once; afterwards nothing of the library is kept."""

    def __init__(self, owner: Any, field: Any, icons: Any) -> None:
        self.source: Any = (owner, field, icons)
        self.mean = float("nan")

    def __call__(self) -> float:
        source = self.source
        if source is not None:
            _, field, icons = source
            context = Context()
            score = ffi.new("fg_score *")
            options = ffi.new("fg_score_options *")
            options.lengths, options.readers_only = lib.FG_SCORE_FREE, True
            context.call(lib.fg_icons_score, score, context.handle, field, icons, options)
            self.mean, self.source = score.mean, None
        return self.mean

    def __getstate__(self) -> dict[str, Any]:
        return {"source": None, "mean": self()}


class _Within:
    """Arrows within a tolerance, and all that must outlive them."""

    def __init__(self, grid: Grid, degrees: float, lengths: str, effort: str) -> None:
        self.grid, self.context = grid, Context()
        handle = self.context.handle
        self.field = grid.create_field(self.context)
        placement = self.context.create(
            "fg_placement", lib.fg_placement_destroy, lib.fg_placement_create, handle, self.field,
            _placement(lengths, effort))
        self.context.call(lib.fg_placement_within, placement, float(degrees), MOST_WITHIN,
                          ffi.new("int *"))
        self.icons = self.context.create("fg_icons", lib.fg_icons_destroy, lib.fg_placement_icons,
                                         placement)
        density = None
        if grid.dimension == 2:
            density = self.context.create("fg_density", lib.fg_density_destroy,
                                          lib.fg_placement_regions, placement)
            self.context.call(lib.fg_placement_find_clusters, handle, self.icons, density)
        self.arrows = _make_arrows(self, self.field, self.icons, density)


def place(grid: Grid, count: int, effort: str = "normal", start: Any = None) -> tuple[Arrows, Any]:
    """Arrows from an even start, or from the icons that an earlier call has returned with its."""
    source = _Placed(grid, count, effort, start)
    return source.arrows, source.icons


class _Placed:
    """Arrows placed without an evolution, and all that must outlive them."""

    def __init__(self, grid: Grid, count: int, effort: str, start: Any) -> None:
        self.grid, self.context = grid, Context()
        self.field = grid.create_field(self.context)
        placement = self.context.create(
            "fg_placement", lib.fg_placement_destroy, lib.fg_placement_create, self.context.handle,
            self.field, _placement("free", effort))
        self.context.call(lib.fg_placement_place, placement, count, start or ffi.NULL)
        self.icons = self.context.create("fg_icons", lib.fg_icons_destroy, lib.fg_placement_icons,
                                         placement)
        self.arrows = _make_arrows(self, self.field, self.icons, None)


def arrows(
    *args: Any, x: Any = None, y: Any = None, z: Any = None, u: Any = None, v: Any = None,
    w: Any = None, n: int = 40, mask: Any = None, period: Any = None,
    tolerance: float | None = None, seed: int = 1, scale: str = "plain", kind: str = "arrows",
    start: str = "clusters", anisotropy: float | None = None, coverage: float | None = None,
    nodes: int | None = None, lengths: str = "free", effort: str = "normal",
    threads: int | None = None,
) -> Arrows:
    """Shows a vector field by few curved arrows: ``arrows([x, y], u, v)``, as `quiver`, or by name.

    The arrows are those of the program: ``flowgrain run FILE --arrows N``.

    The order of the first release, ``arrows(u, v, x, y)``, is still taken, with a FutureWarning,
    where x and y are axes, or a mesh grid while u and v are none. Where both pairs may be either,
    as those of a saddle, they are x, y, u, v, and a UserWarning says so; names leave no doubt.

    Parameters
    ----------
    u, v : array_like, (ny, nx); with `w` (nz, ny, nx); or (n,) of scattered points
        Components of the velocity along x and y, numbers of any type. Masked and NaN samples are
        missing: no arrow goes there. Between points, as stations, the field is interpolated as the
        program does it of a table's: in triangles, in 3D by local fits, and not over gaps.
    x, y : array_like, (nx,) and (ny,), or both of the shape of u; optional
        Coordinates, ascending or descending, evenly spaced or not; by default 0, 1, ... Those of a
        curvilinear grid have the shape of u; the field is then interpolated onto an even raster,
        linearly in triangles, as fine as the samples but with 769 nodes along a side at most.
    w, z : array_like, optional
        Third component and coordinate of a field in 3D.
    n : int
        How many arrows: exactly so many, or with ``kind="clusters"`` at most.
    mask : array_like of bool, of the shape of u, optional
        True where a sample is missing, as in `numpy.ma`.
    period : float or sequence of float or None, optional
        Length after which x, or x and y (and z), repeat: 360 for longitudes round the globe.
    tolerance : float, optional
        Degrees. In place of `n`: the fewest arrows, 1000 at most, whose `Arrows.error` is at most
        so much.
    seed : int
        Of the noise that the clusters grow from, 1 or more.
    scale : {"plain", "geo"}
        "geo": x and y are longitude and latitude in degrees, u and v are along east and north.
    kind : {"arrows", "clusters"}
        "clusters": one arrow in each cluster of an evolution that has come to n clusters.
    start : {"clusters", "even"}
        What the search for the best places starts from.
    anisotropy, coverage : float, optional
        Of the clusters: how much cheaper interfaces are along the flow, 0.15; the share of the area
        that clusters cover, 0.3.
    nodes : int, optional
        Of the clusters' mesh along its longest side; by default what `n` needs.
    lengths : {"free", "fair"}
        "fair": all arrows have about the same length.
    effort : {"normal", "quick", "thorough"}
        Of the search.
    threads : int, optional
        At most so many; the result does not depend on it.

    Returns
    -------
    Arrows

    Raises
    ------
    ValueError
        Shapes that do not fit, a field that is zero or missing everywhere, more arrows than there
        is room for, numbers out of range.
    MemoryError

    Examples
    --------
    >>> import numpy as np, flowgrain
    >>> y, x = np.mgrid[0:6:61j, 0:8:81j]
    >>> few = flowgrain.arrows(x, y, -np.cos(x) * np.sin(y), np.sin(x) * np.cos(y), n=12)
    >>> len(few), few.paths[0].shape[1]
    (12, 2)
    """
    grid = _grid_of(args, [u, v, w], [x, y, z], mask, period, scale)
    if tolerance is not None:
        degrees = _positive("tolerance", tolerance, "a number of degrees above 0")
        return _Within(grid, degrees, lengths, effort).arrows
    run = _Run(grid, [n], kind=kind, seed=seed, anisotropy=anisotropy, coverage=coverage,
               nodes=nodes, start=start, lengths=lengths, effort=effort, threads=threads)
    found = run.next()
    if found is None:
        raise ValueError(f"the evolution ended without a scale of {n} {kind}")
    return found


def evolve(
    *args: Any, x: Any = None, y: Any = None, z: Any = None, u: Any = None, v: Any = None,
    w: Any = None, n: Sequence[int] | None = None, mask: Any = None, period: Any = None,
    seed: int = 1, scale: str = "plain", kind: str = "arrows", start: str = "clusters",
    anisotropy: float | None = None, coverage: float | None = None, nodes: int | None = None,
    lengths: str = "free", effort: str = "normal", threads: int | None = None,
) -> Iterator[Arrows]:
    """Iterates over scales, from many arrows to few: ``evolve([x, y], u, v)``, as `arrows`.

    An arrow keeps its `Arrows.id` from scale to scale. `Arrows.parent` tells which arrow of the
    next scale it goes into; it is known once that scale has been asked for.

    Parameters
    ----------
    n : sequence of int, descending, optional
        How many arrows each scale has; by default 200, 100, 50, 25, 12, in 3D 60, 25, 12. With
        ``kind="clusters"`` how many clusters at most; by default as many as can first be counted,
        halved until 12.
    u, v, x, y, w, z, mask, period, seed, scale, kind, start, anisotropy, coverage, nodes, \
lengths, effort, threads
        As for `arrows`.

    Yields
    ------
    Arrows

    Raises
    ------
    ValueError, MemoryError
        As `arrows`.
    """
    grid = _grid_of(args, [u, v, w], [x, y, z], mask, period, scale)
    run = _Run(grid, None if n is None else list(n), kind=kind, seed=seed, anisotropy=anisotropy,
               coverage=coverage, nodes=nodes, start=start, lengths=lengths, effort=effort,
               threads=threads)
    return _scales(run)


def _scales(run: _Run) -> Iterator[Arrows]:
    found = run.next()
    while found is not None:
        yield found
        found.error  # its icons are the run's, until the next
        found = run.next(found)


def _grid_of(args: tuple[Any, ...], velocity: list[Any], places: list[Any], mask: Any,
             period: Any, scale: str) -> Grid:
    lacking = [pair for pair in (places, velocity) if pair[0] is None and pair[1] is None]
    if len(args) == 4 and len(lacking) == 2:
        args = _in_order(args)
        places[:2], velocity[:2] = args[:2], args[2:]
    elif len(args) == 2 and lacking:
        lacking[-1][:2] = args
    elif args:
        raise TypeError("([x, y], u, v) are needed, in this order or by their names")
    if velocity[0] is None or velocity[1] is None:
        raise TypeError("both u and v are needed")
    if velocity[2] is None and places[2] is not None:
        raise ValueError("z is given without w")
    dimension = 2 if velocity[2] is None else 3
    return make_grid(velocity[:dimension], places[:dimension], mask, period, scale)


def _in_order(args: tuple[Any, ...]) -> tuple[Any, ...]:
    """x, y, u, v, which may be given as u, v, x, y."""
    one, other = (min(np.ma.asanyarray(a).ndim for a in pair) for pair in (args[:2], args[2:]))
    if one == other > 1:
        one, other = mesh_rank(*args[2:]), mesh_rank(*args[:2])
        if one == other > 0 and not all(map(np.array_equal, args[:2], args[2:])):
            warnings.warn("both pairs of arrays may be coordinates: taken as x, y, u, v; "
                          "arrows(x=..., y=..., u=..., v=...) leaves no doubt", stacklevel=4)
    if one <= other:
        return args
    warnings.warn("taken as u, v, x, y: give x and y first, arrows(x, y, u, v), as in quiver, or "
                  "all four by name; this order will be refused", FutureWarning, stacklevel=4)
    return args[2:] + args[:2]
