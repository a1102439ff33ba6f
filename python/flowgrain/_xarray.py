"""``Dataset.flowgrain`` of xarray: finds components and coordinates as the program does."""

from __future__ import annotations

import difflib
from typing import Any, NamedTuple

import numpy as np
import xarray as xr

from ._arrows import Arrows, _choice, arrows
from ._dataset import FRAMES, eastward, meaning
from ._model import centred, turned
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
        if (x is None) != (y is None):
            raise ValueError("both x and y are needed, or none")
        self._check_names(u=u, v=v, x=x, y=y)
        _choice("frame", frame, tuple(FRAMES))
        data = self._dataset if x is None else self._only(x, y)
        found = meaning(data, u, v, frame)
        first, second = centred(data, found)
        px, py = (first[first.dims[-1 - k]] if name is None else self._dataset[name]
                  for k, name in enumerate(found.coordinates if x is None else (x, y)))
        px, py = _of_all_times(px), _of_all_times(py)
        degrees = found.is_geographic and x in (None, found.coordinates[0])
        for variable in (*(data[k] for k in found.components), px, py):
            _check_unpacked(variable)
        px, py = eastward(px, degrees), eastward(py, degrees)
        plane = [*py.dims, *(d for d in px.dims if d not in py.dims)]
        if len(plane) != 2 or not set(plane) <= set(first.dims):
            raise ValueError(f"{px.name} and {py.name} have the dimensions {', '.join(plane)}; "
                             f"two of {first.name}'s, {', '.join(map(str, first.dims))}, are "
                             "needed")
        for axis in (px, py):
            if axis.ndim == 1 and axis.dtype.kind in "iuf":
                ordered(str(axis.name), axis.values)  # refuses by its name
        if degrees:
            px = px.copy(data=in_one_piece(px.values))
        others = [d for d in first.dims if d not in plane]
        if px.ndim == 2:
            px, py = px.transpose(*plane), py.transpose(*plane)
        first, second = (c.transpose(*others, *plane) for c in (first, second))
        if degrees and found.is_along_grid and px.ndim == 2:
            east, north = turned(first.values, second.values, px.values, py.values)
            first, second = first.copy(data=east), second.copy(data=north)
        elif x is not None and not degrees and frame == "east":
            places = meaning(self._dataset, u, v, frame)
            at = [self._dataset[k] for k in places.coordinates if k is not None]
            if places.is_geographic and [set(c.dims) for c in at] == 2 * [set(plane)]:
                lon, lat = (eastward(c, True).transpose(*plane).values for c in at)
                east, north = turned(first.values, second.values, lon, lat, back=True)
                first, second = first.copy(data=east), second.copy(data=north)
        return _Field(first, second, px, py, degrees, others)

    def _only(self, x: Any, y: Any) -> xr.Dataset:
        """Without other coordinates at the same places."""
        places = {*self._dataset[x].dims, *self._dataset[y].dims}
        others = [k for k, c in self._dataset.coords.items()
                  if c.dims and set(c.dims) <= places and k not in (x, y)]
        return self._dataset.drop_vars(others)

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


def _of_all_times(position: Any) -> Any:
    """Positions in a plane that are the same for each time, as WRF has them."""
    for dimension in position.dims[:-2]:
        first = position.isel({dimension: 0}, drop=True)
        if position.sizes[dimension] == 1 or bool((position == first).all()):
            position = first
    return position


def _check_unpacked(variable: Any) -> None:
    """xarray takes the attributes of what it has unpacked away."""
    for key in ("scale_factor", "add_offset", "_FillValue", "missing_value", "_Unsigned"):
        if variable.dtype.kind in "iu" and key in variable.attrs:
            raise ValueError(f"{variable.name} has whole numbers and the attribute {key}: "
                             "xr.decode_cf(ds) unpacks them")


def _label(variable: Any) -> str:
    name = variable.attrs.get("long_name") or variable.attrs.get("standard_name") or variable.name
    units = variable.attrs.get("units")
    return f"{name} [{units}]" if units else str(name)
