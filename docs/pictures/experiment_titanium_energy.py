"""Test matrix of Ti-6Al-4V: pressures, energies and wear per energy.

Fouvry, Arnaud, Mignot and Neubauer (2017), Appendix A, nine tests at constant normal force: cylinder R = 10 to 80 mm on
a flat, 67 to 1066 N/mm, sliding +-75 um. (a) Maximum contact pressure: computed over printed. (b) Friction coefficient
that the printed dissipated energy implies by the energy computed with 0.6, a loop of the same half-width at zero force;
grey: the published range of Q/P. (c) Wear volume over dissipated energy at the lowest and the highest frequency.
"""

import json

import numpy as np
from _figures import BLUE, ORANGE, ROOT, figure, letters, save

DATA = json.loads((ROOT / "docs" / "data" / "experiments.json").read_text(encoding="utf-8"))["fouvry_2017"]["rows"]
names = [row["test"] for row in DATA]
places = np.arange(len(names))
drawn, (a, b, c) = figure(3, height=62, gridspec_kw={"width_ratios": [1.2, 1.2, 0.7]})
a.plot(places, [row["program_pressure"] / row["pressure_MPa"] for row in DATA], "o", color=BLUE)
a.axhline(1, color="0.6", lw=0.6)
a.set(ylabel="pressure, computed / printed", ylim=(0.97, 1.03))
b.axhspan(0.60, 0.65, color="0.9", lw=0)
b.plot(places, [row["implied_friction"] for row in DATA], "o", color=ORANGE)
b.set(ylabel="friction implied by the energy", ylim=(0.35, 0.8))
for axes in (a, b):
    axes.set(xlim=(-0.6, len(names) - 0.4))
    axes.set_xticks(places, names, rotation=90)
worn = sorted((row["frequency_Hz"], row["volume_mm3"] / row["energy_J"]) for row in DATA if "volume_mm3" in row)
c.bar([0, 1], [1e4 * value for _, value in worn], width=0.5, color=[BLUE, ORANGE])
c.set_xticks([0, 1], [f"{frequency:g} Hz" for frequency, _ in worn])
c.set(ylabel=r"volume / energy [$10^{-4}$ mm$^3$/J]", xlim=(-0.6, 1.6))
letters((a, b, c))
save(drawn)
