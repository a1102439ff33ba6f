"""``Dataset.flowgrain`` of xarray: finds components and coordinates as the program does."""

from __future__ import annotations

import difflib
from typing import Any, NamedTuple

import numpy as np
import xarray as xr

from ._arrows import Arrows, _choice, arrows
from ._dataset import eastward, find_coordinates, find_pair, role_of
from ._model import FRAMES, centred, frame_of, positions, turned
from ._grid import in_one_piece, ordered
from ._plane import period_of


class _Field(NamedTuple):
    u: Any  # with the dimensions of y and x last
    v: Any
    x: Any
    y: Any
    degrees: bool  # x and y are longitude and latitude
    others: list[Any]  # other dimensions


@xr.register_dataset_accessor("flowgrain")
class DatasetFlowgrain:
    """Arrows of a dataset's velocity.

    The components are found by CF's standard names ("eastward_wind", "sea_water_x_velocity"), else
    by their names ("u10" and "v10", "vozocrtx" and "vomecrty"); the coordinates by standard_name,
    axis, units or name.
    """

    def __init__(self, dataset: xr.Dataset) -> None:
        self._dataset = dataset

    def _field(self, u: Any, v: Any, x: Any, y: Any, frame: str) -> _Field:
        if (u is None) != (v is None):
            raise ValueError("both u and v are needed, or none")
        if u is None:
            u, v = find_pair(self._dataset)
        self._check_names(u=u, v=v, x=x, y=y)
        _choice("frame", frame, FRAMES)
        first, second, staggered = centred(self._dataset, self._dataset[u], self._dataset[v])
        if (x is None) != (y is None):
            raise ValueError("both x and y are needed, or none")
        if x is None:
            px, py, degrees = find_coordinates(first)
        else:
            px, py = self._dataset[x], self._dataset[y]
            degrees = role_of(px) == "lon" and role_of(py) == "lat"
        px, py = eastward(px), eastward(py)
        plane = [*py.dims, *(d for d in px.dims if d not in py.dims)]
        if len(plane) != 2 or not set(plane) <= set(first.dims):
            raise ValueError(f"{px.name} and {py.name} have the dimensions {', '.join(plane)}; "
                             f"two of {u}'s, {', '.join(map(str, first.dims))}, are needed")
        for axis in (px, py):
            if axis.ndim == 1 and axis.dtype.kind in "iuf":
                ordered(str(axis.name), axis.values)  # refuses by its name
        if degrees:
            px = px.copy(data=in_one_piece(px.values))
        others = [d for d in first.dims if d not in plane]
        if px.ndim == 2:
            px, py = px.transpose(*plane), py.transpose(*plane)
        first, second = (c.transpose(*others, *plane) for c in (first, second))
        if frame == "auto":
            frame = frame_of(self._dataset, first, second, staggered) or frame
        first, second = self._in_frame(first, second, px, py, degrees, frame)
        return _Field(first, second, px, py, degrees, others)

    def _check_names(self, **given: Any) -> None:
        for role, name in given.items():
            try:
                if name is not None:
                    self._dataset[name]
            except KeyError:
                fewest = 2 if role in "uv" else 1  # dimensions
                known = [str(k) for k, v in self._dataset.variables.items() if v.ndim >= fewest]
                near = difflib.get_close_matches(str(name), known, len(known) or 1, 0.0)
                raise ValueError(f"{role} is {name!r}, which is none of the variables that may be "
                                 f"it: {', '.join(near) or 'there is none'}") from None

    def _in_frame(self, u: Any, v: Any, px: Any, py: Any, degrees: bool,
                  frame: str) -> tuple[Any, Any]:
        """Components along east and north on longitudes and latitudes, else along the axes."""
        if degrees and px.ndim == 2:
            if frame == "auto":
                raise ValueError(
                    f"{u.name} and {v.name} may be along east and north or along the lines of "
                    "their curvilinear grid: frame='east' or frame='grid' says it")
            if frame == "grid":
                east, north = turned(u.values, v.values, px.values, py.values)
                return u.copy(data=east), v.copy(data=north)
        elif not degrees and frame == "east":
            places = positions(self._dataset, u.dims[-2:])
            if places is not None:
                one, other = turned(u.values, v.values, places[0], places[1], back=True)
                return u.copy(data=one), v.copy(data=other)
        return u, v

    def arrows(self, u: str | None = None, v: str | None = None, *, x: str | None = None,
               y: str | None = None, frame: str = "auto",
               **options: Any) -> "Arrows | xr.DataArray":
        """Arrows of the velocity.

        Parameters
        ----------
        u, v, x, y : str, optional
            Variables of the components and coordinates; found by default. Components on the faces
            of cells (Arakawa's C grid) become means at the cells' centres.
        frame : {"auto", "east", "grid"}
            Whether the components are along east and north or along the lines of the grid. Those
            of a curvilinear grid in longitude and latitude that are along the grid are turned by
            the direction that its positions give. By default standard names and names tell.
        **options
            As of `flowgrain.arrows`. On longitudes and latitudes ``scale`` is "geo", and
            ``period`` is 360 where they go round the globe.

        Returns
        -------
        Arrows or DataArray
            Where there are other dimensions, such as time, an array of `Arrows` with these
            dimensions and their coordinates.

        Raises
        ------
        ValueError
            No velocity is found, or not how its components lie; the dataset has no variable of a
            name; and as `flowgrain.arrows`.
        """
        first, second, px, py, degrees, others = self._field(u, v, x, y, frame)
        if degrees:
            options.setdefault("scale", "geo")
            if px.ndim == 1:
                options.setdefault("period", period_of(px.values, 360.0))
        found = np.empty([first.sizes[d] for d in others], object)
        for index in np.ndindex(*found.shape):
            found[index] = arrows(px.values, py.values, u=first[index].values,
                                  v=second[index].values, **options)
        if found.size == 1:
            return found.reshape(-1)[0]
        kept = {k: c for k, c in first.coords.items() if set(c.dims) <= set(others)}
        return xr.DataArray(found, kept, others, name="arrows")

    def quiver(self, ax: Any = None, u: str | None = None, v: str | None = None, *,
               x: str | None = None, y: str | None = None, frame: str = "auto",
               **options: Any) -> Any:
        """Draws the velocity as few curved arrows.

        Parameters
        ----------
        ax : matplotlib.axes.Axes, optional
            By default the current ones. On maps of cartopy longitudes and latitudes need no
            ``transform``. Axes without labels get those of the coordinates.
        u, v, x, y, frame : str, optional
            As for `arrows`.
        **options
            As of `flowgrain.quiver`.

        Returns
        -------
        Quiver

        Raises
        ------
        ValueError
            There are other dimensions, of which one place is to be chosen: ``ds.isel(time=0)``;
            and as `flowgrain.quiver`.
        """
        import matplotlib.pyplot as plt

        from ._quiver import quiver

        first, second, px, py, degrees, others = self._field(u, v, x, y, frame)
        for dimension in others:
            if first.sizes[dimension] > 1:
                raise ValueError(f"{first.name} has {first.sizes[dimension]} places along "
                                 f"{dimension}; choose one: ds.isel({dimension}=0)")
        first, second = first.squeeze(others), second.squeeze(others)
        ax = plt.gca() if ax is None else ax
        if degrees and hasattr(ax, "projection") and "transform" not in options:
            import cartopy.crs as ccrs

            options["transform"] = ccrs.PlateCarree()
        artist = quiver(ax, px.values, py.values, first.values, second.values, **options)
        if not hasattr(ax, "projection"):
            for label, put, coordinate in ((ax.get_xlabel(), ax.set_xlabel, px),
                                           (ax.get_ylabel(), ax.set_ylabel, py)):
                if not label:
                    put(_label(coordinate))
        return artist


def _label(variable: Any) -> str:
    name = variable.attrs.get("long_name") or variable.attrs.get("standard_name") or variable.name
    units = variable.attrs.get("units")
    return f"{name} [{units}]" if units else str(name)
