"""Draws docs/gallery/python: quiver beside matplotlib's own, and on a map; needs cartopy."""

import io
import pathlib

import matplotlib

matplotlib.use("agg")
import cartopy.crs as ccrs  # noqa: E402
import matplotlib.pyplot as plt  # noqa: E402
import numpy as np  # noqa: E402
import xarray as xr  # noqa: E402
from PIL import Image  # noqa: E402

import flowgrain  # noqa: E402

ROOT = pathlib.Path(__file__).resolve().parents[2]
OUT = ROOT / "docs" / "gallery" / "python"


def save(figure, name):
    """As a PNG of 128 colours."""
    picture = io.BytesIO()
    figure.savefig(picture, dpi=120)
    image = Image.open(picture).convert("RGB")
    image.quantize(128, dither=Image.Dither.NONE).save(OUT / name, optimize=True)


def beside():
    x, y = np.linspace(0, 8, 129), np.linspace(0, 6, 97)
    px, py = np.meshgrid(x, y)
    u, v = 0.15 + 0 * px, 0.05 + 0 * px
    for cx, cy, strength in ((2.4, 2.1, 1.0), (5.8, 3.6, -1.3)):
        rate = strength / (1.0 + (px - cx) ** 2 + (py - cy) ** 2)
        u -= rate * (py - cy)
        v += rate * (px - cx)
    figure, (left, middle, right) = plt.subplots(1, 3, figsize=(10, 2.9), layout="constrained",
                                                 sharey=True)
    q = flowgrain.quiver(left, x, y, u, v, arrows=30)
    flowgrain.quiverkey(q, 0.72, 1.06, 0.6, "0.6 m/s")
    middle.quiver(x[::8], y[::8], u[::8, ::8], v[::8, ::8])
    right.streamplot(x, y, u, v, color="0.3", linewidth=0.8)
    for ax, title in ((left, "flowgrain.quiver"), (middle, "quiver"), (right, "streamplot")):
        ax.set_title(title, loc="left", fontsize=10)
        ax.set(xlim=(0, 8), ylim=(0, 6))
    figure.colorbar(q, ax=left, label="m/s")
    save(figure, "quiver.png")


def on_a_map():
    wind = xr.open_dataset(ROOT / "data" / "gfs_20140131.nc")
    figure = plt.figure(figsize=(10, 3.2), layout="constrained")
    places = figure.add_gridspec(1, 2, width_ratios=(1.95, 1.0))
    globe = figure.add_subplot(places[0], projection=ccrs.Robinson())
    globe.set_global()
    pole = figure.add_subplot(places[1], projection=ccrs.NorthPolarStereo())
    pole.set_extent([-180, 180, 35, 90], ccrs.PlateCarree())
    for ax, count in ((globe, 80), (pole, 40)):
        ax.gridlines(linewidth=0.4, color="0.8")
        q = wind.flowgrain.quiver(ax, arrows=count, vmin=0, vmax=16)
    figure.colorbar(q, ax=[globe, pole], label="m/s")
    save(figure, "maps.png")


if __name__ == "__main__":
    OUT.mkdir(parents=True, exist_ok=True)
    beside()
    on_a_map()
