"""Calls of the C library: failures become exceptions, and Ctrl-C stops them."""

from __future__ import annotations

import threading
from typing import Any, Callable

import numpy as np

from ._core import ffi, lib


# what hints name, and what it is here
OPTIONS = (("--scale plain", "scale='plain'"), ("Take a larger gamma or more", "Take more"),
           ("name the column of times or levels t or z, or leave", "leave"),
           (" in the file", ""),
           ("with --vars U,V", "with u and v"),
           ("example with --vars", "example with u, v ="),
           ("leave such values empty, or write nan", "make it NaN"))


class Context:
    """What a call of the library reports to and is stopped by; used by one thread at a time."""

    def __init__(self) -> None:
        out = ffi.new("fg_context **")
        if lib.fg_context_create(out):
            raise MemoryError("flowgrain: no memory for a context")
        self.handle = ffi.gc(out[0], lib.fg_context_destroy)

    def call(self, function: Callable[..., int], *arguments: Any) -> None:
        """Calls a function that returns a status, without the GIL.

        In the main thread, the one that sees signals, the work is done by another, so that Ctrl-C
        stops it.
        """
        if threading.current_thread() is threading.main_thread():
            status = self._call_stoppable(function, arguments)
        else:
            status = function(*arguments)
        if status != lib.FG_STATUS_OK:
            raise self._exception(status)

    def _call_stoppable(self, function: Callable[..., int], arguments: tuple[Any, ...]) -> int:
        results: list[int] = []
        done = threading.Event()

        def work() -> None:
            try:
                results.append(function(*arguments))
            finally:
                done.set()

        threading.Thread(target=work, name="flowgrain", daemon=True).start()
        interruption: BaseException | None = None
        while not done.is_set():
            try:
                done.wait()
            except BaseException as exception:  # of any signal's handler
                interruption = exception
                lib.fg_context_stop(self.handle)
        if interruption is not None:
            raise interruption
        return results[0]

    def _exception(self, status: int) -> Exception:
        message = text(lib.fg_context_message(self.handle))
        hint = text(lib.fg_context_hint(self.handle))
        lib.fg_context_clear(self.handle)
        if status == lib.FG_STATUS_MEMORY:
            return MemoryError(message)
        for option, argument in OPTIONS:
            hint = hint.replace(option, argument)
        if hint and "--" not in hint:  # not another option of the program
            message += "\n" + hint
        return ValueError(message)

    def create(
        self,
        kind: str,
        destroy: Callable[[Any], None],
        function: Callable[..., int],
        *arguments: Any,
    ) -> Any:
        """Calls a function whose first argument is where it puts a new object."""
        out = ffi.new(f"{kind} **")
        self.call(function, out, *arguments)
        return ffi.gc(out[0], destroy)


def text(characters: Any) -> str:
    """A text of the library."""
    return ffi.string(characters).decode("utf-8", "replace")


def copy(pointer: Any, shape: tuple[int, ...], dtype: Any) -> np.ndarray:
    """Copies what a pointer points to into an array."""
    dtype = np.dtype(dtype)
    bytes_ = int(np.prod(shape, dtype=np.int64)) * dtype.itemsize
    return np.frombuffer(ffi.buffer(pointer, bytes_), dtype).reshape(shape).copy()


def version() -> str:
    """The library's version."""
    return text(lib.fg_version())
