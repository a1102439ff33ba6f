"""Where coordinates lie in the axes, and which way vectors point there.

Places are shares of the axes' box, (0, 0) to (1, 1): the same bits at any resolution.
"""

from __future__ import annotations

from typing import Any

import numpy as np

from ._grid import on_sphere


class TransformPlane:
    """Coordinates of matplotlib's axes, or of a transform of its."""

    fills_outline = False

    def __init__(self, ax: Any, transform: Any) -> None:
        self._ax, self._transform = ax, transform

    @property
    def _to_axes(self) -> Any:
        given = self._ax.transData if self._transform is None else self._transform
        return given - self._ax.transAxes

    @property
    def is_data(self) -> bool:
        """Whether the coordinates are the axes' own."""
        return self._transform is None

    @property
    def has_data_limits(self) -> bool:
        return self._transform is None or self._transform.contains_branch(self._ax.transData)

    @property
    def circle(self) -> float:
        """After which x is the same place again; 0: never."""
        return 2.0 * np.pi if self._ax.name == "polar" else 0.0

    def forward(self, x: np.ndarray, y: np.ndarray) -> np.ndarray:
        """Places, (n, 2); NaN where there are none."""
        with np.errstate(all="ignore"):
            places = self._to_axes.transform(np.stack([x, y], 1))
        return _finite(np.ma.filled(places, np.nan))

    def inverse(self, places: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        with np.errstate(all="ignore"):
            x, y = np.ma.filled(self._to_axes.inverted().transform(places), np.nan).T
        return x, y

    def space(self, x: np.ndarray, y: np.ndarray, page: np.ndarray) -> Any:
        """Coordinates in which neighbours are close to each other: those on the page."""
        return np.moveaxis(page, -1, 0)

    def turn(self, x: np.ndarray, y: np.ndarray, u: np.ndarray, v: np.ndarray,
             page: np.ndarray) -> list[np.ndarray]:
        """Vectors on the page, of which the axes fill so much, that have the direction in which
        the flow goes there, and the length that they have."""
        near = [np.hypot(*np.gradient(a)) for a in (x, y)]
        with np.errstate(all="ignore"):
            step = 0.01 / np.fmax(np.abs(u) / near[0], np.abs(v) / near[1])
            dx, dy = step * u, step * v
        return _turned(self, x, y, u, v, dx, dy, page)


class CrsPlane:
    """Coordinates of a map projection, or longitude and latitude, on cartopy's GeoAxes."""

    fills_outline = True
    has_data_limits = True
    is_data = False

    def __init__(self, ax: Any, crs: Any) -> None:
        import cartopy.crs as ccrs

        self._ax, self._crs = ax, crs
        degrees = (ccrs.PlateCarree, ccrs.Geodetic, ccrs.RotatedPole, ccrs.RotatedGeodetic)
        self.is_geographic = isinstance(crs, degrees)

    @property
    def _to_axes(self) -> Any:
        return self._ax.transData - self._ax.transAxes

    @property
    def circle(self) -> float:
        return 360.0 if self.is_geographic else 0.0

    def forward(self, x: np.ndarray, y: np.ndarray) -> np.ndarray:
        plane = self._ax.projection.transform_points(self._crs, np.asarray(x), np.asarray(y))
        return _finite(self._to_axes.transform(_finite(plane[:, :2])))

    def inverse(self, places: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        plane = self._to_axes.inverted().transform(places)
        with np.errstate(all="ignore"):
            back = self._crs.transform_points(self._ax.projection, plane[:, 0], plane[:, 1])
        x, y = _finite(back[:, :2]).T
        # beyond the outline of a map PROJ finds places that lie elsewhere on it
        again = self.forward(x, y)
        off = ~(np.hypot(*(again - places).T) < 0.002)
        return np.where(off, np.nan, x), np.where(off, np.nan, y)

    def outline(self) -> np.ndarray:
        """Corners of the map's own extent."""
        (left, right), (low, high) = self._ax.projection.x_limits, self._ax.projection.y_limits
        return self._to_axes.transform([(left, low), (right, high)])

    def space(self, x: np.ndarray, y: np.ndarray, page: np.ndarray) -> Any:
        """As that of TransformPlane: those on the sphere, or of the CRS."""
        return on_sphere(x, y) if self.is_geographic else [x, y]

    def turn(self, x: np.ndarray, y: np.ndarray, u: np.ndarray, v: np.ndarray,
             page: np.ndarray) -> list[np.ndarray]:
        """As that of TransformPlane; u and v are along east and north, or along the CRS's axes."""
        with np.errstate(all="ignore"):
            if self.is_geographic:
                along = u / np.maximum(np.cos(np.radians(y)), 1e-6)
                step = 1e-4 / np.hypot(along, v)
            else:
                along = u
                step = 1.0 / np.hypot(u, v)  # a metre
            dx, dy = step * along, step * v
        return _turned(self, x, y, u, v, dx, dy, page)


def _turned(plane: Any, x: np.ndarray, y: np.ndarray, u: np.ndarray, v: np.ndarray,
            dx: np.ndarray, dy: np.ndarray, page: np.ndarray) -> list[np.ndarray]:
    """Lengths of (u, v) in the direction in which a small step goes on the page; at a map's edge
    and cut the step back counts, or the smaller of both."""
    flat = [np.nan_to_num(a).ravel() for a in (x, y, dx, dy)]
    here = plane.forward(flat[0], flat[1])
    ahead = (plane.forward(flat[0] + flat[2], flat[1] + flat[3]) - here) * page
    back = (here - plane.forward(flat[0] - flat[2], flat[1] - flat[3])) * page
    lengths = [np.where(np.isfinite(d).all(1), np.hypot(*d.T), np.inf) for d in (ahead, back)]
    with np.errstate(all="ignore"):
        way = np.where((lengths[0] > 4.0 * lengths[1])[:, None], back, ahead)
        way = np.where((lengths[1] > 4.0 * lengths[0])[:, None], ahead, way)
        speed = np.hypot(u, v).ravel()
        turned = np.where(speed[:, None] == 0.0, 0.0, way * (speed / np.hypot(*way.T))[:, None])
    known = np.isfinite(x) & np.isfinite(y)
    return [np.where(known, turned[:, k].reshape(x.shape), np.nan) for k in range(2)]


def _finite(places: np.ndarray) -> np.ndarray:
    return np.where(np.isfinite(places).all(-1, keepdims=True), places, np.nan)


def period_of(x: np.ndarray, circle: float) -> float | None:
    """The circle where an axis, in any order, goes once round it."""
    x = np.unique(x)
    way = x[-1] - x[0]
    step = way / max(len(x) - 1, 1)
    closes = abs(way + step - circle) < 0.01 * step or abs(way - circle) < 0.01 * step
    return circle if circle and closes else None
