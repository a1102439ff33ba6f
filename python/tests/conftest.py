import numpy as np
import pytest

# -noreset: by default the server starts again when its last client goes, and ParaView, which
# first looks what the server can do, would then find none
WITH_A_DISPLAY = ["xvfb-run", "-a", "-s", "-screen 0 1280x1024x24 -noreset"]


def vortices(nx=65, ny=49, wide=8.0, tall=6.0):
    """A field without symmetry: x, y, u, v."""
    x, y = np.linspace(1.0, 1.0 + wide, nx), np.linspace(-2.0, -2.0 + tall, ny)
    px, py = np.meshgrid((x - 1.0) / wide, (y + 2.0) / tall)
    u, v = np.full_like(px, 0.15), np.full_like(px, 0.05)
    for cx, cy, strength in ((0.3, 0.35, 1.0), (0.72, 0.6, -1.3)):
        rate = 0.1 * strength / (0.02 + (px - cx) ** 2 + (py - cy) ** 2)
        u -= rate * (py - cy)
        v += rate * (px - cx)
    return x, y, u.astype(np.float32), v.astype(np.float32)


def ocean(east=180.0):
    """A curvilinear grid of the globe whose poles lie elsewhere: longitudes up to `east`,
    latitudes, which are land, and u, v."""
    a, b = np.meshgrid(np.radians(np.arange(0.0, 360.0, 3.0)), np.radians(np.linspace(-65, 70, 61)))
    p, q, r = np.cos(b) * np.cos(a), np.cos(b) * np.sin(a), np.sin(b)
    p, r = p * 0.9 + r * 0.43, r * 0.9 - p * 0.43
    lon = (np.degrees(np.arctan2(q, p)) - 110.0 - east) % 360.0 + east - 360.0
    lat = np.degrees(np.arctan2(r, np.hypot(p, q)))
    a, b = np.radians(lon), np.radians(lat)
    return lon, lat, is_land(lon, lat), np.cos(b) * np.cos(3 * a) + 0.4 * np.sin(
        2 * b), np.cos(b) * np.sin(2 * a)


def is_land(lon, lat):
    """Whether points lie within a number of degrees of some places."""
    places, land = ((20, 5, 30), (-70, -10, 25), (100, 40, 30), (135, -25, 15)), False
    for x, y, degrees in places:
        east = (np.mod(lon - x + 180.0, 360.0) - 180.0) * np.cos(np.radians(lat))
        land = land | (np.hypot(east, lat - y) < degrees)
    return land


@pytest.fixture(scope="session")
def field():
    return vortices()
