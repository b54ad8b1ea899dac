"""A fretting loop and the quantities that are read from it.

Identical bodies with nu = 0, mu = 0.3, constant normal force, tangential amplitude Q* = 0.85 mu P, 48 x 48 cells, two
cycles; loop of the second cycle (solid) and first loading (dotted). W_d is the area of the loop; the energy ratio A
relates it to the rectangle (dashed); delta_0 is the half-width at zero force.
"""

from _figures import BLACK, BLUE, ORANGE, figure, save
from _loadings import FORCE, MU, ONSET, indentation, problem

import fretting

amplitude = 0.85 * MU * FORCE
stage = {"tangential_force": [amplitude, 0.0], "increments": 96, "cycles": 2}
history = fretting.run(problem(48, [indentation(), stage]))
x, y = history.increments["shift_x"] / ONSET, history.increments["tangential_force_x"] / (MU * FORCE)
drawn, axes = figure(height=70, wide=False)
axes.fill(x[97:], y[97:], color=BLUE, alpha=0.15, lw=0)
axes.plot(x[96:], y[96:], color=BLUE)
axes.plot(x[:25], y[:25], color=BLUE, ls=":")
d, q = x[96:].max(), y[96:].max()
axes.plot([-d, d, d, -d, -d], [-q, -q, q, q, -q], color="0.5", lw=0.7, ls="--")
axes.axhline(0, color="0.8", lw=0.6, zorder=0)
axes.axvline(0, color="0.8", lw=0.6, zorder=0)
opening = history.cycles["opening"][1] / ONSET
axes.annotate(
    "",
    xy=(opening, 0),
    xytext=(0, 0),
    arrowprops={"arrowstyle": "<|-|>", "color": ORANGE, "lw": 1, "shrinkA": 0, "shrinkB": 0, "mutation_scale": 7},
)
axes.text(opening / 2, -0.1, "$\\delta_0$", color=ORANGE, ha="center", va="top")
axes.text(-0.03, q, "$Q^*$", ha="right", va="center", bbox={"fc": "white", "ec": "none", "pad": 1})
axes.text(d, -0.08, "$\\delta^*$", ha="center", va="top", bbox={"fc": "white", "ec": "none", "pad": 1})
axes.text(0.02, 0.27, "$W_d$", color=BLUE, ha="center")
ratio, sliding = history.cycles["energy_ratio"][1], history.cycles["sliding_ratio"][1]
axes.set_title(
    f"$A = W_d / (4 Q^* \\delta^*) = {ratio:.3f}$,   $D = \\delta_0 / \\delta^* = {sliding:.3f}$", color=BLACK
)
axes.set(
    xlabel="relative displacement $\\delta$ / onset of gross slip", ylabel="$Q / \\mu P$", xlim=(-1.15 * d, 1.15 * d)
)
save(drawn)
