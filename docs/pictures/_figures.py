"""What the scripts of the figures share: sizes, colours, maps, and where a figure goes."""

import os
import sys
from pathlib import Path
from typing import Any

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np

HERE = Path(__file__).parent
ROOT = HERE.parents[1]
FOLDER = Path(os.environ.get("FRETTING_PICTURES", HERE))
plt.style.use(HERE / "style.mplstyle")

MM = 1 / 25.4
WIDE, NARROW = 170 * MM, 85 * MM
"""Widths of a figure over two columns and over one [inch]."""
BLUE, ORANGE, GREEN, PINK, YELLOW, SKY, BLACK = plt.rcParams["axes.prop_cycle"].by_key()["color"]
BLUE, ORANGE, GREEN, PINK, YELLOW, SKY, BLACK = (
    f"#{c.lstrip('#')}" for c in (BLUE, ORANGE, GREEN, PINK, YELLOW, SKY, BLACK)
)
OPEN_COLOUR, STICK_COLOUR, SLIP_COLOUR = "#f2f2f2", BLUE, YELLOW


def figure(columns: int = 1, rows: int = 1, height: float = 60.0, wide: bool = True, **more: Any) -> tuple[Any, Any]:
    """Return a figure of `height` [mm] and its axes."""
    return plt.subplots(rows, columns, figsize=(WIDE if wide else NARROW, height * MM), **more)


def save(drawn: Any) -> None:
    """Write a figure as the PNG that is named like the script that draws it."""
    name = Path(sys.argv[0]).stem
    drawn.savefig(FOLDER / f"{name}.png")
    plt.close(drawn)


def letters(panels: Any) -> None:
    """Name panels (a), (b), ... at their upper left corner."""
    for letter, axes in zip("abcdefgh", np.ravel(panels), strict=False):
        axes.set_title(f"({letter})", loc="left", fontweight="bold", fontsize=8)


def zones(axes: Any, history: Any, step: int, unit: float) -> None:
    """Draw the zones of an increment over x and y in units of a length."""
    colours = matplotlib.colors.ListedColormap([OPEN_COLOUR, STICK_COLOUR, SLIP_COLOUR])
    map_of(axes, history, history.field("zone", step), unit, cmap=colours, vmin=-0.5, vmax=2.5)


def zone_legend(target: Any, **more: Any) -> None:
    """Name the colours of the zones."""
    entries = (("stick", STICK_COLOUR), ("slip", SLIP_COLOUR), ("open", OPEN_COLOUR))
    patches = [matplotlib.patches.Patch(facecolor=c, edgecolor="0.6", lw=0.5, label=name) for name, c in entries]
    target.legend(handles=patches, **more)


def map_of(axes: Any, history: Any, values: Any, unit: float, **more: Any) -> Any:
    """Draw a field over x and y in units of a length."""
    (x0, x1), (y0, y1) = (
        (c[0] - (c[1] - c[0]) / 2, c[-1] + (c[1] - c[0]) / 2) for c in (history.x / unit, history.y / unit)
    )
    image = axes.imshow(values.T, origin="lower", extent=(x0, x1, y0, y1), interpolation="nearest", **more)
    axes.set_aspect("equal")
    axes.spines[["right", "top"]].set_visible(True)
    return image


def middle(history: Any, name: str, step: int = -1) -> Any:
    """Return a field along x through the middle: mean of the two middle rows."""
    values = history.field(name, step)
    half = values.shape[1] // 2
    return 0.5 * (values[:, half - 1] + values[:, half])
