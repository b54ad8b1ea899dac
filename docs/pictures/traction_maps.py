"""Pressure, shear and slip of a coated contact at the tangential peak.

Rigid ball, R = 10 mm, on a half-space with E_s = 210 GPa, nu = 0.3, coating E_c/E_s = 2 of thickness h = a_H = 73 um,
mu = 0.3, P = 12 N, first peak Q = 0.9 mu P, 128 x 128 cells. p_H is the Hertz pressure of the uncoated contact, a_H
its radius. Arrows: direction of the shear traction on the lower body. White line: border of stick.
"""

import numpy as np
from _coated import HERTZ, MU, coated, cycle
from _figures import figure, letters, map_of, save

import fretting

history = fretting.run(
    coated(2.0, [cycle(0.9, 24, 1)], 128, output={"every": 1, "fields": ["pressure", "shear", "slip", "zone"]})
)
step = 20 + 6 - 1
p, qx, qy = (history.field(name, step) for name in ("pressure", "shear_x", "shear_y"))
slip = np.hypot(history.field("slip_x", step), history.field("slip_y", step))
stick = history.field("zone", step) == 1
drawn, panels = figure(3, height=58)
shown = [
    (np.where(p > 0, p, np.nan) / HERTZ.max_pressure, "$p / p_H$", "viridis"),
    (np.where(p > 0, np.hypot(qx, qy), np.nan) / (MU * HERTZ.max_pressure), "$|q| / \\mu p_H$", "cividis"),
    (np.where(p > 0, slip, np.nan) * 1e9, "relative slip [nm]", "magma"),
]
for axes, (values, label, colours) in zip(panels, shown, strict=True):
    image = map_of(axes, history, values, HERTZ.contact_radius, cmap=colours, vmin=0)
    drawn.colorbar(image, ax=axes, label=label, location="bottom", shrink=0.9)
    axes.contour(
        history.x / HERTZ.contact_radius,
        history.y / HERTZ.contact_radius,
        stick.T.astype(float),
        [0.5],
        colors="w",
        linewidths=0.8,
    )
    axes.set(xlabel="$x / a_H$", xticks=[-1, 0, 1], yticks=[-1, 0, 1])
some = slice(3, None, 7)
size = np.hypot(qx, qy)
u, v = (np.where(p > 0, q / np.where(size > 0, size, 1), np.nan) for q in (qx, qy))
panels[1].quiver(
    history.x[some] / HERTZ.contact_radius,
    history.y[some] / HERTZ.contact_radius,
    u[some, some].T,
    v[some, some].T,
    color="w",
    scale=28,
    width=0.006,
)
panels[0].set_ylabel("$y / a_H$")
letters(panels)
save(drawn)
