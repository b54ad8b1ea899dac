"""Line contact as a row of parallel cylinders.

Rigid cylinders, R = 50 a, half-width a of the contact, on a half-space, nu = 0.3, frictionless, periodic along x with
two periods. (a) Pressure: lines, closed form for the row; dots, 512 cells per period (every eighth); dashed, a single
cylinder (Hertz). (b) RMS error of the pressure relative to its RMS.
"""

import numpy as np
from _figures import figure, letters, save

import fretting

MODULUS, A, RADIUS = 1 / 0.91, 1.0, 50.0


def row(x: np.ndarray, period: float) -> np.ndarray:
    """Pressure under a row of cylinders, by the substitution s = tan(pi x / L) in the airfoil equation."""
    s, b = np.tan(np.pi * np.asarray(x) / period), np.tan(np.pi * A / period)
    t = b * np.cos(np.pi * (np.arange(400) + 0.5) / 400)
    s = np.clip(s, -b, b)[..., None]
    part = (np.arctan(t) - np.arctan(s)) / np.where(t == s, 1, t - s)
    root = np.sqrt(np.maximum(b**2 - s[..., 0] ** 2, 0))
    return MODULUS * period / (2 * np.pi**2 * RADIUS) * root * np.pi / 400 * part.sum(-1)


drawn, (left, right) = figure(2, height=62)
counts = (64, 128, 256, 512)
for period, mark in ((4.0, "o"), (16.0, "s")):
    angle = np.pi * (np.arange(4000) + 0.5) / 4000
    force = np.pi / 4000 * np.sum(row(A * np.cos(angle), period) * A * np.sin(angle))
    errors = []
    for cells in counts:
        depth = 8 * period / cells
        history = fretting.run(
            {
                "grid": {"cells": [cells, 8], "size": [period, depth], "periodic": True},
                "upper": {"rigid": True},
                "lower": {"substrate": {"young": 1.0, "poisson": 0.3}},
                "profile": {"cylinder": {"radius": RADIUS, "axis": "y"}},
                "load": [{"normal_force": force * depth, "increments": 1}],
            }
        )
        p = history.field("pressure")[:, 4]
        exact = row(history.x, period) * (np.abs(history.x) < A)
        errors.append(np.sqrt(np.sum((p - exact) ** 2) / np.sum(exact**2)))
    x = np.linspace(-A, A, 300)
    (line,) = left.plot(x, row(x, period), lw=0.9)
    left.plot(history.x[::8], p[::8], mark, color=line.get_color(), ms=2.5, label=f"period {period:g} a")
    right.loglog(counts, errors, mark + "-", lw=0.8, label=f"period {period:g} a")
hertz = fretting.analytic.hertz_line(radius=RADIUS, line_force=np.pi * A**2 * MODULUS / (4 * RADIUS), modulus=MODULUS)
x = np.linspace(-A, A, 300)
left.plot(x, hertz.max_pressure * np.sqrt(1 - x**2), "k--", lw=0.8, label="single cylinder")
left.set(xlabel="$x / a$", ylabel="$p / E$", xlim=(-1.3, 1.3), ylim=(0, None))
left.legend(loc="lower center")
right.set(xlabel="cells per period", ylabel="RMS error / RMS pressure", xticks=counts, xticklabels=counts)
right.minorticks_off()
right.legend()
letters((left, right))
save(drawn)
