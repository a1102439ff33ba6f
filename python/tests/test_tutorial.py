import json
import pathlib

import pytest

EXAMPLES = pathlib.Path(__file__).parents[1] / "examples"


def test_tutorial(monkeypatch):
    """The notebook's code, cell by cell."""
    matplotlib = pytest.importorskip("matplotlib")
    matplotlib.use("agg")
    for package in ("cartopy", "xarray", "netCDF4"):
        pytest.importorskip(package)
    import matplotlib.pyplot as plt

    monkeypatch.chdir(EXAMPLES)
    notebook = json.loads((EXAMPLES / "tutorial.ipynb").read_text())
    names = {"__name__": "__main__"}
    for cell in notebook["cells"]:
        if cell["cell_type"] == "code":
            exec(compile("".join(cell["source"]), cell["id"], "exec"), names)
    for number in plt.get_fignums():
        plt.figure(number).canvas.draw()
    assert len(plt.get_fignums()) == 4
    assert len(names["globe_arrows"]) == 50 and len(names["q"].get_paths()) == 80
    plt.close("all")
