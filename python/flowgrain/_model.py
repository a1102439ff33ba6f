"""Grids of ocean and weather models: components on the faces of cells, and along the grid's lines.

The rules are the program's, docs/method/model-grids.md, of a dataset of xarray.
"""

from __future__ import annotations

from typing import Any, Hashable

import numpy as np
import xarray as xr

from ._dataset import ANGLES, MASKS, check_units, eastward, frame_by_terms, role_of
from ._grid import on_sphere

FRAMES = ("auto", "east", "grid")
# on which side of a centre the face of the same index lies
SIDES = {"xq": 1, "yq": 1, "xi_u": 1, "eta_v": 1, "i_g": -1, "j_g": -1, "XG": -1, "YG": -1,
         "XU": -1, "YV": -1}  # fmt: skip


def centred(dataset: xr.Dataset, u: Any, v: Any) -> tuple[Any, Any, bool]:
    """Components on the same points, and whether they were on the faces of cells.

    Of Arakawa's C grid these are the means of two faces; a face without a value beside one that has
    one is a wall.
    """
    check_units(u, v)
    if set(u.dims) == set(v.dims):
        return u, v.transpose(*u.dims), False
    if u.ndim < 2 or v.ndim != u.ndim or set(u.dims[:-2]) != set(v.dims[:-2]):
        raise ValueError(f"{u.name} has the dimensions {dict(u.sizes)}, {v.name} {dict(v.sizes)}")
    v = v.transpose(*u.dims[:-2], *v.dims[-2:])
    faces, centres = (u.dims[-1], v.dims[-2]), (v.dims[-1], u.dims[-2])
    for face, centre in zip(faces, centres):
        if face == centre or abs(dataset.sizes[face] - dataset.sizes[centre]) > 1:
            raise ValueError(
                f"{u.name} has the dimensions {dict(u.sizes)}, {v.name} {dict(v.sizes)}: "
                "components on the faces of cells lie across each other, and have at most one face "
                "more or less than there are cells")
    dims = (*u.dims[:-2], centres[1], centres[0])
    means = [_mean(dataset, component, face, centre, dims)
             for component, face, centre in zip((u, v), faces, centres)]
    for name in MASKS:
        if name in dataset and set(dataset[name].dims) == set(dims[-2:]):
            sea = dataset[name].transpose(*dims[-2:]).values != 0
            means = [m.where(xr.DataArray(sea, dims=dims[-2:])) for m in means]
            break
    return means[0], means[1], True


def _mean(dataset: xr.Dataset, component: Any, face: Hashable, centre: Hashable,
          dims: tuple[Hashable, ...]) -> Any:
    along = component.dims.index(face)
    values = np.moveaxis(np.asarray(component.values, np.float64), along, -1)
    count, faces = dataset.sizes[centre], values.shape[-1]
    left = np.arange(count) - (1 if _side(dataset, component, face, centre) > 0 else 0)
    inside = (left >= 0) & (left + 1 < faces)  # else there is no second face
    one, other = (values[..., np.clip(n, 0, faces - 1)] for n in (left, left + 1))
    flow = 0.5 * (np.nan_to_num(one) + np.nan_to_num(other))
    mean = np.where(inside & (np.isfinite(one) | np.isfinite(other)), flow, np.nan)
    new = [centre if d == face else d for d in component.dims]
    coordinates = {k: c for k, c in dataset.coords.items() if set(c.dims) <= set(new)}
    return xr.DataArray(np.moveaxis(mean, -1, along), coordinates, new, str(component.name),
                        component.attrs).transpose(*dims)


def _side(dataset: xr.Dataset, component: Any, face: Hashable, centre: Hashable) -> int:
    """-1: face n lies before centre n; 1: behind it."""
    faces, centres = dataset.sizes[face], dataset.sizes[centre]
    if faces != centres:
        return -1 if faces > centres else 1
    if face in dataset.coords and centre in dataset.coords:
        at, to = (dataset[d].values for d in (face, centre))
        if at.dtype.kind in "iuf" and to.dtype.kind in "iuf" and centres > 1:
            off = (float(at[0]) - float(to[0])) / (float(to[1]) - float(to[0]))
            if 0.1 < abs(off) < 0.9:
                return 1 if off > 0.0 else -1
    off = _off(dataset, component, face, centre)
    if 0.1 < abs(off) < 0.9:
        return 1 if off > 0.0 else -1
    if face in dataset.coords and dataset[face].attrs.get("c_grid_axis_shift") in (0.5, -0.5):
        return 1 if dataset[face].attrs["c_grid_axis_shift"] > 0 else -1
    if str(face) in SIDES:
        return SIDES[str(face)]
    raise ValueError(f"{component.name} is on as many {face} as there are {centre}: on which side "
                     f"of them is not known; a coordinate {face}, or its attribute "
                     "c_grid_axis_shift, 0.5 or -0.5, says it")


def _off(dataset: xr.Dataset, component: Any, face: Hashable, centre: Hashable) -> float:
    """How far in cells a component's positions are from those of the centres."""
    other = next(d for d in component.dims[-2:] if d != face)
    own, middles = positions(dataset, (other, face)), positions(dataset, (other, centre))
    if own is None or middles is None:
        return 0.0
    near = slice(0, min(own[0].shape[1], middles[0].shape[1]) - 1)
    step = [np.diff(c)[:, near] for c in middles]
    gap = [a[:, near] - b[:, near] for a, b in zip(own, middles)]
    for way in (step, gap):
        way[0] = way[0] - 360.0 * np.rint(way[0] / 360.0)
    with np.errstate(all="ignore"):
        share = (gap[0] * step[0] + gap[1] * step[1]) / (step[0] ** 2 + step[1] ** 2)
    return float(np.nanmedian(share)) if np.isfinite(share).any() else 0.0


def positions(dataset: xr.Dataset, dims: tuple[Hashable, ...]) -> list[np.ndarray] | None:
    """Longitude and latitude of two dimensions; None: the dataset has none."""
    found: dict[str, np.ndarray] = {}
    for name, variable in dataset.variables.items():
        if variable.ndim == 2 and set(variable.dims) == set(dims):
            role = role_of(dataset[name])
            if role in ("lon", "lat"):
                place = eastward(dataset[name]).transpose(*dims)
                found.setdefault(role, place.values.astype(np.float64))
    return [found["lon"], found["lat"]] if len(found) == 2 else None


def frame_of(dataset: xr.Dataset, u: Any, v: Any, staggered: bool) -> str | None:
    """"east": components along east and north; "grid": along the grid; None: nothing says it."""
    return frame_by_terms(u, v, any(name in dataset for name in ANGLES), staggered)


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
