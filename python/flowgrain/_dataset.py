"""Components and coordinates of a dataset of xarray, by their names and attributes.

The rules are the library's (src/terms), so that they are the program's.
"""

from __future__ import annotations

from itertools import count
from typing import Any, NamedTuple

import xarray as xr

from ._core import ffi, lib
from ._library import text

ROLES = {0: "x", 1: "y"}


class Terms(NamedTuple):
    """Variables as the library's functions take them."""

    array: Any  # of fg__term
    texts: list[Any]  # that it points to


def _number(numbers: dict[Any, int], key: Any) -> int:
    return numbers.setdefault(key, len(numbers))


def terms(variables: dict[str, Any]) -> Terms:
    """Names and attributes of variables by name.

    Those with the same dimensions are at the same points; on the faces of cells components of one
    vector differ in the plane's dimensions.
    """
    out = Terms(ffi.new("fg__term[]", max(1, len(variables))), [])
    places: dict[Any, int] = {}
    groups: dict[Any, int] = {}
    for term, (name, variable) in zip(out.array, variables.items()):
        for attribute in ("name", "standard_name", "long_name", "units"):
            said = name if attribute == "name" else variable.attrs.get(attribute)
            if said is not None:
                out.texts.append(ffi.new("char[]", str(said).encode("utf-8", "replace")))
                setattr(term, attribute, out.texts[-1])
        term.place = _number(places, frozenset(variable.dims))
        term.group = _number(groups, variable.dims[:-2])
        term.file = -1
    return out


def find_pair(dataset: xr.Dataset) -> tuple[str, str]:
    """Names of the components of the velocity: by CF's standard names, else by their names."""
    variables = {str(k): v for k, v in dataset.data_vars.items()
                 if v.ndim >= 2 and v.dtype.kind in "iuf"}
    names, found = terms(variables), ffi.new("fg__vector **")
    all_found, rules = ffi.new("size_t *"), ffi.new("fg__vector_rules *")
    if not lib.fg__vectors_find(found, all_found, names.array, len(variables), rules):
        raise MemoryError("flowgrain: no memory for the names of variables")
    vectors = [found[0][i] for i in range(all_found[0])]
    known = [(v.rank, *(list(variables)[v.component[k]] for k in (0, 1)))
             for v in vectors if not v.is_upright and v.polar.sense == 0]
    lib.free(found[0])
    if not known:
        raise ValueError("no pair of variables is known as a velocity by standard_name or name; "
                         f"give u and v, of {', '.join(map(str, dataset.data_vars)) or 'none'}")
    best = [pair[1:] for pair in known if pair[0] == known[0][0]]
    if len(best) > 1:
        raise ValueError(f"{len(best)} vectors could be meant: "
                         f"{' | '.join(','.join(pair) for pair in best)}; give u and v")
    return best[0]


def role_of(coordinate: Any) -> str | None:
    """The axis of a coordinate: "lon" or "lat" in degrees, else "x" or "y"; None: neither."""
    term = terms({str(coordinate.name): coordinate})
    if "grid_index" in str(coordinate.attrs.get("standard_name", "")):
        return None
    geographic = lib.fg__geographic_role(term.array)
    if geographic in ROLES:
        return "lon" if geographic == 0 else "lat"
    axis = str(coordinate.attrs.get("axis", "")).encode()
    role = lib.fg__role_of_attributes(term.array, axis, "positive" in coordinate.attrs)
    if role < 0:
        role = lib.fg__role_of_name(term.array[0].name)
    return ROLES.get(role)


def _units(variable: Any) -> bytes:
    return str(variable.attrs.get("units", "")).encode("utf-8", "replace")


def eastward(coordinate: Any) -> Any:
    """A coordinate that counts to the east and north, though its units say west or south."""
    west = any(lib.fg__unit_factor(_units(coordinate), unit) < 0
               for unit in (b"degrees_east", b"degrees_north"))
    return coordinate.copy(data=-coordinate.values) if west else coordinate


def check_units(u: Any, v: Any) -> None:
    """Refuses components in two units."""
    if lib.fg__units_differ(_units(u), _units(v)):
        raise ValueError(f"{u.name} is in {u.attrs['units']}, {v.name} in {v.attrs['units']}")


def _may_be_index(coordinate: Any) -> bool:
    return "axis" not in coordinate.attrs and lib.fg__term_may_be_index(
        terms({str(coordinate.name): coordinate}).array)


def find_coordinates(u: xr.DataArray) -> tuple[Any, Any, bool]:
    """Coordinates along x and y, and whether they are longitude and latitude.

    Those of one dimension are preferred, but for what may be mere indices, then those of two;
    without any, the last two dimensions.
    """
    for rank, indices in ((1, False), (2, True), (1, True)):
        roles: dict[str, Any] = {}
        for coordinate in u.coords.values():
            if coordinate.ndim == rank and coordinate.size > 1 and (
                    indices or not _may_be_index(coordinate)):
                role = role_of(coordinate)
                if role is not None:
                    roles.setdefault(role, coordinate)
        for x, y, degrees in (("lon", "lat", True), ("x", "y", False)):
            if x in roles and y in roles:
                return roles[x], roles[y], degrees
    return u[u.dims[-1]], u[u.dims[-2]], False


def frame_by_terms(u: Any, v: Any, angle: bool, staggered: bool) -> str | None:
    """"east": components along east and north; "grid": along the grid; None: nothing says it."""
    names, why = terms({str(u.name): u, str(v.name): v}), ffi.new("char[]", 256)
    counted = all(lib.fg__counts_cells(str(d).encode()) for d in u.dims[-2:])
    evidence = ffi.new("fg__frame_evidence *", {"staggered": staggered, "angle": angle,
                                                "on_indices": counted})
    frame = lib.fg__frame_of_terms(why, len(why), names.array, names.array + 1, evidence)
    return {1: "east", -1: "grid"}.get(frame)


def _names(name_at: Any) -> list[str]:
    return [text(name) for name in iter(map(name_at, count()).__next__, ffi.NULL)]


MASKS, ANGLES = _names(lib.mask_name), _names(lib.angle_name)
