"""Hertz's contact on so many cells in the contact radius: what is warned of, and whether error bars hold.

    python docs/data/reviews/few_cells.py

prints a table: the true error over the error bar, with the relative error, of a frictionless sphere in one increment on
48 x 48 cells. The references are Hertz's formulas, written here.
"""

import math
import warnings

import fretting

YOUNG, POISSON, RADIUS, CONTACT_RADIUS = 210e9, 0.3, 10e-3, 72e-6


def exact() -> dict[str, float]:
    """Return force, maximum contact pressure, approach and area of Hertz's contact of a rigid sphere."""
    modulus = YOUNG / (1 - POISSON**2)
    force = 4 * modulus * CONTACT_RADIUS**3 / (3 * RADIUS)
    area = math.pi * CONTACT_RADIUS**2
    return {"force": force, "max_pressure": 1.5 * force / area, "approach": CONTACT_RADIUS**2 / RADIUS, "area": area}


def case(radius_in_cells: float, cells: int = 48) -> dict[str, object]:
    """Return the case whose contact radius is so many cells."""
    size = cells * CONTACT_RADIUS / radius_in_cells
    return {
        "grid": {"cells": [cells, cells], "size": [size, size]},
        "upper": {"rigid": True},
        "lower": {"substrate": {"young": YOUNG, "poisson": POISSON}},
        "profile": {"sphere": {"radius": RADIUS}},
        "load": [{"normal_force": exact()["force"], "increments": 1}],
    }


def row(radius_in_cells: float) -> str:
    """Return a line of the table."""
    names = {"max_pressure": "max_pressure", "approach": "approach", "contact_area": "area"}
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", fretting.FrettingWarning)
        history = fretting.run(case(radius_in_cells), estimate_error=True)
    bars = history.error_bars["stages"][-1] if history.error_bars else {}
    parts = []
    for name, key in names.items():
        # The quantity of interest that a bar belongs to, where there is one; else the largest cell.
        found, bar = (
            (bars[name]["value"], bars[name]["error_bar"]) if bars else (float(history.increments[name][-1]), None)
        )
        error = found / exact()[key] - 1
        parts.append(
            f"no bar ({error:+.2g})" if bar is None else f"{abs(error) * exact()[key] / bar:.2f} ({error:+.1g})"
        )
    told = ", ".join(warning["name"] for warning in history.warnings) or "nothing"
    return f"| {radius_in_cells:g} | {' | '.join(parts)} | {told} |"


if __name__ == "__main__":
    print("| cells in the radius | max pressure | approach | contact area | warned of |\n|---|---|---|---|---|")
    for radius_in_cells in (0.2, 0.5, 0.8, 1.0, 1.3, 2.2, 3, 4, 5, 6, 8, 10, 16):
        print(row(radius_in_cells))
