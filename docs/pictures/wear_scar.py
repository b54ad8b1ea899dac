"""Partial-slip wear towards the limiting shape.

Identical bodies with nu = 0, mu = 0.3, fixed approach, displacement amplitude such that the stick radius is 0.6 a,
energy wear law, 240 cycles of 8 increments, 48 x 48 cells. (a) Pressure along x; grey: limiting shape (Popov 2014), a
punch of the stick radius. (b) Gap opened by wear. (c) Normal force above its limit, relative to the start.
"""

import matplotlib.pyplot as plt
import numpy as np
from _figures import figure, letters, save
from _loadings import FORCE, MODULUS, MU, PEAK, RADIUS, SHEAR, problem

import fretting

c, approach = 0.6, 1 / RADIUS
shift = MU * MODULUS * approach * (1 - c**2) / (4 * SHEAR)
stages = [{"approach": approach, "increments": 1}, {"shift": [shift, 0.0], "increments": 8, "cycles": 240}]
case = problem(48, stages, wear={"coefficient": 25.0})
case["grid"]["size"] = [3.2, 3.2]
case["output"] = {"fields": ["pressure", "worn_depth"], "every": 8}
history = fretting.run(case)
half = len(history.x) // 2
drawn, panels = figure(3, height=62)
shown = [0, 3, 15, 60, 239]
colours = plt.get_cmap("viridis")(np.linspace(0, 0.85, len(shown)))
for cycle, colour in zip(shown, colours, strict=True):
    step = int(history.cycles["last_increment"][cycle])
    panels[0].plot(history.x, history.field("pressure", step)[:, half] / PEAK, lw=1, color=colour, label=f"{cycle + 1}")
    panels[1].plot(
        history.x, history.field("worn_depth", step)[:, half] / approach, lw=1, color=colour, label=f"{cycle + 1}"
    )
r = np.linspace(0, 0.999 * c, 300)
root = np.sqrt(c**2 - r**2)
limit = MODULUS / np.pi * (2 * root / RADIUS + (approach - c**2 / RADIUS) / root) / PEAK
panels[0].plot(np.concatenate([-r[::-1], r]), np.concatenate([limit[::-1], limit]), color="0.75", lw=3, zorder=0)
panels[0].set(xlabel="$x / a$", ylabel="$p / p_0$", ylim=(0, 2.5))
panels[0].legend(title="cycles", fontsize=6, title_fontsize=6)
panels[1].set(xlabel="$x / a$", ylabel="wear depth / approach")
force = history.increments["normal_force"][history.cycles["last_increment"]]
final = 2 * MODULUS * (approach * c - c**3 / (3 * RADIUS))
panels[2].loglog(history.cycles["cycle"], (force - final) / (FORCE - final))
panels[2].set(xlabel="cycle", ylabel="$(P - P_\\infty) / (P_0 - P_\\infty)$")
letters(panels)
save(drawn)
