"""Stick and slip zones through a fretting loop.

Rigid ball, R = 10 mm, on a half-space with E_s = 210 GPa, nu = 0.3, coating E_c/E_s = 2 of thickness h = a_H = 73 um,
mu = 0.3, P = 12 N, amplitude 0.9 mu P, 96 x 96 cells. Second cycle; above each map Q/(mu P). At each reversal the
whole contact sticks at first; slip then grows inward from the edge.
"""

from _coated import HERTZ, along, coated, cycle
from _figures import figure, save, zone_legend, zones

import fretting

history = fretting.run(coated(2.0, [cycle(0.9)], output={"fields": ["zone"], "every": 1}))
steps = [79, 80, 84, 88, 92, 96, 100, 103, 104, 108, 112, 115]
drawn, panels = figure(6, 2, height=68)
_, force = along(history)
for axes, step in zip(panels.ravel(), steps, strict=True):
    zones(axes, history, step, HERTZ.contact_radius)
    value = force[step] if abs(force[step]) > 5e-4 else 0.0
    axes.set_title(f"{value:.2f}", fontsize=7, pad=2)
    axes.set(xticks=[-1, 0, 1] if axes in panels[1] else [], yticks=[-1, 0, 1] if axes in panels[:, 0] else [])
panels[1, 0].set(xlabel="$x / a_H$", ylabel="$y / a_H$")
zone_legend(drawn, loc="outside lower right", ncols=3)
save(drawn)
