"""Quantities of each fretting cycle of a history."""

from typing import Any

import numpy as np
import numpy.typing as npt

Columns = dict[str, npt.NDArray[Any]]

_MEANING: dict[str, tuple[type, str]] = {
    "stage": (int, "number of the stage, from 0"),
    "cycle": (int, "number of the cycle in its stage, from 1"),
    "first_increment": (int, "first increment of the cycle"),
    "last_increment": (int, "last increment of the cycle"),
    "stands_for": (int, "cycles it represents: more than 1 with cycle jumps"),
    "last_cycle": (int, "number in its stage of the last cycle it represents, from 1"),
    "dissipated_energy": (float, "dissipated energy W_d of this simulated cycle [force x length]"),
    "total_dissipated_energy": (
        float,
        "dissipated energy since the start of the history, including the cycles represented by cycle jumps [force x length]",
    ),
    "drive": (str, "tangential, or torsional"),
    "direction": (float, "direction of the tangential force's main axis, from x [rad]"),
    "force_amplitude": (float, "Q*: half the range of the force along it, or of the moment"),
    "displacement_amplitude": (float, "delta*: half the range of the relative displacement along it, or of the twist"),
    "opening": (float, "delta_0: loop half-width at the middle of the force range"),
    "energy_ratio": (float, "A = W_d / (4 Q* delta*) [-]"),
    "sliding_ratio": (float, "D = delta_0 / delta* [-]"),
    "stiffness": (float, "slope of the loop directly after reversal"),
    "regime": (str, "sliding condition: full_stick, partial_slip, mixed or gross_slip"),
    "closure": (float, "cycle-to-cycle change of tractions, forces and motions, relative [-]"),
    "steady": (bool, "whether the stage ended here because the cycle is steady"),
    "worn_volume": (float, "wear volume since the start of the history [length^3]"),
    "max_worn_depth": (float, "maximum wear depth after the cycle [length]"),
}

MEANING = {name: meaning for name, (_, meaning) in _MEANING.items()}


def columns(records: list[dict[str, Any]]) -> Columns:
    """Return records of cycles as one array a name; a missing number is NaN, a missing word empty."""
    missing: dict[type, object] = {float: np.nan, str: ""}
    return {
        name: np.array([missing[kind] if record[name] is None else record[name] for record in records], dtype=kind)
        for name, (kind, _) in _MEANING.items()
    }
