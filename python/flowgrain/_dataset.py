"""Components and coordinates of a dataset of xarray, by their names and attributes.

The rules are the program's (src/read/netcdf/pairs.c and roles.c).
"""

from __future__ import annotations

import re
from typing import Any, Iterator

import xarray as xr

WORDS = (("u", "v"), ("x", "y"), ("eastward", "northward"), ("east", "north"),
         ("zonal", "meridional"))  # fmt: skip
PARTS = (("eastward", "northward"), ("zonal", "meridional"), ("vozo", "vome"), ("sozo", "some"),
         ("east", "north"))  # fmt: skip
# of standard names: a velocity, another vector, no vector
VELOCITY = ("wind", "velocity", "drift")
OTHER = ("stress", "shear", "flux", "tendency", "transport", "product", "momentum", "force",
         "acceleration", "gradient", "displacement")  # fmt: skip
NO_VECTOR = ("coordinate", "grid_index", "square_of", "derivative", "longitude", "latitude",
             "inverse_of", "cell_", "index_at", "status_flag", "quality_flag",
             "standard_error")  # fmt: skip
# derived from a component, but none
SPOILT = re.compile(
    r"(?i)(?:^|_)[uv]?(?:sd|se|unc|var|num|nobs|lon|lat|count|rms|rmse|area|angle|index|longitude"
    r"|latitude|weight|variance|status|(?:err|qc|qartod|flag|std|uncert|qual|mask|bnds|bounds)\w*)"
    r"(?=_|$)")
POINTS = r"_?(?:rho|psi|[tuvwcf]|\d+)"  # of a grid
SPEEDS = re.compile(r"(?i)^\s*(?:|(?:[cmk]?m|knots?|kts?|miles?|feet|ft|meters?|metres?)\b.*)$")


def _patterns(name: str) -> Iterator[tuple[str, int]]:
    """Patterns of a component's name, with # for the part that denotes it, and component 0 or 1."""
    for letters in re.finditer(r"[A-Za-z]+", name):
        word = letters.group().lower()
        start, end = letters.span()
        whole = (start == 0 or not name[start - 1].isalpha()) and (
            end == len(name) or not name[end].isalpha())
        for pair in WORDS:
            if whole and word in pair:
                yield f"w{name[:start]}#{name[end:]}", pair.index(word)
        if len(word) > 1:
            if word[0] in "uv":
                yield f"f{name[:start]}#{name[start + 1:]}", "uv".index(word[0])
            for last in ("uv", "xy"):
                if word[-1] in last:
                    yield f"l{name[:end - 1]}#{name[end:]}", last.index(word[-1])
    for pair in PARTS:
        for k in (0, 1):
            at = name.lower().find(pair[k])
            if at >= 0:
                rest = name[at + len(pair[k]):]
                if pair[0] in ("vozo", "sozo"):  # NEMO: also differ at the end
                    rest = rest[:-1] + "#"
                yield f"p{name[:at]}#{rest}", k


def _standard_pattern(variable: Any) -> tuple[int, str, int] | None:
    """Rank, pattern of the standard name, and the component."""
    name = str(variable.attrs.get("standard_name", ""))
    if any(word in name for word in NO_VECTOR):
        return None
    other = any(word in name for word in OTHER)
    if not other and not any(word in name for word in VELOCITY):
        return None
    name = re.sub(r"_at_[uv]_location.*", "", name)
    tokens = name.split("_")
    for n, token in enumerate(tokens):
        for pair in WORDS:
            if token in pair:
                key = "_".join([*tokens[:n], "#", *tokens[n + 1:]])
                return (2 if other else 0), key, pair.index(token)
    return None


def find_pair(dataset: xr.Dataset) -> tuple[str, str]:
    """Names of the components of the velocity: by CF's standard names, else by their names."""
    found: dict[tuple[int, str, tuple[Any, ...]], list[list[str]]] = {}

    def add(rank: int, key: str, name: str, component: int) -> None:
        # on the faces of cells they differ in the plane's dimensions
        dims = dataset[name].dims[:-2]
        entry = found.setdefault((rank, key, dims), [[], []])[component]
        if name not in entry:
            entry.append(name)

    for name, variable in dataset.data_vars.items():
        if variable.ndim < 2 or variable.dtype.kind not in "iuf":
            continue
        standard = _standard_pattern(variable)
        if standard is not None:
            add(standard[0], standard[1], str(name), standard[2])
        if not SPOILT.search(str(name)):
            speed = bool(SPEEDS.match(str(variable.attrs.get("units", ""))))
            for key, component in _patterns(str(name)):
                add(1 if speed else 3, key, str(name), component)
    pairs: list[tuple[int, str, str]] = []
    for (rank, _, _), (first, second) in found.items():
        if len(first) == len(second) == 1:
            pairs.append((rank, first[0], second[0]))
        elif rank in (0, 2):  # several of one standard name, as u10 and u100: distinguished by names
            pairs += [(rank, a, b) for a in first for b in second
                      if {k for k, c in _patterns(a) if c == 0} & {k for k, c in _patterns(b) if c}]
    if not pairs:
        raise ValueError("no pair of variables is known as a velocity by standard_name or name; "
                         f"give u and v, of {', '.join(map(str, dataset.data_vars)) or 'none'}")
    best = min(pairs, key=lambda pair: pair[0])
    return best[1], best[2]


def role_of(coordinate: Any) -> str | None:
    """The axis of a coordinate: "lon" or "lat" in degrees, else "x" or "y"; None: neither."""
    attrs = coordinate.attrs
    standard = str(attrs.get("standard_name", ""))
    units = str(attrs.get("units", "")).lower().replace(" ", "_")
    name = str(coordinate.name).lower()
    if "grid_index" in standard:
        return None
    for role, words, unit, axis in (
        ("lon", ("lon", "longitude", "nav_lon"), ("degrees_east", "degree_east", "degrees_e"), "X"),
        ("lat", ("lat", "latitude", "nav_lat"), ("degrees_north", "degree_north", "degrees_n"),
         "Y"),
    ):
        if standard == words[1] or units in unit:
            return role
        if not standard and (name in words or re.fullmatch(words[0] + POINTS, name)):
            return role
        letter = axis.lower()
        if attrs.get("axis") == axis or standard == f"projection_{letter}_coordinate":
            return letter
        if name in (letter, f"{letter}c", "rlon" if letter == "x" else "rlat"):
            return letter
    return None


def find_coordinates(u: xr.DataArray) -> tuple[Any, Any, bool]:
    """Coordinates along x and y, and whether they are longitude and latitude.

    Those of one dimension are preferred, then those of two; without any, the last two dimensions.
    """
    for count in (1, 2):
        roles: dict[str, Any] = {}
        for coordinate in u.coords.values():
            if coordinate.ndim == count and coordinate.size > 1:
                role = role_of(coordinate)
                if role is not None:
                    roles.setdefault(role, coordinate)
        for x, y, degrees in (("lon", "lat", True), ("x", "y", False)):
            if x in roles and y in roles:
                return roles[x], roles[y], degrees
    return u[u.dims[-1]], u[u.dims[-2]], False
