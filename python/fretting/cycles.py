"""What each fretting cycle of a history came to."""

from typing import Any

import numpy as np
import numpy.typing as npt

Columns = dict[str, npt.NDArray[Any]]

_MEANING: dict[str, tuple[type, str]] = {
    "stage": (int, "number of the stage, from 0"),
    "cycle": (int, "number of the cycle in its stage, from 1"),
    "first_increment": (int, "first increment of the cycle"),
    "last_increment": (int, "last increment of the cycle"),
    "stands_for": (int, "cycles it stands for: more than 1 where wear is extrapolated"),
    "last_cycle": (int, "number in its stage of the last cycle it stands for, from 1"),
    "dissipated_energy": (float, "work of friction in this one computed cycle [force x length]"),
    "total_dissipated_energy": (
        float,
        "work of friction since the start of the history, over all cycles that computed ones stand for [force x length]",
    ),
    "drive": (str, "tangential, or torsional"),
    "direction": (float, "direction of the tangential force's main axis, from x [rad]"),
    "force_amplitude": (float, "half the range of the force along it, or of the moment"),
    "displacement_amplitude": (float, "half the range of the shift along it, or of the twist"),
    "opening": (float, "half the width of the loop at the middle of the force's range"),
    "energy_ratio": (float, "dissipated energy over 4 force amplitude x displacement amplitude [-]"),
    "sliding_ratio": (float, "opening over displacement amplitude [-]"),
    "stiffness": (float, "slope of the loop just after reversal"),
    "regime": (str, "full_stick, partial_slip, mixed or gross_slip"),
    "closure": (float, "how far the end of the cycle is from its start, relative [-]"),
    "steady": (bool, "whether the stage ended here because the cycle closed"),
    "worn_volume": (float, "volume worn off since the start of the history [length^3]"),
    "max_worn_depth": (float, "largest worn depth after them [length]"),
}

MEANING = {name: meaning for name, (_, meaning) in _MEANING.items()}


def columns(records: list[dict[str, Any]]) -> Columns:
    """Return records of cycles as one array a name; a missing number is NaN, a missing word empty."""
    missing: dict[type, object] = {float: np.nan, str: ""}
    return {
        name: np.array([missing[kind] if record[name] is None else record[name] for record in records], dtype=kind)
        for name, (kind, _) in _MEANING.items()
    }
