"""Components on the faces of cells, and along a grid's lines, as those that are drawn.

What they are the library says (`_dataset`).
"""

from __future__ import annotations

from typing import Any, Hashable

import numpy as np
import xarray as xr

from ._dataset import Meaning
from ._grid import on_sphere


def centred(dataset: xr.Dataset, found: Meaning) -> tuple[Any, Any]:
    """Components on the same points, without what a mask leaves out.

    Of Arakawa's C grid these are the means of two faces; a face without a value beside one that has
    one is a wall.
    """
    u, v = (dataset[name] for name in found.components)
    if set(u.dims) != set(v.dims):
        if u.ndim != v.ndim or set(u.dims[:-2]) != set(v.dims[:-2]):
            raise ValueError(f"{u.name} has the dimensions {dict(u.sizes)}, {v.name} "
                             f"{dict(v.sizes)}; transpose them so that y and x are the last")
        v = v.transpose(*u.dims[:-2], *v.dims[-2:])
    else:
        v = v.transpose(*u.dims)
    faces, centres = (u.dims[-1], v.dims[-2]), (v.dims[-1], u.dims[-2])
    dims = (*u.dims[:-2], centres[1], centres[0])
    one, other = (_mean(dataset, component, face, centre, side, dims) if side else component
                  for component, face, centre, side in zip((u, v), faces, centres, found.sides))
    if found.mask is not None:
        sea = dataset[found.mask].fillna(0) != 0
        one, other = (c.where(sea).transpose(*c.dims, ...) for c in (one, other))
    return one, other


def _mean(dataset: xr.Dataset, component: Any, face: Hashable, centre: Hashable, side: int,
          dims: tuple[Hashable, ...]) -> Any:
    """side: -1, face n lies before centre n; 1, behind it."""
    along = component.dims.index(face)
    values = np.moveaxis(np.asarray(component.values, np.float64), along, -1)
    count, faces = dataset.sizes[centre], values.shape[-1]
    left = np.arange(count) - (1 if side > 0 else 0)
    inside = (left >= 0) & (left + 1 < faces)  # else there is no second face
    one, other = (values[..., np.clip(n, 0, faces - 1)] for n in (left, left + 1))
    flow = 0.5 * (np.nan_to_num(one) + np.nan_to_num(other))
    mean = np.where(inside & (np.isfinite(one) | np.isfinite(other)), flow, np.nan)
    new = [centre if d == face else d for d in component.dims]
    coordinates = {k: c for k, c in dataset.coords.items() if set(c.dims) <= set(new)}
    return xr.DataArray(np.moveaxis(mean, -1, along), coordinates, new, str(component.name),
                        component.attrs).transpose(*dims)


def turned(u: np.ndarray, v: np.ndarray, longitude: np.ndarray, latitude: np.ndarray,
           back: bool = False) -> tuple[np.ndarray, np.ndarray]:
    """Components along the grid as those along east and north; `back`: the other way. The grid's
    direction is that of its positions."""
    lon, lat = np.radians(longitude), np.radians(latitude)
    way = np.gradient(on_sphere(longitude, latitude), axis=-1)
    east = way[1] * np.cos(lon) - way[0] * np.sin(lon)
    north = way[2] * np.cos(lat) - np.sin(lat) * (way[0] * np.cos(lon) + way[1] * np.sin(lon))
    size = np.hypot(east, north)
    with np.errstate(all="ignore"):
        cosine, sine = east / size, north / size
    if back:
        sine = -sine
    return u * cosine - v * sine, u * sine + v * cosine
