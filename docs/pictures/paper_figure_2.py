"""Shear traction through a fretting loop of elastically similar bodies.

Identical half-spaces in contact with a sphere, nu = 0 (for which the closed form is exact), mu = 0.1, constant normal
force P, amplitude of the tangential force 0.92 mu P, 128 x 128 cells. Thin lines: computed, along x through the
centre; thick grey lines: Cattaneo, Mindlin and Deresiewicz. Shown between the second zero of Q and the next peak and
back; a_H and p_H are the Hertz values.
"""

import numpy as np
from _figures import figure, middle, save
from _paper import case, hertz

import fretting

shown = case("paper_figure_2.toml")
for body in ("upper", "lower"):
    if "substrate" in shown[body]:
        shown[body]["substrate"]["poisson"] = 0.0
radius, peak = hertz(shown)
history = fretting.run(shown)
friction, force = shown["friction"]["coefficient"], shown["load"][0]["normal_force"]
amplitude = shown["load"][1]["tangential_force"][0]
x = np.linspace(-1.05, 1.05, 801) * radius


def cap(c: float) -> np.ndarray:
    """Return a semi-elliptic traction over a circle of radius c."""
    return friction * peak * np.sqrt(np.maximum(c * c - x * x, 0.0)) / radius


def exact(step: int) -> np.ndarray:
    """Closed form on the way down (steps 20 to 60) and up again."""
    tangential = history.increments["tangential_force_x"][step]
    sign = 1 if step <= 60 else -1
    c0 = radius * (1 - amplitude / (friction * force)) ** (1 / 3)
    c1 = radius * (1 - (amplitude - sign * tangential) / (2 * friction * force)) ** (1 / 3)
    return -sign * (cap(radius) - 2 * cap(c1) + cap(c0))


drawn, axes = figure(height=75, wide=False)
names = {40: "unloading", 50: "unloading", 60: "minimum", 70: "reloading", 80: "reloading"}
for step, branch in names.items():
    ratio = history.increments["tangential_force_x"][step] / (friction * force)
    ratio = 0.0 if abs(ratio) < 0.005 else ratio
    axes.plot(x / radius, exact(step) / peak, color="0.8", lw=3.5, zorder=1)
    axes.plot(
        history.x / radius, middle(history, "shear_x", step) / peak, lw=1, label=f"$Q/\\mu P$ = {ratio:.2f}, {branch}"
    )
axes.set(xlabel="$x / a_H$", ylabel="$q_x / p_H$", xlim=(-1.1, 1.1))
drawn.legend(loc="outside lower center", ncols=2)
save(drawn)
