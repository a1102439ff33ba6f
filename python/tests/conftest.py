import numpy as np
import pytest

# -noreset: by default the server starts again when its last client goes, and ParaView, which
# first looks what the server can do, would then find none
WITH_A_DISPLAY = ["xvfb-run", "-a", "-s", "-screen 0 1280x1024x24 -noreset"]


def vortices(nx=65, ny=49, wide=8.0, tall=6.0):
    """A field without symmetry: u, v, x, y."""
    x, y = np.linspace(1.0, 1.0 + wide, nx), np.linspace(-2.0, -2.0 + tall, ny)
    px, py = np.meshgrid((x - 1.0) / wide, (y + 2.0) / tall)
    u, v = np.full_like(px, 0.15), np.full_like(px, 0.05)
    for cx, cy, strength in ((0.3, 0.35, 1.0), (0.72, 0.6, -1.3)):
        rate = 0.1 * strength / (0.02 + (px - cx) ** 2 + (py - cy) ** 2)
        u -= rate * (py - cy)
        v += rate * (px - cx)
    return u.astype(np.float32), v.astype(np.float32), x, y


@pytest.fixture(scope="session")
def field():
    return vortices()
