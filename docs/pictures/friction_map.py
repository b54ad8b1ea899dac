"""Friction that varies over the surface.

Rigid sphere, R = 100, on a half-space, nu = 0.3, friction 0.5 and 0.05 by quarters, prescribed approach, then
displaced along x and y (coupled), 20 x 20 cells. (a) Coefficient of friction. (b) Shear traction over the maximum
contact pressure, arrows: direction. (c) Difference from a dense direct solution without FFT
(tests/golden/two_patches.py), logarithmic; the solver tolerance is 1e-10.
"""

import json

import numpy as np
from _figures import ROOT, figure, letters, map_of, save
from matplotlib.colors import LogNorm

import fretting

golden = json.loads((ROOT / "tests/golden" / "two_patches.json").read_text(encoding="utf-8"))
n, size = golden["cells"], golden["size"]
shown = golden["quarters"]
friction = np.array(shown["friction"]).reshape(n, n)
history = fretting.run(
    {
        "grid": {"cells": [n, n], "size": [size, size]},
        "upper": {"rigid": True},
        "lower": {"substrate": {"young": 1.0, "poisson": 0.3}},
        "profile": {"sphere": {"radius": 100.0}},
        "friction": {"map": friction},
        "solver": {"tolerance": 1e-10},
        "load": [{"approach": golden["approach"], "shift": [0.0, 0.0], "increments": 1}]
        + [{"shift": shift, "increments": 1} for shift in golden["shifts"]],
        "output": {"fields": ["pressure", "shear"], "every": 1},
    }
)
p, qx, qy = (history.field(name) for name in ("pressure", "shear_x", "shear_y"))
last = shown["steps"][-1]
expected = [np.array(last[key]).reshape(n, n) for key in ("shear_x", "shear_y")]
largest = max(last["pressure"])
drawn, panels = figure(3, height=60)
off = np.maximum(np.hypot(qx - expected[0], qy - expected[1]) / largest, 1e-14)
fields = [
    (friction, "$\\mu$", {"cmap": "cividis"}),
    (np.where(p > 0, np.hypot(qx, qy) / largest, np.nan), "$|q| / p_{max}$", {"cmap": "viridis"}),
    (np.where(p > 0, off, np.nan), "difference / $p_{max}$", {"cmap": "magma", "norm": LogNorm(1e-14, 1e-9)}),
]
for axes, (values, label, more) in zip(panels, fields, strict=True):
    image = map_of(axes, history, values, 1.0, **more)
    drawn.colorbar(image, ax=axes, label=label, location="bottom", shrink=0.85)
    axes.set(xlabel="x")
length = np.hypot(qx, qy)
u, v = (np.where(p > 0, q / np.where(length > 0, length, 1), np.nan) for q in (qx, qy))
panels[1].quiver(history.x[::2], history.y[::2], u[::2, ::2].T, v[::2, ::2].T, color="w", scale=18, width=0.007)
panels[0].set_ylabel("y")
letters(panels)
save(drawn)
