"""Depth of a scar in a hard coating over its volume, and what the stroke changes.

Fouvry, Paulin and Liskiewicz (2007): alumina ball, R = 12.7 mm, on TiC (1.6 um), 100 N, displacement +-50 and +-100 um.
Lines: closed form, the flat worn by a rigid, unworn ball that moves +-s. Computed: elastic ball and coating, surfaces
stay (s = 0), 48 x 48 cells; squares: surfaces move by +-50 and +-100 um, 64 cells across. Circles: measured depths at
the end, before and after the coating spalled; that they belong to the largest volume is assumed.
"""

import json
import sys

import numpy as np
from _figures import BLACK, BLUE, GREEN, ORANGE, ROOT, SKY, figure, save

sys.path.insert(0, str(ROOT / "docs" / "data"))
import worn_scars as scars

DATA = json.loads((ROOT / "docs" / "data" / "experiments.json").read_text(encoding="utf-8"))["fouvry_2007"]
MOVING = json.loads((ROOT / "docs" / "data" / "moving_scars.json").read_text(encoding="utf-8"))["fouvry_2007"]
volumes = np.linspace(0.0, 12.0, 80)[1:]
drawn, axes = figure(1, height=66, wide=False)
for stroke, colour in ((0.0, BLUE), (0.05, GREEN), (0.1, ORANGE)):
    depths = [1e3 * scars.ball_depth(volume * 1e-5, 12.7, stroke) for volume in volumes]
    axes.plot(volumes, depths, color=colour, label=f"rigid, s = {1e3 * stroke:.0f} um")
path = sorted([*((row["volume"], row["depth"]) for row in DATA["path"]), (DATA["computed_volume"], DATA["computed"])])
axes.plot([v / 1e4 for v, _ in path], [d for _, d in path], "D-", color=SKY, ms=4, label="computed, elastic, s = 0")
at = DATA["volume"] / 1e4
for row, colour in zip(MOVING, (GREEN, ORANGE), strict=True):
    axes.plot(at, row["depth"], "s", color=colour, ms=4, label=f"computed, elastic, s = {row['stroke']:.0f} um")
axes.plot(at, DATA["measured"]["before_spalling"], "o", color=BLACK, ms=5, label="measured, before spalling")
axes.plot([at] * 2, DATA["measured"]["after_spalling"], "o", color=BLACK, mfc="white", ms=5, label="after spalling")
axes.axhline(1.6, color="0.6", lw=0.7, ls=":")
axes.text(0.1, 1.62, "coating thickness", fontsize=6, color="0.4", va="bottom")
axes.set(xlabel=r"wear volume [$10^4$ um$^3$]", ylabel="depth [um]", xlim=(0, 12), ylim=(0, 1.9))
axes.legend(loc="lower right", fontsize=6)
save(drawn)
