"""What each fretting cycle of a history came to."""

from collections.abc import Sequence
from typing import Any

import numpy as np
import numpy.typing as npt

from fretting._arrays import Reals

Columns = dict[str, npt.NDArray[Any]]

MEANING = {
    "stage": "number of the stage, from 0",
    "cycle": "number of the cycle in its stage, from 1",
    "first": "first increment of the cycle",
    "last": "last increment of the cycle",
    "energy": "work of friction in the cycle [force x length]",
    "force_amplitude": "half the span of the tangential force [force]",
    "shift_amplitude": "half the span of the shift [length]",
    "energy_ratio": "energy over 4 force amplitude x shift amplitude [-]; 0: no slip, towards 1: gross slip",
    "least_stick_share": "smallest share of the contact area that sticks [-]",
    "regime": "gross_slip when any increment slips fully, else partial_slip when any slips, else full_stick",
}


def cycles(steps: Columns, lengths: Sequence[int | None]) -> Columns:
    """Return the quantities of :data:`MEANING`, one entry a full cycle.

    `steps` are the columns of a history; `lengths` holds the increments of a cycle of each stage, ``None`` for a stage
    without cycles. Forces and shifts are vectors: the span of a path is the diagonal of the box around it, which is its
    length where the path is straight.
    """
    spans = [
        (stage, number + 1, rows[number * length : (number + 1) * length])
        for stage, length in enumerate(lengths)
        if length
        for rows in [np.flatnonzero(steps["stage"] == stage)]
        for number in range(len(rows) // length)
    ]
    answers = [_cycle(steps, stage, number, rows) for stage, number, rows in spans]
    types: dict[str, Any] = {
        "stage": np.int64,
        "cycle": np.int64,
        "first": np.int64,
        "last": np.int64,
        "regime": np.dtype("<U12"),
    }
    return {
        name: np.asarray([answer[name] for answer in answers], dtype=types.get(name, np.float64)) for name in MEANING
    }


def _cycle(steps: Columns, stage: int, number: int, rows: npt.NDArray[np.int64]) -> dict[str, Any]:
    # The state that the cycle starts from belongs to its loop.
    path = np.concatenate([rows[:1] - 1, rows]) if rows[0] > 0 else rows
    energy = steps["dissipated_energy"]
    spent = float(energy[rows[-1]] - (energy[rows[0] - 1] if rows[0] > 0 else 0.0))
    force = _half_span(steps["tangential_force_x"][path], steps["tangential_force_y"][path])
    shift = _half_span(steps["shift_x"][path], steps["shift_y"][path])
    box = 4.0 * force * shift
    area = steps["contact_area"][rows]
    touching = area > 0.0
    shares = steps["stick_area"][rows][touching] / area[touching]
    return {
        "stage": stage,
        "cycle": number,
        "first": rows[0],
        "last": rows[-1],
        "energy": spent,
        "force_amplitude": force,
        "shift_amplitude": shift,
        "energy_ratio": spent / box if box > 0.0 else 0.0,
        "least_stick_share": float(shares.min()) if shares.size else 0.0,
        "regime": _worst(set(steps["regime"][rows].tolist())),
    }


def _half_span(x: Reals, y: Reals) -> float:
    return 0.5 * float(np.hypot(np.ptp(x), np.ptp(y)))


def _worst(regimes: set[str]) -> str:
    for regime in ("gross_slip", "partial_slip", "full_stick", "frictionless"):
        if regime in regimes:
            return regime
    return "apart"
