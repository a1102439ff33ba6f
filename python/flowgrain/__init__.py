"""Few curved arrows that show a vector field, for numpy, matplotlib and xarray.

`arrows` gives the arrows of a field in arrays, `evolve` scales of them from many to few. `quiver`
draws them into matplotlib axes. ``Dataset.flowgrain`` of xarray does both with what it finds.
"""

import importlib.util
import sys
from typing import TYPE_CHECKING, Any

from ._arrows import Arrow, Arrows, Counts, arrows, evolve
from ._library import version

__version__ = version()
__all__ = ["Arrow", "Arrows", "Counts", "arrows", "evolve", "quiver", "quiverkey"]

if TYPE_CHECKING:
    from ._quiver import quiver, quiverkey


def __getattr__(name: str) -> Any:
    """What needs matplotlib is loaded when it is asked for."""
    if name in ("Quiver", "QuiverKey", "gale", "quiver", "quiverkey"):
        from . import _quiver

        return getattr(_quiver, name)
    raise AttributeError(f"module 'flowgrain' has no attribute {name!r}")


class _AfterXarray:
    """Adds ``Dataset.flowgrain`` once xarray is imported, which takes longer than all of this."""

    def find_spec(self, name: str, path: Any, target: Any = None) -> Any:
        if name != "xarray":
            return None
        sys.meta_path.remove(self)
        spec = importlib.util.find_spec(name)
        if spec is not None and spec.loader is not None:
            execute = spec.loader.exec_module

            def execute_both(module: Any) -> None:
                execute(module)
                importlib.import_module("flowgrain._xarray")

            spec.loader.exec_module = execute_both  # type: ignore[assignment]
        return spec


if "xarray" in sys.modules:
    importlib.import_module("flowgrain._xarray")
else:
    sys.meta_path.insert(0, _AfterXarray())  # type: ignore[arg-type]
