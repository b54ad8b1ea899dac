"""Fretting wear of a cylinder on a flat: measured and computed.

McColl, Ding and Leen (2004): steel cylinder R = 6 mm, 18.5 N/mm, displacement +-25 um, 18 000 cycles; E = 200 GPa,
nu = 0.3, mu = 0.9; Archard coefficients 2.9e-8 /MPa (flat) and 1.9e-8 /MPa (cylinder), which were fitted to the worn
volumes of this test. (a) Scar of the flat; measured: Fig. 11a, digitised by I. Llavori; finite elements: his level-set
model with moving surfaces. Computed: surfaces move (160 cells), and stay where they are (320 cells). (b) The same less
measured (smoothed over 0.03 mm).
"""

import json
import sys

import numpy as np
from _figures import BLUE, GREEN, ORANGE, ROOT, figure, letters, save

sys.path.insert(0, str(ROOT / "docs" / "data"))
import worn_scars as scars

DATA = json.loads((ROOT / "docs" / "data" / "experiments.json").read_text(encoding="utf-8"))["mccoll"]
MOVING = json.loads((ROOT / "docs" / "data" / "moving_scars.json").read_text(encoding="utf-8"))["mccoll"]
at, seen = scars.measured_scar()
element, worn = scars.columns("finite_elements")
x = np.concatenate([-np.array(DATA["x"])[::-1], DATA["x"]])
depth = np.concatenate([DATA["depth"][::-1], DATA["depth"]])
there = np.concatenate([-np.array(MOVING["x"])[::-1], MOVING["x"]])
moved = np.concatenate([MOVING["depth"][::-1], MOVING["depth"]])
drawn, (left, right) = figure(2, height=66, gridspec_kw={"width_ratios": [1.6, 1]})
left.fill_between(at, -seen, 0, color="0.88", lw=0)
left.plot(at, -seen, color="0.35", lw=0.9, label="measured")
left.plot(np.concatenate([-element[::-1], element]), -np.concatenate([worn[::-1], worn]), "s", color=ORANGE, ms=3.5,
          label="finite elements, surfaces move")  # fmt: skip
left.plot(there, -moved, color=GREEN, lw=1.4, label="computed, surfaces move")
left.plot(x, -depth, color=BLUE, lw=1.4, label="computed, surfaces stay")
left.set(xlabel="x [mm]", ylabel="surface of the flat [um]", xlim=(-0.38, 0.38), ylim=(-3.3, 2.6), yticks=range(-3, 1))
left.legend(loc="upper center", ncol=1, fontsize=6, handlelength=1.4)
smooth = np.convolve(seen, np.ones(7) / 7, mode="same")
inside = np.abs(at) < 0.3
right.axhspan(-0.2, 0.2, color="0.92", lw=0)
right.axhline(0, color="0.6", lw=0.6)
right.plot(at[inside], (np.interp(at, x, depth) - smooth)[inside], color=BLUE)
right.plot(at[inside], (np.interp(at, there, moved) - smooth)[inside], color=GREEN)
right.plot(at[inside], (np.interp(np.abs(at), element, worn, right=0) - smooth)[inside], color=ORANGE, lw=1)
right.set(xlabel="x [mm]", ylabel="too deep [um]", ylim=(-1, 1), xlim=(-0.31, 0.31))
right.text(0.3, 0.22, "roughness 0.2 um", ha="right", fontsize=6, color="0.4")
letters((left, right))
save(drawn)
