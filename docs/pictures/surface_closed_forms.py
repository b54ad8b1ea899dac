"""Profiles with closed-form solutions.

Rigid profile on a half-space, nu = 0.3, frictionless, prescribed force; contact radius a = 1 (flat punch: its radius),
grid of 2.4 a. (a) Pressure along x with 48 x 48 cells (dots) and closed forms (lines): rounded punch with a flat of
0.6 a (Sneddon), cone (Love), flat punch (Boussinesq). (b) Error of the approach over the number of cells per side; the
circle of the flat punch is a staircase of cells, its error has no order. Ellipsoid: R_x = 220 a, R_y = 70 a.
"""

import numpy as np
from _figures import figure, letters, save

import fretting
from fretting import analytic

MODULUS = 1 / 0.91
NODES, WEIGHTS = np.polynomial.legendre.leggauss(60)
GRIDS = [24, 48, 96, 144, 192]


def gauss(f: object, lower: float, upper: float) -> float:
    """Integrate by 60 Gauss points."""
    return (upper - lower) / 2 * np.sum(WEIGHTS * f((lower + upper) / 2 + (upper - lower) / 2 * NODES))


B, A, EDGE = 0.6, 1.0, 30.0


def rate(t: np.ndarray) -> np.ndarray:
    """Sneddon's function of the gap (r - b)^2 / 2R beyond b."""
    return (2 * np.sqrt(np.maximum(t**2 - B**2, 0)) - B * np.arccos(np.minimum(B / t, 1))) / EDGE


def rounded(r: float) -> float:
    """Pressure under the rounded punch."""
    if r >= A:
        return 0.0
    low, high = np.sqrt(max(B**2 - r**2, 0)), np.sqrt(A**2 - r**2)
    return MODULUS / np.pi * gauss(lambda s: rate(np.hypot(r, s)) / np.hypot(r, s), low, high)


punch = analytic.flat_punch(radius=1.0, force=0.01, modulus=MODULUS)
cone = analytic.cone(slope=0.01, force=np.pi * MODULUS * 0.005, modulus=MODULUS)
ellipse = analytic.hertz_ellipse(radius_x=220.0, radius_y=70.0, force=0.0147, modulus=MODULUS)
SHAPES = {
    "rounded punch": (
        {"rounded_punch": {"flat_radius": B, "edge_radius": EDGE}},
        2 * MODULUS * gauss(lambda t: t * rate(t), B, A),
        A / EDGE * (np.sqrt(A**2 - B**2) - B * np.arccos(B / A)),
        np.vectorize(rounded),
        (2.4, 2.4),
    ),
    "cone": ({"cone": {"slope": 0.01}}, np.pi * MODULUS * 0.005, cone.approach, cone.pressure, (2.4, 2.4)),
    "flat punch": ({"flat_punch": {"radius": 1.0}}, 0.01, punch.approach, punch.pressure, (2.4, 2.4)),
    "ellipsoid": (
        {"ellipsoid": {"radius_x": 220.0, "radius_y": 70.0}},
        0.0147,
        ellipse.approach,
        None,
        (2.3 * ellipse.semi_axes[0], 2.3 * ellipse.semi_axes[1]),
    ),
}
drawn, (left, right) = figure(2, height=66)
for (name, (profile, force, approach, pressure, size)), mark in zip(SHAPES.items(), "osv^", strict=True):
    errors = []
    for cells in GRIDS:
        history = fretting.run(
            {
                "grid": {"cells": [cells, cells], "size": list(size)},
                "upper": {"rigid": True},
                "lower": {"substrate": {"young": 1.0, "poisson": 0.3}},
                "profile": profile,
                "load": [{"normal_force": force, "increments": 1}],
            }
        )
        errors.append(abs(history.increments["approach"][0] / approach - 1))
        if cells == 48 and pressure is not None:
            p = history.field("pressure")[:, 24]
            x = np.linspace(-1.15, 1.15, 600)
            (line,) = left.plot(x, pressure(np.hypot(x, history.y[24])), lw=0.9)
            left.plot(history.x, p, mark, color=line.get_color(), ms=2.5, label=name)
    right.loglog(GRIDS, errors, mark + "-", lw=0.8, label=name)
left.set(xlabel="$x / a$", ylabel="$p / E$", ylim=(0, 0.025))
left.legend()
guide = np.array([24, 192])
right.loglog(guide, 1.5e-3 * (24 / guide) ** 2, color="0.6", ls=":", label="second order")
right.set(xlabel="cells per side", ylabel="error of the approach", xticks=GRIDS, xticklabels=GRIDS)
right.minorticks_off()
right.set_ylim(3e-6, 0.3)
right.legend(fontsize=6, ncols=2, loc="upper right")
letters((left, right))
save(drawn)
