"""Maximum contact pressure and contact radius of a coated half-space.

Rigid sphere of radius 10 mm on a coated half-space, frictionless. E_s = 210 GPa (substrate), nu = 0.3 everywhere,
coating thickness h = a_H, 128 x 128 cells. Pressure along x through the centre, relative to the Hertz values a_H = 0.1
mm and p_H of the uncoated substrate under the same force of 30.8 N. Dots: edge of contact of an axisymmetric solution
of the integral equation.
"""

import json

import numpy as np
from _figures import ROOT, figure, middle, save
from _paper import case, hertz

import fretting

rows = json.loads((ROOT / "tests/golden" / "coated_sphere.json").read_text(encoding="utf-8"))["rows"]
drawn, axes = figure(height=75, wide=False)
shown = case("paper_figure_1.toml")
radius, peak = hertz(shown)
r = np.linspace(-1, 1, 400)
axes.plot(r, np.sqrt(1 - r**2), color="0.75", lw=4, label="Hertz, uncoated")
for ratio, label in [(0.25, "1/4"), (0.5, "1/2"), (1, "1"), (2, "2"), (4, "4")]:
    shown["lower"]["coatings"][0]["young"] = ratio * shown["lower"]["substrate"]["young"]
    history = fretting.run(shown)
    pressure = middle(history, "pressure") / peak
    (line,) = axes.plot(history.x / radius, pressure, label=f"$E_c/E_s$ = {label}")
    edge = next(
        row["a"] for row in rows if row["h"] == 1.0 and row["young_ratio"] == ratio and row["poisson_coating"] == 0.3
    )
    axes.plot([-edge, edge], [0, 0], "o", color=line.get_color(), clip_on=False, zorder=5)
axes.set(xlabel="$x / a_H$", ylabel="$p / p_H$", xlim=(-1.5, 1.5), ylim=(0, None))
drawn.legend(loc="outside lower center", ncols=3)
save(drawn)
