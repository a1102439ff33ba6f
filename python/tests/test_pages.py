"""The code of the pages for users, docs/users/python.md and paraview.md, as it stands there."""

import os
import pathlib
import shutil
import subprocess
import sys

import pytest
from conftest import WITH_A_DISPLAY

ROOT = pathlib.Path(__file__).parents[2]
WHEELS = sorted((ROOT / "build-python").glob("flowgrain-*.whl"))


def blocks(page, language):
    command = [ROOT / "scripts" / "blocks", ROOT / "docs" / "users" / page, language]
    return subprocess.run(command, check=True, capture_output=True, text=True).stdout


def test_python_page(monkeypatch, tmp_path):
    matplotlib = pytest.importorskip("matplotlib")
    matplotlib.use("agg")
    for package in ("cartopy", "xarray", "netCDF4"):
        pytest.importorskip(package)
    import matplotlib.pyplot as plt

    shutil.copy(ROOT / "data" / "gfs_20140131.nc", tmp_path / "wind.nc")
    monkeypatch.chdir(tmp_path)
    names = {"__name__": "__main__"}
    exec(compile(blocks("python.md", "python"), "python.md", "exec"), names)
    plt.close("all")
    for picture in ("arrows", "next", "map", "wind"):
        assert (tmp_path / f"{picture}.png").stat().st_size > 5000
    assert len(names["few"]) == 12 and len(names["q"].get_paths()) == 30
    assert len(names["scale"]) == 8


@pytest.mark.skipif(not WHEELS, reason="no wheel in build-python")
@pytest.mark.parametrize("page", ["python.md", "paraview.md"])
def test_installation(page, tmp_path):
    """What pip is told there, without a network and into a folder of its own."""
    pytest.importorskip("pip")
    home = tmp_path / "home"
    target = home / "flowgrain"
    environment = {**os.environ, "HOME": str(home), "PIP_NO_DEPS": "1", "PIP_NO_INDEX": "1",
                   "PIP_DISABLE_PIP_VERSION_CHECK": "1", "PIP_TARGET": str(target)}
    # the Python of these tests may be called otherwise
    commands = blocks(page, "sh").replace("python3 ", f"{sys.executable} ")
    subprocess.run(["bash", "-euc", commands], cwd=ROOT, env=environment, check=True)
    assert (target / "flowgrain" / "paraview" / "flowgrain_filter.py").exists()
    if page == "paraview.md":
        run_in_paraview(environment, tmp_path)


def run_in_paraview(environment, folder):
    if not shutil.which("pvpython") or not shutil.which("xvfb-run"):
        pytest.skip("installed; no pvpython or xvfb-run for the script")
    program = os.environ.get("FLOWGRAIN_PROGRAM")
    if not program:
        pytest.skip("installed; no program that makes a field for the script")
    subprocess.run([program, "synth", "vortex3d", "-o", folder / "field.vti", "--nodes", "33"],
                   check=True)
    (folder / "script.py").write_text(blocks("paraview.md", "python"))
    subprocess.run([*WITH_A_DISPLAY, "pvpython", "script.py"], cwd=folder, env=environment,
                   check=True)
    assert (folder / "arrows.png").stat().st_size > 5000
