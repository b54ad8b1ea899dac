"""The drawing of the contact problem."""

from typing import Any

import numpy as np
from _figures import BLACK, BLUE, ORANGE

GREY, COAT, BASE = "#d9d9d9", "#b9d3e8", "#e8e0d2"


def arrow(
    axes: Any, start: tuple[float, float], end: tuple[float, float], text: str, at: tuple[float, float], **more: Any
) -> None:
    """Draw an arrow with its name."""
    style = {
        "arrowstyle": "-|>",
        "lw": 1.2,
        "color": more.pop("color", BLACK),
        "shrinkA": 0,
        "shrinkB": 0,
        "mutation_scale": 8,
    }
    axes.annotate("", xy=end, xytext=start, arrowprops=style)
    axes.text(*at, text, color=style["color"], ha="center", va="center", **more)


def contact(axes: Any, labels: bool = True) -> None:
    """Draw a ball on a coated half-space with forces, motions and axes; the overlap is exaggerated."""
    edge, radius, depth = 1.0, 1.55, 1.15
    x = np.linspace(-2.6, 2.6, 800)
    r = np.maximum(abs(x), edge)
    outside = ((2 - r**2) * np.arcsin(1 / r) + np.sqrt(r**2 - 1)) / (np.pi * radius)  # Hertz, a = 1
    surface = -np.where(abs(x) < edge, (1 - x**2 / 2) / radius, outside)
    ball = -1 / radius + x**2 / (2 * radius)
    axes.fill_between(x, surface, -depth, color=COAT, lw=0)
    axes.fill_between(x, -depth, -2.0, color=BASE, lw=0)
    axes.plot(x, surface, color=BLACK, lw=1)
    axes.plot(x, np.full_like(x, -depth), color=BLACK, lw=0.6)
    inside = ball < 1.35
    axes.fill_between(x[inside], ball[inside], 1.35, color=GREY, lw=0)
    axes.plot(x[inside], ball[inside], color=BLACK, lw=1)
    axes.plot([-edge, edge], [-0.5 / radius] * 2, "|", color=BLUE, ms=7, mew=1.4)
    arrow(axes, (0, 1.75), (0, 0.75), "$P,\\ \\delta_n$", (0.5, 1.55))
    arrow(axes, (-1.15, 0.85), (-0.25, 0.85), "$Q,\\ \\delta$", (-0.72, 1.07), color=ORANGE)
    arrow(axes, (-2.45, -1.85), (-1.75, -1.85), "$x$", (-1.6, -1.85))
    arrow(axes, (-2.45, -1.25), (-2.45, -1.92), "$z$", (-2.25, -1.45))
    ends = {"arrowstyle": "<|-|>", "lw": 0.8, "shrinkA": 0, "shrinkB": 0, "mutation_scale": 6}
    axes.annotate(
        "", xy=(1.95, surface[np.searchsorted(x, 1.95)]), xytext=(1.95, -depth), arrowprops={**ends, "color": BLACK}
    )
    axes.text(2.1, -0.65, "$h$", va="center")
    axes.annotate("", xy=(-edge, -0.86), xytext=(edge, -0.86), arrowprops={**ends, "color": BLUE})
    axes.text(0.0, -1.0, "$2a$", ha="center", va="center", color=BLUE, fontsize=7)
    axes.text(-1.72, -0.72, "$E_c, \\nu_c$", ha="center", va="center", fontsize=7)
    axes.text(0.0, -1.55, "substrate $E_s, \\nu_s$", ha="center", va="center", fontsize=7)
    axes.text(0.55, 0.25, "radius $R$", ha="center", va="center", fontsize=7)
    if labels:
        axes.text(2.35, 0.12, "gap $g$", ha="center", va="center", fontsize=7)
        axes.annotate("", xy=(1.6, 0.02), xytext=(2.05, 0.1), arrowprops={"arrowstyle": "-", "lw": 0.5, "color": BLACK})
    axes.set(xlim=(-2.65, 2.65), ylim=(-2.02, 1.8), aspect="equal")
    axes.axis("off")
