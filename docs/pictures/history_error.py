"""Error of the history while a contact grows.

Rigid sphere indenting a half-space with friction, nu = 0.3 (Spence's problem), 64 x 64 cells, linear and cubic ramps
of the force. Errors against 640 linear increments on the same grid: (a) shear traction, L2; (b) dissipated energy; (c)
stick radius over contact radius minus Spence's value, grey: half a cell. Numbers: docs/data/spence.json.
"""

import json

from _figures import BLUE, ORANGE, ROOT, figure, letters, save

data = json.loads((ROOT / "docs/data" / "spence.json").read_text(encoding="utf-8"))
drawn, panels = figure(3, height=60)
for friction, line in ((0.1, ":"), (0.304, "-")):
    for ramp, colour, mark in (("linear", BLUE, "o"), ("cubic", ORANGE, "s")):
        rows = [
            r for r in data["rows"] if r["friction"] == friction and r["ramp"] == ramp and r["increments"] != "auto"
        ]
        x = [r["increments"] for r in rows]
        name = f"{ramp}, $\\mu$ = {friction:g}"
        exact = rows[0]["stick_radius_exact"]
        for axes, key in zip(panels, ("shear_error", "energy_error", "stick_radius"), strict=True):
            values = [r[key] - (exact if key == "stick_radius" else 0.0) for r in rows]
            axes.plot(x, values, mark + line, color=colour, lw=0.9, label=name)
panels[2].axhspan(-data["half_cell"], data["half_cell"], color="0.9", zorder=0)
for axes, label in zip(panels, ("error of the shear traction", "error of $W_d$", "$c / a$ minus exact"), strict=True):
    axes.set(xscale="log", xlabel="increments", ylabel=label, xticks=[10, 20, 40, 80], xticklabels=[10, 20, 40, 80])
    axes.minorticks_off()
for axes in panels[:2]:
    axes.set_yscale("log")
drawn.legend(*panels[0].get_legend_handles_labels(), loc="outside lower center", ncols=4)
letters(panels)
save(drawn)
