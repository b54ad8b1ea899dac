"""Von Mises stress under a coating through a fretting loop.

Rigid ball, R = 10 mm, on a half-space with E_s = 210 GPa, nu = 0.3, coating E_c/E_s = 2 of thickness h = a_H = 73 um
(dashed), mu = 0.3, P = 12 N, amplitude 0.9 mu P, 97 x 97 cells, section y = 0. Stress relative to the Hertz pressure
p_H of the uncoated contact; one colour scale. Bars on top: contact (black) and stick zone (blue).
"""

import numpy as np
from _coated import HERTZ, coated, cycle
from _figures import BLUE, figure, save

import fretting

case = coated(2.0, [cycle(0.9, 48, 1)], 97, output={"every": 1})
case["grid"]["size"] = [3.2 * HERTZ.contact_radius] * 2
history = fretting.run(case)
a = HERTZ.contact_radius
depths = np.unique(np.concatenate([np.linspace(0.02, 1, 26), np.linspace(1.02, 1.8, 16)])) * a
steps = {19: "after indentation", 31: "first peak", 43: "Q = 0, unloading", 55: "minimum"}
drawn, panels = figure(2, 2, height=82, sharex=True, sharey=True)
stresses = {step: history.subsurface(depths, increment=step) for step in steps}
top = max(float(s["von_mises"].max()) for s in stresses.values()) / HERTZ.max_pressure
levels = np.linspace(0, np.ceil(top * 10) / 10, 24)
for axes, (step, words) in zip(panels.ravel(), steps.items(), strict=True):
    stress = stresses[step]
    section = stress["von_mises"].isel(y=len(history.y) // 2).values / HERTZ.max_pressure
    image = axes.contourf(history.x / a, stress["depth"].values / a, section, levels, cmap="viridis")
    axes.axhline(1.0, color="w", ls="--", lw=0.8)
    row = history.field("zone", step)[:, len(history.y) // 2]
    for value, colour, place in ((row > 0, "k", -0.05), (row == 1, BLUE, -0.12)):
        axes.plot(
            history.x / a, np.where(value, place, np.nan), color=colour, lw=2, solid_capstyle="butt", clip_on=False
        )
    axes.set_title(words, fontsize=7)
panels[0, 0].set(ylim=(1.8, -0.16), xlim=(-1.6, 1.6))
for axes in panels[:, 0]:
    axes.set_ylabel("$z / a_H$")
for axes in panels[1]:
    axes.set_xlabel("$x / a_H$")
drawn.colorbar(image, ax=panels, label="von Mises stress / $p_H$", ticks=np.arange(0, levels[-1] + 0.01, 0.2))
save(drawn)
