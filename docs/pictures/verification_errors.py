"""Discretisation error over the number of cells.

(a) Approach: Hertz, coated spheres (E_c/E_s = 1/4 and 4, h = a_H) against an axisymmetric integral equation. (b)
Partial slip of identical bodies, nu = 0, mu = 0.3, Q = 0.75 mu P, against Cattaneo and Mindlin: displacement,
dissipated energy, stick area. Grids of 2.4 contact radii; dotted: first and second order. The stick area is counted by
cells and scatters.
"""

import json

import numpy as np
from _figures import ROOT, figure, letters, save
from _loadings import FORCE, MU, SHEAR, indentation, problem, sphere_contact

import fretting
from fretting import analytic

GRIDS = [16, 32, 64, 128, 256]
rows = json.loads((ROOT / "tests/golden" / "coated_sphere.json").read_text(encoding="utf-8"))["rows"]
hertz = analytic.hertz(radius=100.0, force=FORCE, modulus=1 / 0.91)
drawn, (left, right) = figure(2, height=66)
for ratio, mark, name in ((1.0, "o", "Hertz"), (0.25, "s", "$E_c/E_s$ = 1/4"), (4.0, "v", "$E_c/E_s$ = 4")):
    row = next(r for r in rows if r["h"] == 1.0 and r["young_ratio"] == ratio and r["poisson_coating"] == 0.3)
    errors = []
    for cells in GRIDS:
        coating = {"thickness": hertz.contact_radius, "young": ratio, "poisson": 0.3}
        history = fretting.run(
            {
                "grid": {"cells": [cells, cells], "size": [2.4 * row["a"] * hertz.contact_radius] * 2},
                "upper": {"rigid": True},
                "lower": {"coatings": [coating], "substrate": {"young": 1.0, "poisson": 0.3}},
                "profile": {"sphere": {"radius": 100.0}},
                "load": [{"normal_force": FORCE, "increments": 1}],
            }
        )
        errors.append(abs(history.increments["approach"][0] / (row["approach"] * hertz.approach) - 1))
    left.loglog(GRIDS, errors, mark + "-", lw=0.8, label=name)
exact = analytic.cattaneo_mindlin(
    sphere_contact(), friction_coefficient=MU, shear_modulus=SHEAR, tangential_force=0.75 * MU * FORCE
)
values: dict[str, list[float]] = {"relative displacement": [], "dissipated energy": [], "stick area": []}
for cells in GRIDS:
    steps = fretting.run(
        problem(cells, [indentation(), {"tangential_force": [0.75 * MU * FORCE, 0.0], "increments": 1}])
    ).increments
    values["relative displacement"].append(abs(steps["shift_x"][-1] / exact.shift - 1))
    values["dissipated energy"].append(abs(steps["dissipated_energy"][-1] / exact.dissipated_energy - 1))
    values["stick area"].append(abs(steps["stick_area"][-1] - np.pi * exact.stick_radius**2) / np.pi)
for (name, errors), mark in zip(values.items(), "osv", strict=True):
    right.loglog(GRIDS, errors, mark + "-", lw=0.8, label=name)
guide = np.array([16.0, 256.0])
for axes, first in ((left, 6e-3), (right, 6e-2)):
    for order in (1, 2):
        axes.loglog(guide, first * (16 / guide) ** order, color="0.6", ls=":")
    axes.set(xlabel="cells per side", xticks=GRIDS, xticklabels=GRIDS)
    axes.minorticks_off()
    axes.legend(fontsize=6)
left.set_ylabel("error of the approach")
right.set_ylabel("relative error")
letters((left, right))
save(drawn)
