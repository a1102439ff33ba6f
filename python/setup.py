"""Builds the extension on flowgrain_core; everything else is in pyproject.toml."""

import sys

from setuptools import setup
from setuptools.command.build_ext import build_ext

sys.path.insert(0, ".")
import build_core  # noqa: E402


class BuildWithCore(build_ext):
    """build_ext, once the library that the extension is linked with is there."""

    def run(self):
        build_core.make_library()
        super().run()


setup(
    cffi_modules=["build_core.py:ffibuilder"],
    cmdclass={"build_ext": BuildWithCore},
    # the stable interface of CPython: one wheel for all later versions
    options={"bdist_wheel": {"py_limited_api": "cp310"}},
)
