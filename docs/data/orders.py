"""Order in the increments of histories of every kind: errors against the limit of many increments, by both rules."""

from collections.abc import Callable
from typing import Any

import numpy as np

import fretting

RADIUS = 100.0
MODULUS = 1 / (1 - 0.3**2)
FORCE = 4 * MODULUS / (3 * RADIUS)  # contact radius 1
LINE_FORCE = np.pi * MODULUS / (4 * RADIUS)  # half-width 1
MU = 0.3
COUNTS = (8, 16, 32, 64)
FINEST = 512


def _sphere(stages: list[dict[str, Any]], cells: int = 32, **more: Any) -> dict[str, Any]:
    """Return a rigid sphere on a coated body, indented before the stages."""
    coating = {"thickness": 1.0, "young": 2.0, "poisson": 0.3}
    return {
        "grid": {"cells": [cells, cells], "size": [2.6, 2.6]},
        "upper": {"rigid": True},
        "lower": {"coatings": [coating], "substrate": {"young": 1.0, "poisson": 0.3}},
        "profile": {"sphere": {"radius": RADIUS}},
        "friction": {"coefficient": MU},
        "load": [{"normal_force": FORCE, "increments": 40, "ramp": "cubic"}, *stages],
        "output": {"fields": []},
        **more,
    }


def _line(periodic: bool) -> Callable[[int], dict[str, Any]]:
    def case(count: int) -> dict[str, Any]:
        # A period of four half-widths, of which cells along y repeat: the line contact as a periodic case.
        grid = {"cells": [128, 4], "size": [4.0, 0.125], "periodic": True} if periodic else {"cells": 128, "size": 2.6}
        per = 0.125 if periodic else 1.0
        pull = 0.7 * MU * LINE_FORCE * per
        return {
            "grid": grid,
            "upper": {"rigid": True},
            "lower": {"substrate": {"young": 1.0, "poisson": 0.3}},
            "profile": {"cylinder": {"radius": RADIUS, "axis": "y"}},
            "friction": {"coefficient": MU},
            "load": [
                {"normal_force": LINE_FORCE * per, "increments": 40, "ramp": "cubic"},
                {"tangential_force": [pull, 0.0], "increments": count, "cycles": 1},
            ],
            "output": {"fields": []},
        }

    return case


def _friction_map(count: int) -> dict[str, Any]:
    at = (np.arange(32) + 0.5) / 32 * 2.6 - 1.3
    varying = MU * (1 + 0.5 * np.sin(2 * at[:, None]) * np.cos(at[None, :]))
    return _sphere([_pull(0.5, count)], friction={"map": varying})


def _pull(share: float, count: int, **more: Any) -> dict[str, Any]:
    return {"tangential_force": [share * MU * FORCE, 0.0], "increments": count, "cycles": 1, **more}


def _rotating(count: int) -> dict[str, Any]:
    share = 0.6 * MU * FORCE
    turn = {"tangential_force": [share, share], "phase": {"tangential_force": [90, 0]}, "waveform": "sine"}
    return _sphere([{"tangential_force": [share, 0.0], "increments": 8}, {**turn, "increments": count, "cycles": 1}])


def _out_of_phase(count: int) -> dict[str, Any]:
    cycle = _pull(0.4, count, waveform="sine", phase={"normal_force": 90})
    return _sphere([{**cycle, "normal_force": 0.3 * FORCE}])


def _torsion_with_pull(count: int) -> dict[str, Any]:
    twist = {"twist_moment": 0.15 * MU * FORCE, "phase": {"twist_moment": 90}, "waveform": "sine"}
    return _sphere([_pull(0.4, count, **twist)])


HISTORIES: dict[str, tuple[Callable[[int], dict[str, Any]], str]] = {
    "loop": (lambda count: _sphere([_pull(0.7, count)]), "dissipated_energy"),
    "rotating force": (_rotating, "dissipated_energy"),
    "torsion and force out of phase": (_torsion_with_pull, "dissipated_energy"),
    "normal and tangential force out of phase": (_out_of_phase, "dissipated_energy"),
    "wear": (
        lambda count: _sphere([_pull(0.7, count)], wear={"coefficient": 0.3}),
        "worn_volume",
    ),
    "friction map": (_friction_map, "dissipated_energy"),
    "line contact": (_line(periodic=False), "dissipated_energy"),
    "line contact in a period": (_line(periodic=True), "dissipated_energy"),
}


def orders() -> dict[str, Any]:
    """Return for every history the errors of a quantity of its cycle by both rules."""
    rows = []
    for name, (case, column) in HISTORIES.items():

        def value(count: int, integration: str, case: Any = case, column: str = column) -> tuple[float, int]:
            question = case(count)
            history = fretting.run({**question, "solver": {"integration": integration}})
            steps = history.increments
            before = int(np.count_nonzero(steps["stage"] < steps["stage"][-1]))
            return float(steps[column][-1] - steps[column][before - 1]), int(steps["convolutions"][before:].sum())

        limit, _ = value(FINEST, "second_order")
        row: dict[str, Any] = {"history": name, "quantity": column, "limit": limit}
        for integration in ("end_point", "second_order"):
            found = [value(count, integration) for count in COUNTS]
            errors = [abs(one / limit - 1) for one, _ in found]
            row[integration] = {
                "errors": errors,
                "order": float(np.log2(errors[0] / errors[-1]) / np.log2(COUNTS[-1] / COUNTS[0])),
                "convolutions": [count for _, count in found],
            }
        rows.append(row)
        print(row)
    return {"counts": COUNTS, "finest": FINEST, "rows": rows}
