"""What moving surfaces cost beside surfaces that stay: operator applications per increment, and time."""

import time
import warnings
from typing import Any

import fretting

STEEL = {"young": 200e3, "poisson": 0.3}


def cylinder(stroke: float) -> dict[str, Any]:
    """Return McColl's cylinder on a flat, three computed cycles with wear."""
    return {
        "grid": {"cells": 160, "size": 0.7, "datum": 6.0},
        "upper": {"substrate": {**STEEL, "wear_coefficient": 1.9e-8}},
        "lower": {"substrate": {**STEEL, "wear_coefficient": 2.9e-8}},
        "profile": {"cylinder": {"radius": 6.0, "axis": "y"}},
        "friction": {"coefficient": 0.9},
        "wear": {"law": "archard", "every": 3},
        "load": [
            {"normal_force": 18.5, "increments": 8, "ramp": "square"},
            {"shift": [stroke, 0.0], "cycles": 9, "increments": 16},
        ],
        "output": {"fields": []},
    }


def ball(stroke: float) -> dict[str, Any]:
    """Return a rigid ball on a coated flat, coupled, two cycles of 32 increments without wear."""
    return {
        "grid": {"cells": [64, 64], "size": [0.64, 0.64]},
        "upper": {"rigid": True},
        "lower": {
            "coatings": [{"thickness": 2e-3, "young": 300e3, "poisson": 0.22}],
            "substrate": {"young": 210e3, "poisson": 0.3},
        },
        "profile": {"sphere": {"radius": 10.0}},
        "friction": {"coefficient": 0.3},
        "load": [
            {"normal_force": 100.0, "increments": 8, "ramp": "cubic"},
            {"shift": [stroke, 0.0], "cycles": 2, "increments": 32},
        ],
        "output": {"fields": []},
    }


CASES = [
    ("coated ball, partial slip, +-1 um", ball(1e-3)),
    ("coated ball, gross slip, +-100 um", ball(0.1)),
    ("cylinder, partial slip, +-0.2 um", cylinder(2e-4)),
    ("cylinder, gross slip, +-25 um", cylinder(0.025)),
]


def moving_cost() -> dict[str, Any]:
    """Run each case with surfaces that stay and with surfaces that move, one thread, the least time of three."""
    rows = []
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", fretting.FrettingWarning)
        for name, case in CASES:
            row: dict[str, Any] = {"case": name}
            for displacement in ("small", "finite"):
                times = []
                for _ in range(3):
                    started = time.process_time()
                    history = fretting.run({**case, "kinematics": {"displacement": displacement}}, threads=1)
                    times.append(time.process_time() - started)
                of_cycles = history.increments["stage"] == 1
                row[displacement] = {
                    "applications": float(history.increments["convolutions"][of_cycles].mean()),
                    "of_whole_grid": float(history.increments["full_grid_convolutions"][of_cycles].mean()),
                    "seconds": min(times),
                }
                row["increments"] = int(of_cycles.sum())
            rows.append(row)
            print(row, flush=True)
    return {"rows": rows}
