"""Draws the field vortex3 with matplotlib: what a user would do instead."""
import sys

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np

path, kind = sys.argv[1], (sys.argv[2:] or ["streamplot"])[0]
axis = np.linspace(0.0, 1.0, 257)
x, y = np.meshgrid(axis, axis)
u, v = np.zeros_like(x), np.zeros_like(x)
for (cx, cy), strength in (((0.28, 0.30), 1), ((0.74, 0.34), -1), ((0.48, 0.74), 1)):
    r2 = (x - cx) ** 2 + (y - cy) ** 2 + 0.08**2
    u -= strength * (y - cy) / r2
    v += strength * (x - cx) / r2
plt.figure(figsize=(6.6, 6.6))
if kind == "quiver":
    part = slice(None, None, 9)
    plt.quiver(x[part, part], y[part, part], u[part, part], v[part, part])
else:
    plt.streamplot(axis, axis, u, v, color=np.hypot(u, v))
plt.savefig(path, dpi=144)
