"""Quantities of each fretting cycle of a history."""

from typing import Any

import numpy as np
import numpy.typing as npt

from fretting._meaning import CYCLE_KINDS, CYCLE_MEANING

Columns = dict[str, npt.NDArray[Any]]

MEANING = CYCLE_MEANING


def columns(records: list[dict[str, Any]]) -> Columns:
    """Return records of cycles as one array a name; a missing number is NaN, a missing word empty."""
    missing: dict[type, object] = {float: np.nan, str: ""}
    return {
        name: np.array([missing[kind] if record[name] is None else record[name] for record in records], dtype=kind)
        for name, kind in CYCLE_KINDS.items()
    }
