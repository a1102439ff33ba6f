"""What a dataset of xarray means. The library says it (flowgrain/dataset.h), as of files."""

from __future__ import annotations

import re
import warnings
from typing import Any, NamedTuple

import numpy as np
import xarray as xr

from ._core import ffi, lib
from ._library import Context

FRAMES = {"auto": lib.FG_FRAME_AUTO, "east": lib.FG_FRAME_EAST, "grid": lib.FG_FRAME_GRID}
# numbers of xarray's are unpacked already, and its dates are no numbers
UNPACKED = {"scale_factor", "add_offset", "_FillValue", "missing_value", "valid_min", "valid_max",
            "valid_range", "_Unsigned"}  # fmt: skip
# what helps here against a refusal of the library's
ADVICE = {"axis '(.*)' is not strictly monotonic": "sort it: ds.sortby('{}')",
          "runs along .* a staggered grid$": "coordinates of the faces and the centres, or the "
          "faces' attribute c_grid_axis_shift, 0.5 or -0.5, say on which side they lie",
          "nothing says whether": "frame='east' or frame='grid' says it",
          "component to the .* by its|off the direction|again as the speed": "u and v are taken as "
          "they are where they are named: u=..., v=..."}  # fmt: skip
DATES = {"units": "seconds since 1970-01-01"}


def eastward(coordinate: Any, degrees: bool) -> Any:
    """A coordinate that counts to the east and north, though its units say west or south; in
    degrees, though its units may be radians."""
    units = str(coordinate.attrs.get("units", "")).encode("utf-8", "replace")
    to = (b"degrees_east", b"degrees_north", *([b"degrees"] if degrees else []))
    for factor in (lib.fg__unit_factor(units, unit) for unit in to):
        if factor not in (0.0, 1.0):
            return coordinate.copy(data=factor * coordinate.values)
    return coordinate


class Meaning(NamedTuple):
    """Names of variables, or None."""

    components: list[str]
    coordinates: list[str | None]
    mask: str | None
    is_geographic: bool
    is_along_grid: bool
    sides: list[int]


class _Source:
    """Variables as the library asks for them."""

    def __init__(self, dataset: xr.Dataset) -> None:
        self.names = [name for name, v in dataset.variables.items() if v.ndim <= 8]
        self.variables = [dataset.variables[name] for name in self.names]
        self.failure: BaseException | None = None
        self.kept: list[Any] = []
        self.handle = ffi.new_handle(self)

    def text(self, value: Any) -> Any:
        self.kept.append(ffi.new("char[]", str(value).encode("utf-8", "replace")))
        return self.kept[-1]

    def declare(self) -> Any:
        array = ffi.new("fg_variable[]", max(1, len(self.names)))
        for out, name, variable in zip(array, self.names, self.variables):
            out.name, out.rank = self.text(name), variable.ndim
            out.is_number = variable.dtype.kind in "biufM"
            for k, (dimension, length) in enumerate(variable.sizes.items()):
                out.dimension[k], out.length[k] = self.text(dimension), length
            said = dict(variable.attrs)
            for key in ("coordinates", "grid_mapping"):  # where xarray puts them
                said.setdefault(key, variable.encoding.get(key))
            said.update(DATES if variable.dtype.kind == "M" else {})
            known = {k: a for k, a in said.items() if k not in UNPACKED and a is not None}
            attributes = ffi.new("fg_attribute[]", max(1, len(known)))
            self.kept.append(attributes)
            out.attribute = attributes
            for attribute, (key, value) in zip(attributes, known.items()):
                attribute.name = self.text(key)
                numbers = np.ravel(value)
                if numbers.dtype.kind in "biuf":
                    self.kept.append(ffi.new("double[]", numbers.astype(float).tolist()))
                    attribute.number, attribute.count = self.kept[-1], len(numbers)
                else:
                    attribute.text = self.text(value)
            out.attributes = len(known)
        self.kept.append(array)
        return ffi.new("fg_variables *", {"name": self.text("dataset"), "variable": array,
                                          "count": len(self.names), "user": self.handle,
                                          "fetch": lib.fetch_numbers})


@ffi.def_extern()
def fetch_numbers(user: Any, number: int, start: Any, count: Any, out: Any) -> bool:
    source = ffi.from_handle(user)
    try:
        variable = source.variables[number]
        part = variable[tuple(slice(start[k], start[k] + count[k]) for k in range(variable.ndim))]
        values = np.asarray(part.values)
        if values.dtype.kind == "M":
            values = values.astype("M8[s]").astype(np.int64)
        target = np.frombuffer(ffi.buffer(out, 8 * values.size), np.float64)
        target[:] = values.ravel()
        return True
    except BaseException as failure:  # the caller raises it
        source.failure = failure
        return False


def meaning(dataset: xr.Dataset, u: Any = None, v: Any = None,
            frame: str = "auto") -> Meaning:
    """The vector that u and v name, or the only one of the best rank."""
    source, context = _Source(dataset), Context()
    names = ffi.NULL if u is None else source.text(f"{u},{v}")
    options = ffi.new("fg_read_options *", {"vars": names, "frame": FRAMES[frame]})
    out = ffi.new("fg_vector_meaning *")
    try:
        context.call(lib.fg_vector_find, out, context.handle, source.declare(), options)
    except ValueError as refusal:
        if source.failure is not None:
            raise source.failure from None
        for pattern, advice in ADVICE.items():
            about = re.search(pattern, str(refusal))
            if about:
                raise ValueError(f"{refusal}; {advice.format(*about.groups())}") from None
        raise

    def name_of(n: int) -> Any:
        return source.names[n] if n >= 0 else None

    for doubt in ffi.string(out.doubts).decode("utf-8", "replace").splitlines():
        warnings.warn(doubt, stacklevel=4)
    components = [name_of(n) for n in out.component[0:2]]
    if out.is_polar:
        raise ValueError(f"{components[0]} and {components[1]} are a speed and its direction: "
                         "components are needed")
    return Meaning(components, [name_of(n) for n in out.coordinate], name_of(out.mask),
                   out.is_geographic, out.is_along_grid, list(out.side))
