"""What two touching bodies cannot leave: worn Ti-6Al-4V.

Arnaud, Baydoun and Fouvry (2021): cylinder R = 80 mm on a flat, 1066 N/mm, sliding +-75 um, 5000 cycles. Thickness lost
by both bodies together: published half-width and depths (dots; +-0.1 mm, +-5 um), the cap that bodies which keep
touching leave for the same worn area (dashed), the program with a constant wear coefficient, 256 cells, and with debris
that stays, 240 cells: in (a) 0.94 of it, fitted to the half-width; in (b) 0.85 of it and a rim of 1.08 mm, by the
constants of their model. (a) 0.1 Hz, U scar. (b) 2 Hz, W scar.
"""

import json

import numpy as np
from _figures import BLACK, BLUE, GREEN, ORANGE, ROOT, figure, letters, save

DATA = json.loads((ROOT / "docs" / "data" / "experiments.json").read_text(encoding="utf-8"))["arnaud"]["rows"]
MOVING = json.loads((ROOT / "docs" / "data" / "moving_scars.json").read_text(encoding="utf-8"))["arnaud"]
drawn, panels = figure(2, height=62, sharey=True)
for axes, row in zip(panels, DATA, strict=True):
    half = row["cap"]["half_width"]
    x = np.linspace(-half, half, 200)
    axes.plot(x, -1e3 * (half**2 - x**2) / 160, color=ORANGE, ls="--", label="cap of the same area")
    place = np.array(row["x"])
    depth = -1e3 * np.array(row["depth"])
    axes.plot(
        np.concatenate([-place[::-1], place]),
        np.concatenate([depth[::-1], depth]),
        color=BLUE,
        label="computed, no debris",
    )
    kept = MOVING[row["shape"]]
    place, depth = np.array(kept["x"]), -1e3 * np.array(kept["worn"])
    axes.plot(
        np.concatenate([-place[::-1], place]),
        np.concatenate([depth[::-1], depth]),
        color=GREEN,
        label="computed, debris",
    )
    places, values = [-1.8, 0.0, 1.8], [0.0, -1e3 * row["middle_mm"], 0.0]
    if row["shape"] == "W":
        at = row["deepest_at_mm"]
        places, values = [*places, -at, at], [*values, *[-1e3 * row["deepest_mm"]] * 2]
    axes.errorbar(places, values, xerr=0.1, yerr=5, fmt="o", color=BLACK, ms=4, lw=0.7, label="measured")
    axes.set(xlabel="x [mm]", xlim=(-4, 4), ylim=(-190, 12))
    axes.set_title(f"{row['frequency_Hz']:g} Hz, {row['shape']} scar", fontsize=8)
panels[0].set_ylabel("thickness lost [um]")
panels[0].legend(loc="lower left", fontsize=6)
letters(panels)
save(drawn)
