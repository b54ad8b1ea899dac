"""Temperature rise by friction and contact resistance of a history."""

import json
from typing import TYPE_CHECKING, Any, Literal

import numpy as np

from fretting import _core, _dataset
from fretting._meaning import described
from fretting.stress import on_grid

if TYPE_CHECKING:
    import xarray

    from fretting.history import History

FIELDS = {
    "heat": "heat of friction, mean over the cycle [power/area]",
    "heat_into_lower": "heat that goes into the lower body [power/area]",
    "rise_lower": "temperature rise of the lower surface",
    "rise_upper": "temperature rise of the upper surface",
}


def temperature(history: "History", cycle: int, frequency: float | None, threads: int | None) -> "xarray.Dataset":
    """Return temperature rises: see :meth:`fretting.History.temperature`."""
    module = _dataset.module("temperature")
    if frequency is None:
        frequency = (history.plan["case"].get("conduction") or {}).get("frequency")
        if frequency is None:
            raise ValueError("temperature: the case has no [thermal] frequency; give frequency=...")
    if not (np.isfinite(frequency) and frequency > 0.0):
        raise ValueError(f"frequency = {frequency}: must be positive and finite")
    if history.plan["case"]["friction"].get("max_shear") is not None:
        raise ValueError("temperature: heat by friction under friction.max_shear, a shear strength, is not computed")
    if _dataset.rolls(history, cycle):
        raise ValueError(
            "temperature: the contact rolls, and the heat of a cycle is taken to enter both bodies in the same places"
        )
    first, last = _dataset.span(history, cycle)
    increments = []
    if first == 0:
        none = np.zeros((len(history.x), len(history.y)))
        increments.append((none, (none, none), (none, none)))
    for number in range(max(first - 1, 0), last + 1):
        pressure, *parts = (
            on_grid(history, history.field(name, number))
            for name in ("pressure", "shear_x", "shear_y", "slip_x", "slip_y")
        )
        increments.append((pressure, (parts[0], parts[1]), (parts[2], parts[3])))
    loading = float(history.cycles["dissipated_energy"][cycle]), float(frequency)
    answer = _core.surface_temperature(json.dumps(history.plan), increments, loading, threads)
    variables: dict[str, Any] = {
        name: (("y", "x"), answer[name].T, described(meaning, history.units))
        for name, meaning in FIELDS.items()
        if name in answer
    }
    attributes = {"frequency": frequency, "increments": [first, last], "kept_fields_account_for": answer["accounted"]}
    dataset: xarray.Dataset = module.Dataset(variables, coords=_dataset.axes(history), attrs=attributes)
    return dataset


def contact_resistance(
    history: "History", increment: int, kind: Literal["electrical", "thermal"], threads: int | None
) -> float:
    """Return the resistance of the contact: see :meth:`fretting.History.contact_resistance`."""
    pressure = on_grid(history, history.field("pressure", increment))
    return _core.contact_resistance(json.dumps(history.plan), kind == "thermal", pressure, threads)
