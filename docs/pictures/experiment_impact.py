"""Oblique impact of an alumina ball on glass: measured and computed.

Kharaz, Gorham and Salman (2001): d = 5 mm, E = 380 GPa, nu = 0.23, on glass, E = 70 GPa, nu = 0.25; mu = 0.092,
3.9 m/s, no spin before; nothing fitted. Angles from the normal. (a) Tangential velocity of the centre after over
before. (b) Spin after. (c) Rebound angle less that of a mirror. Computed: forces of the program, 48 x 48
cells, 160 increments, the ball's motion integrated around it. Uncoupled theory: method of dimensionality reduction.
Bars: 0.02 and 7 %, the scatter of the three measured quantities against conservation of momentum; the source states no
uncertainty.
"""

import json
import sys

import numpy as np
from _figures import BLACK, BLUE, ORANGE, ROOT, figure, letters, save

sys.path.insert(0, str(ROOT / "docs" / "data"))
import oblique_impact as impact

DATA = json.loads((ROOT / "docs" / "data" / "experiments.json").read_text(encoding="utf-8"))["kharaz"]
angles = np.concatenate([np.linspace(0.5, 24, 40), np.linspace(25, 64, 20)])
theory = [impact.uncoupled(angle, springs=200, steps=2500)[0] for angle in angles]
stiff = [impact.rigid(angle) for angle in angles]
ours = sorted((row["angle"], row["tangential"]) for name in (*impact.GIVEN, "between") for row in DATA[name])
drawn, panels = figure(3, height=66)
a, b, c = panels


def spin(angle: float, restitution: float) -> float:
    """Return the spin that goes with a restitution."""
    return 2.5 * impact.SPEED * np.sin(np.radians(angle)) * (1 - restitution) / impact.RADIUS


def turned(angle: float, restitution: float) -> float:
    """Return rebound angle less angle of incidence, for no loss of normal velocity."""
    return float(np.degrees(np.arctan(restitution * np.tan(np.radians(angle))))) - angle


rows = {name: np.array([(row["angle"], row["measured"]) for row in DATA[name]]).T for name in impact.GIVEN}
a.errorbar(*rows["tangential_restitution"], yerr=0.02, fmt="o", color=BLACK, ms=4, lw=0.7, capsize=2, label="measured")
b.errorbar(*rows["spin"], yerr=0.07 * rows["spin"][1], fmt="o", color=BLACK, ms=4, lw=0.7, capsize=2)
c.plot(rows["rebound_angle"][0], rows["rebound_angle"][1] - rows["rebound_angle"][0], "o", color=BLACK, ms=4)
x, restitution = np.array(ours).T
for axes, form in ((a, lambda _, e: e), (b, spin), (c, turned)):
    axes.plot(angles, [form(q, t.tangential) for q, t in zip(angles, theory, strict=True)], color=ORANGE, lw=1,
              label="uncoupled theory")  # fmt: skip
    axes.plot(angles, [form(q, t.tangential) for q, t in zip(angles, stiff, strict=True)], color="0.6", lw=0.9, ls="--",
              label="rigid ball")  # fmt: skip
    axes.plot(x, [form(q, e) for q, e in ours], ".-", color=BLUE, lw=1.2, ms=4, label="computed")
    axes.set(xlabel="angle of incidence [deg]", xlim=(0, 65), xticks=range(0, 61, 15))
a.set(ylabel="tangential restitution", ylim=(0.5, 1.05))
handles, names = a.get_legend_handles_labels()
order = [names.index(name) for name in ("measured", "computed", "uncoupled theory", "rigid ball")]
a.legend([handles[i] for i in order], [names[i] for i in order], loc="upper left", fontsize=6)
b.set(ylabel="spin [rad/s]", ylim=(0, 750))
c.set(ylabel="rebound angle less incidence [deg]")
letters(panels)
save(drawn)
