"""Torsional fretting.

Identical bodies with nu = 0, mu = 0.3, constant P, torsional moment +-0.9 of that of full slip, 16 increments per
cycle. (a) Line: Lubkin (1951) for the first loading and Masing's doubling for the reversals; dots: computed with 96 x
96 cells. The loop starts on the virgin curve. (b) Error of the rotation relative to its maximum for three grids.
"""

import numpy as np
from _figures import BLACK, figure, letters, save
from _loadings import FORCE, MU, indentation, problem, sphere_contact

import fretting
from fretting import analytic

full = 3 * np.pi * MU * FORCE / 16


def first(moments: np.ndarray) -> np.ndarray:
    """Rotation of a first loading."""
    return np.array(
        [
            analytic.torsion(sphere_contact(), friction_coefficient=MU, shear_modulus=0.25, moment=m).twist
            if m > 0
            else 0.0
            for m in moments
        ]
    )


drawn, (left, right) = figure(2, height=62)
top = 0.9 * full
line = np.linspace(0, top, 60)
sweep = np.linspace(top, -top, 120)
peak = first(np.array([top]))[0]
down = peak - 2 * first((top - sweep) / 2)
left.plot(
    np.concatenate([first(line), down, -down]),
    np.concatenate([line, sweep, -sweep]) / full,
    lw=1,
    label="Lubkin, Masing",
)
for cells, mark in ((24, "v"), (48, "s"), (96, "o")):
    history = fretting.run(problem(cells, [indentation(), {"twist_moment": top, "increments": 16, "cycles": 1}]))
    moment, twist = history.increments["twist_moment"], history.increments["twist"]
    exact = first(moment[1:5])
    back = exact[-1] - 2 * first((moment[4] - moment[5:13]) / 2)
    again = back[-1] + 2 * first((moment[13:] - moment[12]) / 2)
    exact = np.concatenate([exact, back, again])
    if cells == 96:
        left.plot(twist[1:], moment[1:] / full, "o", color=BLACK, ms=3, label="computed")
    right.semilogy(
        range(1, 17), abs(twist[1:] - exact) / abs(exact).max(), mark + "-", lw=0.8, label=f"{cells} x {cells} cells"
    )
left.set(xlabel="rotation [rad]", ylabel="$M_z$ / full-slip moment")
left.legend()
right.set(xlabel="increment", ylabel="error / max rotation", ylim=(3e-6, 3e-2), xticks=[4, 8, 12, 16])
right.legend(loc="upper center", ncols=3, fontsize=6, handlelength=1.2, columnspacing=1.0)
letters((left, right))
save(drawn)
